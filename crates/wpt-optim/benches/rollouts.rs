//! What one call of the cost costs, per level: alone, on lanes, with its gradient; and a whole surface.
//!
//! `cargo bench -p wpt-optim`; results and machine stand in BENCHMARKS.md.

use divan::{Bencher, black_box};
use quad_dynamics::Level;
use wpt_optim::{Choice, Grid, LANES, Problem};

fn main() {
    divan::main();
}

/// North of the station, near the optimum.
const NORTH: [f64; 2] = [4.0, 4.5];

/// Nodes of the surfaces.
const GRID: Grid = Grid {
    columns: 41,
    rows: 41,
};

fn problem(level: u8, duration_s: f64) -> Problem {
    let level = Level::try_from(level).expect("levels are 1 to 5");
    Problem::nominal(Choice::Two, duration_s, level).expect("the nominal problem can be posed")
}

/// One call for a crossing in 10 s.
#[divan::bench(args = [1, 2, 3, 4, 5], sample_count = 20, sample_size = 1)]
fn call_10_s(bencher: Bencher<'_, '_>, level: u8) {
    let problem = problem(level, 10.0);
    bencher.bench_local(|| problem.evaluate(black_box(&NORTH)));
}

/// One call for a crossing in 20 s.
#[divan::bench(args = [1, 2, 3, 4, 5], sample_count = 20, sample_size = 1)]
fn call_20_s(bencher: Bencher<'_, '_>, level: u8) {
    let problem = problem(level, 20.0);
    bencher.bench_local(|| problem.evaluate(black_box(&NORTH)));
}

/// Four calls side by side for a crossing in 20 s.
#[divan::bench(args = [1, 2, 3, 4, 5], sample_count = 20, sample_size = 1)]
fn four_lanes_20_s(bencher: Bencher<'_, '_>, level: u8) {
    let problem = problem(level, 20.0);
    bencher.bench_local(|| problem.evaluate_lanes(black_box([&NORTH; LANES].map(|x| x.as_slice()))));
}

/// Cost and gradient of two variables for a crossing in 20 s.
#[divan::bench(args = [1, 3, 5], sample_count = 10, sample_size = 1)]
fn gradient_20_s(bencher: Bencher<'_, '_>, level: u8) {
    let problem = problem(level, 20.0);
    bencher.bench_local(|| problem.gradient(black_box(&NORTH)));
}

/// The surface of 41 by 41 nodes at all five levels for a crossing in 20 s, on all cores.
#[divan::bench(sample_count = 1, sample_size = 1)]
fn five_surfaces_20_s(bencher: Bencher<'_, '_>) {
    let problems = [1, 2, 3, 4, 5].map(|level| problem(level, 20.0));
    bencher.bench_local(|| problems.each_ref().map(|p| p.surface(GRID)));
}
