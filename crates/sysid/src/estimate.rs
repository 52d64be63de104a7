//! What an identification answers: estimates with their uncertainty, and how well they describe the data.

use nalgebra::SMatrix;
use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, StudentsT};

/// The confidence level of every interval printed by this crate, unless another is asked for.
pub const CONFIDENCE: f64 = 0.95;

/// An estimated number with its uncertainty, in the unit of the number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// The estimate.
    pub value: f64,
    /// Its standard error; 0 for a number that was given, not estimated.
    pub standard_error: f64,
    /// Degrees of freedom of the standard error: of Student's t that the interval uses. Infinite for a known error.
    pub degrees_of_freedom: f64,
}

/// A confidence interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    /// Lower end.
    pub lower: f64,
    /// Upper end.
    pub upper: f64,
}

impl Interval {
    /// Whether the interval contains a value; its ends belong to it.
    pub fn contains(&self, value: f64) -> bool {
        (self.lower..=self.upper).contains(&value)
    }
}

impl Estimate {
    /// A number known with this standard error, as from a data sheet.
    pub fn known(value: f64, standard_error: f64) -> Self {
        Self {
            value,
            standard_error,
            degrees_of_freedom: f64::INFINITY,
        }
    }

    /// The 95 % confidence interval.
    pub fn interval(&self) -> Interval {
        self.interval_at(CONFIDENCE)
    }

    /// The confidence interval at a level between 0 and 1, by Student's t.
    ///
    /// # Panics
    /// If the level is not between 0 and 1: a programming error.
    pub fn interval_at(&self, confidence: f64) -> Interval {
        let half = student_quantile(0.5 + 0.5 * confidence, self.degrees_of_freedom) * self.standard_error;
        Interval {
            lower: self.value - half,
            upper: self.value + half,
        }
    }

    /// Probability of an estimate at least as far from zero if the truth is zero, by Student's t.
    pub fn p_value_of_zero(&self) -> f64 {
        if self.standard_error == 0.0 {
            return if self.value == 0.0 { 1.0 } else { 0.0 };
        }
        let t = (self.value / self.standard_error).abs();
        StudentsT::new(0.0, 1.0, self.degrees_of_freedom.clamp(f64::MIN_POSITIVE, 1e6))
            .map_or(f64::NAN, |student| 2.0 * student.sf(t))
    }

    /// Quantile of Student's t with these degrees of freedom.
    ///
    /// # Panics
    /// If the probability is not between 0 and 1: a programming error.
    pub fn quantile(probability: f64, degrees_of_freedom: f64) -> f64 {
        student_quantile(probability, degrees_of_freedom)
    }

    /// Half the width of the 95 % interval.
    pub fn half_width(&self) -> f64 {
        student_quantile(0.5 + 0.5 * CONFIDENCE, self.degrees_of_freedom) * self.standard_error
    }

    /// Probability of an estimate at least as far from `hypothesis` if that were the truth: two-sided Student's t test.
    pub fn p_value_against(&self, hypothesis: f64) -> f64 {
        let distance = (self.value - hypothesis).abs();
        if distance == 0.0 {
            return 1.0;
        }
        student(self.degrees_of_freedom).map_or(f64::NAN, |t| 2.0 * t.sf(distance / self.standard_error))
    }

    /// The estimate of `f(x)` to first order, with `|f'|` times the standard error.
    #[must_use]
    pub fn mapped(&self, value: f64, slope: f64) -> Self {
        Self {
            value,
            standard_error: self.standard_error * slope.abs(),
            ..*self
        }
    }
}

impl Estimate {
    /// The estimate with another, independent standard error on top; degrees of freedom by Welch and Satterthwaite,
    /// `ν = (u_1² + u_2²)² / (u_1⁴/ν_1 + u_2⁴/ν_2)`.
    ///
    /// Source: Joint Committee for Guides in Metrology, *Guide to the expression of uncertainty in measurement*, G.4.1.
    #[must_use]
    pub fn with_error(&self, standard_error: f64, degrees_of_freedom: f64) -> Self {
        let together = self.standard_error.hypot(standard_error);
        if together == 0.0 {
            return *self;
        }
        let share = |error: f64, freedom: f64| (error / together).powi(4) / freedom;
        Self {
            value: self.value,
            standard_error: together,
            degrees_of_freedom: 1.0
                / (share(self.standard_error, self.degrees_of_freedom)
                    + share(standard_error, degrees_of_freedom)),
        }
    }
}

