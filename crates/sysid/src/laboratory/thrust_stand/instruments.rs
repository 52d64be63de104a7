//! The stand's instruments, and how much one rotor differs from the next.

use super::StandError;
use crate::laboratory::{Generator, Sensor};
use crate::rotor_dynamics::DynamicSample;
use crate::rotor_static::StaticSample;
use quad_rotor::{MechanisticRotor, Motor, Propeller};
use rand_distr::{Distribution, StandardNormal};
use serde::{Deserialize, Serialize};

/// The four sensors of a thrust stand. Duty and time are known exactly: the stand's own computer makes them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Instruments {
    /// Thrust, N.
    pub thrust: Sensor,
    /// Reaction torque, N m.
    pub torque: Sensor,
    /// Rotor speed, rad/s.
    pub speed: Sensor,
    /// Supply voltage, V.
    pub voltage: Sensor,
}

/// A small stand, tared: load cells of 20 N and 0.5 N m with noise of 0.15 % of the range and 24-bit converters read to
/// their last stable digit, an optical tachometer, a 10-bit voltmeter.
impl Default for Instruments {
    fn default() -> Self {
        Self {
            thrust: Sensor {
                noise: 0.03,
                bias: 0.0,
                quantum: 0.005,
                minimum: -20.0,
                maximum: 20.0,
            },
            torque: Sensor {
                noise: 7.5e-4,
                bias: 0.0,
                quantum: 1e-4,
                minimum: -0.5,
                maximum: 0.5,
            },
            speed: Sensor {
                noise: 0.5,
                bias: 0.0,
                quantum: 0.1,
                minimum: 0.0,
                maximum: 2000.0,
            },
            voltage: Sensor {
                noise: 0.01,
                bias: 0.0,
                quantum: 0.02,
                minimum: 0.0,
                maximum: 20.0,
            },
        }
    }
}

impl Instruments {
    /// Instruments that tell the truth.
    pub const PERFECT: Self = Self {
        thrust: Sensor::PERFECT,
        torque: Sensor::PERFECT,
        speed: Sensor::PERFECT,
        voltage: Sensor::PERFECT,
    };

    pub(super) fn validate(&self) -> Result<(), StandError> {
        let named = [
            ("thrust", &self.thrust),
            ("torque", &self.torque),
            ("speed", &self.speed),
            ("voltage", &self.voltage),
        ];
        for (instrument, sensor) in named {
            sensor
                .validate()
                .map_err(|source| StandError::Sensor { instrument, source })?;
        }
        Ok(())
    }

    pub(super) fn read(&self, truth: &DynamicSample, generator: &mut Generator) -> DynamicSample {
        DynamicSample {
            battery_voltage_v: self.voltage.read(truth.battery_voltage_v, generator),
            thrust_n: self.thrust.read(truth.thrust_n, generator),
            torque_n_m: self.torque.read(truth.torque_n_m, generator),
            speed_rad_s: self.speed.read(truth.speed_rad_s, generator),
            ..*truth
        }
    }

    /// The mean of several readings.
    pub(super) fn steady(
        &self,
        truth: &DynamicSample,
        readings: usize,
        generator: &mut Generator,
    ) -> StaticSample {
        let all: Vec<DynamicSample> = (0..readings).map(|_| self.read(truth, generator)).collect();
        let mean = |f: fn(&DynamicSample) -> f64| all.iter().map(f).sum::<f64>() / readings as f64;
        StaticSample {
            duty: truth.duty,
            battery_voltage_v: mean(|s| s.battery_voltage_v),
            thrust_n: mean(|s| s.thrust_n),
            torque_n_m: mean(|s| s.torque_n_m),
            speed_rad_s: mean(|s| s.speed_rad_s),
        }
    }
}

/// Relative standard deviations of rotors of one kind from each other.
///
/// Assumptions: hobby-grade motors and moulded propellers, a few percent.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RotorSpread {
    /// Of the speed constant `K_v`.
    pub velocity_constant: f64,
    /// Of the resistance R.
    pub resistance: f64,
    /// Of the thrust constant.
    pub thrust: f64,
    /// Of the torque constant.
    pub torque: f64,
    /// Of the rotor's inertia.
    pub inertia: f64,
}

impl Default for RotorSpread {
    fn default() -> Self {
        Self {
            velocity_constant: 0.01,
            resistance: 0.03,
            thrust: 0.015,
            torque: 0.015,
            inertia: 0.02,
        }
    }
}

impl RotorSpread {
    /// A rotor that differs from the nominal one at random.
    pub fn applied(
        &self,
        nominal: &MechanisticRotor<f64>,
        generator: &mut Generator,
    ) -> MechanisticRotor<f64> {
        // Normal deviates beyond three deviations are cut, so that no constant changes its sign.
        let mut factor = |deviation: f64| {
            let normal: f64 = StandardNormal.sample(generator);
            1.0 + deviation * normal.clamp(-3.0, 3.0)
        };
        MechanisticRotor {
            propeller: Propeller {
                thrust_per_speed_squared: nominal.propeller.thrust_per_speed_squared * factor(self.thrust),
                torque_per_speed_squared: nominal.propeller.torque_per_speed_squared * factor(self.torque),
            },
            motor: Motor {
                velocity_constant: nominal.motor.velocity_constant * factor(self.velocity_constant),
                resistance: nominal.motor.resistance * factor(self.resistance),
                rotor_inertia: nominal.motor.rotor_inertia * factor(self.inertia),
                ..nominal.motor
            },
            ..*nominal
        }
    }
}
