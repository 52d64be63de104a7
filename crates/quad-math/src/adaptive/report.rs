//! What an adaptive run hands back.

use super::DenseStep;
use crate::{Sample, State};

/// How an adaptive run ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AdaptiveStatus<X> {
    /// It reached its end.
    Completed,
    /// The tolerance asks for steps that no longer advance the time: a singularity or a jump, or a
    /// tolerance below rounding.
    StepTooSmall {
        /// The time reached, s.
        time_s: f64,
        /// The step that was too small, s.
        step_s: f64,
    },
    /// The limit on the number of steps was met: stiffness, or a limit too low.
    TooManySteps {
        /// The time reached, s.
        time_s: f64,
    },
    /// Numerical divergence: beyond this time even the smallest steps lead to NaN or infinite numbers.
    NotFinite {
        /// The time reached, s.
        time_s: f64,
        /// The state there: the last finite one (or the initial state as given).
        state: X,
    },
}

/// The work an adaptive run took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AdaptiveStatistics {
    /// Steps accepted.
    pub accepted: usize,
    /// Steps rejected because of their error or because of numbers that are not finite.
    pub rejected: usize,
    /// Evaluations of `f`.
    pub evaluations: usize,
}

/// What an adaptive run computed, to its end or to its failure.
#[derive(Clone)]
pub struct AdaptiveRun<X: State<f64>> {
    /// The start.
    pub initial: Sample<X>,
    /// The accepted steps in order, each with its continuous extension.
    pub steps: Vec<DenseStep<f64, X>>,
    /// Where the steps end: the last instant and state.
    pub last: Sample<X>,
    /// How the run ended.
    pub status: AdaptiveStatus<X>,
    /// The work it took.
    pub statistics: AdaptiveStatistics,
}

impl<X: State<f64> + std::fmt::Debug> std::fmt::Debug for AdaptiveRun<X> {
    /// Everything but the steps, which may be thousands.
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("AdaptiveRun")
            .field("initial", &self.initial)
            .field("last", &self.last)
            .field("status", &self.status)
            .field("statistics", &self.statistics)
            .finish_non_exhaustive()
    }
}

impl<X: State<f64>> AdaptiveRun<X> {
    /// Whether the run reached its end.
    pub const fn is_complete(&self) -> bool {
        matches!(self.status, AdaptiveStatus::Completed)
    }

    /// The points the integrator stepped on: the start and the end of every accepted step.
    pub fn samples(&self) -> impl Iterator<Item = Sample<X>> + '_ {
        let ends = self.steps.iter().skip(1).map(|step| Sample {
            time_s: step.start_s,
            state: step.start,
        });
        let first = std::iter::once(self.initial);
        first
            .chain(ends)
            .chain((!self.steps.is_empty()).then_some(self.last))
    }

    /// The state at time `t`, s, by the continuous extension; `None` outside the computed span.
    pub fn at(&self, t: f64) -> Option<X> {
        if t == self.last.time_s {
            return Some(self.last.state);
        }
        if !(self.initial.time_s <= t && t < self.last.time_s) {
            return None;
        }
        let after = self.steps.partition_point(|step| step.start_s <= t);
        Some(self.steps[after - 1].at(t))
    }
}
