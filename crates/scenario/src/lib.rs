//! Scenario files in TOML: what flies, where, how and for how long.
//!
//! ```
//! use scenario::{End, Keep, Scenario};
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
//! let flown = Scenario::from_toml_str(text, "example")?.fly(&(), &Keep::METRICS)?;
//! assert_eq!(flown.ending.end, End::Done);
//! assert!(flown.metric("position_error_final_m")? < 1e-3);
//! assert!(flown.metric("z.settling_time_s")? < 2.5);
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
//! [`Scenario::fly`] flies a scenario and returns what you want to [keep](Keep) of it: metrics, costs, rows ([`Flown`]). In three steps,
//! if you attach black boxes of your own or resume a saved run: [`Scenario::build`] makes the agents ([`Built`]), [`Built::start`]
//! puts them into a simulation ([`Run`]), [`Run::fly`] runs it.
//!
//! Files that a scenario names are read by whoever implements [`Files`]: this crate reads and writes nothing. A [`Template`] is a
//! scenario file that keys are [set](set()) in by their paths, which is what sweeps and optimisers do.
//!
//! # What it does not do
//!
//! It has no loops or expressions: a family of scenarios is a sweep. It draws nothing.

mod assemble;
mod cost;
mod error;
mod file;
mod fly;
mod key;
mod library;
mod metrics;
mod ready;
mod run;
mod step;
mod template;

pub use assemble::{AgentInfo, AgentKind, Built};
pub use cost::StationCost;
pub use error::{EstimatorFault, KeyError, ScenarioError};
pub use file::{
    Algorithm, AttitudeFile, BoxLimits, Circle, CommandOffset, ControllerFile, ErrorFile, EstimatorFile,
    EtsFile, Format, InitialDeviationFile, InitialErrorFile, LawChoice, LevelChange, LimitsFile, LoopFile,
    OptimiseFile, OutputFile, POSITION, PathFile, Point, Polynomial, ProcessNoiseFile, QuadrotorFile,
    ReferenceFile, Scenario, SensorFile, SensorKind, SensorsFile, SetPoint, StartFile, StopFile, TargetFile,
    TurbulenceFile, VariableFile, WeightsFile, WindFile, WindStep,
};
pub use fly::{Flown, Keep};
pub use key::{get, set};
pub use library::{Files, STATIONS, VEHICLES};
pub use metrics::{Metric, MetricError, MetricsBox};
pub use ready::{READY, ready};
pub use run::{End, Ending, Run};
pub use template::{Setting, Template};
pub use wpt_optim::{Outcome, Pair};

/// The example of the README, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
