//! The quadrotor model family: one rigid body in two formalisms, five levels of resolution.
//!
//! Each level is a system `ẋ = f(x, u)` over any scalar ([`quad_math::Real`]). Pick it by type
//! ([`Level1`] to [`Level5`], or [`MechanisticQuadrotor`], the 'truth' behind levels 4 and 5) or by value
//! ([`AnyQuadrotor`]); both offer the same ([`QuadrotorModel`]).
//!
//! | level | rigid body | rotor | phenomena of its own | states |
//! | --- | --- | --- | --- | --- |
//! | [`Level1`] | linear about hover at the present heading | ideal, `T = K_T u` | | 12 |
//! | [`Level2`] | Newton-Euler, quaternion | ideal | | 13 |
//! | [`Level3`] | as 2 | first order, `Ṫ = ω_R (K_T u − T)` | | 17 |
//! | [`Level4`] | as 2 | identified transfer functions | drag, gyroscopic torque | 29 |
//! | [`Level5`] | as 2 | polynomials in PWM and voltage, then as 4 | + input limits, voltage sag | 30 |
//! | [`MechanisticQuadrotor`] | as 2 | motor and propeller, states `Ω`, `V` | as given | 22 |
//!
//! Besides rigid body and rotors a model has a set of phenomena ([`PhenomenonSet`]), each switched on and off
//! separately; [`Level::phenomena`] is the level's own set. Each declares what it needs ([`Prerequisite`]); a
//! model without that is rejected. Turbulence, wind shear and process noise act from outside: their physics is
//! here and takes its random numbers as arguments, the engine draws them.
//!
//! ```
//! use nalgebra::Vector3;
//! use quad_dynamics::{Level, Level3, QuadrotorModel, Vehicle};
//! use quad_math::rk4_step;
//!
//! let vehicle = Vehicle::qball_x4(); // or Vehicle::from_toml_str(&text, "my.toml")?
//! let model = Level3::<f64>::build(&vehicle, &Level::Three.phenomena())?;
//! let hover = model.hover(Vector3::zeros(), 0.0);
//!
//! // Ten per cent more thrust on rotor 3, left: the right side goes down.
//! let mut input = hover.input;
//! input.commands[2] *= 1.1;
//! let mut state = hover.state;
//! for _ in 0..200 {
//!     state = rk4_step(&model, &state, &input, 0.001);
//! }
//! let flight = model.flight(&state);
//! assert!(flight.attitude.roll > 0.0 && flight.position.y > 0.0);
//! # Ok::<(), quad_dynamics::BuildError>(())
//! ```
//!
//! # Where to find an equation
//!
//! | equation | code | source |
//! | --- | --- | --- |
//! | `m (v̇ + ω × v) = F`, `I ω̇ + ω × I ω = M` | [`RigidBody::derivative`] | thesis 3.3.1, D.1 |
//! | Euler-Lagrange, translation, inertial velocities | [`RigidBody::lagrange_inertial_acceleration`] | 3.3.2, D.2 |
//! | Euler-Lagrange, translation, body velocities | [`RigidBody::lagrange_body_velocity_rate`] | 3.3.2, D.2 |
//! | Euler-Lagrange, rotation, `M(η) η̈ + C(η, η̇) η̇ = J⁻ᵀ M_B` | [`RigidBody::lagrange_euler_acceleration`] | 3.3.2, D.2 |
//! | linear model about hover | [`Level1`], its `derivative` | 3.3.3 |
//! | `F = −Σ T_i e_z`, `M_x = L (T_3 − T_4)`, `M_y = L (T_2 − T_1)`, `M_z = −Σ s_i Q_i` | [`RotorGeometry::wrench`] | 3.4 |
//! | gyroscopic torque `−ω × Σ s_i I_R Ω_i e_z` | [`gyroscopic_torque`] | 3.4 |
//! | spin-up reaction `−Σ s_i I_R Ω̇_i e_z` | [`SpinningRotors`], in `Quadrotor::spin_moment` | 3.4 |
//! | drag `−k ∣v∣ v` and rate damping | [`Drag::wrench`] | 3.4 |
//! | `u* = C u` | [`Vehicle::control_matrix`] | 3.6 |
//! | ground effect `T = T_∞ / (1 − (R/4z)²)` | [`GroundEffect`] | 3.7; Cheeseman and Bennett 1955 |
//! | blockage `D = ½ ρ C_D S (∣w∣ w − ∣V_c∣ V_c)` | [`Blockage`] | 3.7; Leishman 2006 |
//! | turbulence, Dryden's filters | [`Dryden`] | 3.7; MIL-F-8785C |
//! | rotation of the gusts | [`DrydenRotation`] | MIL-F-8785C |
//! | wind over height | [`Shear`] | MIL-F-8785C |
//! | process noise `Δv = σ √h n` | [`ProcessNoise`] | 3.7; Gelb 1974 |
//! | resolution, its partial order | [`Resolution`] | 5.1.4 |
//! | a vehicle within its standard errors | [`UncertainVehicle`] | JCGM 100:2008 |
//! | rotors | [`quad_rotor`], one type per model | 3.5, 4.5 |
//! | battery current `Σ d_i (K_v Q_i + I_0)` | [`CurrentDraw`] | choice |
//! | hover trim | [`QuadrotorModel::hover`], solved in `trim.rs` | |
//!
//! # Conventions
//!
//! World W north-east-down, body B forward-right-down with its origin at the centre of mass; height is `−z`.
//! Rotors of a '+' layout: 1 rear, 2 front, 3 left, 4 right. Commands are offsets of the duty
//! from zero thrust, `u_i = ū_i − ū_0` ([`Input`]). SI units, rad. The types do not guard units or frames here: names and
//! docs say them.
//!
//! # Changing the level in flight
//!
//! Every model reduces its state to a [`Snapshot`] and adopts one: `upper.adopt(&lower.snapshot(x, u), u)`
//! lifts, the reverse restricts, and `restrict(lift(x)) = x` between neighbours, headings taken within one
//! turn. [`AnyQuadrotor::at_level`] does both.

