//! How many flights at level 5 do levels 1 to 4 save? The nominal crossing in 10 s with two variables, from random starts.
//!
//!     cargo run --release -p wpt-optim --example multi_fidelity -- [seeds]
//!
//! Each line is a seed: level 5's cost of the guided optimum and of plain Nelder-Mead's, with the flights of every level.
//! Ends with an error unless every guided optimum is within 1 % of the best one known, with at most a quarter of plain's flights.

use quad_dynamics::Level;
use rayon::prelude::*;
use std::error::Error;
use std::ops::ControlFlow;
use wpt_optim::multi_fidelity::{LevelCost, MultiFidelityReport, MultiFidelitySettings, multi_fidelity};
use wpt_optim::optimisers::{Limits, NelderMead, Report, SimplexSettings, run};
use wpt_optim::{Choice, Problem};

const DURATION_S: f64 = 10.0;
const LEVELS: [Level; 5] = [Level::One, Level::Two, Level::Three, Level::Four, Level::Five];
/// Generations of 30 flights at level 1, whose two variables have but two valleys: no further searches are needed.
const GENERATIONS: u32 = 10;

struct Pair {
    guided: MultiFidelityReport,
    plain: Report,
}

type Failure = Box<dyn Error + Send + Sync>;

/// A start for each seed, anywhere in the box: a sequence of low discrepancy.
fn start(problem: &Problem, seed: u64) -> Vec<f64> {
    let shares = [0.754_877_666_2, 0.569_840_290_9].map(|step: f64| (0.5 + seed as f64 * step).fract());
    let variables = problem.variables().into_iter().zip(shares);
    variables
        .map(|(v, s)| v.lower + s * (v.upper - v.lower))
        .collect()
}

fn pair(problems: &[Problem], seed: u64) -> Result<Pair, Failure> {
    let top = &problems[LEVELS.len() - 1];
    // A decision of the wrong length can't come from an optimiser; any other flies.
    let cost = |problem: &Problem, x: &[f64]| problem.evaluate(x).map_or(f64::NAN, |o| o.cost);
    let levels: Vec<_> = problems.iter().map(|p| move |x: &[f64]| cost(p, x)).collect();
    let costs: Vec<LevelCost> = levels.iter().map(|c| c as LevelCost).collect();
    let from = start(top, seed);
    let settings = MultiFidelitySettings {
        generations: GENERATIONS,
        searches: 0,
        seed,
        ..MultiFidelitySettings::default()
    };
    let guided = multi_fidelity(top.variables(), &from, &costs, &settings, &mut |_| {
        ControlFlow::Continue(())
    })?;
    // A modest end: 1e-4 of the box and 1e-6 of the cost.
    let modest = SimplexSettings {
        spread: 1e-4,
        cost_spread: 1e-6,
        ..SimplexSettings::default()
    };
    let mut simplex = NelderMead::new(top.variables(), &from, modest)?;
    let plain = run(
        &mut simplex,
        |x| cost(top, x),
        Limits::evaluations(1000),
        &mut |_| ControlFlow::Continue(()),
    )?;
    let found = guided.best().map_or(f64::NAN, |b| b.cost);
    println!(
        "seed {seed:2} from {from:.2?}: guided {found:.6} with {:?} flights, plain {:.6} with {}; {}",
        guided.calls, plain.best.cost, plain.evaluations, plain.stop
    );
    Ok(Pair { guided, plain })
}

fn main() -> Result<(), Failure> {
    let seeds: u64 = std::env::args()
        .nth(1)
        .map_or(Ok(20), |argument| argument.parse())?;
    let problems = LEVELS
        .iter()
        .map(|&level| Problem::nominal(Choice::Two, DURATION_S, level))
        .collect::<Result<Vec<_>, _>>()?;
    let pairs = (0..seeds)
        .into_par_iter()
        .map(|seed| pair(&problems, seed))
        .collect::<Result<Vec<_>, _>>()?;
    let found = |p: &Pair| p.guided.best().map_or(f64::NAN, |b| b.cost);
    let costs = pairs.iter().flat_map(|p| [found(p), p.plain.best.cost]);
    let best = costs.fold(f64::INFINITY, f64::min);
    let near = pairs.iter().filter(|p| found(p) <= 1.01 * best).count();
    let share = |p: &Pair| p.guided.calls[LEVELS.len() - 1] as f64 / p.plain.evaluations as f64;
    let most = pairs.iter().map(share).fold(0.0, f64::max);
    // The stricter count: flights until the best so far is within 1 %, all of them where it never is.
    let until = |history: &[f64]| history.iter().take_while(|&&cost| cost > 1.01 * best).count() as u64 + 1;
    let total = |f: &dyn Fn(&Pair) -> u64| pairs.iter().map(f).sum::<u64>();
    println!(
        "flights at level 5 until within 1 %: {} guided, {} plain",
        total(&|p| until(&p.guided.history)),
        total(&|p| until(&p.plain.history))
    );
    println!(
        "{near} of {seeds} within 1 % of {best:.6}; level-5 flights {} guided, {} plain; at most {most:.3} of plain's",
        total(&|p| p.guided.calls[LEVELS.len() - 1]),
        total(&|p| p.plain.evaluations)
    );
    if (near as u64) < seeds || most > 0.25 {
        return Err(
            "levels 1 to 4 did not guide level 5 to its optimum with a quarter of the flights".into(),
        );
    }
    Ok(())
}
