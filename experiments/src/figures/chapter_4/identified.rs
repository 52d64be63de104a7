//! The static models that the stand gives of one rotor, and the vehicle that flies with them.

use crate::item::ItemError;
use crate::rotor_bench::panels::Characterisation;
use crate::rotor_bench::{RotorBench, TestedRotor};
use quad_dynamics::Vehicle;
use quad_dynamics::vehicle::PolynomialRotorParameters;
use sysid::rotor_static::{LinearGains, Quantity, StaticSample, linear_gains};

/// What the stand says of one rotor.
pub(super) struct Found {
    /// Readings over the operating range.
    pub(super) samples: Vec<StaticSample>,
    pub(super) gains: LinearGains,
    pub(super) polynomials: Characterisation,
    /// Duty, raw, at which the cubic carries a quarter of the weight.
    pub(super) hover_duty: f64,
    minimum_duty: f64,
}

impl Found {
    /// From the tests of a rotor.
    pub(super) fn of(bench: &RotorBench, vehicle: &Vehicle, rotor: &TestedRotor) -> Result<Self, ItemError> {
        let samples = bench.operating(vehicle, rotor)?;
        let polynomials = bench.characterise(rotor)?;
        let x = polynomials
            .cubic(Quantity::Thrust)
            .inverse(vehicle.hover_thrust_per_rotor());
        Ok(Self {
            gains: linear_gains(&samples)?,
            samples,
            polynomials,
            hover_duty: rotor.stand.minimum_duty + x / bench.nominal_voltage_v,
            minimum_duty: rotor.stand.minimum_duty,
        })
    }

    /// The vehicle with the rotor parameters that were found, in place of its file's.
    pub(super) fn applied(&self, vehicle: &Vehicle) -> Vehicle {
        let mut vehicle = vehicle.clone();
        vehicle.linear_rotor.thrust_gain = self.gains.thrust_gain.value;
        vehicle.linear_rotor.torque_gain = self.gains.torque_gain.value;
        vehicle.pwm.zero_thrust = self.gains.zero_thrust.value;
        vehicle.polynomial_rotor = Some(PolynomialRotorParameters {
            thrust: self.polynomials.cubic(Quantity::Thrust),
            torque: self.polynomials.cubic(Quantity::Torque),
        });
        vehicle
    }

    /// Value of the line and of the cubic at a raw duty, in N or N m.
    pub(super) fn models(&self, bench: &RotorBench, quantity: Quantity, duty: f64) -> [f64; 2] {
        let x = (duty - self.minimum_duty) * bench.nominal_voltage_v;
        let gain = match quantity {
            Quantity::Thrust => self.gains.thrust_gain.value,
            Quantity::Torque => self.gains.torque_gain.value,
        };
        let line = gain * (duty - self.gains.zero_thrust.value);
        [line, self.polynomials.cubic(quantity).value(x)]
    }
}
