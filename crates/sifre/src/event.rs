//! What happens during a run that is worth noting.

use quad_dynamics::Level;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Something that happened to an agent.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", tag = "event")]
pub enum AgentEvent {
    /// A quadrotor continues at another level of resolution.
    LevelChanged {
        /// The level until now.
        from: Level,
        /// The level from now on.
        to: Level,
    },
    /// A tracker has lost sight of its target.
    TargetLost,
    /// A tracker sees its target (again).
    TargetFound,
    /// A quadrotor's estimator failed, which ends the run.
    EstimatorFailed {
        /// Why, in words.
        reason: String,
    },
    /// Whatever another kind of agent has to tell.
    Note {
        /// In words.
        text: Cow<'static, str>,
    },
}

/// Something that happened, when and to whom.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Event {
    /// When, ns.
    pub time_ns: u64,
    /// Name of the agent.
    pub agent: String,
    /// What.
    #[serde(flatten)]
    pub what: AgentEvent,
}