/// Quantile of Student's t; of the normal distribution beyond a million degrees of freedom, where both agree to 1e-6.
fn student_quantile(probability: f64, degrees_of_freedom: f64) -> f64 {
    assert!(
        probability > 0.0 && probability < 1.0,
        "a confidence level is between 0 and 1"
    );
    student(degrees_of_freedom).map_or(f64::NAN, |t| t.inverse_cdf(probability))
}

fn student(degrees_of_freedom: f64) -> Option<StudentsT> {
    StudentsT::new(0.0, 1.0, degrees_of_freedom.clamp(f64::MIN_POSITIVE, 1e6)).ok()
}

/// How well a fit describes the data.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Goodness {
    /// Residual standard deviation `√(Σ r² / (n − p))`, in the unit of the data.
    pub standard_deviation: f64,
    /// Largest residual, in the unit of the data.
    pub largest_residual: f64,
    /// `R² = 1 − Σ r² / Σ (y − ȳ)²`; `None` if the data are constant.
    pub r_squared: Option<f64>,
    /// `n − p`; fewer where intervals were widened for correlated residuals, or come from repetitions.
    pub degrees_of_freedom: f64,
}

impl Goodness {
    /// From residuals, the data they belong to, and the number of fitted parameters.
    pub fn of(residuals: &[f64], data: &[f64], parameters: usize) -> Self {
        let squares: f64 = residuals.iter().map(|r| r * r).sum();
        let mean = data.iter().sum::<f64>() / data.len() as f64;
        let spread: f64 = data.iter().map(|y| (y - mean).powi(2)).sum();
        let degrees_of_freedom = residuals.len() as f64 - parameters as f64;
        Self {
            standard_deviation: (squares / degrees_of_freedom).sqrt(),
            largest_residual: residuals.iter().fold(0.0_f64, |m, r| m.max(r.abs())),
            r_squared: (spread > 0.0).then(|| 1.0 - squares / spread),
            degrees_of_freedom,
        }
    }

    /// Fit in percent, `100 (1 − √(Σ r² / Σ (y − ȳ)²))`, the normalised root mean square error turned round; `None` if the
    /// data are constant.
    pub fn fit_percent(&self) -> Option<f64> {
        self.r_squared
            .map(|r2| 100.0 * (1.0 - (1.0 - r2).max(0.0).sqrt()))
    }
}

/// The result of a least-squares fit with `N` parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit<const N: usize> {
    /// The parameters in the order of the model.
    pub parameters: [Estimate; N],
    /// Their covariance matrix.
    pub covariance: SMatrix<f64, N, N>,
    /// Measured minus fitted, in the order of the data.
    pub residuals: Vec<f64>,
    /// How well the fit describes the data.
    pub goodness: Goodness,
    /// Condition number of the scaled problem: large where the data hardly tell two parameters apart.
    pub condition_number: f64,
    /// How the iteration ended; `None` for a linear fit, which has none.
    pub convergence: Option<Convergence>,
    /// What a reader must know before using the numbers.
    pub warnings: Vec<Warning>,
}

impl<const N: usize> Fit<N> {
    /// The parameters' values.
    pub fn values(&self) -> [f64; N] {
        self.parameters.map(|p| p.value)
    }

    /// The standard error of a combination of parameters with this gradient: `√(gᵀ C g)`.
    pub fn propagated(&self, value: f64, gradient: &[f64; N]) -> Estimate {
        let g = nalgebra::SVector::<f64, N>::from(*gradient);
        Estimate {
            value,
            standard_error: (g.transpose() * self.covariance * g).x.max(0.0).sqrt(),
            degrees_of_freedom: self.goodness.degrees_of_freedom,
        }
    }
}

/// How an iteration ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Convergence {
    /// Whether a stopping criterion of the minimum was met.
    pub converged: bool,
    /// Evaluations of the residuals.
    pub evaluations: usize,
}

