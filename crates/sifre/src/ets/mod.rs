//! Energy transmission systems as agents: ground stations that keep their beam on another agent's receiver.
//!
//! [`Ets`] is what any of them can be asked. [`GimballedEts`] is the station as it is built, with camera, tracker and gimbal;
//! [`IdealEts`] always points exactly, which bounds what any tracker could transmit.

mod gimballed;
mod ideal;
mod record;

pub use gimballed::GimballedEts;
pub use ideal::IdealEts;

use crate::agent::{Agent, Published};
use ::ets::{GimbalState, Link, Mode, Station};
use nalgebra::{Vector2, Vector3};
use quad_kinematics::Rotation;

/// An energy transmission system: an agent that keeps a laser on another agent's receiver.
pub trait Ets: Agent {
    /// Name of the agent that it tracks.
    fn target(&self) -> &str;

    /// What its tracker is doing.
    fn mode(&self) -> Mode;

    /// Angles (rad) and rates (rad/s) of its platform at its latest instant.
    fn gimbal(&self) -> GimbalState<f64>;

    /// The light on the receiver at its latest instant: geometry and power.
    fn link(&self) -> Link<f64>;
}

/// Everything that makes an energy transmission system.
#[derive(Clone, Debug)]
pub struct EtsSetup {
    /// Name of the agent.
    pub name: String,
    /// Name of the agent that it tracks.
    pub target: String,
    /// Its parameters, and those of the receiver that the target carries.
    pub station: Station,
    /// Pan at the start, rad, clockwise from the pedestal's heading.
    pub pan_rad: f64,
    /// Tilt at the start, rad, upwards.
    pub tilt_rad: f64,
    /// Seed of the image's noise.
    pub seed: u64,
}

impl EtsSetup {
    /// The project's nominal station, at rest with zero pan and tilt.
    pub fn nominal(name: impl Into<String>, target: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            target: target.into(),
            station: Station::nominal(),
            pan_rad: 0.0,
            tilt_rad: 0.0,
            seed: 0,
        }
    }
}

/// The pose that a station publishes: its platform's.
fn pose(physics: &::ets::Ets<f64>, gimbal: &GimbalState<f64>) -> Published {
    Published {
        position: physics.pedestal.origin(),
        velocity: Vector3::zeros(),
        rotation: Rotation::from_matrix(physics.pedestal.rotation(gimbal).matrix),
        body_rates: ::ets::platform_rate_matrix(gimbal.tilt)
            * Vector2::new(gimbal.pan_rate, gimbal.tilt_rate),
    }
}
