//! The box of the decision vectors: variables between bounds.

use crate::{SetupError, Variable};
use serde::{Deserialize, Serialize};

/// A box: variables, each with a lower bound less than its upper one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<Variable>", into = "Vec<Variable>")]
pub struct Space {
    variables: Vec<Variable>,
}

impl Space {
    /// A box of these variables.
    ///
    /// # Errors
    /// No variables; one twice; bounds that are not finite, equal, or in the wrong order.
    pub fn new(variables: Vec<Variable>) -> Result<Self, SetupError> {
        if variables.is_empty() {
            return Err(SetupError::NoVariables);
        }
        for (k, v) in variables.iter().enumerate() {
            if variables[..k].iter().any(|other| other.name == v.name) {
                let name = v.name.clone();
                return Err(SetupError::Twice { name });
            }
        }
        let bad = |v: &&Variable| !((v.upper - v.lower).is_finite() && v.lower < v.upper);
        if let Some(v) = variables.iter().find(bad) {
            return Err(SetupError::BadBounds {
                name: v.name.clone(),
                lower: v.lower,
                upper: v.upper,
            });
        }
        Ok(Self { variables })
    }

    /// The variables.
    pub fn variables(&self) -> &[Variable] {
        &self.variables
    }

    /// How many variables there are, n.
    pub fn dimension(&self) -> usize {
        self.variables.len()
    }

    /// The distance between the bounds of variable `i`, in its unit.
    pub fn width(&self, i: usize) -> f64 {
        self.variables[i].upper - self.variables[i].lower
    }

    /// An error unless `start` has one value per variable, within the bounds.
    ///
    /// # Errors
    /// The wrong number of values, or the first value that is out of bounds or not finite.
    pub fn admit(&self, start: &[f64]) -> Result<(), SetupError> {
        let (expected, found) = (self.dimension(), start.len());
        if expected != found {
            return Err(SetupError::StartLength { expected, found });
        }
        for (v, &value) in self.variables.iter().zip(start) {
            if !(v.lower..=v.upper).contains(&value) {
                return Err(SetupError::StartOutside {
                    name: v.name.clone(),
                    value,
                    lower: v.lower,
                    upper: v.upper,
                });
            }
        }
        Ok(())
    }

    /// The nearest point of the box.
    pub fn clipped(&self, mut x: Vec<f64>) -> Vec<f64> {
        for (v, x) in self.variables.iter().zip(&mut x) {
            *x = x.clamp(v.lower, v.upper);
        }
        x
    }

    /// The point of the box at these shares of its widths, each from 0 (lower bound) to 1 (upper bound).
    pub fn at_shares(&self, shares: &[f64]) -> Vec<f64> {
        let point = self.variables.iter().zip(shares);
        self.clipped(point.map(|(v, s)| v.lower + s * (v.upper - v.lower)).collect())
    }

    /// Where a point lies, as shares of the widths.
    pub fn shares(&self, x: &[f64]) -> Vec<f64> {
        let point = self.variables.iter().zip(x);
        point.map(|(v, x)| (x - v.lower) / (v.upper - v.lower)).collect()
    }
}

impl TryFrom<Vec<Variable>> for Space {
    type Error = SetupError;

    fn try_from(variables: Vec<Variable>) -> Result<Self, SetupError> {
        Self::new(variables)
    }
}

impl From<Space> for Vec<Variable> {
    fn from(space: Space) -> Self {
        space.variables
    }
}
