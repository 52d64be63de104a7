//! Asking and telling for every method: a rule turns the answers to one batch of points into the next batch.

use crate::{Answer, Candidate, Evaluation, Optimiser, SetupError, Space, StopReason, TellError, Variable};
use serde::{Deserialize, Serialize};

/// A point and the answer to it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Vertex<A = f64> {
    /// One value per variable, in its unit.
    pub values: Vec<f64>,
    /// Cost, or cost and gradient.
    pub answer: A,
}

impl<A: Answer> Vertex<A> {
    /// Its cost.
    pub fn cost(&self) -> f64 {
        self.answer.cost()
    }
}

/// What a method does next.
#[derive(Clone, Debug, PartialEq)]
pub enum Next {
    /// Evaluate these points, in any order; at least one.
    Ask(Vec<Vec<f64>>),
    /// Nothing more.
    Stop(StopReason),
}

/// A method: from the answers to a batch to the next batch. What it remembers is its own state.
pub trait Rule<A = f64> {
    /// What comes after these points, which are those asked for, in that order.
    fn next(&mut self, space: &Space, told: Vec<Vertex<A>>) -> Next;
}

/// A point of the batch under way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Slot<A> {
    values: Vec<f64>,
    proposed: bool,
    answer: Option<A>,
}

/// An optimiser that follows a rule.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stepwise<R, A = f64> {
    space: Space,
    rule: R,
    batch: Vec<Slot<A>>,
    first_id: u64,
    evaluations: u64,
    best: Option<Evaluation>,
    ending: Option<StopReason>,
}

impl<A, R: Rule<A>> Stepwise<R, A> {
    /// Follows `rule` from a first batch of points.
    ///
    /// # Errors
    /// A first point outside the space, or none.
    pub fn start(space: Space, rule: R, first: Vec<Vec<f64>>) -> Result<Self, SetupError> {
        let count = first.len() as f64;
        SetupError::unless(
            !first.is_empty(),
            "points of the first batch",
            count,
            "at least one",
        )?;
        for point in &first {
            space.admit(point)?;
        }
        Ok(Self {
            space,
            rule,
            batch: slots(first),
            first_id: 0,
            evaluations: 0,
            best: None,
            ending: None,
        })
    }

    /// The rule with its state.
    pub fn rule(&self) -> &R {
        &self.rule
    }

    /// The box that is searched.
    pub fn space(&self) -> &Space {
        &self.space
    }

    /// Where an awaited candidate is in the batch.
    fn place(&self, id: u64) -> Result<usize, TellError> {
        let place = id.checked_sub(self.first_id).map(|k| k as usize);
        let awaited = |slot: &Slot<A>| slot.proposed && slot.answer.is_none();
        place
            .filter(|&k| self.batch.get(k).is_some_and(awaited))
            .ok_or(TellError::NotAwaited { id })
    }
}

fn slots<A>(points: Vec<Vec<f64>>) -> Vec<Slot<A>> {
    let slot = |values| Slot {
        values,
        proposed: false,
        answer: None,
    };
    points.into_iter().map(slot).collect()
}

impl<A: Answer, R: Rule<A>> Stepwise<R, A> {
    /// Once every point is answered: on to the next batch.
    fn advance(&mut self) {
        let told = |slot: Slot<A>| {
            let values = slot.values;
            slot.answer.map(|answer| Vertex { values, answer })
        };
        let count = self.batch.len() as u64;
        let answered = std::mem::take(&mut self.batch)
            .into_iter()
            .filter_map(told)
            .collect();
        self.first_id += count;
        match self.rule.next(&self.space, answered) {
            Next::Ask(points) => self.batch = slots(points),
            Next::Stop(reason) => self.ending = Some(reason),
        }
    }
}

impl<A: Answer, R: Rule<A>> Optimiser<A> for Stepwise<R, A> {
    fn variables(&self) -> &[Variable] {
        self.space.variables()
    }

    fn ask(&mut self) -> Option<Candidate> {
        let place = self.batch.iter().position(|slot| !slot.proposed)?;
        self.batch[place].proposed = true;
        Some(Candidate {
            id: self.first_id + place as u64,
            values: self.batch[place].values.clone(),
        })
    }

    fn tell(&mut self, candidate: &Candidate, answer: A) -> Result<(), TellError> {
        let id = candidate.id;
        let place = self.place(id)?;
        let cost = answer.cost();
        if !cost.is_finite() {
            return Err(TellError::NotFinite { id, cost });
        }
        // A gradient of other variables is worth nothing, nor is its cost.
        let n = self.space.dimension();
        let answer = if answer.is_usable(n) { answer } else { A::failed(n) };
        let cost = answer.cost();
        self.evaluations += 1;
        // Of equal costs the first asked for, so that the order of telling doesn't matter.
        let better = |best: &Evaluation| cost < best.cost || (cost == best.cost && id < best.candidate.id);
        if self.best.as_ref().is_none_or(better) {
            let values = self.batch[place].values.clone();
            let candidate = Candidate { id, values };
            self.best = Some(Evaluation { candidate, cost });
        }
        self.batch[place].answer = Some(answer);
        if self.batch.iter().all(|slot| slot.answer.is_some()) {
            self.advance();
        }
        Ok(())
    }

    fn renew(&mut self) {
        for slot in &mut self.batch {
            slot.proposed = slot.answer.is_some();
        }
    }

    fn best(&self) -> Option<&Evaluation> {
        self.best.as_ref()
    }

    fn evaluations(&self) -> u64 {
        self.evaluations
    }

    fn ending(&self) -> Option<StopReason> {
        self.ending
    }
}
