//! Adaptive integration by Dormand and Prince's method of order 5(4) with dense output.
//!
//! The step size follows the estimated local error, measured against a mixed absolute and relative tolerance
//! in the root mean square over the state's numbers, and is steered by a proportional-integral law. For
//! smooth, non-stiff `ẋ = f(t, x)`: put kinks and jumps of `f` on the ends of separate runs, or pay for them
//! in rejected steps.
//!
//! Source: Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., sections II.4
//! (error norm, starting step) and II.5; Gustafsson (1991) for the proportional-integral law, with the
//! constants of the code DOPRI5.

mod dormand_prince;
mod report;
mod stepper;

pub use dormand_prince::{DenseStep, DormandPrinceStep, dormand_prince_step};
pub use report::{AdaptiveRun, AdaptiveStatistics, AdaptiveStatus};

use crate::{Flat, State};
use std::ops::Range;
use stepper::Stepper;

/// Tolerances and limits of an adaptive run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AdaptiveOptions {
    /// Absolute tolerance of the local error, in each number's own unit, > 0.
    pub absolute_tolerance: f64,
    /// Relative tolerance of the local error, > 0.
    pub relative_tolerance: f64,
    /// First step to try, s, > 0; by default it is estimated.
    pub initial_step_s: Option<f64>,
    /// Longest step, s, > 0, possibly infinite.
    pub maximum_step_s: f64,
    /// Most steps tried, accepted and rejected together.
    pub maximum_steps: usize,
}

impl Default for AdaptiveOptions {
    /// Tolerances of 1e-9, any step, a million steps at most.
    fn default() -> Self {
        Self {
            absolute_tolerance: 1e-9,
            relative_tolerance: 1e-9,
            initial_step_s: None,
            maximum_step_s: f64::INFINITY,
            maximum_steps: 1_000_000,
        }
    }
}

/// A wrong question to the adaptive integrator.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum AdaptiveError {
    /// A tolerance that is not a positive, finite number.
    #[error(
        "tolerances must be positive and finite, got {absolute_tolerance} (absolute) and {relative_tolerance} (relative)"
    )]
    BadTolerance {
        /// The absolute tolerance given.
        absolute_tolerance: f64,
        /// The relative tolerance given.
        relative_tolerance: f64,
    },
    /// An initial or longest step that is not positive (or an initial one that is not finite).
    #[error("steps must be positive, got {step_s} s")]
    BadStep {
        /// The step given, s.
        step_s: f64,
    },
    /// Ends that are not finite, or an end before the start.
    #[error("a run must end after its start, got {start_s} s to {end_s} s")]
    BadSpan {
        /// The start given, s.
        start_s: f64,
        /// The end given, s.
        end_s: f64,
    },
}

/// The integrator with validated options.
///
/// ```
/// use nalgebra::Vector2;
/// use quad_math::{AdaptiveOptions, DormandPrince};
/// let integrator = DormandPrince::new(AdaptiveOptions::default())?;
/// // A pendulum of one metre, let go at one radian.
/// let swing = |_t: f64, x: &Vector2<f64>| Vector2::new(x.y, -9.81 * x.x.sin());
/// let run = integrator.run(swing, 0.0..10.0, Vector2::x())?;
/// assert!(run.is_complete());
/// let halfway = run.at(5.0).expect("within the span");
/// assert!(halfway.x.abs() <= 1.0);
/// # Ok::<(), quad_math::AdaptiveError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DormandPrince {
    options: AdaptiveOptions,
}

impl DormandPrince {
    /// The integrator with these options.
    ///
    /// # Errors
    /// [`AdaptiveError::BadTolerance`], [`AdaptiveError::BadStep`].
    pub fn new(options: AdaptiveOptions) -> Result<Self, AdaptiveError> {
        let AdaptiveOptions {
            absolute_tolerance,
            relative_tolerance,
            initial_step_s,
            maximum_step_s,
            ..
        } = options;
        if ![absolute_tolerance, relative_tolerance]
            .iter()
            .all(|&value| value.is_finite() && value > 0.0)
        {
            return Err(AdaptiveError::BadTolerance {
                absolute_tolerance,
                relative_tolerance,
            });
        }
        if let Some(step_s) = initial_step_s.filter(|&step_s| !(step_s.is_finite() && step_s > 0.0)) {
            return Err(AdaptiveError::BadStep { step_s });
        }
        if maximum_step_s.is_nan() || maximum_step_s <= 0.0 {
            return Err(AdaptiveError::BadStep {
                step_s: maximum_step_s,
            });
        }
        Ok(Self { options })
    }

    /// The options.
    pub fn options(&self) -> &AdaptiveOptions {
        &self.options
    }

    /// Integrates `ẋ = f(t, x)` from `initial` over `span_s` (start to end, s).
    ///
    /// A run that fails on the way is a result: its status says why and when, and it keeps its steps.
    /// State and rate must list their numbers in the same order.
    ///
    /// # Errors
    /// [`AdaptiveError::BadSpan`].
    pub fn run<X>(
        &self,
        f: impl Fn(f64, &X) -> X::Rate,
        span_s: Range<f64>,
        initial: X,
    ) -> Result<AdaptiveRun<X>, AdaptiveError>
    where
        X: State<f64> + Flat<f64>,
        X::Rate: Flat<f64>,
    {
        const {
            assert!(
                X::LEN == <X::Rate as Flat<f64>>::LEN,
                "the error norm pairs a state with its rate"
            )
        };
        let Range {
            start: start_s,
            end: end_s,
        } = span_s;
        if !(start_s.is_finite() && end_s.is_finite() && start_s <= end_s) {
            return Err(AdaptiveError::BadSpan { start_s, end_s });
        }
        Ok(Stepper::new(&self.options, &f, start_s, end_s, initial).run())
    }
}

#[cfg(test)]
mod tests;
