//! What can be wrong with an optimisation before and while it runs.

use sifre::TellError;

/// Why an optimiser can't be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SetupError {
    /// Nothing to decide.
    #[error("an optimiser needs at least one variable")]
    NoVariables,
    /// Bounds that enclose nothing.
    #[error(
        "variable \"{name}\" must lie between two finite bounds, the lower one first and less than the upper one, not between {lower} and {upper}"
    )]
    BadBounds {
        /// The variable.
        name: String,
        /// Its lower bound.
        lower: f64,
        /// Its upper bound.
        upper: f64,
    },
    /// A start that doesn't have one value per variable.
    #[error("a start needs one value for each of the {expected} variables, not {found}")]
    StartLength {
        /// Number of variables.
        expected: usize,
        /// Number of values.
        found: usize,
    },
    /// A start beyond the bounds.
    #[error(
        "the start of \"{name}\", {value}, is outside its bounds, {lower} to {upper}: move it or widen them"
    )]
    StartOutside {
        /// The variable.
        name: String,
        /// Its start.
        value: f64,
        /// Its lower bound.
        lower: f64,
        /// Its upper bound.
        upper: f64,
    },
    /// A simplex of another number of vertices than one more than there are variables.
    #[error("a simplex in {variables} variables has {} vertices, not {found}", variables + 1)]
    SimplexSize {
        /// Number of variables.
        variables: usize,
        /// Number of vertices.
        found: usize,
    },
    /// A setting out of its range.
    #[error("the setting \"{name}\" is {value} and must be {must_be}")]
    BadSetting {
        /// The setting.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it must be.
        must_be: &'static str,
    },
}

impl SetupError {
    /// An error unless the setting is in its range.
    pub(crate) fn unless(
        ok: bool,
        name: &'static str,
        value: f64,
        must_be: &'static str,
    ) -> Result<(), Self> {
        if ok {
            return Ok(());
        }
        Err(Self::BadSetting { name, value, must_be })
    }
}

/// Why a run has no result.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum RunError {
    /// No evaluation allowed.
    #[error("a budget of zero evaluations finds nothing: allow at least one")]
    ZeroBudget,
    /// The optimiser had ended before.
    #[error("the optimiser has ended before this run and has no best candidate")]
    NothingToAsk,
    /// No candidate had a finite cost.
    #[error(
        "none of the {evaluations} candidates evaluated has a finite cost (the last one cost {last_cost}): check the cost function and the bounds"
    )]
    AllFailed {
        /// How many were evaluated.
        evaluations: u64,
        /// What the last one cost.
        last_cost: f64,
    },
    /// The optimiser refused a cost.
    #[error(transparent)]
    Tell(#[from] TellError),
}
