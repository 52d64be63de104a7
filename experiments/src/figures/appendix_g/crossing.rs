//! A vehicle crosses the station's field, facing it, at any level and with all steps refined.

use crate::item::ItemError;
use crate::scenarios;
use quad_dynamics::Level;
use scenario::{Keep, Scenario};
use sifre::Recording;

/// The scenario file.
pub(super) const NAME: &str = "table-G.4";

/// The crossing at a level, every step `refinement` times shorter than in the file.
pub(super) fn cross(level: Level, refinement: u64) -> Result<Recording, ItemError> {
    let mut scenario: Scenario = scenarios::find(NAME)?.scenario()?;
    for quadrotor in &mut scenario.quadrotor {
        quadrotor.level = level;
        quadrotor.step_s = quadrotor.step_s.refined(refinement)?;
    }
    for ets in &mut scenario.ets {
        ets.step_s = ets.step_s.refined(refinement)?;
    }
    let flown = scenario.fly(&(), &Keep::rows(scenario.output.step_s))?;
    match flown.ending.report.status.is_completed() {
        true => Ok(flown.recording),
        false => Err(ItemError::new(format!("{level}: {}", flown.ending))),
    }
}
