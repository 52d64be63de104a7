//! Why a simulation can't be put together, asked to run, or resumed.

use crate::agent::MemoryError;
use quad_math::GridError;

/// An agent refers to another that does not exist.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("agent \"{agent}\" refers to \"{wanted}\", which {}", suggestion(.wanted, .agent, .known))]
pub struct UnknownAgent {
    /// The agent that refers.
    pub agent: String,
    /// The name it refers to.
    pub wanted: String,
    /// The other agents.
    pub known: Vec<String>,
}

fn suggestion(wanted: &str, agent: &str, known: &[String]) -> String {
    let what = if wanted == agent {
        "is itself"
    } else {
        "is not in the simulation"
    };
    if known.is_empty() {
        format!("{what}: it has no other agents; add it")
    } else {
        format!("{what}: add it, or name one of {}", known.join(", "))
    }
}

/// Why an agent can't take its place in a simulation.
#[derive(Debug, thiserror::Error)]
pub enum BindError {
    /// It refers to an agent that does not exist.
    #[error(transparent)]
    UnknownAgent(#[from] UnknownAgent),
    /// It can't have the step that it was given.
    #[error("agent \"{agent}\" can't run at a step of {step_s} s: {source}")]
    Step {
        /// The agent.
        agent: String,
        /// The step, s.
        step_s: f64,
        /// Why.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
}

/// Why a simulation can't be, or can't run.
#[derive(Debug, thiserror::Error)]
pub enum SimulationError {
    /// No agents.
    #[error("a simulation needs at least one agent: add a quadrotor, a target or an agent of your own")]
    Empty,
    /// Two agents of one name.
    #[error("two agents are named \"{name}\": give each its own name")]
    DuplicateName {
        /// The name.
        name: String,
    },
    /// An agent that can't take its place.
    #[error(transparent)]
    Bind(#[from] BindError),
    /// A time that the clock doesn't have.
    #[error("the end of the run: {0}")]
    Time(#[from] GridError),
    /// A flight added to a batch that has begun or is recorded.
    #[error("\"{name}\" can't be added: the batch has begun or is recorded; add all flights first")]
    AlreadyBegun {
        /// The flight.
        name: String,
    },
    /// An end before the present.
    #[error("the end of the run must be later than now, {now_s} s, got {end_s} s")]
    EndBeforeNow {
        /// The end asked for, s.
        end_s: f64,
        /// The present, s.
        now_s: f64,
    },
    /// A stop condition on an agent that isn't there.
    #[error("a stop condition names the unknown agent \"{wanted}\"; known: {}", .known.join(", "))]
    UnknownInCondition {
        /// The name.
        wanted: String,
        /// The agents there are.
        known: Vec<String>,
    },
    /// A black box was attached while an agent that it is to record is between two instants.
    #[error(
        "a black box can't be attached at {now_s} s: agent \"{agent}\" is between two of its instants and due at {due_s} s; \
         attach it before the run, or at a common multiple of the agents' steps"
    )]
    AttachedMidStep {
        /// The agent.
        agent: String,
        /// The present, s.
        now_s: f64,
        /// The agent's next instant, s.
        due_s: f64,
    },
    /// A black box could not be opened.
    #[error("the black box can't be started: {0}")]
    BlackBox(#[from] crate::BlackBoxError),
}

/// Why a snapshot can't be taken or resumed.
#[derive(Debug, thiserror::Error)]
pub enum SnapshotError {
    /// It is no snapshot, or can't be written as one.
    #[error("not a saved simulation: {0}")]
    Format(#[from] serde_json::Error),
    /// A snapshot of another version of the format.
    #[error("the saved simulation has format {found}, this version reads format {expected}")]
    Version {
        /// The format read.
        expected: u32,
        /// The format found.
        found: u32,
    },
    /// A time beyond the clock.
    #[error("the saved time must be below the clock's end at 2^50 ns, got {time_ns} ns")]
    Time {
        /// The time, ns.
        time_ns: u64,
    },
    /// The snapshot has other agents than the simulation.
    #[error(
        "the saved simulation has agents {}, this one has {}: assemble the same agents as before",
        .snapshot.join(", "), .simulation.join(", ")
    )]
    OtherAgents {
        /// The snapshot's agents.
        snapshot: Vec<String>,
        /// The simulation's.
        simulation: Vec<String>,
    },
    /// An agent of another kind.
    #[error("agent \"{agent}\" is a {found} in the saved simulation and a {expected} here")]
    OtherKind {
        /// The agent.
        agent: String,
        /// The kind here.
        expected: String,
        /// The kind in the snapshot.
        found: String,
    },
    /// An agent with another step.
    #[error("agent \"{agent}\" has a step of {found_s} s in the saved simulation and of {expected_s} s here")]
    OtherStep {
        /// The agent.
        agent: String,
        /// The step here, s.
        expected_s: f64,
        /// The step in the snapshot, s.
        found_s: f64,
    },
    /// What an agent published or recorded has the wrong number of numbers.
    #[error("agent \"{agent}\" has {found} numbers in the saved simulation, expected {expected}")]
    Length {
        /// The agent.
        agent: String,
        /// How many belong there.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// Something that happened to nobody, or after the present.
    #[error(
        "an event names \"{agent}\" at {time_ns} ns, which is not an agent or is later than the saved time"
    )]
    Event {
        /// The agent.
        agent: String,
        /// When, ns.
        time_ns: u64,
    },
    /// An agent can't take up its state.
    #[error("agent \"{agent}\": {source}")]
    Memory {
        /// The agent.
        agent: String,
        /// Why.
        source: Box<MemoryError>,
    },
}
