//! The rotors and supplies of the family, from a vehicle's parameters.

use crate::BuildError;
use crate::family::{FamilyRotor, FamilySupply};
use crate::vehicle::Vehicle;
use quad_math::{Real, constant};
use quad_rotor::{
    Battery, BatteryState, ConstantVoltage, FirstOrderRotor, IdealRotor, LinearRotor, MechanisticRotor,
    NonLinearRotor, Propeller, ResponseState, RotorDynamics, RotorOutput, Sag, SpinState, ThrustState,
};

pub(super) fn zero_thrust_offset<R: Real>(vehicle: &Vehicle<R>) -> R {
    vehicle.pwm.zero_thrust - vehicle.pwm.minimum
}

pub(super) fn propeller<R: Real>(
    vehicle: &Vehicle<R>,
    needed_by: &'static str,
) -> Result<Propeller<R>, BuildError> {
    Ok(vehicle
        .require_propeller(needed_by)?
        .law(vehicle.environment.air_density))
}

pub(super) fn ideal<R: Real>(vehicle: &Vehicle<R>) -> IdealRotor<R> {
    let gains = &vehicle.linear_rotor;
    IdealRotor {
        thrust_gain: gains.thrust_gain,
        torque_gain: gains.torque_gain,
    }
}

/// The constant supply of levels 1 to 4, whose rotors don't look at the voltage: nominal, or 1 V where
/// the vehicle names no battery.
pub(super) fn stiff<R: Real>(vehicle: &Vehicle<R>) -> ConstantVoltage<R> {
    ConstantVoltage {
        voltage: vehicle.battery.as_ref().map_or(R::one(), |b| b.nominal_voltage),
    }
}

fn battery<R: Real>(
    vehicle: &Vehicle<R>,
    sag: bool,
    needed_by: &'static str,
) -> Result<Battery<R>, BuildError> {
    let b = vehicle.require_battery(needed_by)?;
    let sag = sag.then_some(Sag {
        full_voltage: b.full_voltage,
        internal_resistance: b.internal_resistance,
        exponential_amplitude: b.exponential_amplitude,
        exponential_rate: b.exponential_rate,
    });
    Ok(Battery {
        nominal_voltage: b.nominal_voltage,
        sag,
    })
}

fn dynamics<R: Real>(vehicle: &Vehicle<R>, needed_by: &'static str) -> Result<RotorDynamics<R>, BuildError> {
    Ok(*vehicle.require_rotor_dynamics(needed_by)?)
}

/// Upper end of the polynomials' variable, V: full duty on the full battery, or on the nominal one.
fn polynomial_range_end<R: Real>(vehicle: &Vehicle<R>) -> R {
    let duty = vehicle.pwm.maximum - vehicle.pwm.minimum;
    duty * vehicle
        .battery
        .as_ref()
        .map_or(R::one(), |b| b.full_voltage.simd_max(b.nominal_voltage))
}

/// A rotor's bandwidth as a scale for rates of thrust and torque, 1/s: the order of a small motor's.
const RATE_SCALE: f64 = 20.0;

/// Scale of the charge drawn, Ah: small against the charge over which a full battery's voltage falls (1/B = 0.03 Ah), below
/// which the discharge curve is no curve.
const CHARGE_SCALE_AH: f64 = 0.01;

/// Natural sizes of a [`ResponseState`]: thrust and torque in hover, and their rates.
fn response_scales<R: Real>(hover: &RotorOutput<R>) -> Vec<R> {
    let rate: R = constant(RATE_SCALE);
    let (thrust, torque) = (hover.thrust, hover.torque);
    vec![thrust, rate * thrust, torque, rate * torque]
}

/// The sum of a response's two poles, which is more than the quicker one; of thrust or torque.
fn fastest_response<R: Real>(dynamics: &RotorDynamics<R>) -> R {
    dynamics.thrust_c1.simd_max(dynamics.torque_c3)
}

impl<R: Real> FamilyRotor<R> for IdealRotor<R> {
    type Supply = ConstantVoltage<R>;
    type OverF64 = IdealRotor<f64>;
    const NAME: &'static str = "level 2";
    const FEELS_VOLTAGE: bool = false;

    fn of(vehicle: &Vehicle<R>) -> Result<Self, BuildError> {
        Ok(ideal(vehicle))
    }

    fn supply(vehicle: &Vehicle<R>, _sag: bool) -> Result<ConstantVoltage<R>, BuildError> {
        Ok(stiff(vehicle))
    }

    fn state_scales(_hover: &(), _output: &RotorOutput<R>) -> Vec<R> {
        Vec::new()
    }

    fn fastest_pole(&self, _hover: &()) -> R {
        R::zero()
    }
}

impl<R: Real> FamilyRotor<R> for FirstOrderRotor<R> {
    type Supply = ConstantVoltage<R>;
    type OverF64 = FirstOrderRotor<f64>;
    const NAME: &'static str = "level 3";
    const FEELS_VOLTAGE: bool = false;

    fn of(vehicle: &Vehicle<R>) -> Result<Self, BuildError> {
        let gains = &vehicle.linear_rotor;
        Ok(Self {
            thrust_gain: gains.thrust_gain,
            torque_per_thrust: gains.torque_gain / gains.thrust_gain,
            bandwidth: gains.bandwidth,
        })
    }

