//! System identification of a quadrotor.
//!
//! | module | holds |
//! | --- | --- |
//! | [`measurement`] | the reader of all measurement files |
//! | [`recorded`] | public data sets in the project's frames and units |
//! | [`flight`] | thrust, lag and inertia from recorded flights |
//! | [`validation`] | replay of flights at levels 2 to 5, fit %, Theil's coefficient |
//! | [`regression`], [`estimate`], [`residual`] | least squares with its uncertainty |
//! | [`laboratory`] | virtual measurements |

pub mod centre_of_mass;
pub mod coverage;
pub mod estimate;
pub mod flight;
pub mod laboratory;
pub mod lack_of_fit;
pub mod load_cell;
pub mod measurement;
pub mod pendulum;
pub mod pipeline;
pub mod recorded;
pub mod regression;
pub mod residual;
pub mod rotor_dynamics;
pub mod rotor_static;
pub mod validation;

pub use estimate::{Convergence, Estimate, Fit, Goodness, Interval, Warning};

#[cfg(test)]
mod test_coverage;
