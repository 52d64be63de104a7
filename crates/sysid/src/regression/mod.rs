//! Least squares: linear by singular values, non-linear by Levenberg-Marquardt, total where both axes are noisy.
//!
//! ```text
//! y = X p + r:   p̂ = argmin |r|²,   cov p̂ = s² (Xᵀ X)⁻¹,   s² = |r|² / (n − p)
//! y = f(p) + r:  the same at the minimum, with X = ∂f/∂p by automatic differentiation
//! ```
//!
//! Assumptions: residuals independent, of equal variance, and small enough that `f` is straight over the intervals. The
//! columns of X are scaled to unit length first, so that the condition number speaks of the data and not of units.
//! Source: Draper and Smith, *Applied Regression Analysis*; Golub and Van Loan, *Matrix Computations*, chapters 5 and 6.

mod correlated;
mod linear;
mod nonlinear;
mod pure_error;
mod total;

pub use linear::{Row, linear};
pub use nonlinear::{Predictor, nonlinear, slopes};
pub use total::{Deviations, NoisyPoint, TotalFit, total};

/// Why a fit was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FitError {
    /// Fewer data than unknowns, or as many: no residual is left to judge the fit by.
    #[error("{unknowns} unknowns with their uncertainty need at least {} data points, got {points}", unknowns + 1)]
    TooFewPoints {
        /// How many data there are.
        points: usize,
        /// How many unknowns are sought.
        unknowns: usize,
    },
    /// The data leave a combination of the unknowns open.
    #[error(
        "the data determine only {rank} of {unknowns} unknowns: vary the input so that each has its own effect"
    )]
    RankDeficient {
        /// How many combinations are determined.
        rank: usize,
        /// How many unknowns are sought.
        unknowns: usize,
    },
    /// A number is NaN or infinite.
    #[error("data point {index} (counted from 0) must be finite")]
    NotFinite {
        /// Place in the order of the data.
        index: usize,
    },
    /// All data are equal though the regressors change: a stuck sensor. A fit would give rounding with an interval of rounding.
    #[error(
        "all {points} data points are {value} while the input changes: is the sensor stuck or not connected?"
    )]
    ConstantData {
        /// How many data there are.
        points: usize,
        /// What they all are.
        value: f64,
    },
    /// The model gave NaN or infinity at the start of the iteration.
    #[error("the model's prediction at the start {start:?} is not finite: choose another start")]
    NoStart {
        /// The start.
        start: Vec<f64>,
    },
    /// A standard deviation is negative, or both of a point are zero.
    #[error(
        "point {index} (counted from 0) has the standard deviations {x_deviation} and {y_deviation}: none may be negative \
         and one must be positive"
    )]
    Deviation {
        /// Place in the order of the points.
        index: usize,
        /// Along x.
        x_deviation: f64,
        /// Along y.
        y_deviation: f64,
    },
    /// The points scatter as much across any line as along it, or lie on a vertical one.
    #[error(
        "the points have no direction: they scatter {scatter:.3} times as much across the best line as along it; measure over a \
         wider range"
    )]
    NoDirection {
        /// Scatter across over spread along, both in units of the standard deviations.
        scatter: f64,
    },
    /// The decomposition did not converge.
    #[error("the singular values of the data could not be computed")]
    Decomposition,
}

/// Ratio of singular values below which a combination counts as undetermined: rounding of the data in `f64`.
const RANK_TOLERANCE: f64 = 1e-12;

/// Condition number of the scaled problem from which a warning is given: four digits of the data's sixteen and of any
/// measurement's three or four are then lost in the worst combination.
const ILL_CONDITIONED: f64 = 1e4;

#[cfg(test)]
mod tests;
