//! What a cost function answers, with or without a gradient.

use serde::{Deserialize, Serialize};

/// The cost that replaces a non-finite one: worse than any finite cost, and its differences stay finite.
pub const FAILED_COST: f64 = 1e300;

/// The cost of a point that has none yet: worse than any, and a number that JSON can write.
pub(crate) const NO_COST: f64 = f64::MAX;

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
