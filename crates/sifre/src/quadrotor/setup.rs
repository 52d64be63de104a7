//! How a quadrotor agent is put together.

use super::air::{AirError, ProcessNoiseSource, Wind, check_speed};
use super::estimation::{Estimation, EstimationSetupError};
use super::pilot::Pilot;
use super::rule::{LevelRule, RuleError};
use crate::agent::FARTHEST_M;
use crate::guidance::Guidance;
use crate::schedule::{Schedule, ScheduleError};
use nalgebra::Vector3;
use quad_dynamics::{BuildError, Level, Phenomenon, PhenomenonSet, Vehicle};
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
    /// The phenomena switched on; those of the level itself by default.
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
    /// A disturbance of the input: added to the pilot's commands on their way to the rotors, as an offset in duty.
    pub command_offset: Schedule<[f64; 4]>,
    /// More about the air: a wind that is added to the one above, its growth with height, and gusts.
    #[serde(skip_serializing_if = "Wind::is_still")]
    pub wind: Wind,
    /// Noise on the accelerations.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub process_noise: Option<ProcessNoiseSource>,
    /// Changes of level in flight.
    pub level: Schedule<LevelChoice>,
    /// The level by the distance to another agent; not together with the changes above.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rule: Option<LevelRule>,
}

impl Script {
    /// What is switched on at a level: what the choice says, or else the level's own phenomena and those that the script
    /// feeds (`wind-shear`, `turbulence`, `process-noise`).
    pub fn phenomena(&self, choice: &LevelChoice) -> PhenomenonSet {
        let fed = self
            .sources()
            .into_iter()
            .filter(|s| s.is_there)
            .map(|s| s.phenomenon);
        match &choice.phenomena {
            Some(phenomena) => phenomena.clone(),
            None => fed.fold(choice.level.phenomena(), PhenomenonSet::with),
        }
    }

    /// All choices of level that the script may make.
    pub(super) fn choices(&self) -> impl Iterator<Item = &LevelChoice> {
        let by_rule = self.rule.iter().flat_map(|rule| [&rule.fine, &rule.coarse]);
        self.level.values().chain(by_rule)
    }

    fn sources(&self) -> [Source; 3] {
        let source = |phenomenon, wanted, is_there| Source {
            phenomenon,
            wanted,
            is_there,
        };
        [
            source(Phenomenon::WindShear, "wind.shear", self.wind.shear.is_some()),
            source(
                Phenomenon::Turbulence,
                "wind.turbulence",
                self.wind.turbulence.is_some(),
            ),
            source(
                Phenomenon::ProcessNoise,
                "process_noise",
                self.process_noise.is_some(),
            ),
        ]
    }

    /// Whether the air never moves.
    pub(super) fn is_still(&self) -> bool {
        let any = |winds: &Schedule<[f64; 3]>| winds.values().next().is_some();
        let wind = &self.wind;
        !any(&self.wind_m_s)
            && !any(&wind.steps_m_s)
            && wind.constant_m_s == [0.0; 3]
            && wind.turbulence.is_none()
    }

    /// Checks its own numbers.
    fn check_air(&self) -> Result<(), AirError> {
        let changes = self.wind_m_s.times().chain(self.wind.steps_m_s.times());
        for at in std::iter::once(0).chain(changes) {
            let scheduled = self.wind_m_s.at(at).copied().unwrap_or_default();
            check_speed((Vector3::from(scheduled) + self.wind.mean(at)).norm())?;
        }
        self.wind.check()?;
        self.process_noise.map_or(Ok(()), |noise| noise.check())
    }

