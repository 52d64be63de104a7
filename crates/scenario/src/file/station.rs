//! Ground stations and targets in a scenario file.

use super::Point;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sifre::{StepSize, steps};

/// An energy transmission system: a ground station that keeps camera and laser on an agent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EtsFile {
    /// Name, unique among all agents, without dots.
    pub name: String,
    /// What it is: `nominal`, or a station file relative to the scenario.
    #[serde(default = "nominal")]
    pub station: String,
    /// Name of the agent that it tracks.
    pub tracks: String,
    /// Where its axes cross (north, east, down), m, if not where its file says.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub position_m: Option<[f64; 3]>,
    /// Heading of zero pan, degrees clockwise from north, if not what its file says.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heading_deg: Option<f64>,
    /// Pan at the start, degrees clockwise from its heading.
    #[serde(default)]
    pub pan_deg: f64,
    /// Tilt at the start, degrees upwards.
    #[serde(default)]
    pub tilt_deg: f64,
    /// Standard deviation of the image's noise, pixels, if not what its file says.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub noise_px: Option<f64>,
    /// Optical power of the laser, W, if not what its file says.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub power_w: Option<f64>,
    /// Time between two commands of the gimbal, s.
    #[serde(default = "ets_step")]
    #[schemars(with = "f64")]
    pub step_s: StepSize,
}

/// A target: something to track, face or follow that nothing disturbs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TargetFile {
    /// Name, unique among all agents, without dots.
    pub name: String,
    /// How it moves.
    pub path: PathFile,
    /// Time between two of its positions, s.
    #[serde(default = "target_step")]
    #[schemars(with = "f64")]
    pub step_s: StepSize,
}

/// How a target moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum PathFile {
    /// It stands.
    Fixed {
        /// Position (north, east, down), m.
        position_m: [f64; 3],
        /// Heading, degrees clockwise from north.
        #[serde(default)]
        yaw_deg: f64,
    },
    /// It moves smoothly through points, at rest before the first and after the last.
    Waypoints {
        /// The points in order of time.
        waypoints: Vec<Point>,
    },
}

fn nominal() -> String {
    "nominal".to_owned()
}

const fn ets_step() -> StepSize {
    steps::ETS.step
}

const fn target_step() -> StepSize {
    steps::TARGET.step
}
