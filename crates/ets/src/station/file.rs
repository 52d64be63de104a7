//! The station file: the TOML schema as types, every number with its source beside it.

use crate::{StationError, VisibilityLaw};
use provenance::{Sourced, from_toml};
use serde::{Deserialize, Serialize};

type Number = Sourced<f64>;
type Pair = Sourced<[f64; 2]>;
type Triple = Sourced<[f64; 3]>;

/// A station file as it is written.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StationFile {
    /// Name of the station, as legends and messages print it.
    pub name: String,
    /// One or two sentences: what it is and where its numbers come from as a whole.
    pub description: String,
    /// Where it stands.
    pub pedestal: PedestalFile,
    /// Pan axis of the gimbal.
    pub pan: AxisFile,
    /// Tilt axis of the gimbal.
    pub tilt: AxisFile,
    /// Camera.
    pub camera: CameraFile,
    /// Tracking controller.
    pub tracker: TrackerFile,
    /// Laser and emitter.
    pub laser: LaserFile,
    /// Air.
    pub atmosphere: AtmosphereFile,
    /// Receiver on the vehicle.
    pub receiver: ReceiverFile,
    /// Limits of the link.
    pub limits: LimitsFile,
}

/// The table `[pedestal]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PedestalFile {
    /// Crossing of the gimbal's axes in W, m.
    pub position_m: Triple,
    /// Heading of zero pan, degrees clockwise from north.
    pub heading_deg: Number,
}

/// The tables `[pan]` and `[tilt]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AxisFile {
    /// Time constant τ of the rate, s.
    pub time_constant_s: Number,
    /// Largest rate, degrees per second.
    pub rate_limit_deg_s: Number,
    /// Least angle, degrees.
    pub minimum_deg: Number,
    /// Largest angle, degrees.
    pub maximum_deg: Number,
}

/// The table `[camera]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraFile {
    /// Focal length, m.
    pub focal_length_m: Number,
    /// Distance of neighbouring pixels, m.
    pub pixel_pitch_m: Number,
    /// Columns and rows, px.
    pub pixels_px: Pair,
    /// Principal point, column and row from the upper left corner, px.
    pub principal_point_px: Pair,
    /// Frame rate, Hz.
    pub frame_rate_hz: Number,
    /// From capture to delivery, s.
    pub latency_s: Number,
    /// Standard deviation of the image point's noise, px; 0 for none.
    pub noise_px: Number,
    /// Step to which image coordinates are rounded, px; 0 for none.
    pub quantum_px: Number,
}

/// Order of the error dynamics.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Order {
    /// `ṙ_C = −r_C/T`.
    First,
    /// Both poles at `−1/T`: `ω_n = 1/T`, `ζ = 1`.
    Second,
}

/// The table `[tracker]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TrackerFile {
    /// Order of the error dynamics.
    pub order: Sourced<Order>,
    /// Time constant T of the error, s.
    pub time_constant_s: Number,
    /// Fading factor δ of the line of sight's filter.
    pub fading: Number,
    /// Hold time after the last sighting, s.
    pub hold_s: Number,
    /// Largest angle of the search, degrees.
    pub search_radius_deg: Number,
    /// Distance of the search's turns, degrees.
    pub search_pitch_deg: Number,
    /// Speed of the search on its outermost turn, degrees per second.
    pub search_speed_deg_s: Number,
}

/// The table `[laser]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LaserFile {
    /// Optical power, W.
    pub power_w: Number,
    /// Wavelength, m.
    pub wavelength_m: Number,
    /// Radius at the waist (1/e²), m.
    pub waist_radius_m: Number,
    /// Divergence, half angle (1/e²), rad.
    pub divergence_rad: Number,
    /// Emitter in E, m.
    pub offset_m: Triple,
}

/// The table `[atmosphere]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AtmosphereFile {
    /// Visibility, m.
    pub visibility_m: Number,
    /// Law of the attenuation's colour.
    pub law: Sourced<VisibilityLaw>,
}

/// The table `[receiver]`: either `radius_m` (a disc) or `width_m` and `height_m` (a rectangle).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReceiverFile {
    /// Radius of a disc, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius_m: Option<Number>,
    /// Width of a rectangle, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width_m: Option<Number>,
    /// Height of a rectangle, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height_m: Option<Number>,
    /// Centre in B from the centre of mass, m.
    pub offset_m: Triple,
    /// Normal in B, a unit vector.
    pub normal: Triple,
    /// Photovoltaic efficiency.
    pub efficiency: Number,
}

/// The table `[limits]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LimitsFile {
    /// Largest range, m.
    pub range_m: Number,
    /// Largest angle of incidence, degrees.
    pub incidence_deg: Number,
    /// Largest spot offset, m.
    pub spot_offset_m: Number,
}

impl StationFile {
    /// Reads the text of a station file; `origin` is the file's name in messages.
    ///
    /// # Errors
    /// Not TOML, a missing or unknown key, a value of the wrong type, or an empty source, with line, column and key path.
    pub fn from_toml_str(text: &str, origin: &str) -> Result<Self, StationError> {
        Ok(from_toml(text, origin)?)
    }
}
