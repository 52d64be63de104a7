//! How a quadrotor agent is put together.

use super::pilot::Pilot;
use crate::guidance::Guidance;
use crate::schedule::{Schedule, ScheduleError};
use nalgebra::Vector3;
use quad_dynamics::{BuildError, Level, PhenomenonSet, Vehicle};
use quad_math::FixedStep;
use quad_ndi::ControllerError;
use serde::{Deserialize, Serialize};
use std::num::NonZeroU32;
use std::sync::Arc;

/// A level of resolution, and what is switched on at it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LevelChoice {
    /// The level.
    pub level: Level,
    /// The phenomena switched on; those of the level itself unless told otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub phenomena: Option<PhenomenonSet>,
}

impl LevelChoice {
    /// The phenomena switched on.
    pub fn phenomena(&self) -> PhenomenonSet {
        self.phenomena.clone().unwrap_or_else(|| self.level.phenomena())
    }
}

impl From<Level> for LevelChoice {
    /// The level with its own phenomena.
    fn from(level: Level) -> Self {
        Self {
            level,
            phenomena: None,
        }
    }
}

/// Where a quadrotor begins: in hover.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Start {
    /// Position in W, m.
    pub position_m: [f64; 3],
    /// Heading ψ, rad.
    pub yaw_rad: f64,
}

/// What happens to a quadrotor at given times, from outside.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Script {
    /// Velocity of the air in W, m/s; still before the first entry. Felt by models with drag.
    pub wind_m_s: Schedule<[f64; 3]>,
    /// A disturbance of the input: added to the pilot's commands on their way to the rotors, in zeroed duty.
    pub command_offset: Schedule<[f64; 4]>,
    /// Changes of level in flight.
    pub level: Schedule<LevelChoice>,
}

/// Everything that makes a quadrotor agent.
#[derive(Debug)]
pub struct Setup {
    /// Name of the agent.
    pub name: String,
    /// Its vehicle; agents may share one.
    pub vehicle: Arc<Vehicle>,
    /// The level it begins at.
    pub level: LevelChoice,
    /// Where it begins.
    pub start: Start,
    /// Velocity in W that it begins with, m/s; level and with the rotors of hover all the same.
    pub velocity_m_s: [f64; 3],
    /// Who commands the rotors.
    pub pilot: Box<dyn Pilot>,
    /// What it is asked to do.
    pub guidance: Box<dyn Guidance>,
    /// What happens to it.
    pub script: Script,
    /// How its model is integrated, commands and wind held.
    pub method: FixedStep,
    /// How many equal steps the integrator takes from one of the agent's instants to the next.
    pub substeps: NonZeroU32,
}

impl Setup {
    /// A quadrotor in hover at the origin, undisturbed, one RK4 step per step of the agent; change what differs by
    /// struct update.
    pub fn new(
        name: impl Into<String>,
        vehicle: &Arc<Vehicle>,
        level: impl Into<LevelChoice>,
        pilot: impl Pilot + 'static,
        guidance: impl Guidance + 'static,
    ) -> Self {
        Self {
            name: name.into(),
            vehicle: Arc::clone(vehicle),
            level: level.into(),
            start: Start::default(),
            velocity_m_s: [0.0; 3],
            pilot: Box::new(pilot),
            guidance: Box::new(guidance),
            script: Script::default(),
            method: FixedStep::Rk4,
            substeps: NonZeroU32::MIN,
        }
    }

    /// The quantities that must be finite.
    pub(super) fn check_numbers(&self) -> Result<(), QuadrotorError> {
        let [x, y, z] = self.start.position_m;
        let [u, v, w] = self.velocity_m_s;
        let start = [x, y, z, self.start.yaw_rad, u, v, w];
        if let Some(value) = start.into_iter().find(|x| !x.is_finite()) {
            let name = self.name.clone();
            return Err(QuadrotorError::BadStart { name, value });
        }
        let script = |source| QuadrotorError::Script {
            name: self.name.clone(),
            source,
        };
        self.script.wind_m_s.check_finite().map_err(script)?;
        self.script.command_offset.check_finite().map_err(script)
    }

    /// Where it begins in W, m.
    pub(super) fn position(&self) -> Vector3<f64> {
        Vector3::from(self.start.position_m)
    }
}

/// Why a quadrotor agent can't be.
#[derive(Debug, thiserror::Error)]
pub enum QuadrotorError {
    /// A model can't be built.
    #[error("quadrotor \"{name}\": {source}")]
    Build {
        /// The agent.
        name: String,
        /// Why.
        source: Box<BuildError>,
    },
    /// The pilot can't fly a model, now or at a later change of level.
    #[error("quadrotor \"{name}\": {source}")]
    Controller {
        /// The agent.
        name: String,
        /// Why.
        source: Box<ControllerError>,
    },
    /// A start that isn't finite.
    #[error("quadrotor \"{name}\": it can't start at {value}: position, heading and velocity must be finite")]
    BadStart {
        /// The agent.
        name: String,
        /// The number.
        value: f64,
    },
    /// A number of the script that isn't finite.
    #[error("quadrotor \"{name}\": {source}")]
    Script {
        /// The agent.
        name: String,
        /// Why.
        source: ScheduleError,
    },
}

impl QuadrotorError {
    pub(super) fn build(name: String, source: BuildError) -> Self {
        let source = Box::new(source);
        Self::Build { name, source }
    }

    pub(super) fn controller(name: String, source: ControllerError) -> Self {
        let source = Box::new(source);
        Self::Controller { name, source }
    }
}
