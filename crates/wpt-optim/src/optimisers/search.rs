//! What every optimiser here can do, with or without gradients.

use serde::{Deserialize, Serialize};
use sifre::{Candidate, Evaluation, Optimiser, RandomSearch, TellError};
use std::fmt;
use std::time::Duration;

/// The cost told in place of one that is not finite: worse than any that is, and differences of it stay finite.
pub const FAILED_COST: f64 = 1e300;

/// The cost of a point that has none yet: worse than any, and a number that JSON can write.
pub(super) const NO_COST: f64 = f64::MAX;

/// What a cost function answers: a cost, or a cost with its gradient.
pub trait Answer: Clone {
    /// The cost.
    fn cost(&self) -> f64;

    /// Whether it speaks of `n` variables, every number of it is finite, and the cost is below [`FAILED_COST`].
    fn is_usable(&self, n: usize) -> bool;

    /// The answer in its place where it isn't, for `n` variables.
    fn failed(n: usize) -> Self;
}

impl Answer for f64 {
    fn cost(&self) -> f64 {
        *self
    }

    fn is_usable(&self, _n: usize) -> bool {
        self.abs() < FAILED_COST
    }

    fn failed(_n: usize) -> Self {
        FAILED_COST
    }
}

/// A cost and its derivative with respect to each variable, in the cost's unit per the variable's.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CostAndGradient {
    /// Cost `f`.
    pub cost: f64,
    /// Gradient `∂f/∂x_i`.
    pub gradient: Vec<f64>,
}

impl Answer for CostAndGradient {
    fn cost(&self) -> f64 {
        self.cost
    }

    fn is_usable(&self, n: usize) -> bool {
        self.cost.is_usable(n) && self.gradient.len() == n && self.gradient.iter().all(|g| g.is_finite())
    }

    fn failed(n: usize) -> Self {
        Self {
            cost: FAILED_COST,
            gradient: vec![0.0; n],
        }
    }
}

/// Why an optimisation ended.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum StopReason {
    /// The candidates left differ by less than the tolerances.
    Converged {
        /// Largest difference of a variable (annealing: longest step), as a share of its width.
        spread: f64,
        /// Largest difference of the costs (with gradients: largest component of the projected gradient).
        cost_spread: f64,
    },
    /// No further progress, though the tolerances are not met.
    Stalled {
        /// Iterations since the last progress.
        iterations: u64,
    },
    /// The method's own schedule is at its end.
    ScheduleDone,
    /// All evaluations allowed are spent.
    Budget {
        /// How many.
        evaluations: u64,
    },
    /// The time allowed is over.
    Time {
        /// How long it took.
        elapsed: Duration,
    },
    /// A cost as low as asked for.
    Target {
        /// The cost.
        cost: f64,
    },
    /// The observer said so.
    Interrupted,
}

impl fmt::Display for StopReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Converged { spread, cost_spread } => {
                write!(
                    f,
                    "converged: spread {spread:.1e} of the box, {cost_spread:.1e} of the cost"
                )
            }
            Self::Stalled { iterations } => write!(f, "stalled: no progress for {iterations} iterations"),
            Self::ScheduleDone => f.write_str("schedule at its end"),
            Self::Budget { evaluations } => write!(f, "budget of {evaluations} evaluations spent"),
            Self::Time { elapsed } => write!(f, "time over after {:.1} s", elapsed.as_secs_f64()),
            Self::Target { cost } => write!(f, "target reached: {cost:.3e}"),
            Self::Interrupted => f.write_str("interrupted"),
        }
    }
}

/// An optimiser that is told answers of type `A` and says why it ended.
///
/// Its verbs are not those of [`Optimiser`], so that both traits can be in scope.
pub trait Search<A = f64> {
    /// How many variables are decided on.
    fn dimension(&self) -> usize;

    /// The next candidate; `None` where it waits for answers or has ended.
    fn propose(&mut self) -> Option<Candidate>;

    /// The answer to a candidate.
    ///
    /// # Errors
    /// A candidate that isn't awaited; an answer that isn't finite (the candidate is then still awaited).
    fn learn(&mut self, candidate: &Candidate, answer: A) -> Result<(), TellError>;

    /// Proposes once more what was proposed and not answered, after an interruption.
    fn renew(&mut self);

    /// The best so far.
    fn best_so_far(&self) -> Option<&Evaluation>;

    /// Why it ended; `None` while it goes on.
    fn ending(&self) -> Option<StopReason>;
}

impl Search for RandomSearch {
    fn dimension(&self) -> usize {
        self.variables().len()
    }

    fn propose(&mut self) -> Option<Candidate> {
        self.ask()
    }

    fn learn(&mut self, candidate: &Candidate, answer: f64) -> Result<(), TellError> {
        self.tell(candidate, answer)
    }

    /// Does nothing: candidates of a random search that were lost are as good as any other.
    fn renew(&mut self) {}

    fn best_so_far(&self) -> Option<&Evaluation> {
        self.best()
    }

    fn ending(&self) -> Option<StopReason> {
        self.is_done().then_some(StopReason::ScheduleDone)
    }
}
