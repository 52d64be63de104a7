//! Boxes, methods and SciPy's recorded results.

use optim::test_functions::{himmelblau, rastrigin, rosenbrock, sphere};
use optim::{
    Annealing, AnnealingSettings, Answer, Evolution, EvolutionSettings, Limits, LineSearch,
    LineSearchSettings, NelderMead, Optimiser, Progress, Report, SimplexSettings, Variable, run,
};
use serde::Deserialize;
use std::ops::ControlFlow;

pub(crate) fn space(n: usize, lower: f64, upper: f64) -> Vec<Variable> {
    let variable = |k| Variable {
        name: format!("x_{k}"),
        unit: "1".into(),
        lower,
        upper,
    };
    (0..n).map(variable).collect()
}

pub(crate) fn function(name: &str) -> fn(&[f64]) -> f64 {
    match name {
        "himmelblau" => himmelblau,
        "rosenbrock" => rosenbrock,
        "rastrigin" => rastrigin,
        "sphere" => sphere,
        other => panic!("no test function \"{other}\""),
    }
}

pub(crate) fn go_on(_: &Progress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Runs to the method's own end.
pub(crate) fn solve<A: Answer>(search: &mut impl Optimiser<A>, cost: impl FnMut(&[f64]) -> A) -> Report {
    run(search, cost, Limits::evaluations(1_000_000), &mut go_on).unwrap()
}

pub(crate) fn simplex(variables: Vec<Variable>, start: &[f64]) -> NelderMead {
    let settings = SimplexSettings {
        restarts: 2,
        ..SimplexSettings::default()
    };
    NelderMead::new(variables, start, settings).unwrap()
}

pub(crate) fn lines(variables: Vec<Variable>, start: &[f64]) -> LineSearch {
    LineSearch::new(variables, start, LineSearchSettings::default()).unwrap()
}

pub(crate) fn annealing(variables: Vec<Variable>, start: &[f64], seed: u64) -> Annealing {
    let settings = AnnealingSettings {
        seed,
        ..AnnealingSettings::default()
    };
    Annealing::new(variables, start, settings).unwrap()
}

pub(crate) fn evolution(variables: Vec<Variable>, seed: u64) -> Evolution {
    let settings = EvolutionSettings {
        seed,
        ..EvolutionSettings::default()
    };
    Evolution::new(variables, settings).unwrap()
}

#[derive(Deserialize)]
pub(crate) struct Found {
    pub(crate) x: Vec<f64>,
    pub(crate) cost: f64,
    pub(crate) evaluations: u64,
}

#[derive(Deserialize)]
pub(crate) struct SimplexCase {
    pub(crate) function: String,
    pub(crate) lower: f64,
    pub(crate) upper: f64,
    pub(crate) simplex: Vec<Vec<f64>>,
    pub(crate) adaptive: bool,
    pub(crate) found: Found,
    pub(crate) iterations: u64,
    pub(crate) points: Vec<Vec<f64>>,
}

#[derive(Deserialize)]
pub(crate) struct LocalCase {
    pub(crate) function: String,
    pub(crate) lower: f64,
    pub(crate) upper: f64,
    pub(crate) start: Vec<f64>,
    pub(crate) found: Found,
}

#[derive(Deserialize)]
pub(crate) struct GlobalCase {
    pub(crate) function: String,
    pub(crate) lower: f64,
    pub(crate) upper: f64,
    pub(crate) variables: usize,
    pub(crate) found: Found,
}

/// Written by `tools/scipy_optimisers.py`.
#[derive(Deserialize)]
pub(crate) struct Scipy {
    pub(crate) scipy: String,
    pub(crate) nelder_mead: Vec<SimplexCase>,
    pub(crate) l_bfgs_b: Vec<LocalCase>,
    pub(crate) differential_evolution: Vec<GlobalCase>,
    pub(crate) dual_annealing: Vec<GlobalCase>,
    pub(crate) powell: Vec<LocalCase>,
}

pub(crate) fn scipy() -> Scipy {
    serde_json::from_str(include_str!("../data/scipy_optimisers.json")).unwrap()
}
