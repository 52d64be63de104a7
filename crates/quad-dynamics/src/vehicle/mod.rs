//! The parameters of a vehicle: read from a file, validated once, plain numbers from then on.
//!
//! A vehicle is one type, generic in what stands in a number's place: [`VehicleFile`] has numbers with sources and standard
//! errors, [`Vehicle`] plain `f64` in SI units with every number checked, `Vehicle<Dual64>` numbers that are differentiated. Each
//! group of numbers is one struct, and one list in [`groups`](Entry) says of each of its numbers the key, the unit and the range.
//! Whatever concerns all numbers (reading, writing, checking, another scalar, uncertainty, identification, a scenario's parameters)
//! visits that list ([`Vehicle::map_numbers`], [`Vehicle::for_each_number_mut`]).
//!
//! A model takes from a [`Vehicle`] what it needs, and asks for the optional groups by name ([`Vehicle::require_motor`] and its
//! like), so that a vehicle without a motor model flies at the levels that need none and is refused, with both names, by those
//! that do.
//!
//! Nothing here reads a disk: who knows the path hands over the text and the file's name.

mod accessors;
pub mod builtin;
pub mod derive;
mod error;
mod file;
mod groups;
mod read;
#[cfg(test)]
mod tests;
pub mod uncertain;
mod validate;

use nalgebra::{Matrix3, Vector3};
use quad_rotor::{Cubic, Motor, RotorDynamics};
use serde::{Deserialize, Serialize};

use crate::{Drag, PerRotor};

pub use error::VehicleError;
pub use groups::Entry;
pub use provenance::Sourced;
pub use uncertain::UncertainVehicle;

/// A vehicle file as it is written: every number with its source.
pub type VehicleFile = Vehicle<Sourced<f64>>;

/// Sense of rotation of a rotor, seen from above.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Spin {
    /// Clockwise seen from above: positive about `z_B` (down), `s = +1`.
    Clockwise,
    /// Counter-clockwise seen from above: negative about `z_B`, `s = −1`.
    CounterClockwise,
}

impl Spin {
    /// Spin sense s about `z_B`: +1 clockwise, −1 counter-clockwise seen from above.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::Clockwise => 1.0,
            Self::CounterClockwise => -1.0,
        }
    }
}

/// A quadrotor's parameters, SI units throughout; generic in what stands in a number's place.
///
/// The fields are open: a study changes what it likes and may call [`Vehicle::validate`] again.
#[derive(Debug, Clone, PartialEq)]
pub struct Vehicle<N = f64> {
    /// Name, as legends and messages print it.
    pub name: String,
    /// What it is and where its numbers come from as a whole.
    pub description: String,
    /// Where it flies.
    pub environment: Environment<N>,
    /// Rigid body.
    pub airframe: Airframe<N>,
    /// The four rotors in the order of the commands; on a '+' layout 1 rear, 2 front, 3 left, 4 right.
    pub rotors: PerRotor<RotorMount<N>>,
    /// Range of the raw PWM command.
    pub pwm: PwmRange<N>,
    /// Linear rotor, levels 1 to 4.
    pub linear_rotor: LinearRotorParameters<N>,
    /// Transfer functions of the empirical rotor, levels 4 and 5.
    pub rotor_dynamics: Option<RotorDynamics<N>>,
    /// Static polynomials of the empirical rotor, level 5.
    pub polynomial_rotor: Option<PolynomialRotorParameters<N>>,
    /// Propeller: mechanistic rotor, and rotor speed from thrust.
    pub propeller: Option<PropellerParameters<N>>,
    /// Motor and speed controller: mechanistic rotor.
    pub motor: Option<Motor<N>>,
    /// Battery.
    pub battery: Option<BatteryParameters<N>>,
    /// Drag and rate damping of the airframe.
    pub drag: Option<Drag<N>>,
    /// Arms under the rotors.
    pub arms: Option<ArmParameters<N>>,
}

