//! Sensors and a filter's first belief in a scenario file.

use quad_estimation::sensor::{EARTH_FIELD_UT, Instrument, Quality, Sensor};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::{SeqAccessDeserializer, StrDeserializer};
use serde::de::{Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use std::fmt;

/// Sensors: by their quality, or one by one.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum SensorsFile {
    /// Accelerometer, gyroscope, magnetometer, sonar and position fixes, this good.
    Of(Quality),
    /// These. None at all is dead reckoning.
    List(Vec<SensorFile>),
}

/// A sensor. Noise, bias, drift, quantum and range are in the unit of what it measures: m/s² (accelerometer), rad/s (gyroscope),
/// µT (magnetometer), m (sonar, barometer, position fix).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SensorFile {
    /// What it measures.
    pub kind: SensorKind,
    /// Readings per second; a sensor that is faster than the quadrotor's steps reads once per step.
    pub rate_hz: f64,
    /// Standard deviation of the noise of each reading, white from reading to reading.
    pub noise: f64,
    /// Standard deviation of the bias that it is turned on with.
    #[serde(default)]
    pub turn_on_bias: f64,
    /// Density of the random walk by which the bias drifts, unit/√s.
    #[serde(default)]
    pub bias_drift: f64,
    /// Step of the digital reading; 0 for none.
    #[serde(default)]
    pub quantum: f64,
    /// Least and largest true value that it gives a reading of; no limits if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub range: Option<[f64; 2]>,
    /// Time from the taking of a reading to its arrival, s.
    #[serde(default)]
    pub delay_s: f64,
    /// Probability that a reading never arrives, from 0 to below 1.
    #[serde(default)]
    pub dropout: f64,
    /// The magnetic field (north, east, down) that a magnetometer is in, µT; that of the middle northern latitudes if absent. For a
    /// magnetometer only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub field_ut: Option<[f64; 3]>,
}

/// What a sensor measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SensorKind {
    /// Specific force along the body's axes.
    Accelerometer,
    /// Body rates.
    Gyroscope,
    /// Magnetic field along the body's axes.
    Magnetometer,
    /// Range to the ground below the body.
    Sonar,
    /// Height.
    Barometer,
    /// Position from outside: motion capture, a satellite receiver.
    PositionFix,
}

/// The error of a filter's initial estimate: belief less flight. Each is three numbers, or one: the standard
/// deviation that it is drawn with on each axis, from the scenario's seed and the quadrotor's name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct InitialErrorFile {
    /// Of the position (north, east, down), m.
    pub position_m: ErrorFile,
    /// Of the velocity (north, east, down), m/s.
    pub velocity_m_s: ErrorFile,
    /// Of the attitude: a turn about the body's axes (forward, right, down), degrees.
    pub attitude_deg: ErrorFile,
}

/// An error along three axes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum ErrorFile {
    /// This one.
    Fixed([f64; 3]),
    /// Drawn with this standard deviation on each axis.
    Drawn(f64),
}

/// The filter's stated initial uncertainty, as standard deviations on each axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct InitialDeviationFile {
    /// Of the position, m; that of an error that is drawn, or else 0.1, if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position_m: Option<f64>,
    /// Of the velocity, m/s; that of an error that is drawn, or else 0.1, if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub velocity_m_s: Option<f64>,
    /// Of the attitude, degrees; that of an error that is drawn, or else 2.9 (0.05 rad), if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub attitude_deg: Option<f64>,
}

impl SensorFile {
    /// The sensor.
    pub(crate) fn sensor(&self) -> Sensor {
        Sensor {
            instrument: match self.kind {
                SensorKind::Accelerometer => Instrument::Accelerometer,
                SensorKind::Gyroscope => Instrument::Gyroscope,
                SensorKind::Magnetometer => Instrument::Magnetometer {
                    field_ut: self.field_ut.unwrap_or(EARTH_FIELD_UT),
                },
                SensorKind::Sonar => Instrument::Sonar,
                SensorKind::Barometer => Instrument::Barometer,
                SensorKind::PositionFix => Instrument::PositionFix,
            },
            noise: self.noise,
            turn_on_bias: self.turn_on_bias,
            bias_drift: self.bias_drift,
            quantum: self.quantum,
            range: self.range,
            rate_hz: self.rate_hz,
            delay_s: self.delay_s,
            dropout: self.dropout,
        }
    }
}

impl Default for ErrorFile {
    /// None.
    fn default() -> Self {
        Self::Fixed([0.0; 3])
    }
}

// By hand, not untagged: an error keeps its own words and the key that it is at.
impl<'de> Deserialize<'de> for SensorsFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Either;
        impl<'de> Visitor<'de> for Either {
            type Value = SensorsFile;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("`good`, `poor`, `very-poor` or a list of sensors")
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<SensorsFile, E> {
                Quality::deserialize(StrDeserializer::new(text)).map(SensorsFile::Of)
            }

            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<SensorsFile, A::Error> {
                Vec::deserialize(SeqAccessDeserializer::new(list)).map(SensorsFile::List)
            }
        }
        deserializer.deserialize_any(Either)
    }
}

impl<'de> Deserialize<'de> for ErrorFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Either;
        impl<'de> Visitor<'de> for Either {
            type Value = ErrorFile;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("three numbers, or one: a standard deviation")
            }

            fn visit_f64<E: Error>(self, deviation: f64) -> Result<ErrorFile, E> {
                Ok(ErrorFile::Drawn(deviation))
            }

            fn visit_i64<E: Error>(self, deviation: i64) -> Result<ErrorFile, E> {
                Ok(ErrorFile::Drawn(deviation as f64))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<ErrorFile, A::Error> {
                <[f64; 3]>::deserialize(SeqAccessDeserializer::new(list)).map(ErrorFile::Fixed)
            }
        }
        deserializer.deserialize_any(Either)
    }
}

impl JsonSchema for SensorsFile {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "SensorsFile".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "Sensors: by their quality, or one by one.",
            "oneOf": [
                { "enum": Quality::ALL },
                { "type": "array", "items": generator.subschema_for::<SensorFile>() },
            ],
        })
    }
}

impl JsonSchema for ErrorFile {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "ErrorFile".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "An error along three axes, or the standard deviation that it is drawn with on each.",
            "oneOf": [
                { "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3 },
                { "type": "number", "minimum": 0 },
            ],
        })
    }
}
