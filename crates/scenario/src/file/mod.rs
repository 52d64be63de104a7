//! The scenario file: the TOML schema as types. Units are in the keys; unknown keys are errors.

mod controller;
mod estimator;
mod optimise;
mod output;
mod quadrotor;
mod reference;
mod sensor;
mod station;

pub use controller::{AttitudeFile, ControllerFile, LawChoice, LoopFile, POSITION};
pub use estimator::EstimatorFile;
pub use optimise::{Algorithm, LimitsFile, OptimiseFile, VariableFile, WeightsFile};
pub use output::{BoxLimits, Format, OutputFile, StopFile};
pub use quadrotor::{
    CommandOffset, LevelChange, ProcessNoiseFile, QuadrotorFile, StartFile, TurbulenceFile, WindFile,
    WindStep,
};
pub use reference::{Circle, Point, Polynomial, ReferenceFile, SetPoint};
pub use sensor::{ErrorFile, InitialDeviationFile, InitialErrorFile, SensorFile, SensorKind, SensorsFile};
pub use station::{EtsFile, PathFile, TargetFile};

use crate::error::ScenarioError;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A scenario: what flies, where, how, for how long.
///
/// World axes are north, east and down with the origin on the ground, so a height of 2 m is z = -2. Headings are in
/// degrees clockwise from north.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "sifre scenario")]
pub struct Scenario {
    /// Name, as reports and plots print it.
    pub name: String,
    /// What it shows, in a sentence or two.
    #[serde(default)]
    pub description: String,
    /// How long it lasts, s.
    pub duration_s: f64,
    /// Seed of everything random.
    #[serde(default)]
    pub seed: u64,
    /// Quadrotors.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub quadrotor: Vec<QuadrotorFile>,
    /// Energy transmission systems: ground stations that track an agent.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ets: Vec<EtsFile>,
    /// Targets, which stand still or move as a script says.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub target: Vec<TargetFile>,
    /// What ends the run before its time.
    #[serde(default)]
    pub stop: StopFile,
    /// What is recorded, where and how often.
    #[serde(default)]
    pub output: OutputFile,
    /// What `sifre optimise` is to find. Other commands take only weights and limits of the cost Φ from it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub optimise: Option<OptimiseFile>,
}

impl Scenario {
    /// Reads the text of a scenario file; `origin` is the file's name in messages.
    ///
    /// # Errors
    /// Not TOML, a missing or unknown key, or a value of the wrong type, each with line, column and key path. Whether the
    /// scenario can be flown is seen when it is [built](crate::Scenario::build).
    pub fn from_toml_str(text: &str, origin: &str) -> Result<Self, ScenarioError> {
        Ok(provenance::from_toml(text, origin)?)
    }

    /// Reads a scenario whose keys were [changed](crate::set); `origin` is its name in messages.
    ///
    /// # Errors
    /// As [`Scenario::from_toml_str`]; there is no line to tell.
    pub fn from_table(table: &toml::Table, origin: &str) -> Result<Self, ScenarioError> {
        Ok(provenance::from_table(table, origin)?)
    }

    /// The vehicles and stations that it names: those that come with the project, and files relative to the scenario.
    pub fn named_files(&self) -> impl Iterator<Item = &str> {
        let flown = self.quadrotor.iter().map(|agent| &agent.vehicle);
        let believed = self
            .quadrotor
            .iter()
            .filter_map(|agent| agent.controller.vehicle.as_ref());
        let stations = self.ets.iter().map(|agent| &agent.station);
        flown.chain(believed).chain(stations).map(String::as_str)
    }

    /// The JSON schema of scenario files, for editors.
    #[must_use]
    pub fn json_schema() -> serde_json::Value {
        schemars::schema_for!(Self).to_value()
    }
}