    /// Checks that what is switched on is fed, and has a ground below it.
    fn check_phenomena(&self, phenomena: &PhenomenonSet, altitude_m: f64) -> Result<(), AirError> {
        if let Some(missing) = self
            .sources()
            .into_iter()
            .find(|s| !s.is_there && phenomena.contains(s.phenomenon))
        {
            return Err(AirError::NoSource {
                phenomenon: missing.phenomenon,
                wanted: missing.wanted,
            });
        }
        let grounded = [
            Phenomenon::GroundEffect,
            Phenomenon::WindShear,
            Phenomenon::Turbulence,
        ];
        match grounded.into_iter().find(|p| phenomena.contains(*p)) {
            Some(phenomenon) if altitude_m < 0.0 => Err(AirError::BelowGround {
                altitude_m,
                phenomenon,
            }),
            _ => Ok(()),
        }
    }
}

/// What feeds a phenomenon from outside the model.
struct Source {
    phenomenon: Phenomenon,
    wanted: &'static str,
    is_there: bool,
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
    /// Sensors and a filter on board; none if its pilot is to see the flight as it is and nobody estimates it.
    pub estimation: Option<Estimation>,
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
            estimation: None,
            method: FixedStep::Rk4,
            substeps: NonZeroU32::MIN,
        }
    }

    /// The quantities that must be finite.
    pub(super) fn check_numbers(&self) -> Result<(), QuadrotorError> {
        let [x, y, z] = self.start.position_m;
        let [u, v, w] = self.velocity_m_s;
        let start = [x, y, z, self.start.yaw_rad, u, v, w];
        if let Some(value) = start.into_iter().find(|x| x.is_nan() || x.abs() > FARTHEST_M) {
            let name = self.name.clone();
            return Err(QuadrotorError::BadStart { name, value });
        }
        let script = |source| QuadrotorError::Script {
            name: self.name.clone(),
            source,
        };
        self.script.wind_m_s.check_finite().map_err(script)?;
        self.script.command_offset.check_finite().map_err(script)?;
        let air = |source| QuadrotorError::Air {
            name: self.name.clone(),
            source,
        };
        self.script.check_air().map_err(air)?;
        for choice in std::iter::once(&self.level).chain(self.script.choices()) {
            let phenomena = self.script.phenomena(choice);
            self.script.check_phenomena(&phenomena, -z).map_err(air)?;
        }
        self.check_rule()
    }

    fn check_rule(&self) -> Result<(), QuadrotorError> {
        let name = || self.name.clone();
        match &self.script.rule {
            Some(_) if self.script.level.values().next().is_some() => {
                Err(QuadrotorError::TwoMasters { name: name() })
            }
            Some(rule) => rule
                .check()
                .map_err(|source| QuadrotorError::Rule { name: name(), source }),
            None => Ok(()),
        }
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
    /// An estimator that can't be.
    #[error("quadrotor \"{name}\": {source}")]
    Estimation {
        /// The agent.
        name: String,
        /// Why.
        source: Box<EstimationSetupError>,
    },
    /// A start that isn't finite, or is farther away than [`FARTHEST_M`].
    #[error(
        "quadrotor \"{name}\": position, heading and velocity at the start must be finite and at most {FARTHEST_M:e} in magnitude, got {value}"
    )]
    BadStart {
        /// The agent.
        name: String,
        /// The number.
        value: f64,
    },
    /// Air or noise that can't be.
    #[error("quadrotor \"{name}\": {source}")]
    Air {
        /// The agent.
        name: String,
        /// Why.
        source: AirError,
    },
    /// A rule that can't be.
    #[error("quadrotor \"{name}\": {source}")]
    Rule {
        /// The agent.
        name: String,
        /// Why.
        source: RuleError,
    },
    /// Levels by time and by distance at once.
    #[error(
        "quadrotor \"{name}\": the level is set both by time (`level_changes`, `Script::level`) and by distance (`level_rule`, \
         `Script::rule`): keep one of them"
    )]
    TwoMasters {
        /// The agent.
        name: String,
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

    pub(super) fn estimation(name: String, source: EstimationSetupError) -> Self {
        let source = Box::new(source);
        Self::Estimation { name, source }
    }

    pub(super) fn controller(name: String, source: ControllerError) -> Self {
        let source = Box::new(source);
        Self::Controller { name, source }
    }
}
