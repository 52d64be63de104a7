//! The parameters of a vehicle: read from a file, validated once, plain numbers from then on.
//!
//! [`VehicleFile`] mirrors the TOML schema, every number with its source; [`Vehicle`] is the same without the sources,
//! in SI units, with every number checked. A model takes from a [`Vehicle`] what it needs, and asks for the
//! optional groups by name ([`Vehicle::require_motor`] and its like), so that a vehicle without a motor model flies at the
//! levels that need none and is refused, with both names, by those that do.
//!
//! Nothing here reads a disk: who knows the path hands over the text and the file's name.

mod accessors;
pub mod builtin;
mod convert;
pub mod derive;
mod error;
pub mod file;
mod limits;
mod map;
#[cfg(test)]
mod tests;
pub mod uncertain;
mod validate;

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

pub use error::VehicleError;
pub use file::{Sourced, VehicleFile};
pub use uncertain::UncertainVehicle;

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

/// A quadrotor's parameters, SI units throughout; over another scalar than f64 where they are differentiated.
///
/// The fields are open: a study changes what it likes and may call [`Vehicle::validate`] again.
#[derive(Debug, Clone, PartialEq)]
pub struct Vehicle<R = f64> {
    /// Name, as legends and messages print it.
    pub name: String,
    /// What it is and where its numbers come from as a whole.
    pub description: String,
    /// Where it flies.
    pub environment: Environment<R>,
    /// Rigid body.
    pub airframe: Airframe<R>,
    /// The four rotors in the order of the commands; on a '+' layout 1 rear, 2 front, 3 left, 4 right.
    pub rotors: [RotorMount<R>; 4],
    /// Range of the raw PWM command.
    pub pwm: PwmRange<R>,
    /// Linear rotor, levels 1 to 4.
    pub linear_rotor: LinearRotorParameters<R>,
    /// Transfer functions of the empirical rotor, levels 4 and 5.
    pub rotor_dynamics: Option<RotorDynamicsParameters<R>>,
    /// Static polynomials of the empirical rotor, level 5.
    pub polynomial_rotor: Option<PolynomialRotorParameters<R>>,
    /// Propeller: mechanistic rotor, and rotor speed from thrust.
    pub propeller: Option<PropellerParameters<R>>,
    /// Motor and speed controller: mechanistic rotor.
    pub motor: Option<MotorParameters<R>>,
    /// Battery.
    pub battery: Option<BatteryParameters<R>>,
    /// Drag and rate damping of the airframe.
    pub drag: Option<DragParameters<R>>,
    /// Arms under the rotors.
    pub arms: Option<ArmParameters<R>>,
}

/// Where a vehicle flies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Environment<R = f64> {
    /// Gravitational acceleration g, m/s², along `+z_W` (down).
    pub gravity: R,
    /// Air density ρ, kg/m³.
    pub air_density: R,
}

/// The rigid body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Airframe<R = f64> {
    /// Mass m, kg.
    pub mass: R,
    /// Inertia matrix I about the centre of mass in body axes B (forward, right, down), kg·m².
    pub inertia: Matrix3<R>,
    /// Arm length L from the geometric centre to a hub, m; scales the lateral and longitudinal pseudo-inputs.
    pub arm_length: R,
    /// Centre of mass in the airframe's geometric frame, body axes, m.
    pub centre_of_mass: Vector3<R>,
}

/// Where a rotor sits and how it turns.
#[derive(Debug, Clone, PartialEq)]
pub struct RotorMount<R = f64> {
    /// Name of the place, as in `rear`.
    pub name: String,
    /// Hub position r relative to the centre of mass, in B, m.
    pub position: Vector3<R>,
    /// Sense of rotation seen from above.
    pub spin: Spin,
}

/// Range of the raw PWM command ū, a duty without unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PwmRange<R = f64> {
    /// Lower end ū_min, where the controller applies no voltage.
    pub minimum: R,
    /// Upper end ū_max.
    pub maximum: R,
    /// Zero-thrust value ū_0: where the linear rotor's line meets zero thrust. Zeroed command `u = ū − ū_0`.
    pub zero_thrust: R,
}

