//! Quadrotors in a scenario file.

use super::{ControllerFile, ReferenceFile};
use quad_dynamics::{Level, Phenomenon, PhenomenonSet};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};
use sifre::{StepSize, steps};
use std::num::NonZeroU32;

/// A quadrotor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct QuadrotorFile {
    /// Name, unique among all agents, without dots.
    pub name: String,
    /// What it is: `qball-x4`, `qball-x4-vendor`, `crazyflie`, or a vehicle file relative to the scenario.
    #[serde(default = "qball_x4")]
    pub vehicle: String,
    /// Parameters of the vehicle file to be other than there, by their keys: `airframe.mass_kg = 1.5`.
    #[serde(default, skip_serializing_if = "toml::Table::is_empty")]
    #[schemars(schema_with = "object")]
    pub parameters: toml::Table,
    /// Level of resolution, 1 to 5.
    #[serde(default = "three")]
    #[schemars(schema_with = "level")]
    pub level: Level,
    /// The phenomena switched on; those of the level unless told otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(schema_with = "phenomena")]
    pub phenomena: Option<PhenomenonSet>,
    /// Who flies it.
    #[serde(default)]
    pub controller: ControllerFile,
    /// Where it begins, in hover; where its reference begins unless told otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<StartFile>,
    /// What it is asked to do.
    pub reference: ReferenceFile,
    /// Name of an agent that its nose is to point at, whatever the reference's heading.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub facing: Option<String>,
    /// The wind that it flies in.
    #[serde(default)]
    pub wind: WindFile,
    /// Changes of level in flight, in order of time.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub level_changes: Vec<LevelChange>,
    /// Disturbances of the rotor commands, in order of time.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub command_offsets: Vec<CommandOffset>,
    /// Time between two commands, s.
    #[serde(default = "step")]
    #[schemars(with = "f64")]
    pub step_s: StepSize,
    /// Steps of the integrator from one command to the next.
    #[serde(default = "one")]
    pub substeps: NonZeroU32,
}

/// Where a quadrotor begins: level, with the rotors of hover.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StartFile {
    /// Position (north, east, down), m.
    pub position_m: [f64; 3],
    /// Velocity (north, east, down), m/s.
    #[serde(default)]
    pub velocity_m_s: [f64; 3],
    /// Heading, degrees clockwise from north.
    #[serde(default)]
    pub yaw_deg: f64,
}

/// Wind: the velocity of the air over the ground, not the direction that it comes from. Wind from the north blows to the
/// south: `velocity_m_s = [-5, 0, 0]`. It is felt by models with drag.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct WindFile {
    /// Velocity of the air before the first step (north, east, down), m/s.
    pub velocity_m_s: [f64; 3],
    /// Changes of the wind, in order of time: two of them are a gust.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub steps: Vec<WindStep>,
}

/// From this time on, this wind.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WindStep {
    /// From when, s.
    pub from_s: f64,
    /// Velocity of the air (north, east, down), m/s.
    pub velocity_m_s: [f64; 3],
}

/// From this time on, this level.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LevelChange {
    /// From when, s.
    pub from_s: f64,
    /// The level, 1 to 5.
    #[schemars(schema_with = "level")]
    pub level: Level,
    /// The phenomena switched on; those of the level unless told otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(schema_with = "phenomena")]
    pub phenomena: Option<PhenomenonSet>,
}

/// From this time on, this is added to the rotor commands.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CommandOffset {
    /// From when, s.
    pub from_s: f64,
    /// What is added to the duty of each rotor, as a fraction.
    pub duty: [f64; 4],
}

fn qball_x4() -> String {
    "qball-x4".to_owned()
}

const fn three() -> Level {
    Level::Three
}

const fn step() -> StepSize {
    steps::QUADROTOR.step
}

const fn one() -> NonZeroU32 {
    NonZeroU32::MIN
}

fn object(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": "object" })
}

fn level(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": "integer", "minimum": 1, "maximum": Level::ALL.len() })
}

fn phenomena(_: &mut SchemaGenerator) -> Schema {
    let names = Phenomenon::ALL.map(Phenomenon::name);
    json_schema!({ "type": "array", "uniqueItems": true, "items": { "enum": names } })
}
