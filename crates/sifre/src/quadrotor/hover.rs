//! The hover that a quadrotor begins in, and what it draws there.

use nalgebra::Vector3;
use quad_dynamics::{AnyQuadrotor, BuildError, Level, PhenomenonSet, Vehicle};
use quad_math::FixedStep;

/// Step over which the current of hover is taken, s: any, it hardly changes in a second.
const DRAW_STEP_S: f64 = 1e-3;

/// A model of the vehicle in hover.
pub(super) fn model(
    vehicle: &Vehicle,
    level: Level,
    phenomena: &PhenomenonSet,
    at: Vector3<f64>,
    yaw: f64,
) -> Result<AnyQuadrotor<f64>, BuildError> {
    AnyQuadrotor::hovering(level, vehicle, phenomena, at, yaw)
}

/// What a model draws from its battery in hover, A h/s; nothing where it has none that sags.
pub(super) fn hover_draw(model: &AnyQuadrotor<f64>) -> f64 {
    let (mut hovering, input) = (model.clone(), model.hover_input());
    hovering.step(FixedStep::Rk4, &input, DRAW_STEP_S);
    let drawn = |q: &AnyQuadrotor<f64>| q.snapshot(&input).charge_drawn.unwrap_or(0.0);
    (drawn(&hovering) - drawn(model)) / DRAW_STEP_S
}

/// The same hover, but with this velocity in W, m/s.
pub(super) fn set_moving(quadrotor: &mut AnyQuadrotor<f64>, velocity: Vector3<f64>) {
    let input = quadrotor.hover_input();
    let mut snapshot = quadrotor.snapshot(&input);
    snapshot.body.velocity = quadrotor.flight().rotation.matrix.transpose() * velocity;
    quadrotor.adopt(&snapshot, &input);
}
