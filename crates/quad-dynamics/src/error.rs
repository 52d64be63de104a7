//! Why a model can't be built.

use crate::{Capabilities, Phenomenon, PhenomenonSet, Prerequisite, VehicleError};

/// Why a vehicle can't be flown at a level with the phenomena asked for.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BuildError {
    /// The vehicle lacks parameters.
    #[error(transparent)]
    Vehicle(#[from] VehicleError),
    /// A phenomenon needs something that the model doesn't have.
    #[error("{model} can't have {phenomenon}: it needs {prerequisite}")]
    UnmetPrerequisite {
        /// The model that was to have it.
        model: &'static str,
        /// The phenomenon.
        phenomenon: Phenomenon,
        /// What it needs.
        prerequisite: Prerequisite,
    },
    /// The commands that would hold hover lie outside the vehicle's PWM range.
    #[error(
        "{vehicle} can't hover at {model}: rotor {rotor} needs a raw PWM of {command:.4}, outside {minimum} to {maximum}"
    )]
    HoverOutOfRange {
        /// The vehicle's name.
        vehicle: String,
        /// The model.
        model: &'static str,
        /// The rotor, counted from 1.
        rotor: usize,
        /// Raw PWM that hover needs; NaN if the rotor model has no answer.
        command: f64,
        /// Bottom of the raw PWM range.
        minimum: f64,
        /// Top of the raw PWM range.
        maximum: f64,
    },
}

impl BuildError {
    /// Checks that a model has what these phenomena need.
    pub(crate) fn check_phenomena(
        model: &'static str,
        phenomena: &PhenomenonSet,
        capabilities: Capabilities,
    ) -> Result<(), Self> {
        match phenomena.first_unmet(capabilities) {
            None => Ok(()),
            Some(phenomenon) => Err(Self::UnmetPrerequisite {
                model,
                phenomenon,
                prerequisite: phenomenon.prerequisite(),
            }),
        }
    }
}
