//! What a model's angular accelerations leave out: is it a moment proportional to the velocity?
//!
//! `ω̇ − ω̇_model = b + a_u u + a_v v + a_w w`, `[u, v, w]` the velocity along B. Rotors in sideways flow tilt their discs and drag
//! above or below the centre of mass, which turns a small quadrotor; none of the levels has such a moment.
//! Source of the effect: P. Bristeau, P. Martin, E. Salaün, N. Petit, *The role of propeller aerodynamics in the model of a
//! quadrotor UAV*, European Control Conference, 2009.

use crate::estimate::Fit;
use crate::flight::Comparison;
use crate::recorded::MotionCaptureFlight;
use crate::regression::{FitError, Row, linear};

/// Fits what a one-step prediction of one angular acceleration leaves over: `[b, a_u, a_v, a_w]`, rad/s² and rad/(m s).
///
/// `goodness.r_squared` is the part of the left-over that velocity explains.
///
/// # Errors
/// Data that don't determine the four.
pub fn moment_of_velocity(
    flight: &MotionCaptureFlight,
    angular_acceleration: &Comparison,
) -> Result<Fit<4>, FitError> {
    let series = angular_acceleration;
    let rows: Vec<Row<4>> = (0..series.time.len())
        .map(|i| {
            let after = flight.inertial.time.partition_point(|&t| t < series.time[i]);
            let k = after.min(flight.velocity.len() - 1);
            let v_b = flight.attitude[k].conjugate().rotate(&flight.velocity[k]);
            Row {
                regressors: [1.0, v_b.x, v_b.y, v_b.z],
                y: series.measured[i] - series.predicted[i],
            }
        })
        .collect();
    let regressors: Vec<[f64; 4]> = rows.iter().map(|row| row.regressors).collect();
    Ok(linear(&rows)?.with_correlated_errors(&regressors))
}
