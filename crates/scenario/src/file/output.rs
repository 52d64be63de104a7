//! Ends and recordings in a scenario file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sifre::{StepSize, steps};
use std::ffi::OsStr;
use std::path::Path;

/// What ends the run before its time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct StopFile {
    /// A quadrotor below the ground ends the run. On by default: nothing continues underground by mistake.
    pub ground: bool,
    /// Height of the ground above the world's origin, m.
    pub ground_height_m: f64,
    /// A quadrotor outside this box ends the run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub outside: Option<BoxLimits>,
    /// A station that loses its target ends the run.
    pub lost_target: bool,
    /// All quadrotors at rest this close to where their references end (m) end the run, well done.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub arrived_within_m: Option<f64>,
}

impl Default for StopFile {
    fn default() -> Self {
        Self {
            ground: true,
            ground_height_m: 0.0,
            outside: None,
            lost_target: false,
            arrived_within_m: None,
        }
    }
}

/// A box in the world.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoxLimits {
    /// Its corner with the least coordinates (north, east, down), m.
    pub from_m: [f64; 3],
    /// Its corner with the greatest, m.
    pub to_m: [f64; 3],
}

/// What is recorded, where and how often.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct OutputFile {
    /// The file, relative to where the program runs; nothing is recorded without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub path: Option<String>,
    /// Its format; by default that of the path's extension (.csv, .parquet or .jsonl).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub format: Option<Format>,
    /// Time between two rows, s.
    #[schemars(with = "f64")]
    pub step_s: StepSize,
    /// What is recorded: names of channels with `*` for any characters, as in `alpha.*` or `*.position.z`; all if empty.
    pub channels: Vec<String>,
}

impl Default for OutputFile {
    fn default() -> Self {
        Self {
            path: None,
            format: None,
            step_s: steps::BLACK_BOX.step,
            channels: Vec::new(),
        }
    }
}

/// Forms of recordings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Format {
    /// Comma-separated values: any spreadsheet reads it.
    Csv,
    /// Columns in binary, for large recordings.
    Parquet,
    /// A JSON value per line.
    Jsonl,
}

impl Format {
    /// The form that a path's ending stands for: CSV if it has none, nothing if it has one that is no form.
    #[must_use]
    pub fn of(path: &str) -> Option<Self> {
        match Path::new(path).extension().map(OsStr::to_str) {
            Some(Some("parquet")) => Some(Self::Parquet),
            Some(Some("jsonl")) => Some(Self::Jsonl),
            Some(Some("csv")) | None => Some(Self::Csv),
            Some(_) => None,
        }
    }
}

impl OutputFile {
    /// The form of the recording; nothing if its path doesn't tell.
    #[must_use]
    pub fn form(&self) -> Option<Format> {
        self.format
            .or_else(|| Format::of(self.path.as_deref().unwrap_or_default()))
    }
}
