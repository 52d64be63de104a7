//! Small tools that several laws share.

use nalgebra::SVector;
use quad_dynamics::{Flight, Input, QuadrotorModel, StateOf};
use quad_math::{FixedStep, System, rk4_step};

/// Position, velocity, rotation matrix and body rates in one vector: what of a flight all levels have.
pub(crate) fn outputs(flight: &Flight<f64>) -> SVector<f64, 18> {
    let parts = [
        flight.position.as_slice(),
        flight.velocity.as_slice(),
        flight.rotation.matrix.as_slice(),
        flight.body_rates.as_slice(),
    ];
    SVector::from_iterator(parts.concat())
}

/// Flies `steps` RK4 steps over `time` seconds under a constant input.
pub(crate) fn fly<M: QuadrotorModel<f64>>(
    model: &M,
    start: StateOf<f64, M>,
    input: &Input<f64>,
    time: f64,
    steps: u32,
) -> StateOf<f64, M> {
    let h = time / f64::from(steps);
    (0..steps).fold(start, |x, _| FixedStep::Rk4.step(model, &x, input, h))
}

/// The RK4 flow of any system, as [`fly`].
pub(crate) fn flow<S: System<f64>>(
    system: &S,
    start: S::State,
    input: &S::Input,
    time: f64,
    steps: u32,
) -> S::State {
    let h = time / f64::from(steps);
    (0..steps).fold(start, |x, _| rk4_step(system, &x, input, h))
}

/// Largest difference of two lists of numbers, each over the tolerance for its own size.
pub(crate) fn worst_over(left: &[f64], right: &[f64], tolerance: impl Fn(usize) -> f64) -> f64 {
    assert_eq!(left.len(), right.len());
    let ratios = left
        .iter()
        .zip(right)
        .enumerate()
        .map(|(i, (l, r))| (l - r).abs() / tolerance(i));
    // A NaN must fail, and `f64::max` would drop it.
    ratios.fold(0.0, |worst, ratio| if ratio <= worst { worst } else { ratio })
}
