//! Quadrotors in a scenario file.

use super::{ControllerFile, EstimatorFile, ReferenceFile};
use quad_dynamics::{Level, Phenomenon, PhenomenonSet, Shear};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};
use sifre::quadrotor::LevelRule;
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
    /// The phenomena switched on; those of the level by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(schema_with = "phenomena")]
    pub phenomena: Option<PhenomenonSet>,
    /// Who flies it.
    #[serde(default)]
    pub controller: ControllerFile,
    /// Where it begins, in hover; by default where its reference begins.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<StartFile>,
    /// What it is asked to do.
    pub reference: ReferenceFile,
    /// Name of an agent that its nose is to point at, whatever the reference's heading.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub facing: Option<String>,
    /// Sensors and a Kalman filter on board; it knows its flight exactly if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub estimator: Option<EstimatorFile>,
    /// The wind that it flies in.
    #[serde(default)]
    pub wind: WindFile,
    /// Changes of level in flight, in order of time.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub level_changes: Vec<LevelChange>,
    /// The level by the distance to another agent; not together with changes of level.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(schema_with = "rule")]
    pub level_rule: Option<LevelRule>,
    /// Noise on the accelerations, drawn from the scenario's seed and the quadrotor's name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub process_noise: Option<ProcessNoiseFile>,
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
    /// How the wind grows with height; the same at all heights if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(schema_with = "shear")]
    pub shear: Option<Shear>,
    /// Random gusts about the wind, drawn from the scenario's seed and the quadrotor's name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turbulence: Option<TurbulenceFile>,
}

/// Dryden's turbulence at low altitude, by MIL-F-8785C.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TurbulenceFile {
    /// Wind 20 ft above the ground, m/s, which sets the intensity: 7.7 is light, 15 moderate, 23 severe.
    pub w20_m_s: f64,
    /// Whether the gusts turn the air too, which acts on the damping of the body's rates: the specification has it so, and so
    /// does this unless it is `false`. The velocity of the gusts is the same either way.
    #[serde(default = "yes", skip_serializing_if = "is_yes")]
    pub rotational: bool,
}

/// White noise on the accelerations, for what nothing else explains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ProcessNoiseFile {
    /// Intensity of the acceleration's noise, m/s²/√Hz per axis.
    pub acceleration_m_s2_sqrt_hz: f64,
    /// Intensity of the angular acceleration's noise, rad/s²/√Hz per axis.
    pub angular_acceleration_rad_s2_sqrt_hz: f64,
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
    /// The phenomena switched on; those of the level by default.
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

pub(super) const fn three() -> Level {
    Level::Three
}

const fn step() -> StepSize {
    steps::QUADROTOR.step
}

const fn one() -> NonZeroU32 {
    NonZeroU32::MIN
}

const fn yes() -> bool {
    true
}

// By reference, as serde calls it.
const fn is_yes(value: &bool) -> bool {
    *value
}

fn object(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": "object" })
}

pub(super) fn level(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": "integer", "minimum": 1, "maximum": Level::ALL.len() })
}

pub(super) fn phenomena(_: &mut SchemaGenerator) -> Schema {
    let names = Phenomenon::ALL.map(Phenomenon::name);
    json_schema!({ "type": "array", "uniqueItems": true, "items": { "enum": names } })
}

fn shear(_: &mut SchemaGenerator) -> Schema {
    json_schema!({
        "type": "object",
        "additionalProperties": false,
        "properties": {
            "profile": {
                "oneOf": [
                    {
                        "type": "object",
                        "additionalProperties": false,
                        "properties": { "law": { "const": "logarithmic" }, "roughness_m": { "type": "number" } },
                        "required": ["law", "roughness_m"],
                    },
                    {
                        "type": "object",
                        "additionalProperties": false,
                        "properties": { "law": { "const": "power" }, "exponent": { "type": "number" } },
                        "required": ["law", "exponent"],
                    },
                ],
            },
            "reference_height_m": {
                "type": "number",
                "description": "Height above the ground at which the wind is as stated, m; 20 ft if absent.",
            },
        },
        "required": ["profile"],
    })
}

fn rule(generator: &mut SchemaGenerator) -> Schema {
    let choice = json_schema!({
        "type": "object",
        "additionalProperties": false,
        "properties": { "level": level(generator), "phenomena": phenomena(generator) },
        "required": ["level"],
    });
    json_schema!({
        "type": "object",
        "additionalProperties": false,
        "properties": {
            "near": { "type": "string", "description": "Name of the agent whose distance counts." },
            "fine": choice,
            "coarse": choice,
            "fine_within_m": { "type": "number", "description": "Fine from this distance down, m." },
            "coarse_beyond_m": { "type": "number", "description": "Coarse from this distance up, m." },
        },
        "required": ["near", "fine", "coarse", "fine_within_m", "coarse_beyond_m"],
    })
}
