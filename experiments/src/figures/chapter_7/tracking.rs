//! The run of figure 7.6: a target at rest off the image centre, and the station that turns to it.

use ets::{Ets, EtsInput, EtsState, FrameClock};
use nalgebra::{Vector2, Vector3};

/// The image of the target at the start, px, from the centre.
pub(super) const START: [f64; 2] = [200.0, 100.0];
/// Range of the target, m; without influence on its image.
const RANGE_M: f64 = 5.0;
/// Step of the station, s.
pub(super) const STEP_S: f64 = 1e-3;
/// Number of steps.
const STEPS: u64 = 3000;
/// A sample of the run.
pub(super) struct Row {
    /// Time, s.
    pub(super) t: f64,
    /// State of the station.
    pub(super) state: EtsState<f64>,
    /// True image of the target, px.
    pub(super) image: Vector2<f64>,
    /// Whether the camera sees it.
    pub(super) visible: bool,
}

/// Runs the station; every fifth step is kept.
pub(super) fn track(ets: &Ets<f64>, clock: &FrameClock) -> Vec<Row> {
    let mut state = ets.at_rest(0.0, 0.0);
    let r_we = ets.pedestal.rotation(&state.gimbal).matrix;
    let target: Vector3<f64> = ets.pedestal.origin() + r_we * ets.camera.direction(&START.into()) * RANGE_M;
    let input = EtsInput {
        target,
        noise: Vector2::zeros(),
    };
    let mut rows = Vec::new();
    for n in 0..=STEPS {
        if n % 5 == 0 {
            let view = ets.view(&state.gimbal, &target);
            rows.push(Row {
                t: n as f64 * clock.step_s(),
                state,
                image: view.point,
                visible: view.visible == 1.0,
            });
        }
        state = ets.step(clock, n, &state, &input);
    }
    rows
}
