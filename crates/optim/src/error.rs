//! What can be wrong with an optimisation before and while it runs.

/// Why an optimiser can't be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SetupError {
    /// Nothing to decide.
    #[error("an optimiser needs at least one variable")]
    NoVariables,
    /// The same variable twice.
    #[error("variable \"{name}\" is listed twice")]
    Twice {
        /// Its name.
        name: String,
    },
    /// Bounds that enclose nothing.
    #[error("variable \"{name}\": bounds must be finite with lower < upper, got [{lower}, {upper}]")]
    BadBounds {
        /// The variable.
        name: String,
        /// Its lower bound.
        lower: f64,
        /// Its upper bound.
        upper: f64,
    },
    /// A start that doesn't have one value per variable.
    #[error("a start needs one value for each of the {expected} variables, got {found}")]
    StartLength {
        /// Number of variables.
        expected: usize,
        /// Number of values.
        found: usize,
    },
    /// A start beyond the bounds.
    #[error("variable \"{name}\": the start must lie within its bounds [{lower}, {upper}], got {value}")]
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
    #[error("a simplex in {variables} variables has {} vertices, got {found}", variables + 1)]
    SimplexSize {
        /// Number of variables.
        variables: usize,
        /// Number of vertices.
        found: usize,
    },
    /// A setting out of its range.
    #[error("setting \"{name}\" must be {must_be}, got {value}")]
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

/// Why an optimiser can't take an answer.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum TellError {
    /// A candidate that was not asked for, or is answered twice.
    #[error("candidate {id} is not awaited: it was never proposed, or was answered already")]
    NotAwaited {
        /// The candidate.
        id: u64,
    },
    /// A cost that is NaN or infinite.
    #[error(
        "the cost of candidate {id} must be finite, got {cost}: give a penalty where the simulation failed"
    )]
    NotFinite {
        /// The candidate.
        id: u64,
        /// The cost.
        cost: f64,
    },
}

/// Why a run has no result.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum RunError {
    /// No evaluation allowed.
    #[error("a run needs a budget of at least one evaluation, got 0")]
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
