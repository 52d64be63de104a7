//! The energy transmission system: a ground station that keeps a camera and a laser on a quadrotor's receiver.
//!
//! | part | equation | where |
//! | --- | --- | --- |
//! | gimbal | `ω̇ = (sat(u) − ω)/τ` per axis, rate and travel limits | [`Gimbal`], [`Pedestal`] |
//! | camera | `r_C = f [y/x, z/x]` | [`Camera`], [`Image`], [`View`] |
//! | image kinematics | `ṙ_C = L q̇ + d`, `r̈_C = L q̈ + b` | [`ImageKinematics`] |
//! | tracker | `u = q̇ + τ L⁻¹(v − b)` | [`ErrorDynamics`], [`Tracker`] |
//! | sampling, delay, loss, search | fading-memory filter of the line of sight | [`Sight`], [`FrameClock`], [`Search`] |
//! | beam in air | `I = 2P/(πw²) exp(−2ρ²/w² − βz)` | [`Beam`], [`Light`], [`Atmosphere`] |
//! | receiver | range, incidence, spot offset; `P = ∫ I (d + ρ w'/w)·(−n) dA` | [`Receiver`], [`Face`], [`PowerBudget`] |
//! | all together | one pure step | [`Ets`] |
//! | parameters | a TOML file with a source beside each number | [`Station`] |
//!
//! Frames: W world, north-east-down. E on the moving platform, x along the beam, y to the right, z down, origin where the axes of the
//! gimbal cross; `R_WE = R_z(ψ_0 + ψ_E) R_y(θ_E)` with the pedestal's heading ψ_0. Pan ψ_E turns about z (down), positive
//! clockwise seen from above; tilt θ_E turns about the platform's y, positive upwards. C is the camera's frame, x along the optical
//! axis, parallel to E with the same origin. B is the vehicle's body frame.
//!
//! Generic in the scalar ([`quad_math::Real`]): `f64`, dual numbers, SIMD lanes. Nothing allocates in a step, and nothing here
//! depends on a quadrotor: a target is a position, a receiver is attached to a position and a rotation matrix.
//!
//! # Example
//!
//! The target starts 200 px right of and 100 px below the image centre; the tracker brings it there.
//!
//! ```
//! use ets::{Ets, EtsInput, FrameClock, Mode, Station};
//! use nalgebra::{Vector2, Vector3};
//!
//! let station = Station::nominal();
//! let ets = Ets::<f64>::new(&station);
//! let clock = FrameClock::new(0.001, station.frames.rate, station.frames.latency)?;
//!
//! let target = ets.camera.direction(&Vector2::new(200.0, 100.0)) * 5.0; // the platform looks north
//! let input = EtsInput { target, noise: Vector2::zeros() };
//! let mut state = ets.at_rest(0.0, 0.0);
//! for n in 0..3000 {
//!     state = ets.step(&clock, n, &state, &input);
//! }
//! let image = ets.view(&state.gimbal, &target);
//! assert!(image.visible == 1.0 && image.point.norm() < 0.1);
//! assert_eq!(state.sight.mode(&station.tracker), Mode::Tracking);
//!
//! // The light on a receiver that faces the station.
//! let facing_south = nalgebra::Matrix3::from_diagonal(&Vector3::new(-1.0, -1.0, 1.0));
//! let face = ets.receiver.on(&(target + Vector3::x() * 0.2), &facing_south);
//! let link = ets.link(&state.gimbal, &face);
//! assert!(link.power.received + link.power.missed <= link.power.emitted);
//! # Ok::<(), ets::ClockError>(())
//! ```
//!
//! # What it does not do
//!
//! No time, no random numbers, no files: the step's number, noise samples and texts are arguments. No turbulence of the air,
//! no lens distortion, no thermal limits of the cells, no eye-safety verdict: judge by [`PowerBudget::missed`].

mod aim;
mod atmosphere;
mod beam;
mod camera;
mod clock;
mod ets;
mod gimbal;
mod image;
mod power;
mod quadrature;
mod receiver;
mod scalar;
mod search;
mod sight;
pub mod station;
#[cfg(test)]
mod tests;
mod tracker;

pub use atmosphere::{Atmosphere, VisibilityLaw};
pub use beam::{Beam, Light, Ray};
pub use camera::{Camera, Image, MAX_SLOPE, View};
pub use clock::{ClockError, FrameClock, FrameEvent};
pub use ets::{Ets, EtsInput, EtsState, Link};
pub use gimbal::{
    Gimbal, GimbalAxis, GimbalCommand, GimbalState, GimbalStateRate, Pedestal, platform_rate_matrix,
};
pub use image::{ImageKinematics, PointMotion};
pub use power::{PowerBudget, REACH};
pub use receiver::{Aperture, Face, GRAZING, LinkGeometry, Receiver};
pub use search::Search;
pub use sight::{Frame, Mode, Sight};
pub use station::{LinkLimits, Station, StationError};
pub use tracker::{ErrorDynamics, Plant, SINGULAR, Tracker};

/// The README's example is tested with the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