/// Something that makes an estimate less trustworthy than its interval says.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Warning {
    /// Two or more parameters are hardly distinguished by the data.
    #[error(
        "the data hardly distinguish the parameters (condition number {condition_number:.1e}): their intervals are wide and \
         correlated"
    )]
    IllConditioned {
        /// Condition number of the scaled problem.
        condition_number: f64,
    },
    /// The residuals are not white: the model misses something, and the standard errors are too small.
    #[error(
        "the residuals are correlated (Ljung-Box p = {p_value:.1e} over {lags} lags): the model misses something and its intervals \
         are too narrow"
    )]
    CorrelatedResiduals {
        /// Probability of residuals so correlated if they were white.
        p_value: f64,
        /// Lags tested.
        lags: usize,
    },
    /// The residuals are correlated, and the intervals have been widened for it.
    #[error(
        "the residuals are correlated: the intervals allow for correlation over {lags} data points, up to {factor:.1} times wider"
    )]
    IntervalsWidened {
        /// Data over which correlation was taken into account.
        lags: usize,
        /// Largest factor on a standard error.
        factor: f64,
    },
    /// The iteration stopped before a minimum was found.
    #[error("the fit did not converge within {evaluations} evaluations: these are the best values found")]
    NotConverged {
        /// Evaluations of the residuals.
        evaluations: usize,
    },
    /// A sensor sat at the end of its range.
    #[error("{samples} samples are at the end of the sensor's range ({limit}): they bias the fit")]
    Saturated {
        /// How many.
        samples: usize,
        /// The value that repeats.
        limit: f64,
    },
    /// Samples are missing.
    #[error("{gaps} gaps in time, the longest {longest_s} s: the input is held across them")]
    Gaps {
        /// How many.
        gaps: usize,
        /// The longest, s.
        longest_s: f64,
    },
    /// The data do not excite what a parameter describes.
    #[error(
        "{parameter} is hardly excited by the data: its standard error is {relative_error:.2} of its value; change the input \
         faster, or choose a smaller model"
    )]
    Undetermined {
        /// Name of the parameter.
        parameter: &'static str,
        /// Standard error divided by the value.
        relative_error: f64,
    },
    /// The points of a line scatter across it nearly as much as along it.
    #[error(
        "the points scatter {scatter:.2} times as much across the line as along it: the standard errors, to first order, are too \
         small"
    )]
    IndistinctLine {
        /// Scatter across over spread along, both in units of the standard deviations.
        scatter: f64,
    },
    /// The points scatter more, or less, than their stated standard deviations say.
    #[error(
        "the scatter disagrees with the stated standard deviations (chi-squared p = {p_value:.1e}): check them"
    )]
    ScatterUnlikeStated {
        /// Probability of a χ² at least as large.
        p_value: f64,
    },
    /// Groups of repeated measurements differ by more than repetitions scatter: a systematic error.
    #[error(
        "groups of repeated measurements disagree with the model by more than the repetitions scatter (F test, p = {p_value:.1e}): a \
         systematic error, which no interval contains"
    )]
    GroupsDisagree {
        /// Probability of such a disagreement by chance.
        p_value: f64,
    },
    /// A curve misses repeated readings.
    #[error(
        "the curve misses the means of repeated readings by more than they scatter (by {misfit:.2e} on average; F test, p = \
         {p_value:.1e}): its numbers are those of the best curve over these settings, and no interval contains what it misses"
    )]
    CurveMisses {
        /// Root mean square of the means about the curve, in the unit of the data.
        misfit: f64,
        /// Probability of such a misfit by chance.
        p_value: f64,
    },
    /// One placing weighs more or less than the others.
    #[error(
        "placing {index} (counted from 0) departs from the median weight by {:.1} %: a scale at the end of its range, or a fourth \
         point of support?", 100.0 * relative_departure
    )]
    OddWeight {
        /// Place in the order of the data.
        index: usize,
        /// Departure over the median.
        relative_departure: f64,
    },
    /// Few periods of an oscillation were recorded.
    #[error("only {periods} periods were recorded: damping and period are hardly distinguished")]
    FewPeriods {
        /// How many, in halves.
        periods: f64,
    },
    /// Samples are missing from a record without input.
    #[error("{gaps} gaps in time, the longest {longest_s} s: the model bridges them without data")]
    MissingSamples {
        /// How many.
        gaps: usize,
        /// The longest, s.
        longest_s: f64,
    },
    /// A line that is bent.
    #[error(
        "the samples bend: they depart from a straight line by {:.2} % of the span, more than their scatter explains",
        100.0 * departure
    )]
    NotStraight {
        /// Largest departure over the span.
        departure: f64,
    },
    /// A value beyond the range that was calibrated.
    #[error("{value} lies beyond the calibrated range from {from} to {to}")]
    Extrapolated {
        /// The value.
        value: f64,
        /// Lower end of the range.
        from: f64,
        /// Upper end of the range.
        to: f64,
    },
}
