//! Estimators in a scenario file.

use super::quadrotor::{level, phenomena, three};
use super::{InitialDeviationFile, InitialErrorFile, SensorsFile};
use quad_dynamics::{Level, PhenomenonSet};
use quad_estimation::sensor::Quality;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};
use sifre::quadrotor::FilterKind;

/// Sensors that see the flight, and a Kalman filter that makes an estimate of their readings. The filter believes in the
/// controller's vehicle; it knows the commands, but neither the wind nor disturbances of the commands. Noise is drawn from the
/// scenario's seed and the quadrotor's name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct EstimatorFile {
    /// Level of the filter's model, 1 to 5; at least the controller's own if it is in the loop.
    #[schemars(schema_with = "level")]
    pub level: Level,
    /// The phenomena switched on in the filter's model; those of its level by default.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(schema_with = "phenomena")]
    pub phenomena: Option<PhenomenonSet>,
    /// Which Kalman filter: `extended` or `unscented`.
    #[schemars(schema_with = "filter")]
    pub filter: FilterKind,
    /// How good accelerometer, gyroscope, magnetometer, sonar and position fixes are (`good`, `poor` or `very-poor`), or a list of
    /// sensors of your own.
    pub sensors: SensorsFile,
    /// Whether the controller sees the estimate instead of the flight; if not, it is recorded and nothing else.
    pub in_loop: bool,
    /// The error of its initial estimate; none by default.
    pub initial_error: InitialErrorFile,
    /// Its stated initial uncertainty.
    pub initial_deviation: InitialDeviationFile,
}

impl Default for EstimatorFile {
    /// An extended filter on level 3 with poor sensors, in the loop.
    fn default() -> Self {
        Self {
            level: three(),
            phenomena: None,
            filter: FilterKind::Extended,
            sensors: SensorsFile::Of(Quality::Poor),
            in_loop: true,
            initial_error: InitialErrorFile::default(),
            initial_deviation: InitialDeviationFile::default(),
        }
    }
}

fn filter(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": [FilterKind::Extended, FilterKind::Unscented] })
}
