//! Why a scenario can't be read, built or changed.

use provenance::ReadError;
use quad_estimation::sensor::SensorError;
use quad_ndi::{ControllerError, TrajectoryError};
use sifre::quadrotor::QuadrotorError;
use sifre::{GridError, ResumeError, ScheduleError, SimulationError, SnapshotError};
use wpt_optim::ProblemError;

/// Why a scenario can't be read or built.
#[derive(Debug, thiserror::Error)]
pub enum ScenarioError {
    /// Not TOML, a missing or unknown key, or a value that its key can't have.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// A duration that the clock doesn't have.
    #[error("`duration_s` = {duration_s:?}: {source}")]
    Duration {
        /// The duration, s.
        duration_s: f64,
        /// Why not.
        source: GridError,
    },
    /// A name that can't be part of a channel's.
    #[error(
        "an agent's name must have 1 to 100 characters, none of them a dot, comma, quote, asterisk, line break, control or bidirectional \
         character, got \"{name}\""
    )]
    Name {
        /// The name.
        name: String,
    },
    /// A scenario's name that can't be printed.
    #[error(
        "`name` must have up to 100 characters, none of them a line break, control or bidirectional character, got \"{name}\""
    )]
    Title {
        /// The name.
        name: String,
    },
    /// A gimbal that would start outside its travel.
    #[error(
        "{agent}: `{key}` must lie within the gimbal's travel, {from_deg:.1} to {to_deg:.1} degrees, got {value_deg:?}"
    )]
    Travel {
        /// The station.
        agent: String,
        /// The key.
        key: &'static str,
        /// Its value, degrees.
        value_deg: f64,
        /// The travel's beginning, degrees.
        from_deg: f64,
        /// The travel's end, degrees.
        to_deg: f64,
    },
    /// A recording whose form is not known.
    #[error(
        "`output.path` must end in .csv, .parquet or .jsonl unless `output.format` is set, got \"{path}\""
    )]
    Form {
        /// Where to record.
        path: String,
    },
    /// An empty box.
    #[error("stop.outside: `from_m[{axis}]` must be less than `to_m[{axis}]`, got {from} and {to}")]
    EmptyBox {
        /// 0 north, 1 east, 2 down.
        axis: usize,
        /// The least coordinate, m.
        from: f64,
        /// The greatest, m.
        to: f64,
    },
    /// A missing vehicle or station file.
    #[error("agent \"{agent}\": {kind} \"{wanted}\" is {reason}; known by name: {known}")]
    NoFile {
        /// The agent.
        agent: String,
        /// What it should be: `vehicle` or `station`.
        kind: &'static str,
        /// What it asks for.
        wanted: String,
        /// Why it is not available.
        reason: String,
        /// Those that come with the project.
        known: String,
    },
    /// A vehicle file that is wrong.
    #[error("agent \"{agent}\": {source}")]
    Vehicle {
        /// The agent.
        agent: String,
        /// Why.
        source: Box<quad_dynamics::VehicleError>,
    },
    /// A station file that is wrong.
    #[error("agent \"{agent}\": {source}")]
    Station {
        /// The agent.
        agent: String,
        /// Why.
        source: Box<ets::StationError>,
    },
    /// A parameter that the vehicle file doesn't have.
    #[error("agent \"{agent}\", parameters.{key}: {reason}")]
    Parameter {
        /// The agent.
        agent: String,
        /// The key.
        key: String,
        /// Why it can't be set.
        reason: String,
    },
    /// Settings that no controller can have.
    #[error("quadrotor \"{agent}\", controller: {source}")]
    Controller {
        /// The agent.
        agent: String,
        /// Why.
        source: Box<ControllerError>,
    },
    /// Waypoints that make no trajectory.
    #[error("agent \"{agent}\": {source}")]
    Trajectory {
        /// The agent.
        agent: String,
        /// Why.
        source: TrajectoryError,
    },
    /// A list in time that is wrong.
    #[error("quadrotor \"{agent}\", {key}: {source}")]
    Schedule {
        /// The agent.
        agent: String,
        /// Which list.
        key: &'static str,
        /// Why.
        source: ScheduleError,
    },
    /// An estimator that is wrong.
    #[error("quadrotor \"{agent}\", `estimator.{key}`: {source}")]
    Estimator {
        /// The agent.
        agent: String,
        /// The key below `estimator`.
        key: String,
        /// Why.
        source: EstimatorFault,
    },
    /// A list that must not be empty.
    #[error("quadrotor \"{agent}\": `{key}` needs at least one entry, got none")]
    Empty {
        /// The agent.
        agent: String,
        /// Which list.
        key: &'static str,
    },
    /// A number outside what it may be.
    #[error("{agent}: {key} must be {must}, got {value:?}")]
    Number {
        /// Whose, in words.
        agent: String,
        /// Which.
        key: String,
        /// What it was.
        value: f64,
        /// What it must be.
        must: &'static str,
    },
    /// A follower whose start is unknown.
    #[error(
        "quadrotor \"{agent}\" follows \"{leader}\", which has no start: name an agent with a start, or give `start`"
    )]
    NoStart {
        /// The agent.
        agent: String,
        /// Whom it follows.
        leader: String,
    },
    /// A key that can't be set.
    #[error(transparent)]
    Key(#[from] KeyError),
    /// A cost of no station.
    #[error("optimise.station: {}; the cost needs a station of the scenario; known: {known}", match wanted {
        Some(name) => format!("unknown station \"{name}\""),
        None => "no station given".to_owned(),
    })]
    NoStation {
        /// The name in the file, if there is one.
        wanted: Option<String>,
        /// The scenario's stations.
        known: String,
    },
    /// A cost of a station without a quadrotor.
    #[error(
        "optimise.quadrotor: unknown quadrotor \"{quadrotor}\"; name the one that carries the receiver of \"{station}\""
    )]
    NotJudged {
        /// The station.
        station: String,
        /// What it is judged with.
        quadrotor: String,
    },
    /// Weights or limits that no cost can be made of.
    #[error("the cost of ets \"{station}\": {source}")]
    Cost {
        /// The station.
        station: String,
        /// Why.
        source: Box<ProblemError>,
    },
    /// A quadrotor that can't be built.
    #[error(transparent)]
    Quadrotor(#[from] QuadrotorError),
    /// A simulation that can't be assembled.
    #[error(transparent)]
    Simulation(#[from] SimulationError),
    /// A saved flight that is of another scenario.
    #[error("the saved flight can't be resumed in this scenario: {0}")]
    Snapshot(#[from] SnapshotError),
}

impl From<ResumeError> for ScenarioError {
    fn from(error: ResumeError) -> Self {
        match error {
            ResumeError::Simulation(source) => source.into(),
            ResumeError::Snapshot(source) => source.into(),
        }
    }
}

/// What is wrong with an estimator's key.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EstimatorFault {
    /// A sensor with invalid settings.
    #[error(transparent)]
    Sensor(#[from] SensorError),
    /// A second sensor of a kind whose bias the filter estimates.
    #[error("given twice: the filter estimates one accelerometer bias and one gyroscope bias")]
    Twice,
    /// A magnetic field given for a sensor that does not measure it.
    #[error("only a magnetometer measures the magnetic field: remove it")]
    Field,
    /// An error that is not finite, or a standard deviation of one below zero.
    #[error("must be finite, and not negative if it is a standard deviation, got {value}")]
    Error {
        /// The number.
        value: f64,
    },
    /// A filter that claims to be certain.
    #[error("a filter's standard deviation must be positive and finite, got {value}")]
    Deviation {
        /// The number.
        value: f64,
    },
}

/// Why a key of a scenario can't be set.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum KeyError {
    /// A path without keys.
    #[error("\"{path}\" is not a key: write, for example, `quadrotor.alpha.level`")]
    Empty {
        /// The path.
        path: String,
    },
    /// A list has no such entry.
    #[error("`{path}`: no `{entry}` in `{list}`; available: {known}")]
    NoEntry {
        /// The path.
        path: String,
        /// The entry.
        entry: String,
        /// The list.
        list: String,
        /// The entries that exist.
        known: String,
    },
    /// A key below something that has none.
    #[error("`{path}`: `{value}` is a value, not a table")]
    NotATable {
        /// The path.
        path: String,
        /// The key of the value.
        value: String,
    },
    /// A scenario that TOML can't express.
    #[error("the scenario can't be written as TOML: {message}")]
    NoToml {
        /// Why.
        message: String,
    },
    /// An unknown key.
    #[error("`{path}`: unknown key `{key}`")]
    NoKey {
        /// The path.
        path: String,
        /// The key.
        key: String,
    },
}