#[macro_use]
mod level;

mod any;
mod assemble;
mod blockage;
mod drag;
mod dryden;
mod error;
mod family;
mod forces;
mod ground_effect;
mod gyroscopic;
mod lagrange;
mod level1;
mod model;
mod phenomenon;
mod process_noise;
mod quadrotor;
mod quadrotor_state;
mod resolution;
mod rigid_body;
mod shear;
#[cfg(test)]
mod tests;
mod trim;
pub mod vehicle;

/// What the interface is made of, in the version that fits.
#[doc(no_inline)]
pub use {nalgebra, quad_math, quad_rotor};

pub use blockage::Blockage;
pub use drag::Drag;
pub use dryden::{
    Dryden, DrydenNoise, DrydenRotation, DrydenRotationNoise, DrydenRotationState, DrydenState, GustStep,
};
pub use error::BuildError;
pub use family::{FamilyRotor, FamilySupply};
pub use forces::RotorGeometry;
pub use ground_effect::GroundEffect;
pub use gyroscopic::gyroscopic_torque;
pub use level::{
    AnyQuadrotor, Level, Level2, Level3, Level4, Level5, LevelModel, NoSuchLevel, WithLevel, WithQuadrotor,
};
pub use level1::{Level1, LinearRate, LinearState};
pub use model::{Flight, Hover, InFlight, Input, QuadrotorModel, RotorSnapshot, Snapshot, StateOf};
pub use phenomenon::{Capabilities, Phenomenon, PhenomenonSet, Prerequisite};
pub use process_noise::{Kick, ProcessNoise};
pub use quadrotor::{
    Bare, CommandLimits, CurrentDraw, MechanisticQuadrotor, Quadrotor, RotorSet, SpinningRotors,
};
pub use quadrotor_state::{QuadrotorRate, QuadrotorState};
pub use resolution::{Feature, Resolution};
pub use rigid_body::{RigidBody, RigidBodyRate, RigidBodyState, Wrench};
pub use shear::{Shear, ShearError, ShearProfile};
pub use trim::Trim;
pub use vehicle::{UncertainVehicle, Vehicle, VehicleError};

/// Number of rotors: the family is of quadrotors, whose control matrix is square.
pub const ROTORS: usize = 4;

/// One value for each rotor, in the order of the commands.
pub type PerRotor<T> = [T; ROTORS];

/// The README's example is tested with the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
