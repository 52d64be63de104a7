//! The parameters of a station: read from a TOML file, validated once, plain numbers from then on.
//!
//! [`StationFile`] mirrors the file, every number with its source; [`Station`] is the same without the sources, in SI units and
//! rad, with every number checked. Nothing here reads a disk: who knows the path hands over the text and the file's name.

mod error;
mod file;
mod read;
#[cfg(test)]
mod tests;
mod validate;

use crate::{Atmosphere, Beam, Camera, Gimbal, Pedestal, Receiver, Tracker};
pub use error::StationError;
pub use file::{Order, StationFile};
pub use provenance::Sourced;

/// Text of `data/stations/ets.toml`: the project's nominal station.
pub const NOMINAL_TOML: &str = include_str!("../../data/stations/ets.toml");

/// A station's parameters, SI units and rad throughout.
///
/// The fields are open: a study changes what it likes and may call [`Station::validate`] again.
#[derive(Clone, Debug, PartialEq)]
pub struct Station {
    /// Name, as legends and messages print it.
    pub name: String,
    /// What it is and where its numbers come from as a whole.
    pub description: String,
    /// Where it stands.
    pub pedestal: Pedestal<f64>,
    /// Pan and tilt.
    pub gimbal: Gimbal<f64>,
    /// The camera's geometry.
    pub camera: Camera<f64>,
    /// The camera's timing and noise.
    pub frames: Frames,
    /// The tracker's design.
    pub tracker: Tracker<f64>,
    /// The laser.
    pub beam: Beam<f64>,
    /// The air.
    pub atmosphere: Atmosphere<f64>,
    /// The receiver on the vehicle.
    pub receiver: Receiver<f64>,
    /// Limits of the link.
    pub limits: LinkLimits,
}

/// Timing and noise of a camera's frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frames {
    /// Frame rate, Hz.
    pub rate: f64,
    /// Latency from capture to delivery, s.
    pub latency: f64,
    /// Standard deviation of the image point's noise, px; 0 for none. The samples are drawn by who runs the station.
    pub noise: f64,
}

/// Beyond these the power transfer counts as failed; they scale the errors of the trajectory optimisation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkLimits {
    /// Largest range R, m.
    pub range: f64,
    /// Largest angle of incidence α, rad.
    pub incidence: f64,
    /// Largest spot offset `|s|`, m.
    pub spot: f64,
}

impl Station {
    /// The project's nominal station: see [`NOMINAL_TOML`].
    #[must_use]
    pub fn nominal() -> Self {
        Self::from_toml_str(NOMINAL_TOML, "data/stations/ets.toml")
            .expect("the tests of this crate read the file that is compiled in")
    }
}
