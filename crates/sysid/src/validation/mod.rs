//! Validation: how well models predict flights that they were, or were not, fitted on.
//!
//! [`Agreement`] compares two series: fit %, Theil's coefficient with its decomposition, residual statistics. [`replay`] drives
//! levels 2 to 5 of the family with recorded motor commands and battery voltage, as one-step, short-horizon or whole-flight
//! prediction. [`moment_of_velocity`] asks what the levels leave out.

mod agreement;
mod missing;
mod replay;
mod run;

pub use agreement::{Agreement, AgreementError, ResidualStatistics, TheilShares};
pub use missing::moment_of_velocity;
pub use replay::{AVERAGE_S, Prediction, Replay, ReplayAgreement, ReplayError, ReplayVehicle, replay};

#[cfg(test)]
mod tests;
