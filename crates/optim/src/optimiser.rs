//! The trait of all optimisers: they propose decision vectors and learn what they cost.
//!
//! Ask and tell, so that any algorithm drives any simulation: the loop, its threads, its progress and its end belong to the
//! caller. [`minimise`](crate::minimise), [`run`](crate::run) and [`run_parallel`](crate::run_parallel) are such loops.

use crate::TellError;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::time::Duration;

/// One component of a decision vector.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Variable {
    /// Its name, as in `x_0`.
    pub name: String,
    /// SI unit; `1` for a pure number.
    pub unit: String,
    /// Smallest value.
    pub lower: f64,
    /// Largest value.
    pub upper: f64,
}

/// A proposal: evaluate it and tell its cost.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Candidate {
    /// Number of the proposal, from 0 in the order of asking.
    pub id: u64,
    /// One value per [`Variable`].
    pub values: Vec<f64>,
}

/// A proposal and what it cost.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Evaluation {
    /// The proposal.
    pub candidate: Candidate,
    /// Its cost: less is better.
    pub cost: f64,
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

/// Proposes decision vectors and learns what they cost.
///
/// `A` is what a cost function answers: a cost, or a cost with its gradient ([`CostAndGradient`](crate::CostAndGradient)). Several
/// candidates may be asked for before one is answered, in any order, as far as the algorithm has something to propose. Anything random
/// comes from a seed, so the same seed and the same costs give the same run.
pub trait Optimiser<A = f64> {
    /// What is decided on.
    fn variables(&self) -> &[Variable];

    /// The next proposal; `None` where it waits for answers or has ended.
    fn ask(&mut self) -> Option<Candidate>;

    /// The answer to a proposal.
    ///
    /// # Errors
    /// A candidate that isn't awaited; a cost that isn't finite (the candidate is then still awaited).
    fn tell(&mut self, candidate: &Candidate, answer: A) -> Result<(), TellError>;

    /// Proposes once more what was proposed and not answered, after an interruption.
    fn renew(&mut self);

    /// The best so far.
    fn best(&self) -> Option<&Evaluation>;

    /// Number of answers it has received.
    fn evaluations(&self) -> u64;

    /// Why it ended; `None` while it continues.
    fn ending(&self) -> Option<StopReason>;

    /// Whether it has nothing more to propose and awaits nothing.
    fn is_done(&self) -> bool {
        self.ending().is_some()
    }
}
