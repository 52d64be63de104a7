//! Many decisions at once: cost surfaces and populations on SIMD lanes and all cores, and an objective that counts.

use crate::cost::FAILURE;
use crate::error::ProblemError;
use crate::outcome::Outcome;
use crate::problem::{LANES, Problem};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::sync::atomic::{AtomicU64, Ordering};

/// Nodes of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Grid {
    /// Nodes along the first variable.
    pub columns: usize,
    /// Nodes along the second.
    pub rows: usize,
}

/// The cost over the box of a problem of two variables.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Nodes of the first variable, ascending, bounds included.
    pub first: Vec<f64>,
    /// Nodes of the second variable.
    pub second: Vec<f64>,
    /// What each node costs: row by row, a row for each node of the second variable.
    pub outcomes: Vec<Outcome>,
}

/// A node that costs less than all its neighbours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Minimum {
    /// The decision.
    pub at: [f64; 2],
    /// Its cost.
    pub cost: f64,
}

/// `count` values from `lower` to `upper`, both included.
fn nodes(lower: f64, upper: f64, count: usize) -> Vec<f64> {
    let last = (count - 1) as f64;
    (0..count)
        .map(|i| (lower * (last - i as f64) + upper * i as f64) / last)
        .collect()
}

impl Problem {
    /// Flies many decisions: four side by side, on all cores. The result does not depend on the number of threads.
    ///
    /// # Errors
    /// A decision of another length, or with a number that isn't finite.
    pub fn evaluate_all(&self, decisions: &[Vec<f64>]) -> Result<Vec<Outcome>, ProblemError> {
        let blocks: Vec<_> = decisions
            .par_chunks(LANES)
            .map(|block| {
                // Lanes beyond the last decision repeat it.
                let lanes = std::array::from_fn(|i| block[i.min(block.len() - 1)].as_slice());
                Ok(self.evaluate_lanes(lanes)?.into_iter().take(block.len()))
            })
            .collect::<Result<_, ProblemError>>()?;
        Ok(blocks.into_iter().flatten().collect())
    }

    /// The cost over the box of the two variables.
    ///
    /// # Errors
    /// A problem of other than two variables; less than two nodes along one; flights that all failed.
    pub fn surface(&self, grid: Grid) -> Result<Surface, ProblemError> {
        let [first, second] = self.decisions() else {
            let variables = self.decisions().len();
            return Err(ProblemError::NotTwoVariables { variables });
        };
        let Grid { columns, rows } = grid;
        if columns < 2 || rows < 2 {
            return Err(ProblemError::EmptySurface { columns, rows });
        }
        let first = nodes(first.lower, first.upper, columns);
        let second = nodes(second.lower, second.upper, rows);
        let decisions: Vec<_> = second
            .iter()
            .flat_map(|&b| first.iter().map(move |&a| vec![a, b]))
            .collect();
        let outcomes = self.evaluate_all(&decisions)?;
        if outcomes.iter().all(|outcome| outcome.failure.is_some()) {
            let evaluations = outcomes.len();
            return Err(ProblemError::AllFailed { evaluations });
        }
        Ok(Surface {
            first,
            second,
            outcomes,
        })
    }
}

impl Surface {
    /// The cost at a node.
    ///
    /// # Panics
    /// Outside of the grid: a programming error.
    pub fn cost(&self, column: usize, row: usize) -> f64 {
        self.outcomes[row * self.first.len() + column].cost
    }

    /// How many of the flights failed.
    pub fn failures(&self) -> usize {
        self.outcomes.iter().filter(|o| o.failure.is_some()).count()
    }

    /// Nodes within the box that cost less than their eight neighbours, cheapest first.
    pub fn minima(&self) -> Vec<Minimum> {
        let (columns, rows) = (self.first.len(), self.second.len());
        let mut minima = Vec::new();
        for row in 1..rows.saturating_sub(1) {
            for column in 1..columns.saturating_sub(1) {
                let cost = self.cost(column, row);
                let neighbours =
                    (row - 1..=row + 1).flat_map(|r| (column - 1..=column + 1).map(move |c| (c, r)));
                let is_least = neighbours
                    .filter(|&at| at != (column, row))
                    .all(|(c, r)| cost < self.cost(c, r));
                if is_least {
                    let at = [self.first[column], self.second[row]];
                    minima.push(Minimum { at, cost });
                }
            }
        }
        minima.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        minima
    }
}

/// A problem as a function from decision to cost that counts, for optimisers: shared by threads, never NaN.
#[derive(Debug)]
pub struct Objective<'a> {
    problem: &'a Problem,
    evaluations: AtomicU64,
    failures: AtomicU64,
}

impl<'a> Objective<'a> {
    /// Nothing asked yet.
    pub fn new(problem: &'a Problem) -> Self {
        Self {
            problem,
            evaluations: AtomicU64::new(0),
            failures: AtomicU64::new(0),
        }
    }

    /// The cost of a decision: finite whatever happens. A failed flight costs its penalty; a decision that can't be flown
    /// (numbers that are not finite, another length) as much as one that fails at once. Both are counted as failures.
    pub fn cost(&self, x: &[f64]) -> f64 {
        self.evaluations.fetch_add(1, Ordering::Relaxed);
        let outcome = self.problem.evaluate(x);
        let failed = outcome.as_ref().map_or(true, |o| o.failure.is_some());
        self.failures.fetch_add(u64::from(failed), Ordering::Relaxed);
        outcome.map_or(FAILURE, |o| o.cost)
    }

    /// How many costs were asked for.
    pub fn evaluations(&self) -> u64 {
        self.evaluations.load(Ordering::Relaxed)
    }

    /// How many of them were failures.
    pub fn failures(&self) -> u64 {
        self.failures.load(Ordering::Relaxed)
    }
}
