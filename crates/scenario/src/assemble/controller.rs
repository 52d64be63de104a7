//! Controllers: gains follow from the vehicle.

use crate::error::ScenarioError;
use crate::file::ControllerFile;
use quad_dynamics::{CommandLimits, Vehicle};
use quad_ndi::{AnyController, Law};

/// The controller of a vehicle. One that flies a model with input limits knows them.
pub(super) fn assemble(
    agent: &str,
    file: &ControllerFile,
    law: Law,
    vehicle: &Vehicle,
    limits: Option<CommandLimits<f64>>,
) -> Result<AnyController<f64>, ScenarioError> {
    let controller = law.build(vehicle, &file.design());
    let controller = controller.map_err(|source| ScenarioError::Controller {
        agent: agent.to_owned(),
        source: Box::new(source),
    })?;
    Ok(controller.with_limits(limits))
}
