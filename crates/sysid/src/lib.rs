//! System identification of a quadrotor.

pub mod estimate;
pub mod laboratory;
pub mod measurement;
pub mod recorded;
pub mod regression;
pub mod residual;
pub mod rotor_dynamics;
pub mod rotor_static;

pub use estimate::{Convergence, Estimate, Fit, Goodness, Interval, Warning};
