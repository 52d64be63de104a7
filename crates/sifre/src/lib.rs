//! The simulation engine.

mod agent;
pub mod black_box;
mod clock;
mod error;
mod ets;
mod event;
mod exact;
mod guidance;
mod optimiser;
pub mod quadrotor;
mod schedule;
mod simulation;
pub mod steps;
mod target;

pub use crate::ets::{Ets, EtsSetup};
pub use agent::{Agent, AgentId, Directory, Member, MemoryError, Moment, NotFinite, Published};
pub use black_box::{BlackBox, BlackBoxError, Channel, Recording};
pub use clock::StepSize;
pub use error::{BindError, SimulationError, SnapshotError, UnknownAgent};
pub use event::{AgentEvent, Event};
pub use exact::Exact;
pub use guidance::{Facing, Follow, Guidance, Mission};
pub use optimiser::{
    Candidate, Evaluation, Optimiser, OptimiserError, RandomSearch, TellError, Variable, minimise,
};
pub use quad_math::GridError;
pub use quadrotor::Quadrotor;
pub use schedule::{Entry, Schedule, ScheduleError};
pub use simulation::{
    AgentSnapshot, Execution, LastSeen, Observer, PROGRESS_EVERY, Phase, Progress, RecorderId, ResumeError,
    RunReport, RunStatus, Scene, Simulation, SimulationSnapshot, StopCondition, Test, Who,
};
pub use target::{Path, Target};
