//! What can be wrong with a station, each with the file, the key, the value and what would be right.

use crate::ClockError;
use provenance::{RangeError, ReadError};

/// Why a station was refused. `origin` is the name of the file (or of the station, where there is no file).
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StationError {
    /// Not TOML, a missing or unknown key, a value of the wrong type, an empty source.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// NaN, infinite, or outside what any station could have.
    #[error("{origin}: `{key}` = {error}")]
    Range {
        /// Name of the file.
        origin: String,
        /// Path of the key.
        key: &'static str,
        /// Value, range and what may have happened.
        error: RangeError,
    },
    /// An axis without travel.
    #[error(
        "{origin}: `{axis}.minimum_deg` = {minimum_deg} must be below `{axis}.maximum_deg` = {maximum_deg}"
    )]
    NoTravel {
        /// Name of the file.
        origin: String,
        /// `pan` or `tilt`.
        axis: &'static str,
        /// Least angle, degrees.
        minimum_deg: f64,
        /// Largest angle, degrees.
        maximum_deg: f64,
    },
    /// A principal point off the pixels.
    #[error("{origin}: `camera.principal_point_px` = {point:?} lies outside the {pixels:?} pixels")]
    PrincipalPoint {
        /// Name of the file.
        origin: String,
        /// Principal point, px.
        point: [f64; 2],
        /// Columns and rows.
        pixels: [f64; 2],
    },
    /// A field of view that the image kinematics do not cover.
    #[error(
        "{origin}: the camera sees up to a slope of {slope} off its axis, at most {limit} is covered: take a longer focal length or fewer pixels"
    )]
    TooWide {
        /// Name of the file.
        origin: String,
        /// Largest slope `y/x` or `z/x` in the image.
        slope: f64,
        /// Largest slope covered.
        limit: f64,
    },
    /// Frames that no clock can keep.
    #[error("{origin}: `camera.frame_rate_hz` and `camera.latency_s`: {source}")]
    Frames {
        /// Name of the file.
        origin: String,
        /// What is wrong with them.
        source: ClockError,
    },
    /// A tracker that would take every gap between two frames for a loss.
    #[error(
        "{origin}: `tracker.hold_s` = {hold_s} s is too short: two frames and the latency take {least_s} s"
    )]
    HoldTooShort {
        /// Name of the file.
        origin: String,
        /// Hold time, s.
        hold_s: f64,
        /// Two periods of the camera and its latency, s.
        least_s: f64,
    },
    /// A search that leaves gaps between its turns.
    #[error(
        "{origin}: `tracker.search_pitch_deg` = {pitch_deg} leaves gaps: the camera's smaller field of view is {view_deg} degrees"
    )]
    SearchGaps {
        /// Name of the file.
        origin: String,
        /// Distance of the turns, degrees.
        pitch_deg: f64,
        /// Smaller field of view, degrees.
        view_deg: f64,
    },
    /// A beam better than diffraction allows.
    #[error(
        "{origin}: `laser.divergence_rad` = {divergence_rad} is below the diffraction limit {limit_rad} rad of `laser.waist_radius_m`"
    )]
    BelowDiffraction {
        /// Name of the file.
        origin: String,
        /// Divergence, rad.
        divergence_rad: f64,
        /// `λ/(πw_0)`, rad.
        limit_rad: f64,
    },
    /// A normal that is no unit vector.
    #[error("{origin}: `receiver.normal` has the length {length}, not 1")]
    NotUnit {
        /// Name of the file.
        origin: String,
        /// Its length.
        length: f64,
    },
    /// Neither a disc nor a rectangle, or both.
    #[error(
        "{origin}: [receiver] needs either `radius_m` (a disc) or `width_m` and `height_m` (a rectangle)"
    )]
    Aperture {
        /// Name of the file.
        origin: String,
    },
}
