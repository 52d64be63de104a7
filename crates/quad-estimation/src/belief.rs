//! What a filter believes: a mean and the covariance of its error.

use crate::EstimationError;
use nalgebra::{DMatrix, DVector};

/// How unequal, relative to the variances, two entries that should be one number may be: what rounding leaves.
const ASYMMETRY: f64 = 1e-9;

/// A mean `x̂` and the covariance P of the error `x ⊟ x̂`.
#[derive(Clone, Debug, PartialEq)]
pub struct Belief {
    /// The mean, as a flat state.
    pub mean: DVector<f64>,
    /// The covariance of its error.
    pub covariance: DMatrix<f64>,
}

impl Belief {
    /// A belief with a checked covariance.
    ///
    /// # Errors
    /// Numbers that are not finite; a covariance that is not square, symmetric and positive definite.
    pub fn new(mean: DVector<f64>, covariance: DMatrix<f64>) -> Result<Self, EstimationError> {
        let n = covariance.nrows();
        if covariance.ncols() != n {
            return Err(EstimationError::Length {
                what: "a row of the covariance",
                expected: n,
                found: covariance.ncols(),
            });
        }
        for (what, values) in [
            ("a belief's mean", mean.as_slice()),
            ("a covariance", covariance.as_slice()),
        ] {
            for &value in values {
                crate::error::finite(what, value)?;
            }
        }
        for place in 0..n {
            let variance = covariance[(place, place)];
            if variance <= 0.0 {
                return Err(EstimationError::NonPositiveVariance { place, variance });
            }
        }
        for row in 0..n {
            for column in 0..row {
                let difference = (covariance[(row, column)] - covariance[(column, row)]).abs();
                let scale = (covariance[(row, row)] * covariance[(column, column)]).sqrt();
                if difference > ASYMMETRY * scale {
                    return Err(EstimationError::NotSymmetric {
                        row,
                        column,
                        difference,
                    });
                }
            }
        }
        if covariance.clone().cholesky().is_none() {
            return Err(EstimationError::NotPositiveDefinite);
        }
        Ok(Self { mean, covariance })
    }

    /// Standard deviation of one error.
    pub fn deviation(&self, place: usize) -> f64 {
        self.covariance[(place, place)].sqrt()
    }

    /// Whether all its numbers are finite.
    pub(crate) fn is_finite(&self) -> bool {
        self.mean
            .iter()
            .chain(self.covariance.iter())
            .all(|x| x.is_finite())
    }
}

/// `½ (P + Pᵀ)`: what rounding made unequal is made equal.
pub(crate) fn symmetrised(p: &DMatrix<f64>) -> DMatrix<f64> {
    (p + p.transpose()) * 0.5
}

/// The innovation of a measurement.
#[derive(Clone, Debug, PartialEq)]
pub struct Innovation {
    /// The innovation `ν = y − ŷ`.
    pub residual: DVector<f64>,
    /// Its covariance S.
    pub covariance: DMatrix<f64>,
    /// Normalised innovation squared `νᵀ S⁻¹ ν`, χ²-distributed with as many degrees of freedom as there are readings if the
    /// filter is consistent.
    pub nis: f64,
    /// Whether the measurement was used or fell outside the gate.
    pub verdict: Verdict,
}

/// What became of a measurement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It corrected the estimate.
    Used,
    /// Its NIS was beyond the gate: the estimate is unchanged.
    Rejected,
}

impl Innovation {
    /// Logarithm of the measurement's likelihood `−½ (ν² + ln det S + m ln 2π)`.
    pub fn log_likelihood(&self) -> f64 {
        let m = self.residual.len() as f64;
        let log_det = self.covariance.determinant().ln();
        -0.5 * (self.nis + log_det + m * std::f64::consts::TAU.ln())
    }
}
