//! System identification of a quadrotor.

pub mod centre_of_mass;
pub mod estimate;
pub mod laboratory;
pub mod measurement;
pub mod recorded;
pub mod lack_of_fit;
pub mod regression;
pub mod residual;
pub mod rotor_dynamics;
pub mod rotor_static;

pub use estimate::{Convergence, Estimate, Fit, Goodness, Interval, Warning};

#[cfg(test)]
mod test_coverage;
