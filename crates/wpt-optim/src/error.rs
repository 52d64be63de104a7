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
    /// A boundary condition of the mission that is not finite.
    #[error("boundary condition {condition} must be finite, got {value}")]
    BoundaryNotFinite {
        /// Which.
        condition: Condition,
        /// Its value.
        value: f64,
    },
    /// A weight or limit that can't be.
    #[error("{key} must be finite and {}, got {value}", if *.positive { "positive" } else { "not negative" })]
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
        "{key} must be at most {HEAVIEST}, got {value}: scale all weights, since only their ratios count"
    )]
    TooHeavy {
        /// Which, as in `weights.range`.
        key: &'static str,
        /// Its value.
        value: f64,
    },
    /// A decision vector of another length.
    #[error("a decision vector needs one number for each of the {expected} variables, got {found}")]
    WrongLength {
        /// How many numbers there must be.
        expected: usize,
        /// How many there were.
        found: usize,
    },
    /// A component of the decision vector that is not finite.
    #[error("{condition} must be finite, got {value}")]
    NotFinite {
        /// Of which variable.
        condition: Condition,
        /// The value.
        value: f64,
    },
    /// The station's step is no multiple of the vehicle's.
    #[error("the station's step must be a multiple of the vehicle's, {step_ns} ns, got {station_ns} ns")]
    StationStep {
        /// The vehicle's step, ns.
        step_ns: u64,
        /// The station's step, ns.
        station_ns: u64,
    },
    /// A duration that is no multiple of the station's step.
    #[error("a mission's duration must be a multiple of the station's step, {step_s} s, got {duration_s} s")]
    Duration {
        /// The duration, s.
        duration_s: f64,
        /// The station's step, s.
        step_s: f64,
    },
    /// A camera with noise: a cost would be a random number.
    #[error("the noise of the station's camera must be 0, since it makes the cost random, got {noise_px} px")]
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
    #[error("a surface needs at least 2 x 2 nodes, got {columns} x {rows}")]
    EmptySurface {
        /// Nodes along the first variable.
        columns: usize,
        /// Nodes along the second.
        rows: usize,
    },
    /// A surface over other than two variables.
    #[error("a surface needs a problem of two variables, got {variables}")]
    NotTwoVariables {
        /// How many there are.
        variables: usize,
    },
    /// Every rollout failed.
    #[error(
        "all {evaluations} flights failed, so the problem has no finite cost: inspect the histories of one of them"
    )]
    AllFailed {
        /// How many there were.
        evaluations: usize,
    },
}
