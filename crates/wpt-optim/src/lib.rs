//! Trajectories for wireless power transmission: the problem, its rollouts and its optimisers.

mod condition;
mod cost;
mod decision;
mod engine;
mod error;
mod fleet;
mod ideal;
mod mission;
pub mod multi_fidelity;
mod nominal;
pub mod optimisers;
mod outcome;
mod path;
mod problem;
mod recorded;
mod rollout;
pub mod selection;
mod surface;

pub use condition::{Axis, Condition, Order, Side, UnknownCondition};
pub use cost::{BEND, FAILURE, LOST_M, Penalties, Terms, Weights};
pub use decision::Decision;
pub use engine::{EngineError, QUADROTOR, STATION};
pub use error::ProblemError;
pub use mission::{Ends, Mission, Pairing};
pub use nominal::{Choice, HALF_CROSSING_M, HEIGHT_M, POSITION_SETTLING_S};
pub use outcome::{Failure, Histories, History, Outcome};
pub use path::Path;
pub use problem::{Gradient, LANES, Problem};
pub use recorded::{CostBox, Pair, Span};
pub use surface::{Grid, Minimum, Objective, Surface};
