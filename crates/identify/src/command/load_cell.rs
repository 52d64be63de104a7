//! `identify load-cell`.

use super::Done;
use crate::arguments::{Capacity, Common};
use crate::input::{self, Cell};
use crate::output::Answer;
use crate::plot;
use quad_plot::Panel;
use sysid::load_cell::calibrate;

const MILLI: f64 = 1e3;

pub(super) fn identify(common: &Common, capacity: Capacity, answer: &mut Answer) -> Done {
    let (cell, capacity) = match (capacity.capacity_n, capacity.capacity_n_m) {
        (_, Some(torque)) => (Cell::Torque, torque),
        (force, None) => (Cell::Force, force.unwrap_or_default()),
    };
    let samples = input::loads(&common.data, cell, answer)?;
    let calibration = calibrate(&samples, capacity)?;
    answer.warn(&calibration.line.warnings);
    let (unit, label) = match cell {
        Cell::Force => ("V/N", "Load *F*, N"),
        Cell::Torque => ("V/(N m)", "Load *M*, N m"),
    };
    answer.push("zero", "V", calibration.zero());
    answer.push("sensitivity", unit, calibration.sensitivity());
    let points = samples.iter().map(|s| (s.load, s.reading_v)).collect();
    let line = plot::curve(calibration.smallest_load, calibration.largest_load, |load| {
        calibration.reading(load).value
    });
    let residuals = samples
        .iter()
        .zip(&calibration.line.residuals)
        .map(|(s, r)| (s.load, MILLI * r))
        .collect();
    let panel = |label: &str, y: &str| plot::wide(Panel::new(label, y), samples.iter().map(|s| s.load));
    answer.figure = Some(
        plot::figure(1)
            .panel(plot::measured(panel(label, "Reading *y*, V"), points).line("line", plot::FIT, line))
            .panel(plot::residuals(panel(label, "Residual, mV"), residuals)),
    );
    Ok(())
}
