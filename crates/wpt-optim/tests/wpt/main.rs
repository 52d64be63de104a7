//! The problem, its rollouts and its surfaces.

mod allocation;
mod bad_input;
mod engine;
mod failures;
mod gradient;
mod ideal;
mod lanes;
mod surfaces;

use quad_dynamics::Level;
use wpt_optim::{Choice, Problem};

/// A nominal problem.
fn nominal(choice: Choice, duration_s: f64, level: Level) -> Problem {
    Problem::nominal(choice, duration_s, level).expect("the nominal problem can be posed")
}
