//! Flight control for the quadrotor family: dynamic inversion at three resolutions, PID, trajectories, stability.
//!
//! ```
//! use nalgebra::Vector3;
//! use quad_dynamics::{AnyQuadrotor, Level, Vehicle};
//! use quad_math::TimeGrid;
//! use quad_ndi::metrics::StepMetrics;
//! use quad_ndi::{AnyController, C3, FlightPlan, Flyer, Reference, Settings};
//! use std::num::NonZeroU64;
//!
//! // The inversion of level 3 on level 3, settling in 2 s; 1 m up (z points down).
//! let vehicle = Vehicle::qball_x4();
//! let on = Level::Three.phenomena();
//! let model = AnyQuadrotor::hovering(Level::Three, &vehicle, &on, Vector3::zeros(), 0.0)?;
//! let controller = AnyController::C3(C3::new(&vehicle, &Settings::default())?.into());
//! let plan = FlightPlan { grid: TimeGrid::from_seconds(0.001, 4.0)?, record_every: NonZeroU64::MIN };
//! let up = Reference::hold(Vector3::new(0.0, 0.0, -1.0), 0.0);
//! let log = Flyer::new(&vehicle, model, controller)?.fly(&plan, |_time_s| up);
//!
//! let height: Vec<_> = log.records.iter().map(|r| (r.time_s, -r.flight.position.z)).collect();
//! let settled = StepMetrics::of(&height, 1.0).and_then(|m| m.settling_time_s);
//! println!("settled after {settled:?} s");
//! assert!(settled.is_some_and(|t| (t - 2.0).abs() < 0.03));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # The controllers
//!
//! Nested loops: position errors give a demanded tilt, tilt errors give demanded angular accelerations, and the
//! linearising feedback of the level turns these demands into rotor commands.
//!
//! | controller | linearising feedback | designed for | knows |
//! | --- | --- | --- | --- |
//! | [`C1`] | `T = m (g − v_z)`, `M = I v_η` | level 1 | small angles, ideal rotors |
//! | [`C2`] | `T = m (g − v_z)/(cos φ cos θ)`, `M = I ω̇ + ω × I ω` with `ω̇ = W v_η + Ẇ η̇` | level 2 | the whole rigid body, ideal rotors |
//! | [`C3`] | `u_i = (T_i + Ṫ_i/ω_R)/K_T` with `Ṫ`, `Ṁ` from `z⃛ = v_z`, `η⃛ = v_η` | level 3 | as c2, and the rotors' lag |
//! | [`Decoupling`] | `u = (L_G L_f^(ν−1) h)⁻¹ (v − L_f^ν h)` by automatic differentiation | levels 1 to 3 | what the model's code contains |
//! | [`Pid`] | none: weight, inertia and allocation only | any level | nothing of coupling or lag |
//!
//! A controller may fly any model of its own level or above: [`check_pairing`]. [`Law`] names them; [`Law::paired`] is the inversion that
//! belongs to a level.
//!
//! # Where to find an equation
//!
//! | equation | code | source |
//! | --- | --- | --- |
//! | `v = ÿ_d + 2ζω ė + ω² e`, and with the extra pole of level 3 | [`LoopGains`] | thesis 6.4 |
//! | `ω_n τ_s = 5.834` at `ζ = 1`, and for any `ζ` | [`settling`] | F.1 |
//! | c1, c2, c3 | [`C1`], [`C2`], [`C3`] | 6.3 |
//! | `θ = atan(−a'_x/(g − a_z))`, `φ = atan(a'_y/√(a'_x² + (g − a_z)²))`, with rates | [`Reference::following`] | 6.3, 7.4.2 |
//! | `ω̈ = W η⃛ + 2 Ẇ η̈ + Ẅ η̇` | `EulerKinematics` in `inversion.rs` | 6.3.3 |
//! | `u = C⁻¹ u*` | [`Allocation`] | 6.2 |
//! | `s² A(s) + A(0) (2ζ_p ω_p s + ω_p²)`, table F.1, gain limits | [`stability`] | 6.5, F.2 |
//! | the Routh array, with zero pivots and zero rows | [`routh`] | F.2 |
//! | PID, derivative filter, back-calculation | [`Pid`] | 6.6.1 |
//! | what a tuning minimises | [`pid::tune`], head of `pid/tuning.rs` | choice |
//! | legs of degree 9 in position, 7 in heading | [`Trajectory`] | 6.5 |
//! | `ψ = atan2(Δy, Δx)` towards a point | [`FlatOutput::facing`] | appendix A |
//! | settling, overshoot, steady-state and RMS error, effort | [`metrics`] | 6.5 |
//!
//! # Conventions
//!
//! World north-east-down, so climbing is a negative z; body forward-right-down; SI units, rad. Commands are
//! offsets of the duty from zero thrust, as in [`quad_dynamics::Input`]. A controller samples the flight at the start of a step and
//! its commands are held over it ([`ClosedLoop::step`], [`Flyer`]); limits on commands are the controller's field
//! `limits` and, on the model's side, a phenomenon.
//!
//! # What it does not protect against
//!
//! Where an inversion is singular (84° of tilt and beyond) [`C1`] to [`C3`] saturate: finite commands, but no flight
//! out of an inverted attitude. The demanded tilt of the inversions is not limited, PID's is. A wrong
//! relative degree given to [`Decoupling`] is an error only where it makes the matrix singular.

#[macro_use]
mod law;

mod any;
mod closed_loop;
mod controller;
pub mod facing;
mod generic;
mod inversion;
pub mod metrics;
pub mod pid;
mod reference;
pub mod roots;
pub mod routh;
mod settings;
pub mod settling;
pub mod stability;
mod trajectory;

/// The models that are controlled, in the version that fits.
#[doc(no_inline)]
pub use quad_dynamics;

pub use any::InCharge;
pub use closed_loop::{
    Airborne, ClosedLoop, Feedback, FlightLog, FlightPlan, FlightStatus, Flyer, Plant, Record,
};
pub use controller::{Allocation, Control, Controller, ControllerError, Demand, check_pairing};
pub use generic::{Decoupling, InversionError};
pub use inversion::{C1, C2, C3, ObserverState};
pub use law::{AnyController, ControlLaw, Law, LoopDesign, WithLaw, WithPaired};
pub use pid::{Pid, PidGains, PidMemory, PidSettings};
pub use reference::{AttitudeFeedForward, FlatOutput, Reference, TiltLaw};
pub use settings::{AttitudeSettings, Gains, LoopGains, LoopSettings, Settings, SettingsError};
pub use trajectory::{Boundary, Leg, Trajectory, TrajectoryError, Waypoint};

/// The example of the README, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}

#[cfg(test)]
mod tests;
