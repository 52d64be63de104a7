//! What can be wrong with a filter, a sensor or a measurement.

/// Why a filter refuses.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EstimationError {
    /// A state or covariance of the wrong size.
    #[error(
        "{what} has {found} numbers, the filter's model needs {expected}: was it made for another level?"
    )]
    Length {
        /// What the numbers are.
        what: &'static str,
        /// How many there should be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A number that is NaN or infinite.
    #[error("{what} must be finite, got {value}")]
    NotFinite {
        /// What the number is.
        what: &'static str,
        /// The number.
        value: f64,
    },
    /// A covariance with a variance that is not positive.
    #[error(
        "variance {place} of the covariance must be positive, got {variance}: give every state an uncertainty"
    )]
    NonPositiveVariance {
        /// Place in the error state.
        place: usize,
        /// The variance.
        variance: f64,
    },
    /// A covariance that says two things of the same pair of states.
    #[error(
        "the covariance must be symmetric: entries ({row}, {column}) and ({column}, {row}) differ by {difference}"
    )]
    NotSymmetric {
        /// Row.
        row: usize,
        /// Column.
        column: usize,
        /// Difference of the two entries.
        difference: f64,
    },
    /// A covariance that is no covariance: some combination of states has no positive variance.
    #[error(
        "the covariance is not positive definite (its Cholesky factor does not exist): check the correlations, or raise \
         the process noise if it became so in flight"
    )]
    NotPositiveDefinite,
    /// A standard deviation, noise density or gate that is not positive and finite.
    #[error("{what} must be positive and finite, got {value}")]
    BadNoise {
        /// What it is, with its unit.
        what: &'static str,
        /// The value.
        value: f64,
    },
    /// A step that is not positive and finite.
    #[error("a prediction must go forward in time by a finite step, got {step_s} s")]
    BadStep {
        /// The step, s.
        step_s: f64,
    },
    /// A measurement taken after the instant that the filter has reached.
    #[error(
        "a measurement taken at {taken_ns} ns is ahead of the filter, which is at {now_ns} ns: predict first"
    )]
    FromTheFuture {
        /// When it was taken, ns.
        taken_ns: u64,
        /// Where the filter is, ns.
        now_ns: u64,
    },
    /// A measurement out of order by more than the filter remembers.
    #[error(
        "a measurement taken at {taken_ns} ns is out of order: the filter remembers back to {oldest_ns} ns; let it \
         remember longer than the slowest sensor's delay, or drop the measurement"
    )]
    TooOld {
        /// When it was taken, ns.
        taken_ns: u64,
        /// The oldest instant that the filter can go back to, ns.
        oldest_ns: u64,
    },
    /// The estimate became non-finite; the filter keeps the last finite one.
    #[error("the estimate became NaN or infinite; the filter was left unchanged")]
    Diverged,
    /// The spread of an unscented filter's points.
    #[error(
        "an unscented filter's points need 0 < alpha ≤ 1, alpha² (n + kappa) > 0 and a finite beta, got alpha = {alpha}, beta = {beta}, kappa = {kappa}, n = {n}"
    )]
    BadSpread {
        /// α.
        alpha: f64,
        /// β.
        beta: f64,
        /// κ.
        kappa: f64,
        /// Size of the error state.
        n: usize,
    },
}

/// Checks that a number is finite.
pub(crate) fn finite(what: &'static str, value: f64) -> Result<(), EstimationError> {
    if value.is_finite() {
        Ok(())
    } else {
        Err(EstimationError::NotFinite { what, value })
    }
}

/// Checks that a noise is finite and positive.
pub(crate) fn positive(what: &'static str, value: f64) -> Result<(), EstimationError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(EstimationError::BadNoise { what, value })
    }
}
