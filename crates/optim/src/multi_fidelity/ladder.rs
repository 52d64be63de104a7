//! The levels with their counts and the corrections between them.

use super::correction::{Correction, Node};
use super::{LevelCost, LevelProgress};
use crate::{Answer, Space, Variable};
use std::cell::Cell;
use std::ops::ControlFlow;

/// Calls of one level.
#[derive(Debug, Default)]
struct Count {
    calls: Cell<u64>,
    failed: Cell<u64>,
}

/// The levels, the lowest first.
pub(super) struct Ladder<'a> {
    pub(super) space: Space,
    /// The least cost of the highest level after each of its calls.
    pub(super) history: Vec<f64>,
    costs: &'a [LevelCost<'a>],
    counts: Vec<Count>,
    /// Differences of each level from the one below; none of the lowest.
    differences: Vec<Vec<Node>>,
    corrections: Vec<Correction>,
    observe: &'a mut dyn FnMut(&LevelProgress) -> ControlFlow<()>,
}

impl<'a> Ladder<'a> {
    pub(super) fn new(
        space: Space,
        costs: &'a [LevelCost<'a>],
        observe: &'a mut dyn FnMut(&LevelProgress) -> ControlFlow<()>,
    ) -> Self {
        Self {
            space,
            history: Vec::new(),
            costs,
            counts: costs.iter().map(|_| Count::default()).collect(),
            differences: vec![Vec::new(); costs.len()],
            corrections: Vec::new(),
            observe,
        }
    }

    pub(super) fn variables(&self) -> Vec<Variable> {
        self.space.variables().to_vec()
    }

    /// The cost at a level; `None` where it is not finite.
    fn call(&self, level: usize, x: &[f64]) -> Option<f64> {
        let count = &self.counts[level - 1];
        count.calls.set(count.calls.get() + 1);
        let cost = (self.costs[level - 1])(x);
        let usable = cost.is_usable(x.len());
        count.failed.set(count.failed.get() + u64::from(!usable));
        usable.then_some(cost)
    }

    /// The cost at the lowest level; `None` where it is not finite.
    pub(super) fn lowest(&self, x: &[f64]) -> Option<f64> {
        self.call(1, x)
    }

    /// The cost at a level and, at the same point, at all below it, which the corrections learn from.
    pub(super) fn climb(&mut self, level: usize, x: &[f64]) -> Option<f64> {
        let cost = self.call(level, x);
        if level == self.costs.len() {
            let before = self.history.last().copied().unwrap_or(f64::MAX);
            self.history.push(before.min(cost.unwrap_or(f64::MAX)));
        }
        let (u, mut above) = (self.space.shares(x), cost?);
        for k in (2..=level).rev() {
            let below = self.call(k - 1, x)?;
            let known = &mut self.differences[k - 1];
            // An optimum is flown again when the next level begins there.
            if known.iter().all(|node| node.u != u) {
                let (u, difference) = (u.clone(), above - below);
                known.push(Node { u, difference });
            }
            above = below;
        }
        cost
    }

    /// Tells the observer; whether to stop.
    pub(super) fn report(&mut self, level: usize, best: f64) -> bool {
        let calls: Vec<u64> = self.counts.iter().map(|c| c.calls.get()).collect();
        let progress = LevelProgress {
            level,
            calls: &calls,
            best,
        };
        (self.observe)(&progress).is_break()
    }

    /// Fits the corrections of levels 2 to `level` about `x`.
    pub(super) fn correct(&mut self, level: usize, x: &[f64]) {
        let centre = self.space.shares(x);
        let known = self.differences[1..level].iter();
        self.corrections = known.map(|nodes| Correction::fit(nodes, &centre)).collect();
    }

    /// The corrected lowest level `s_L`; `None` where the lowest level fails.
    pub(super) fn surrogate(&self, x: &[f64]) -> Option<f64> {
        let u = self.space.shares(x);
        let corrections = self.corrections.iter().map(|c| c.at(&u)).sum::<f64>();
        Some(self.lowest(x)? + corrections)
    }

    pub(super) fn counts(&self) -> (Vec<u64>, Vec<u64>) {
        let calls = self.counts.iter().map(|c| c.calls.get()).collect();
        (calls, self.counts.iter().map(|c| c.failed.get()).collect())
    }
}
