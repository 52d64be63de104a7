//! Propeller, motor, battery, and five models of one rotor at rising resolution.
//!
//! | model | steady state | dynamics | level |
//! | --- | --- | --- | --- |
//! | [`IdealRotor`] | `T = K_T u`, `Q = K_Q u` | none | 1, 2 |
//! | [`FirstOrderRotor`] | the same gains | `Ṫ = ω_R (K_T u − T)` | 3 |
//! | [`LinearRotor`] | the same gains | identified transfer functions | 4 |
//! | [`NonLinearRotor`] | polynomials in command and voltage | as level 4 | 5 |
//! | [`MechanisticRotor`] | `T = k_T Ω²`, `Q = k_Q Ω²` | motor equations in Ω | the 'truth' behind 4 and 5 |
//!
//! A rotor gives thrust `T` (N, along `−z_B`, positive up) and reaction torque `Q` (N m, positive against
//! its spin). It is driven by the command `u = ū − ū_0`, the offset of the duty from zero thrust, and the battery voltage.
//!
//! ```
//! use quad_rotor::{FirstOrderRotor, RotorInput, RotorModel, ThrustState};
//!
//! let rotor = FirstOrderRotor { thrust_gain: 120.0, torque_per_thrust: 1.0 / 30.0, bandwidth: 15.0 };
//! let input = RotorInput { command: 0.03, voltage: 11.1 };
//! let rate = rotor.derivative(&ThrustState { thrust: 0.0 }, &input);
//! let expected: f64 = 15.0 * 120.0 * 0.03;
//! assert!((rate.thrust - expected).abs() < 1e-12);
//! ```

mod battery;
mod empirical;
mod model;
mod motor;
mod propeller;
mod simple;
pub mod tables;
#[cfg(test)]
mod tests;

pub use battery::{Battery, BatteryRate, BatteryState, ConstantVoltage, Sag, Supply};
pub use empirical::{Cubic, LinearRotor, NonLinearRotor, ResponseRate, ResponseState, RotorDynamics};
pub use model::{RotorInput, RotorModel, RotorOutput, SpinUp};
pub use motor::{MechanisticRotor, Motor, SpinRate, SpinState};
pub use propeller::Propeller;
pub use simple::{FirstOrderRotor, IdealRotor, ThrustRate, ThrustState};

/// The README's example is tested with the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
