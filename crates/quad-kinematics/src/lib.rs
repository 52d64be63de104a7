//! Frames, attitudes and their rate kinematics.
//!
//! Three representations of the attitude of the body frame B (forward-right-down) against the world
//! frame W (north-east-down), each with its rate kinematics, converting into one another:
//!
//! | representation | numbers | rate kinematics | singular | choose it for |
//! | --- | --- | --- | --- | --- |
//! | [`EulerAngles`] `η` | 3 | `η̇ = J(η) ω` | at `θ = ±90°` | small-angle models, demands in roll and pitch, plots |
//! | [`Quaternion`] `q` | 4, `∣q∣ = 1` | `q̇ = ½ q ⊗ [0, ω]` | nowhere | integrating non-linear models |
//! | [`Rotation`] `R_WB` | 9, orthonormal | `Ṙ = R [ω]×` | nowhere | rotating many vectors, geometry |
//!
//! All angles are in rad, rates in rad/s; `ω = [p, q, r]` are body rates: the angular velocity of B
//! against W with components along B. Everything is generic in the scalar ([`quad_math::Real`]).
//!
//! ```
//! use quad_kinematics::EulerAngles;
//! use nalgebra::Vector3;
//!
//! let attitude = EulerAngles::new(0.1, -0.2, 1.5);
//! let back = attitude.quaternion().rotation().euler_angles();
//! assert!((back.vector() - attitude.vector()).norm() < 1e-15);
//!
//! // Nose up and level wings: forward points up, and up is -z in W.
//! let forward_W = EulerAngles::new(0.0, 0.3, 0.0).rotation().matrix * Vector3::x();
//! assert!(forward_W.z < 0.0);
//! ```

mod euler;
mod frames;
mod matrix;
mod quaternion;
#[cfg(test)]
mod tests;

pub use euler::{EulerAngles, EulerRates};
pub use frames::{Body, Camera, FrameVector, Platform, Rotation, World, cross_matrix};
pub use quaternion::{Quaternion, QuaternionRate};

/// The README's example is tested with the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
