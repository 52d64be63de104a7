//! Validation: how well models predict flights that they were, or were not, fitted on.
//!
//! [`Agreement`] compares two series: fit %, Theil's coefficient with its decomposition, residual statistics.

mod agreement;

pub use agreement::{Agreement, AgreementError, ResidualStatistics, TheilShares};
