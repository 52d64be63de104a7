//! System identification of a quadrotor.

pub mod centre_of_mass;
pub mod estimate;
pub mod laboratory;
pub mod lack_of_fit;
pub mod load_cell;
pub mod pendulum;
pub mod regression;
pub mod residual;

pub use estimate::{Convergence, Estimate, Fit, Goodness, Interval, Warning};

#[cfg(test)]
mod test_coverage;
