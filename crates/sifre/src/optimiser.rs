//! Optimisers: who propose decision vectors and are told what they cost.
//!
//! Ask and tell, so that any algorithm drives any simulation: the loop, its threads, its progress and its end belong
//! to the caller. [`RandomSearch`] is the plainest of them and proves the trait.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use serde::{Deserialize, Serialize};

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

/// Why an optimiser can't be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum OptimiserError {
    /// Nothing to decide.
    #[error("an optimiser needs at least one variable")]
    NoVariables,
    /// Bounds that enclose nothing.
    #[error(
        "variable \"{name}\" must lie between two finite bounds, lower first, not between {lower} and {upper}"
    )]
    BadBounds {
        /// The variable.
        name: String,
        /// Its lower bound.
        lower: f64,
        /// Its upper bound.
        upper: f64,
    },
}

/// Why an optimiser can't be told a cost.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum TellError {
    /// A candidate that was not asked for, or is told twice.
    #[error("candidate {id} is not awaited: it was never asked for, or told already")]
    NotAwaited {
        /// The candidate.
        id: u64,
    },
    /// A cost that is no number.
    #[error("candidate {id} costs {cost}: tell a finite cost, with a penalty where the simulation failed")]
    NotFinite {
        /// The candidate.
        id: u64,
        /// The cost.
        cost: f64,
    },
}

/// Proposes decision vectors and learns what they cost.
///
/// Several candidates may be asked for before one is told, in any order, as far as the algorithm has
/// something to propose. Anything random comes from a seed, so the same seed and the same costs give the same run.
pub trait Optimiser {
    /// What is decided on.
    fn variables(&self) -> &[Variable];

    /// The next proposal; `None` where it waits for costs or is [done](Optimiser::is_done).
    fn ask(&mut self) -> Option<Candidate>;

    /// What a proposal cost.
    ///
    /// # Errors
    /// A candidate that isn't awaited; a cost that isn't finite (the candidate is then still awaited).
    fn tell(&mut self, candidate: &Candidate, cost: f64) -> Result<(), TellError>;

    /// The best so far.
    fn best(&self) -> Option<&Evaluation>;

    /// How many costs it was told.
    fn evaluations(&self) -> u64;

    /// Whether it has nothing more to propose and awaits nothing.
    fn is_done(&self) -> bool;
}

/// Asks and tells, one candidate at a time, until the optimiser is done or has nothing to ask.
///
/// # Errors
/// A cost that isn't finite.
pub fn minimise(
    optimiser: &mut dyn Optimiser,
    mut cost: impl FnMut(&[f64]) -> f64,
) -> Result<Option<Evaluation>, TellError> {
    while let Some(candidate) = optimiser.ask() {
        let cost = cost(&candidate.values);
        optimiser.tell(&candidate, cost)?;
    }
    Ok(optimiser.best().cloned())
}

/// Uniformly random candidates within the bounds, a given number of them.
///
/// Candidate k is drawn from stream k of a ChaCha8 generator with the seed: it doesn't depend on what was
/// asked or told before, so a saved search goes on as if it had not been interrupted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RandomSearch {
    variables: Vec<Variable>,
    seed: u64,
    budget: u64,
    asked: u64,
    awaited: Vec<u64>,
    evaluations: u64,
    best: Option<Evaluation>,
}

impl RandomSearch {
    /// A search of `budget` candidates.
    ///
    /// # Errors
    /// No variables; bounds that are not finite or in the wrong order.
    pub fn new(variables: Vec<Variable>, seed: u64, budget: u64) -> Result<Self, OptimiserError> {
        if variables.is_empty() {
            return Err(OptimiserError::NoVariables);
        }
        let bad = |v: &&Variable| !((v.upper - v.lower).is_finite() && v.lower <= v.upper);
        if let Some(Variable {
            name, lower, upper, ..
        }) = variables.iter().find(bad)
        {
            let (name, lower, upper) = (name.clone(), *lower, *upper);
            return Err(OptimiserError::BadBounds { name, lower, upper });
        }
        Ok(Self {
            variables,
            seed,
            budget,
            asked: 0,
            awaited: Vec::new(),
            evaluations: 0,
            best: None,
        })
    }

    /// Candidate number `id`.
    fn candidate(&self, id: u64) -> Candidate {
        let mut generator = ChaCha8Rng::seed_from_u64(self.seed);
        generator.set_stream(id);
        // The 53 upper bits make a number of [0, 1).
        let mut share = || (generator.next_u64() >> 11) as f64 * (f64::EPSILON / 2.0);
        Candidate {
            id,
            values: self
                .variables
                .iter()
                .map(|v| v.lower + share() * (v.upper - v.lower))
                .collect(),
        }
    }
}

impl Optimiser for RandomSearch {
    fn variables(&self) -> &[Variable] {
        &self.variables
    }

    fn ask(&mut self) -> Option<Candidate> {
        let id = (self.asked < self.budget).then_some(self.asked)?;
        self.asked += 1;
        self.awaited.push(id);
        Some(self.candidate(id))
    }

    fn tell(&mut self, candidate: &Candidate, cost: f64) -> Result<(), TellError> {
        let id = candidate.id;
        let place = self.awaited.iter().position(|&awaited| awaited == id);
        let place = place.ok_or(TellError::NotAwaited { id })?;
        if !cost.is_finite() {
            return Err(TellError::NotFinite { id, cost });
        }
        self.awaited.swap_remove(place);
        self.evaluations += 1;
        // Of equal costs the first asked for, so that the order of telling doesn't matter.
        let better = |best: &Evaluation| cost < best.cost || (cost == best.cost && id < best.candidate.id);
        if self.best.as_ref().is_none_or(better) {
            let candidate = candidate.clone();
            self.best = Some(Evaluation { candidate, cost });
        }
        Ok(())
    }

    fn best(&self) -> Option<&Evaluation> {
        self.best.as_ref()
    }

    fn evaluations(&self) -> u64 {
        self.evaluations
    }

    fn is_done(&self) -> bool {
        self.asked == self.budget && self.awaited.is_empty()
    }
}
