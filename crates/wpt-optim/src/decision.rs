//! Decision variables: boundary conditions with bounds and a start.

use crate::condition::Condition;
use crate::error::ProblemError;
use optim::{Space, Variable};
use serde::{Deserialize, Serialize};

/// A boundary condition that is decided on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Decision {
    /// Which boundary condition.
    #[serde(rename = "variable")]
    pub condition: Condition,
    /// Smallest value, in the unit of the condition's key.
    pub lower: f64,
    /// Largest value.
    pub upper: f64,
    /// Where a local search starts.
    pub start: f64,
}

impl Decision {
    /// The variable as optimisers know it.
    pub fn variable(&self) -> Variable {
        Variable {
            name: self.condition.symbol(),
            unit: self.condition.order.unit().to_owned(),
            lower: self.lower,
            upper: self.upper,
        }
    }
}

/// Checks a list of variables: at least one, none twice, bounds in order, starts within.
pub(crate) fn check(decisions: &[Decision]) -> Result<(), ProblemError> {
    let space = Space::new(decisions.iter().map(Decision::variable).collect())?;
    let start: Vec<f64> = decisions.iter().map(|d| d.start).collect();
    Ok(space.admit(&start)?)
}