    fn supply(vehicle: &Vehicle<R>, _sag: bool) -> Result<ConstantVoltage<R>, BuildError> {
        Ok(stiff(vehicle))
    }

    #[inline(always)]
    fn measured_thrusts(rotors: &[ThrustState<R>; 4]) -> Option<[R; 4]> {
        Some(rotors.map(|r| r.thrust))
    }

    fn state_scales(_hover: &ThrustState<R>, output: &RotorOutput<R>) -> Vec<R> {
        vec![output.thrust]
    }

    fn fastest_pole(&self, _hover: &ThrustState<R>) -> R {
        self.bandwidth
    }
}

impl<R: Real> FamilyRotor<R> for LinearRotor<R> {
    type Supply = ConstantVoltage<R>;
    type OverF64 = LinearRotor<f64>;
    const NAME: &'static str = "level 4";
    const FEELS_VOLTAGE: bool = false;

    fn of(vehicle: &Vehicle<R>) -> Result<Self, BuildError> {
        let IdealRotor {
            thrust_gain,
            torque_gain,
        } = ideal(vehicle);
        Ok(Self {
            thrust_gain,
            torque_gain,
            dynamics: dynamics(vehicle, Self::NAME)?,
        })
    }

    fn supply(vehicle: &Vehicle<R>, _sag: bool) -> Result<ConstantVoltage<R>, BuildError> {
        Ok(stiff(vehicle))
    }

    fn state_scales(_hover: &ResponseState<R>, output: &RotorOutput<R>) -> Vec<R> {
        response_scales(output)
    }

    fn fastest_pole(&self, _hover: &ResponseState<R>) -> R {
        fastest_response(&self.dynamics)
    }
}

impl<R: Real> FamilyRotor<R> for NonLinearRotor<R> {
    type Supply = Battery<R>;
    type OverF64 = NonLinearRotor<f64>;
    const NAME: &'static str = "level 5";
    const FEELS_VOLTAGE: bool = true;

    fn of(vehicle: &Vehicle<R>) -> Result<Self, BuildError> {
        let polynomial = vehicle.require_polynomial_rotor(Self::NAME)?;
        Ok(Self {
            thrust: polynomial.thrust,
            torque: polynomial.torque,
            range_end: polynomial_range_end(vehicle),
            zero_thrust_offset: zero_thrust_offset(vehicle),
            dynamics: dynamics(vehicle, Self::NAME)?,
        })
    }

    fn supply(vehicle: &Vehicle<R>, sag: bool) -> Result<Battery<R>, BuildError> {
        battery(vehicle, sag, Self::NAME)
    }

    fn state_scales(_hover: &ResponseState<R>, output: &RotorOutput<R>) -> Vec<R> {
        response_scales(output)
    }

    fn fastest_pole(&self, _hover: &ResponseState<R>) -> R {
        fastest_response(&self.dynamics)
    }
}

impl<R: Real> FamilyRotor<R> for MechanisticRotor<R> {
    type Supply = Battery<R>;
    type OverF64 = MechanisticRotor<f64>;
    const NAME: &'static str = "the mechanistic vehicle";
    const FEELS_VOLTAGE: bool = true;

    fn of(vehicle: &Vehicle<R>) -> Result<Self, BuildError> {
        let needed_by = Self::NAME;
        Ok(Self {
            propeller: propeller(vehicle, needed_by)?,
            motor: *vehicle.require_motor(needed_by)?,
            zero_thrust_offset: zero_thrust_offset(vehicle),
        })
    }

    fn supply(vehicle: &Vehicle<R>, sag: bool) -> Result<Battery<R>, BuildError> {
        battery(vehicle, sag, Self::NAME)
    }

    fn state_scales(hover: &SpinState<R>, _output: &RotorOutput<R>) -> Vec<R> {
        vec![hover.speed, hover.effective_voltage]
    }

    fn fastest_pole(&self, hover: &SpinState<R>) -> R {
        self.bandwidth(hover.speed)
            .simd_max(R::one() / self.motor.controller_lag)
    }
}

/// The charge drawn is the battery's state.
impl<R: Real> FamilySupply<R> for Battery<R> {
    const IS_BATTERY: bool = true;

    fn charge_drawn(state: &BatteryState<R>) -> Option<R> {
        Some(state.charge_drawn)
    }

    fn with_charge_drawn(charge_drawn: Option<R>) -> BatteryState<R> {
        BatteryState {
            charge_drawn: charge_drawn.unwrap_or_else(R::zero),
        }
    }

    fn state_scales() -> Vec<R> {
        vec![constant(CHARGE_SCALE_AH)]
    }
}

/// A stiff supply has no charge to remember.
impl<R: Real> FamilySupply<R> for ConstantVoltage<R> {
    const IS_BATTERY: bool = false;

    fn charge_drawn((): &()) -> Option<R> {
        None
    }

    fn with_charge_drawn(_charge_drawn: Option<R>) {}

    fn state_scales() -> Vec<R> {
        Vec::new()
    }
}