/// Where a vehicle flies.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Environment<N = f64> {
    /// Gravitational acceleration g, m/s², along `+z_W` (down).
    pub gravity: N,
    /// Air density ρ, kg/m³.
    pub air_density: N,
}

/// The rigid body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Airframe<N = f64> {
    /// Mass m, kg.
    pub mass: N,
    /// Inertia matrix I about the centre of mass in body axes B (forward, right, down), kg·m²; off the diagonal `−∫xy dm`.
    pub inertia: Matrix3<N>,
    /// Arm length L from the geometric centre to a hub, m; scales the lateral and longitudinal pseudo-inputs.
    pub arm_length: N,
    /// Centre of mass in the airframe's geometric frame, body axes, m.
    pub centre_of_mass: Vector3<N>,
}

/// Where a rotor sits and how it turns.
#[derive(Debug, Clone, PartialEq)]
pub struct RotorMount<N = f64> {
    /// Name of the place, as in `rear`.
    pub name: String,
    /// Hub in the airframe's geometric frame, body axes, m; relative to the centre of mass: [`Vehicle::hubs`].
    pub hub_position: Vector3<N>,
    /// Sense of rotation seen from above.
    pub spin: Spin,
}

/// Range of the raw PWM command ū, a duty without unit.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PwmRange<N = f64> {
    /// Lower end ū_min, where the controller applies no voltage.
    pub minimum: N,
    /// Upper end ū_max.
    pub maximum: N,
    /// Zero-thrust value ū_0: where the linear rotor's line meets zero thrust. Zeroed command `u = ū − ū_0`.
    pub zero_thrust: N,
}

/// Linear rotor `T = K_T u`, `Q = K_Q u` with bandwidth ω_R.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LinearRotorParameters<N = f64> {
    /// Thrust gain K_T, N per unit of zeroed duty; thrust along `−z_B`, positive up.
    pub thrust_gain: N,
    /// Torque gain K_Q, N·m per unit of zeroed duty; positive against the spin.
    pub torque_gain: N,
    /// Bandwidth ω_R of thrust and torque, rad/s.
    pub bandwidth: N,
}

/// Static thrust and torque as polynomials `k_1 x + k_2 x² + k_3 x³` in the effective motor voltage `x = (ū − ū_min) V_b`.
///
/// x is in volts with the duty as it is; it is not yet the voltage at the motor, which is `x / full_voltage_duty`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PolynomialRotorParameters<N = f64> {
    /// Thrust terms k_1 in N/V, k_2 in N/V², k_3 in N/V³.
    pub thrust: Cubic<N>,
    /// Torque terms k_1 in N·m/V, k_2 in N·m/V², k_3 in N·m/V³.
    pub torque: Cubic<N>,
}

/// Propeller `T = C_T ρ n² D⁴`, `Q = C_Q ρ n² D⁵`, n in revolutions per second.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PropellerParameters<N = f64> {
    /// Diameter D, m.
    pub diameter: N,
    /// Static thrust coefficient C_T, dimensionless.
    pub thrust_coefficient: N,
    /// Static torque coefficient `C_Q = C_P / 2π`, dimensionless.
    pub torque_coefficient: N,
}

/// Battery with internal resistance and exponential zone.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct BatteryParameters<N = f64> {
    /// Nominal voltage, V: the constant voltage of models without sag.
    pub nominal_voltage: N,
    /// Open-circuit voltage when full, V.
    pub full_voltage: N,
    /// Internal resistance, Ω.
    pub internal_resistance: N,
    /// Capacity, A·h.
    pub capacity: N,
    /// Amplitude of the exponential zone A, V.
    pub exponential_amplitude: N,
    /// Rate of the exponential zone B, 1/(A·h).
    pub exponential_rate: N,
}

/// The arms, each of which runs in from its hub under half of the rotor's disc.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ArmParameters<N = f64> {
    /// Width across the slipstream, m.
    pub width: N,
    /// Drag coefficient C_D on the width, dimensionless.
    pub drag_coefficient: N,
    /// Distance below the rotor disc, m.
    pub drop: N,
}
