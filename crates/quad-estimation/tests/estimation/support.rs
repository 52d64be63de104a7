//! A vehicle, its processes, and random numbers.

use nalgebra::{DMatrix, DVector};
use quad_dynamics::{AnyQuadrotor, Level, Vehicle};
use quad_estimation::{Belief, InitialUncertainty, LevelProcess, Process, ProcessNoise};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

pub(crate) fn generator(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

pub(crate) fn normals(n: usize, random: &mut ChaCha8Rng) -> DVector<f64> {
    DVector::from_fn(n, |_, _| StandardNormal.sample(random))
}

pub(crate) fn process(level: Level) -> LevelProcess {
    let vehicle = Vehicle::qball_x4();
    LevelProcess::new(level, &vehicle, &level.phenomena(), ProcessNoise::default()).expect("a valid level")
}

/// A belief about a hover 1 m up.
pub(crate) fn hovering(process: &LevelProcess) -> Belief {
    hovering_within(process, &InitialUncertainty::default())
}

pub(crate) fn hovering_within(process: &LevelProcess, uncertainty: &InitialUncertainty) -> Belief {
    let level = process.level();
    let at = [0.0, 0.0, -1.0].into();
    let model = AnyQuadrotor::hovering(level, &Vehicle::qball_x4(), &level.phenomena(), at, 0.3)
        .expect("a valid level");
    let input = model.hover_input();
    process
        .belief(&model.snapshot(&input), &input, uncertainty)
        .expect("valid deviations")
}

/// A draw from a belief.
pub(crate) fn drawn<P: Process>(process: &P, belief: &Belief, random: &mut ChaCha8Rng) -> DVector<f64> {
    let l = belief.covariance.clone().cholesky().expect("a covariance").l();
    let error = l * normals(belief.covariance.nrows(), random);
    process.retract(&belief.mean, &error)
}

/// Largest difference of two matrices, each entry in units of the geometric mean of its row's and column's scale.
pub(crate) fn scaled_difference(a: &DMatrix<f64>, b: &DMatrix<f64>) -> f64 {
    let scale = |i: usize, j: usize| (b[(i, i)].abs() * b[(j, j)].abs()).sqrt();
    let entry = |(i, j)| (a[(i, j)] - b[(i, j)]).abs() / scale(i, j);
    let places = (0..a.nrows()).flat_map(|i| (0..a.ncols()).map(move |j| (i, j)));
    places.map(entry).fold(0.0, f64::max)
}
