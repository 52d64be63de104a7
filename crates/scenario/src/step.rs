//! Step metrics of an axis, found while it is flown.

use quad_ndi::metrics::StepMetrics;

/// Least change of a set point that counts as a step, m.
const LEAST_STEP_M: f64 = 1e-3;

/// Smallest number of rows of a response: the last 5 % of fewer are empty.
const LEAST_POINTS: usize = 20;

/// The response of an axis since its set point changed last.
///
/// Rows before that are forgotten, so that a reference that moves all the time takes no memory.
#[derive(Debug, Default)]
pub(crate) struct StepResponse {
    target: Option<f64>,
    has_jumped: bool,
    points: Vec<(f64, f64)>,
}

impl StepResponse {
    /// Adds a row: where the axis is and where it should be, m.
    pub(crate) fn add(&mut self, time_s: f64, position: f64, target: f64) {
        if self.target != Some(target) {
            let before = self.target.replace(target);
            self.has_jumped = before.is_none_or(|before| (target - before).abs() >= LEAST_STEP_M);
            self.points.clear();
        }
        self.points.push((time_s, position));
    }

    /// Its metrics; `None` if the axis was not asked to jump and stay.
    pub(crate) fn metrics(&self) -> Option<StepMetrics> {
        let target = self.target?;
        let moves = (target - self.points.first()?.1).abs() >= LEAST_STEP_M;
        if !self.has_jumped || !moves || self.points.len() < LEAST_POINTS {
            return None;
        }
        StepMetrics::of(&self.points, target)
    }
}
