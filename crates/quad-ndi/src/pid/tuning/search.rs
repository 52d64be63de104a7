//! The search for one loop's gains: a box of logarithms, random starts, Nelder-Mead.

use super::trial::Bench;
use super::{LoopReport, StartReport, Termination, TunedLoop, TuningOptions};
use crate::pid::PidSettings;
use argmin::core::{CostFunction, Error, Executor, State, TerminationReason};
use argmin::solver::neldermead::NelderMead;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;
use std::cell::RefCell;

/// Half-widths of the box in the logarithms of `k_p`, `k_i`, `k_d` over the placed ones: ln 10, ln 30, ln 10.
const BOX: [f64; 3] = [
    std::f64::consts::LN_10,
    3.401_197_381_662_155,
    std::f64::consts::LN_10,
];

/// Half-width of the region that starts are drawn from, as a logarithm: a factor 4.
const START_REGION: f64 = 2.0 * std::f64::consts::LN_2;

/// Edge of the first simplex, as a logarithm.
const EDGE: f64 = 0.4;

/// Spread of the costs of a simplex, as standard deviation, at which the search has converged.
const CONVERGED: f64 = 1e-6;

/// The cost as a function of the logarithms of one loop's gains.
struct Problem<'a> {
    bench: &'a Bench,
    tuned: TunedLoop,
    settings: PidSettings,
    /// Costs of all flights so far.
    costs: RefCell<Vec<f64>>,
}

impl Problem<'_> {
    /// The settings with this loop's gains multiplied, and the squared distance from the box.
    fn settings(&self, logarithms: &[f64]) -> (PidSettings, f64) {
        let inside: [f64; 3] = std::array::from_fn(|i| logarithms[i].clamp(-BOX[i], BOX[i]));
        let outside = logarithms.iter().zip(inside).map(|(x, y)| (x - y).powi(2)).sum();
        let mut settings = self.settings;
        let gains = self.tuned.gains_mut(&mut settings);
        gains.proportional *= inside[0].exp();
        gains.integral *= inside[1].exp();
        gains.derivative *= inside[2].exp();
        (settings, outside)
    }
}

impl CostFunction for &Problem<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, logarithms: &Vec<f64>) -> Result<f64, Error> {
        let (settings, outside) = self.settings(logarithms);
        let cost = self.bench.cost(&settings) + outside;
        self.costs.borrow_mut().push(cost);
        Ok(cost)
    }
}

/// A number in −1 … 1 from the upper 53 bits of the generator's next word.
fn unit(generator: &mut ChaCha8Rng) -> f64 {
    const SCALE: f64 = 1.0 / (1_u64 << 52) as f64;
    (generator.next_u64() >> 11) as f64 * SCALE - 1.0
}

/// Gains of one loop for the bench, from random starts and once more from the best end.
pub(super) fn search(
    bench: &Bench,
    options: &TuningOptions,
    tuned: TunedLoop,
    settings: &PidSettings,
    generator: &mut ChaCha8Rng,
) -> LoopReport {
    let problem = Problem {
        bench,
        tuned,
        settings: *settings,
        costs: RefCell::new(Vec::new()),
    };
    let mut best = (bench.cost(settings), vec![0.0; BOX.len()]);
    let cost_before = best.0;
    let mut starts = Vec::with_capacity(options.starts);
    for number in 0..=options.starts {
        // Random starts, and at last the best end with a fresh simplex, lest an early collapse be the end.
        let start = if number < options.starts {
            BOX.iter().map(|_| unit(generator) * START_REGION).collect()
        } else {
            best.1.clone()
        };
        let before = problem.costs.borrow().len();
        let (cost, logarithms, termination) = descend(&problem, start, options.iterations);
        let evaluations = problem.costs.borrow().len() - before;
        starts.push(StartReport {
            cost,
            evaluations,
            termination,
        });
        if cost < best.0 {
            best = (cost, logarithms);
        }
    }
    let (mut found, _) = problem.settings(&best.1);
    let mut least = cost_before;
    let history = problem.costs.into_inner().into_iter().map(|cost| {
        least = least.min(cost);
        least
    });
    LoopReport {
        tuned,
        gains: *tuned.gains_mut(&mut found),
        cost: best.0,
        cost_before,
        starts,
        history: history.collect(),
    }
}

/// Nelder-Mead from one start: best cost, where, and why it stopped.
fn descend(problem: &Problem<'_>, start: Vec<f64>, iterations: u64) -> (f64, Vec<f64>, Termination) {
    let mut simplex = vec![start.clone()];
    for i in 0..start.len() {
        let mut corner = start.clone();
        corner[i] += EDGE;
        simplex.push(corner);
    }
    let fallback = (f64::INFINITY, start, Termination::OutOfIterations);
    // The tolerance is positive and the cost always a number, so neither step fails.
    let Ok(solver) = NelderMead::new(simplex).with_sd_tolerance(CONVERGED) else {
        return fallback;
    };
    let run = Executor::new(problem, solver)
        .configure(|state| state.max_iters(iterations))
        .ctrlc(false)
        .timer(false)
        .run();
    let Ok(result) = run else { return fallback };
    let state = result.state();
    let termination = match state.get_termination_reason() {
        Some(TerminationReason::SolverConverged) => Termination::Converged,
        _ => Termination::OutOfIterations,
    };
    let best = state.get_best_param().cloned().unwrap_or(fallback.1);
    (state.get_best_cost(), best, termination)
}
