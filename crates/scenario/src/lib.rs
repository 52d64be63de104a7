//! Scenario files: what flies, where, how, for how long, as TOML.
//!
//! ```
//! use scenario::{End, Scenario};
//!
//! let text = r#"
//!     name = "a metre up"
//!     duration_s = 5.0
//!
//!     [[quadrotor]]
//!     name = "alpha"
//!     level = 3
//!     start = { position_m = [0, 0, -1] }
//!     reference = { kind = "hold", position_m = [0, 0, -2] }
//! "#;
//! let mut flight = Scenario::from_toml_str(text, "example")?.build(&())?.fly()?;
//! let ending = flight.run(&mut ())?;
//! assert_eq!(ending.end, End::Done);
//! let alpha = flight.simulation.published("alpha").expect("it is there");
//! assert!((alpha.position.z + 2.0).abs() < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # The file
//!
//! [`Scenario`] mirrors the file; its documentation is that of the keys, and of the JSON schema that editors use
//! ([`Scenario::json_schema`]). Units are in the keys. An unknown key, a wrong type, a missing key are errors with line,
//! column and key path. Scenarios that fly, each with comments, are in the `scenarios/` folder.
//!
//! # Conventions
//!
//! World axes are north, east, down; headings are degrees clockwise from north. **Wind is the velocity of the air over the
//! ground**: wind from the north is `velocity_m_s = [-5, 0, 0]` and pushes the vehicle south. A quadrotor that gets below
//! the ground ends the run unless `stop.ground = false`.
//!
//! # From file to flight
//!
//! [`Scenario::build`] makes the agents ([`Built`]), [`Built::fly`] puts them into a simulation ([`Flight`]),
//! [`Flight::run`] runs it and says how it [ended](End). Files that a scenario names are read by whoever implements
//! [`Files`]: this crate reads and writes nothing. [`set`] changes a key by its path, which is what sweeps and
//! optimisers do; [`MetricsBox`] sums up a flight in a few numbers.
//!
//! # What it does not do
//!
//! It has no loops or expressions: a family of scenarios is a sweep. It draws nothing.

mod assemble;
mod error;
mod file;
mod flight;
mod key;
mod library;
mod metrics;
mod read;
mod ready;

pub use assemble::{AgentInfo, AgentKind, Built};
pub use error::{EstimatorFault, KeyError, ScenarioError};
pub use file::{
    Algorithm, AttitudeFile, BoxLimits, Circle, CommandOffset, ControllerFile, ErrorFile, EstimatorFile,
    EtsFile, Format, InitialDeviationFile, InitialErrorFile, LawChoice, LevelChange, LimitsFile, LoopFile,
    OptimiseFile, OutputFile, POSITION, PathFile, Point, Polynomial, ProcessNoiseFile, QuadrotorFile,
    ReferenceFile, Scenario, SensorFile, SensorKind, SensorsFile, SetPoint, StartFile, StopFile, TargetFile,
    TurbulenceFile, VariableFile, WeightsFile, WindFile, WindStep,
};
pub use flight::{End, Ending, Flight};
pub use key::{get, set};
pub use library::{Files, STATIONS, VEHICLES};
pub use metrics::{Metric, MetricsBox};
pub use read::{Place, Position};
pub use ready::{READY, ready};

/// The example of the README, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
