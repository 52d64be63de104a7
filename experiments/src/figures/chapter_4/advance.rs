//! The propeller in an axial stream: the line of its thrust coefficient at small advance ratios, and what it damps.

use super::propeller::{AdvanceRow, Row, SCALE};
use crate::item::ItemError;
use quad_dynamics::Vehicle;
use quad_dynamics::vehicle::derive::{SteadyRotor, axial_damping};
use sysid::rotor_static::AdvanceSample;

/// Largest advance ratio of the line: the coefficient bends beyond.
pub(super) const SMALL_ADVANCE: f64 = 0.3;

/// The run at about hover speed, and the static row at its speed, which is its point at rest.
const HOVER_RUN: &str = "kt0836";
const HOVER_RUN_RPM: f64 = 4029.0;

/// The samples of the hover run at small advance ratios, the static point first.
pub(super) fn small_advance(rows: &[AdvanceRow], at_rest: &[Row]) -> Vec<AdvanceSample> {
    let rest = at_rest.iter().find(|row| row.rpm == HOVER_RUN_RPM);
    let rest = rest.map(|row| AdvanceSample {
        advance_ratio: 0.0,
        thrust_coefficient: row.thrust_coefficient,
    });
    let moving = rows
        .iter()
        .filter(|row| row.run == HOVER_RUN)
        .map(|row| row.sample);
    rest.into_iter()
        .chain(moving.filter(|sample| sample.advance_ratio <= SMALL_ADVANCE))
        .collect()
}

/// Relative difference of the file's damping in roll from what the slope gives.
pub(super) fn damping_error(
    vehicle: &Vehicle,
    steady: &SteadyRotor,
    slope: f64,
    hover: f64,
) -> Result<f64, ItemError> {
    let axial = axial_damping(slope, vehicle.environment.air_density, SCALE.diameter_m, hover);
    let derived = steady.rate_damping(vehicle, axial, hover).x;
    let in_file = vehicle.require_drag("table 4.3")?.rate_damping.x;
    Ok((derived / in_file - 1.0).abs())
}
