//! Level 5 optimised with the help of levels 1 to 4, and without, from the same starts.

use super::optimisations::{Effort, QUICK_STEP, stepped};
use crate::item::ItemError;
use optim::multi_fidelity::{LevelCost, MultiFidelityReport, MultiFidelitySettings, multi_fidelity};
use optim::{Limits, NelderMead, Report, SimplexSettings, minimise};
use quad_dynamics::Level;
use rayon::prelude::*;
use sifre::StepSize;
use std::ops::ControlFlow;
use wpt_optim::{Choice, Objective, Problem};

/// A cost is as good as the optimum within this factor.
const AS_GOOD: f64 = 1.01;
/// Step of vehicle and station: twice the declared one, because flights are counted here.
const STEP: StepSize = StepSize::MILLISECOND.times(2);
/// Duration of the crossings, s.
pub(super) const DURATION_S: f64 = 10.0;
/// Evaluations after which plain searches are given up.
const MOST_EVALUATIONS: u64 = 1500;

/// Both ways from one start.
pub(super) struct Pair {
    /// With the help of the lower levels.
    pub(super) guided: MultiFidelityReport,
    /// Nelder and Mead's simplex at level 5 alone.
    pub(super) plain: Report,
}

/// All starts of a problem.
pub(super) struct Race {
    /// A pair for each start.
    pub(super) pairs: Vec<Pair>,
    /// The least cost that any of them found at level 5.
    pub(super) best: f64,
}

/// Flights at level 5 until the best so far is as good as `best`: `None` where it never is.
fn until(history: &[f64], best: f64) -> Option<u64> {
    let place = history.iter().position(|&cost| cost <= AS_GOOD * best)?;
    Some(place as u64 + 1)
}

impl Pair {
    fn run(problems: &[Problem], seed: u64) -> Result<Self, ItemError> {
        let [.., top] = problems else {
            return Err(ItemError::new("there is no level to optimise"));
        };
        let start = start(top, seed);
        let objectives: Vec<_> = problems.iter().map(Objective::new).collect();
        let costs: Vec<_> = objectives.iter().map(|o| move |x: &[f64]| o.cost(x)).collect();
        let costs: Vec<LevelCost> = costs.iter().map(|c| c as LevelCost).collect();
        let settings = MultiFidelitySettings {
            seed,
            ..MultiFidelitySettings::default()
        };
        let guided = multi_fidelity(top.variables(), &start, &costs, &settings, &mut |_| {
            ControlFlow::Continue(())
        })?;
        // A modest end: 1e-4 of the box and 1e-6 of the cost.
        let modest = SimplexSettings {
            spread: 1e-4,
            cost_spread: 1e-6,
            ..SimplexSettings::default()
        };
        let mut simplex = NelderMead::new(top.variables(), &start, modest)?;
        let limits = Limits::evaluations(MOST_EVALUATIONS);
        let plain = minimise(&mut simplex, costs[costs.len() - 1], limits)?;
        Ok(Self { guided, plain })
    }

    /// Cost of the guided optimum; NaN where level 5 was not reached.
    pub(super) fn guided_cost(&self) -> f64 {
        self.guided.best().map_or(f64::NAN, |best| best.cost)
    }

    /// Guided flights at level 5.
    pub(super) fn guided_flights(&self) -> u64 {
        self.guided.calls.last().copied().unwrap_or_default()
    }

    /// Guided flights at level 5 until as good as `best`.
    pub(super) fn guided_until(&self, best: f64) -> Option<u64> {
        until(&self.guided.history, best)
    }

    /// Plain flights until as good as `best`.
    pub(super) fn plain_until(&self, best: f64) -> Option<u64> {
        until(&self.plain.history, best)
    }
}

impl Race {
    /// Runs both from `starts` starts.
    pub(super) fn run(choice: Choice, effort: Effort, starts: u64) -> Result<Self, ItemError> {
        let problems = Level::ALL
            .iter()
            .map(|&level| stepped(&Problem::nominal(choice, DURATION_S, level)?, step(effort)))
            .collect::<Result<Vec<_>, _>>()?;
        let pairs = (0..starts)
            .into_par_iter()
            .map(|seed| Pair::run(&problems, seed))
            .collect::<Result<Vec<_>, _>>()?;
        let costs = pairs.iter().flat_map(|p| [p.guided_cost(), p.plain.best.cost]);
        let best = costs.fold(f64::INFINITY, f64::min);
        Ok(Self { pairs, best })
    }

    /// How many guided optima are as good as the best.
    pub(super) fn guided_as_good(&self) -> usize {
        let good = |p: &&Pair| p.guided_cost() <= AS_GOOD * self.best;
        self.pairs.iter().filter(good).count()
    }

    /// How many plain optima are as good as the best.
    pub(super) fn plain_as_good(&self) -> usize {
        let good = |p: &&Pair| p.plain.best.cost <= AS_GOOD * self.best;
        self.pairs.iter().filter(good).count()
    }

    /// The most flights at level 5 that a guided search takes, as a share of the plain one's from the same start.
    pub(super) fn largest_share(&self) -> f64 {
        let share = |p: &Pair| p.guided_flights() as f64 / p.plain.evaluations as f64;
        self.pairs.iter().map(share).fold(0.0, f64::max)
    }
}

/// Step of vehicle and station.
pub(super) fn step(effort: Effort) -> StepSize {
    match effort {
        Effort::Full => STEP,
        Effort::Quick => QUICK_STEP,
    }
}

/// A start for each seed, anywhere in the box: the additive sequence of low discrepancy whose steps are the powers of `1/φ_n`, where
/// `φ_n` solves `x^(n+1) = x + 1`.
fn start(problem: &Problem, seed: u64) -> Vec<f64> {
    let variables = problem.variables();
    let n = variables.len() as i32;
    // Ten rounds of the contraction x ← (1 + x)^(1/(n+1)) leave less than 1e-6.
    let golden = (0..10).fold(1.5_f64, |x, _| (1.0 + x).powf(1.0 / f64::from(n + 1)));
    let share = |i: i32| (0.5 + seed as f64 * golden.powi(-i)).fract();
    let shares = (1..=n).map(share);
    variables
        .iter()
        .zip(shares)
        .map(|(v, share)| v.lower + share * (v.upper - v.lower))
        .collect()
}
