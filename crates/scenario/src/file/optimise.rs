//! What `sifre optimise` is to find, in a scenario file. Of it, other commands only use weights and limits of the cost.

use quad_dynamics::Level;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};
use wpt_optim::{Penalties, Weights};

/// The keys to decide on, what is good, and how it is searched. The cost is Φ, the time mean of the weighted squares of range, incidence
/// and spot offset, each over its limit, and of penalties.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OptimiseFile {
    /// The keys to decide on.
    pub variables: Vec<VariableFile>,
    /// Name of the station whose cost counts; may be left out where there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub station: Option<String>,
    /// Name of the quadrotor that carries the receiver; the one that the station tracks if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub quadrotor: Option<String>,
    /// Weights of errors and penalties.
    #[serde(default)]
    pub weights: WeightsFile,
    /// Limits that errors are measured by.
    #[serde(default)]
    pub limits: LimitsFile,
    /// Levels to optimise at, one after the other; as the scenario has it if empty.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(schema_with = "levels")]
    pub levels: Vec<Level>,
    /// How it is searched.
    #[serde(default)]
    pub algorithm: Algorithm,
    /// Seed of the search.
    #[serde(default)]
    pub seed: u64,
    /// Most flights per level.
    #[serde(default = "budget")]
    pub budget: u64,
}

/// A key to decide on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VariableFile {
    /// Path of the key, as `--set` takes it: `quadrotor.alpha.reference.x_0_m`.
    pub key: String,
    /// Smallest value, in the key's unit.
    pub lower: f64,
    /// Largest value.
    pub upper: f64,
    /// Where the search begins; the scenario's own value if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<f64>,
}

/// Weights of the cost's terms, without unit; what is absent is the default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct WeightsFile {
    /// Of the range; 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range: Option<f64>,
    /// Of the incidence; 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub incidence: Option<f64>,
    /// Of the spot's offset; 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spot: Option<f64>,
    /// Of a lost target; 10.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lost_target: Option<f64>,
    /// Of light beside the receiver; 10.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub overfill: Option<f64>,
    /// Of flight below the least height; 10.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ground: Option<f64>,
    /// Of commands beyond the rotors' limits; 10.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub saturation: Option<f64>,
}

/// Limits that errors are measured by; what is absent is the station's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct LimitsFile {
    /// Range, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range_m: Option<f64>,
    /// Angle of incidence, degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub incidence_deg: Option<f64>,
    /// Offset of the spot from the receiver's centre, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spot_m: Option<f64>,
    /// Height of the vehicle's centre of mass below which it costs, m; 0.5.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub least_height_m: Option<f64>,
}

/// How an optimum is searched.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Algorithm {
    /// Nelder and Mead's simplex: local, from the start.
    #[default]
    NelderMead,
    /// Along one variable after the other, over the box and then over a narrower one.
    LineSearch,
    /// Simulated annealing: global, from the start, thousands of flights.
    Annealing,
    /// Differential evolution: global, thousands of flights, on all cores.
    Evolution,
}

impl OptimiseFile {
    /// Weights of the errors.
    pub(crate) fn weights(&self) -> Weights {
        let (file, default) = (&self.weights, Weights::default());
        Weights {
            range: file.range.unwrap_or(default.range),
            incidence: file.incidence.unwrap_or(default.incidence),
            spot: file.spot.unwrap_or(default.spot),
        }
    }

    /// Weights of the penalties, and the least height.
    pub(crate) fn penalties(&self) -> Penalties {
        let (file, default) = (&self.weights, Penalties::default());
        Penalties {
            lost_target: file.lost_target.unwrap_or(default.lost_target),
            overfill: file.overfill.unwrap_or(default.overfill),
            ground: file.ground.unwrap_or(default.ground),
            saturation: file.saturation.unwrap_or(default.saturation),
            least_height_m: self.limits.least_height_m.unwrap_or(default.least_height_m),
        }
    }
}

const fn budget() -> u64 {
    200
}

fn levels(_: &mut SchemaGenerator) -> Schema {
    json_schema!({
        "type": "array",
        "uniqueItems": true,
        "items": { "type": "integer", "minimum": 1, "maximum": Level::ALL.len() },
    })
}
