//! Every optimiser on Himmelblau's function: what it finds, in how many evaluations, how long it takes, and why it ends.
//!
//!     cargo run -p optim --example himmelblau

use optim::test_functions::himmelblau;
use optim::{
    Annealing, CostAndGradient, Evolution, Limits, LineSearch, NelderMead, Optimiser, QuasiNewton, Report,
    RunError, Variable, gradient_by_dual_numbers, minimise,
};
use std::error::Error;

const START: [f64; 2] = [0.0, 0.0];

fn variables() -> Vec<Variable> {
    let axis = |name: &str| Variable {
        name: name.into(),
        unit: "1".into(),
        lower: -5.0,
        upper: 5.0,
    };
    vec![axis("x"), axis("y")]
}

fn solve(mut search: impl Optimiser) -> Result<Report, RunError> {
    minimise(&mut search, himmelblau, Limits::evaluations(100_000))
}

/// The function over dual numbers.
fn with_gradient(x: &[f64]) -> CostAndGradient {
    let cost = |x: &[quad_math::Dual<2>; 2]| {
        let (a, b) = (x[0] * x[0] + x[1] - 11.0, x[0] + x[1] * x[1] - 7.0);
        a * a + b * b
    };
    gradient_by_dual_numbers(cost, [x[0], x[1]])
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut newton = QuasiNewton::new(variables(), &START, Default::default())?;
    let limits = Limits::evaluations(1000);
    let by_gradient = minimise(&mut newton, with_gradient, limits)?;
    let reports = [
        (
            "Nelder-Mead",
            solve(NelderMead::new(variables(), &START, Default::default())?)?,
        ),
        (
            "line search",
            solve(LineSearch::new(variables(), &START, Default::default())?)?,
        ),
        (
            "annealing",
            solve(Annealing::new(variables(), &START, Default::default())?)?,
        ),
        (
            "evolution",
            solve(Evolution::new(variables(), Default::default())?)?,
        ),
        ("projected BFGS", by_gradient),
    ];
    for (name, report) in reports {
        let x = &report.best.candidate.values;
        println!(
            "{name:14} ({:8.5}, {:8.5}) costs {:.1e} after {:5} evaluations, {:6.3} ms; {}",
            x[0],
            x[1],
            report.best.cost,
            report.evaluations,
            1e3 * report.elapsed.as_secs_f64(),
            report.stop
        );
    }
    Ok(())
}
