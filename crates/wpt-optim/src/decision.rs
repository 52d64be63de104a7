//! Decision variables: boundary conditions with bounds and a start.

use crate::condition::Condition;
use crate::error::ProblemError;
use serde::{Deserialize, Serialize};
use sifre::Variable;

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

    fn check(&self) -> Result<(), ProblemError> {
        let Self {
            condition,
            lower,
            upper,
            start,
        } = *self;
        if !(lower.is_finite() && upper.is_finite() && lower < upper) {
            return Err(ProblemError::BadBounds {
                condition,
                lower,
                upper,
            });
        }
        if !(lower..=upper).contains(&start) {
            return Err(ProblemError::StartOutside {
                condition,
                start,
                lower,
                upper,
            });
        }
        Ok(())
    }
}

/// Checks a list of variables: at least one, none twice, bounds in order, starts within.
pub(crate) fn check(decisions: &[Decision]) -> Result<(), ProblemError> {
    if decisions.is_empty() {
        return Err(ProblemError::NoVariables);
    }
    for (i, decision) in decisions.iter().enumerate() {
        decision.check()?;
        if decisions[..i].iter().any(|d| d.condition == decision.condition) {
            let condition = decision.condition;
            return Err(ProblemError::Twice { condition });
        }
    }
    Ok(())
}
