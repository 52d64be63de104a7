//! Controllers: gains follow from the vehicle.

use crate::error::ScenarioError;
use crate::file::{ControllerFile, Law};
use quad_dynamics::{CommandLimits, Level, Vehicle};
use quad_ndi::{AnyController, C1, C2, C3, ControllerError, Pid, TiltLaw};

impl Law {
    /// The law itself: paired with this level where the file leaves it open.
    #[must_use]
    pub const fn at(self, level: Level) -> Self {
        match (self, level) {
            (Self::Paired, Level::One) => Self::C1,
            (Self::Paired, Level::Two) => Self::C2,
            (Self::Paired, _) => Self::C3,
            (given, _) => given,
        }
    }

    /// The name in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::C1 => "c1",
            Self::C2 => "c2",
            Self::C3 => "c3",
            Self::Pid => "pid",
            Self::Paired => "paired",
        }
    }

    /// The lowest level that it may fly.
    #[must_use]
    pub const fn lowest_level(self) -> Level {
        match self {
            Self::C1 | Self::Pid | Self::Paired => Level::One,
            Self::C2 => Level::Two,
            Self::C3 => Level::Three,
        }
    }

    /// How its references turn accelerations into tilt: as the model that it inverts does.
    pub(super) const fn tilt_law(self) -> TiltLaw {
        match self {
            Self::C1 => TiltLaw::SmallAngle,
            _ => TiltLaw::Exact,
        }
    }
}

/// The controller of a vehicle. One that flies a model with input limits knows them.
pub(super) fn assemble(
    agent: &str,
    file: &ControllerFile,
    law: Law,
    vehicle: &Vehicle,
    limits: Option<CommandLimits<f64>>,
) -> Result<AnyController<f64>, ScenarioError> {
    let settings = file.settings();
    let built = || -> Result<AnyController<f64>, ControllerError> {
        Ok(match law {
            Law::C1 => AnyController::C1(C1::new(vehicle, &settings)?.into()),
            Law::C2 => AnyController::C2(C2::new(vehicle, &settings)?.into()),
            Law::C3 | Law::Paired => AnyController::C3(C3::new(vehicle, &settings)?.into()),
            Law::Pid => AnyController::Pid(Pid::new(vehicle, &file.pid())?.into()),
        })
    };
    let controller = built().map_err(|source| ScenarioError::Controller {
        agent: agent.to_owned(),
        source: Box::new(source),
    })?;
    Ok(controller.with_limits(limits))
}
