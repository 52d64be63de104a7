//! System identification of a quadrotor.

pub mod estimate;
pub mod flight;
pub mod laboratory;
pub mod measurement;
pub mod recorded;
pub mod regression;
pub mod residual;
pub mod validation;

pub use estimate::{Convergence, Estimate, Fit, Goodness, Interval, Warning};
