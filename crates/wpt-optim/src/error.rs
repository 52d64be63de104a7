//! What can be wrong with a question.

use crate::condition::Condition;
use crate::cost::HEAVIEST;
use ets::ClockError;
use optim::SetupError;
use quad_dynamics::BuildError;
use quad_math::{GridError, SegmentError};
use quad_ndi::ControllerError;

/// Why a problem can't be posed, or not be evaluated there.
#[derive(Debug, thiserror::Error)]
pub enum ProblemError {
    /// Variables: none, one twice, bounds that enclose nothing, a start outside of them.
    #[error(transparent)]
    Variables(#[from] SetupError),
    /// A boundary condition of the mission that is no number.
    #[error("boundary condition {condition} = {value}: it must be finite")]
    BoundaryNotFinite {
        /// Which.
        condition: Condition,
        /// Its value.
        value: f64,
    },
    /// A weight or limit that can't be.
    #[error("{key} = {value}: it must be finite and {}", if *.positive { "positive" } else { "not negative" })]
    BadNumber {
        /// Which, as in `weights.range`.
        key: &'static str,
        /// Its value.
        value: f64,
        /// Whether zero is refused too.
        positive: bool,
    },
    /// A weight so great that flying badly would cost more than not flying.
    #[error(
        "{key} = {value}: weights up to {HEAVIEST} are allowed; scale all of them, since they count relative to each other"
    )]
    TooHeavy {
        /// Which, as in `weights.range`.
        key: &'static str,
        /// Its value.
        value: f64,
    },
    /// A decision vector of another length.
    #[error("a decision vector of {found} numbers, but there are {expected} variables")]
    WrongLength {
        /// How many numbers there must be.
        expected: usize,
        /// How many there were.
        found: usize,
    },
    /// A component of the decision vector that is no number.
    #[error("{condition} = {value}: a decision must be finite")]
    NotFinite {
        /// Of which variable.
        condition: Condition,
        /// The value.
        value: f64,
    },
    /// The station's step is no multiple of the vehicle's.
    #[error("the station's step of {station_ns} ns is no multiple of the vehicle's of {step_ns} ns")]
    StationStep {
        /// The vehicle's step, ns.
        step_ns: u64,
        /// The station's step, ns.
        station_ns: u64,
    },
    /// A duration that is no multiple of the station's step.
    #[error("a mission of {duration_s} s is no whole number of the station's steps of {step_s} s")]
    Duration {
        /// The duration, s.
        duration_s: f64,
        /// The station's step, s.
        step_s: f64,
    },
    /// A camera with noise: a cost would be a random number.
    #[error("the station's camera has noise of {noise_px} px, which makes the cost random: set it to 0")]
    NoisyCamera {
        /// Its standard deviation, px.
        noise_px: f64,
    },
    /// Time.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// The camera's clock.
    #[error(transparent)]
    Clock(#[from] ClockError),
    /// The trajectory.
    #[error(transparent)]
    Trajectory(#[from] SegmentError),
    /// The model.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// The controller.
    #[error(transparent)]
    Controller(#[from] ControllerError),
    /// A grid of a surface that has no points.
    #[error("a surface needs at least 2 x 2 nodes, not {columns} x {rows}")]
    EmptySurface {
        /// Nodes along the first variable.
        columns: usize,
        /// Nodes along the second.
        rows: usize,
    },
    /// A surface over other than two variables.
    #[error("a surface needs a problem of two variables, not of {variables}")]
    NotTwoVariables {
        /// How many there are.
        variables: usize,
    },
    /// Every rollout failed.
    #[error(
        "all {evaluations} flights failed: the problem has no finite cost; look at one of them by its histories"
    )]
    AllFailed {
        /// How many there were.
        evaluations: usize,
    },
}