/// Linear rotor `T = K_T u`, `Q = K_Q u` with bandwidth ω_R.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearRotorParameters<R = f64> {
    /// Thrust gain K_T, N per unit of zeroed duty; thrust along `−z_B`, positive up.
    pub thrust_gain: R,
    /// Torque gain K_Q, N·m per unit of zeroed duty; positive against the spin.
    pub torque_gain: R,
    /// Bandwidth ω_R of thrust and torque, rad/s.
    pub bandwidth: R,
}

/// Transfer functions from the static to the actual thrust and torque.
///
/// Thrust `c_T2 / (s² + c_T1 s + c_T2)`, reaction torque on the airframe `(c_Q1 s + c_Q2) / (s² + c_Q3 s + c_Q4)` with
/// `c_Q2 = c_Q4`. The torque is what a bench measures, aerodynamic plus spin-up `Q + I_R dΩ/dt`; hence its zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RotorDynamicsParameters<R = f64> {
    /// c_T1, 1/s.
    pub thrust_c1: R,
    /// c_T2, 1/s².
    pub thrust_c2: R,
    /// c_Q1, 1/s; 0 if the zero is absent.
    pub torque_c1: R,
    /// c_Q2, 1/s².
    pub torque_c2: R,
    /// c_Q3, 1/s.
    pub torque_c3: R,
    /// c_Q4, 1/s².
    pub torque_c4: R,
}

/// Static thrust and torque as polynomials `k_1 x + k_2 x² + k_3 x³` in the effective motor voltage `x = (ū − ū_min) V_b`.
///
/// x is in volts with the duty as it is; it is not yet the voltage at the motor, which is `x / full_voltage_duty`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PolynomialRotorParameters<R = f64> {
    /// Thrust terms k_1 in N/V, k_2 in N/V², k_3 in N/V³.
    pub thrust: [R; 3],
    /// Torque terms k_1 in N·m/V, k_2 in N·m/V², k_3 in N·m/V³.
    pub torque: [R; 3],
}

/// Propeller `T = C_T ρ n² D⁴`, `Q = C_Q ρ n² D⁵`, n in revolutions per second.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PropellerParameters<R = f64> {
    /// Diameter D, m.
    pub diameter: R,
    /// Static thrust coefficient C_T.
    pub thrust_coefficient: R,
    /// Static torque coefficient `C_Q = C_P / 2π`.
    pub torque_coefficient: R,
}

/// Brushless motor with its speed controller.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotorParameters<R = f64> {
    /// Velocity constant K_v, rad/s per volt; the torque constant is `1/K_v`.
    pub velocity_constant: R,
    /// Resistance of motor and controller R, Ω.
    pub resistance: R,
    /// No-load current I_0, A.
    pub no_load_current: R,
    /// Inertia of propeller and bell about the spin axis I_R, kg·m².
    pub rotor_inertia: R,
    /// Time constant of the speed controller τ_ESC, s.
    pub controller_lag: R,
    /// Duty above ū_min at which the whole battery voltage is applied: `V_eff = (ū − ū_min) / full_voltage_duty · V_b`.
    pub full_voltage_duty: R,
}

/// Battery with internal resistance and exponential zone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BatteryParameters<R = f64> {
    /// Nominal voltage, V: the constant voltage of models without sag.
    pub nominal_voltage: R,
    /// Open-circuit voltage when full, V.
    pub full_voltage: R,
    /// Internal resistance, Ω.
    pub internal_resistance: R,
    /// Capacity, A·h.
    pub capacity: R,
    /// Amplitude of the exponential zone A, V.
    pub exponential_amplitude: R,
    /// Rate of the exponential zone B, 1/(A·h).
    pub exponential_rate: R,
}

/// Drag of the airframe, against the air-relative velocity and the body rates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DragParameters<R = f64> {
    /// Quadratic coefficients per body axis, N·s²/m²: `F_i = −k_i |v_i| v_i`.
    pub quadratic: Vector3<R>,
    /// Rate damping per body axis, N·m·s: `M_i = −d_i ω_i`.
    pub rate_damping: Vector3<R>,
}

/// The arms, each of which runs in from its hub under half of the rotor's disc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArmParameters<R = f64> {
    /// Width across the slipstream, m.
    pub width: R,
    /// Drag coefficient C_D on the width, dimensionless.
    pub drag_coefficient: R,
    /// Distance below the rotor disc, m.
    pub drop: R,
}
