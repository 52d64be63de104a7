//! Uniformly random candidates: the plainest optimiser, and a yardstick for the others.

use crate::draws::Draws;
use crate::{Candidate, Evaluation, Optimiser, SetupError, Space, StopReason, TellError, Variable};
use serde::{Deserialize, Serialize};

/// Uniformly random candidates within the bounds, a given number of them.
///
/// Candidate k is drawn from stream k of a ChaCha8 generator with the seed: it doesn't depend on what was
/// asked or answered before, so a saved search resumes as if it had not been interrupted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RandomSearch {
    variables: Space,
    seed: u64,
    budget: u64,
    asked: u64,
    awaited: Vec<u64>,
    /// Asked for and lost: to be proposed again, the first one last.
    renewed: Vec<u64>,
    evaluations: u64,
    best: Option<Evaluation>,
}

impl RandomSearch {
    /// A search of `budget` candidates.
    ///
    /// # Errors
    /// No variables; bounds that are not finite or enclose nothing.
    pub fn new(variables: Vec<Variable>, seed: u64, budget: u64) -> Result<Self, SetupError> {
        Ok(Self {
            variables: Space::new(variables)?,
            seed,
            budget,
            asked: 0,
            awaited: Vec::new(),
            renewed: Vec::new(),
            evaluations: 0,
            best: None,
        })
    }

    /// Candidate number `id`.
    fn candidate(&self, id: u64) -> Candidate {
        let mut draws = Draws::new(self.seed, id);
        let variables = self.variables.variables().iter();
        let values = variables.map(|v| v.lower + draws.share() * (v.upper - v.lower));
        Candidate {
            id,
            values: values.collect(),
        }
    }
}

impl Optimiser for RandomSearch {
    fn variables(&self) -> &[Variable] {
        self.variables.variables()
    }

    fn ask(&mut self) -> Option<Candidate> {
        let id = match self.renewed.pop() {
            Some(id) => id,
            None => {
                let id = (self.asked < self.budget).then_some(self.asked)?;
                self.asked += 1;
                id
            }
        };
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

    fn renew(&mut self) {
        self.renewed.append(&mut self.awaited);
        self.renewed.sort_unstable_by(|a, b| b.cmp(a));
    }

    fn best(&self) -> Option<&Evaluation> {
        self.best.as_ref()
    }

    fn evaluations(&self) -> u64 {
        self.evaluations
    }

    fn ending(&self) -> Option<StopReason> {
        let left = self.asked < self.budget || !self.renewed.is_empty() || !self.awaited.is_empty();
        (!left).then_some(StopReason::ScheduleDone)
    }
}
