//! Multi-fidelity optimisation: cheap levels guide the expensive one.
//!
//! ```text
//! s_L(x) = f_1(x) + Σ_{k=2..L} δ_k(x),   δ_k(x_i) = f_k(x_i) − f_{k−1}(x_i) at every x_i flown at level k
//! ```
//!
//! Differential evolution over the whole box and simplices from its end, from the start and from random points minimise level 1,
//! which is cheap to search: globally with high probability, no more. Then each level in turn, up to the highest,
//! starts at the optimum of the one below: it is asked at that point and at a small step along each variable, which makes the
//! corrections δ interpolate its values and slopes, and a trust region moves to the minimum of `s_L`, for which level 1 alone is asked:
//!
//! ```text
//! ρ = (f_L(x) − f_L(x⁺)) / (s_L(x) − s_L(x⁺)):   x⁺ taken if better;   radius halved for ρ < ¼, doubled for ρ > ¾ at its edge
//! ```
//!
//! Additive corrections because the levels are one flight with more or fewer phenomena: their costs differ by little and smoothly, which
//! a ratio (it has no meaning at a zero cost) or a co-kriging (a statistical model of every cost over the whole box, hundreds of
//! points for six variables) do not use. A trust region because corrections hold nearby. The result is a local minimum
//! of the highest level in the valley that level 1 prefers, whatever the lower levels say: they steer, they don't decide.
//!
//! Sources: trust regions with corrections, Alexandrov et al. 2001, J. Aircraft 38(6); corrections by radial basis functions
//! instead of gradients, March and Willcox 2012, Struct. Multidiscip. Optim. 46; chains of levels, Le Gratiet and Garnier 2014.

mod correction;
mod ladder;
mod trust_region;

use crate::draws::Draws;
use crate::{
    Evolution, EvolutionSettings, Limits, NelderMead, RunError, SetupError, SimplexSettings, Space,
    StopReason, Variable, minimise,
};
use ladder::Ladder;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// The cost of a decision at one level.
pub type LevelCost<'a> = &'a dyn Fn(&[f64]) -> f64;

/// Stream of the random points; the evolution's count up from zero.
const RANDOM_STREAM: u64 = u64::MAX;
/// Most evaluations per variable of a simplex at the lowest level.
const SIMPLEX_CALLS: u64 = 300;

/// Settings of [`multi_fidelity`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MultiFidelitySettings {
    /// Most generations of the evolution at the lowest level; at least 1.
    pub generations: u32,
    /// Simplices from random points at the lowest level, beside those from the start and the evolution's end.
    pub searches: u32,
    /// First radius of the trust region, and length of the exploring steps, as a share of each width.
    pub radius: f64,
    /// A trust region smaller than this ends a level.
    pub least_radius: f64,
    /// A predicted gain of less than this share of the cost ends a level.
    pub gain: f64,
    /// Most calls at each level above the lowest while it is the one that is optimised; at least 1.
    pub calls: u64,
    /// Seed of the evolution and the random points.
    pub seed: u64,
}

/// Sixty generations and three searches, radii of 5 % to 0.1 % of the box, gains of 1e-4.
impl Default for MultiFidelitySettings {
    fn default() -> Self {
        Self {
            generations: 60,
            searches: 3,
            radius: 0.05,
            least_radius: 1e-3,
            gain: 1e-4,
            calls: 60,
            seed: 0,
        }
    }
}

/// The optimum of one level on the way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LevelOptimum {
    /// The level, 1 for the lowest.
    pub level: usize,
    /// The decision.
    pub values: Vec<f64>,
    /// Its cost at this level.
    pub cost: f64,
    /// Why the search at this level ended.
    pub stop: StopReason,
}

/// How far a multi-fidelity optimisation is, after each call above the lowest level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LevelProgress<'a> {
    /// The level that is optimised.
    pub level: usize,
    /// Calls of every level so far, the lowest first.
    pub calls: &'a [u64],
    /// The least cost at this level so far.
    pub best: f64,
}

/// What a multi-fidelity optimisation found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MultiFidelityReport {
    /// The optimum of each level, the lowest first; the last is the answer, unless interrupted before.
    pub optima: Vec<LevelOptimum>,
    /// Calls of every level, the lowest first.
    pub calls: Vec<u64>,
    /// Of them, those without a finite cost.
    pub failed: Vec<u64>,
    /// The least cost of the highest level after each of its calls.
    pub history: Vec<f64>,
    /// How long it took.
    pub elapsed: Duration,
}

impl MultiFidelityReport {
    /// The optimum of the highest level reached.
    pub fn best(&self) -> Option<&LevelOptimum> {
        self.optima.last()
    }
}

/// Why a multi-fidelity optimisation has no result.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MultiFidelityError {
    /// Nothing to guide, or nothing to be guided by.
    #[error("a multi-fidelity optimisation needs two levels or more, got {found}")]
    TooFewLevels {
        /// How many there are.
        found: usize,
    },
    /// Bad variables, start or settings.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The lowest level has no finite cost.
    #[error("at the lowest level: {0}")]
    LowestLevel(RunError),
    /// A level has no finite cost at the optimum of the one below.
    #[error(
        "level {level} has no finite cost at the optimum of the level below, {values:?}: check its cost function"
    )]
    Failed {
        /// The level.
        level: usize,
        /// The optimum of the level below.
        values: Vec<f64>,
    },
}

fn check(settings: &MultiFidelitySettings) -> Result<(), SetupError> {
    let s = settings;
    let radius = s.radius > 0.0 && s.radius <= 0.5;
    SetupError::unless(radius, "radius", s.radius, "above 0 and at most 0.5")?;
    let least = s.least_radius > 0.0 && s.least_radius <= s.radius;
    SetupError::unless(
        least,
        "least_radius",
        s.least_radius,
        "above 0 and at most the radius",
    )?;
    SetupError::unless(s.gain > 0.0 && s.gain < 1.0, "gain", s.gain, "between 0 and 1")?;
    SetupError::unless(
        s.generations >= 1,
        "generations",
        f64::from(s.generations),
        "at least 1",
    )?;
    SetupError::unless(s.calls >= 1, "calls", s.calls as f64, "at least 1")
}

/// Minimises the last of `costs`, guided by the others, the lowest level first.
///
/// A cost that is not finite counts as failed: such a point is left out of the corrections and never taken.
///
/// # Errors
/// Fewer than two levels; bad variables, start or settings; no finite cost where a level begins.
pub fn multi_fidelity(
    variables: Vec<Variable>,
    start: &[f64],
    costs: &[LevelCost<'_>],
    settings: &MultiFidelitySettings,
    observe: &mut dyn FnMut(&LevelProgress) -> ControlFlow<()>,
) -> Result<MultiFidelityReport, MultiFidelityError> {
    let began = Instant::now();
    if costs.len() < 2 {
        return Err(MultiFidelityError::TooFewLevels { found: costs.len() });
    }
    check(settings)?;
    let space = Space::new(variables)?;
    space.admit(start)?;
    let mut ladder = Ladder::new(space, costs, observe);
    let mut optima = vec![lowest(&mut ladder, start, settings)?];
    for level in 2..=costs.len() {
        let below = optima[level - 2].values.clone();
        let optimum = trust_region::optimum(&mut ladder, level, below, settings)?;
        let interrupted = optimum.stop == StopReason::Interrupted;
        optima.push(optimum);
        if interrupted {
            break;
        }
    }
    let (calls, failed) = ladder.counts();
    Ok(MultiFidelityReport {
        optima,
        calls,
        failed,
        history: ladder.history,
        elapsed: began.elapsed(),
    })
}

/// The optimum of the lowest level: the best end of simplices from the evolution's end, the start and random points.
fn lowest(
    ladder: &mut Ladder,
    start: &[f64],
    settings: &MultiFidelitySettings,
) -> Result<LevelOptimum, MultiFidelityError> {
    let failed = MultiFidelityError::LowestLevel;
    let cost = |x: &[f64]| ladder.lowest(x).unwrap_or(f64::NAN);
    let limits = Limits::evaluations(u64::MAX);
    // To 1 % of the cost: the simplex does the rest.
    let rough = EvolutionSettings {
        absolute: 0.0,
        generations: settings.generations,
        seed: settings.seed,
        ..EvolutionSettings::default()
    };
    let mut evolution = Evolution::new(ladder.variables(), rough)?;
    let evolved = minimise(&mut evolution, cost, limits).map_err(failed)?.best;
    // To a tenth of the smallest trust region.
    let simplex = SimplexSettings {
        spread: 0.1 * settings.least_radius,
        cost_spread: settings.gain * evolved.cost.abs(),
        restarts: 1,
        ..SimplexSettings::default()
    };
    let limits = Limits::evaluations(SIMPLEX_CALLS * start.len() as u64);
    let mut draws = Draws::new(settings.seed, RANDOM_STREAM);
    let mut shares = || start.iter().map(|_| draws.share()).collect::<Vec<f64>>();
    let points: Vec<_> = (0..settings.searches)
        .map(|_| ladder.space.at_shares(&shares()))
        .collect();
    let refine = |from: &[f64]| {
        let mut search = NelderMead::new(ladder.variables(), from, simplex)?;
        minimise(&mut search, cost, limits).map_err(failed)
    };
    let mut best = refine(&evolved.candidate.values)?;
    for from in std::iter::once(start.to_vec()).chain(points) {
        // A start where every cost fails is no reason to stop.
        if let Ok(other) = refine(&from)
            && other.best.cost < best.best.cost
        {
            best = other;
        }
    }
    Ok(LevelOptimum {
        level: 1,
        values: best.best.candidate.values,
        cost: best.best.cost,
        stop: best.stop,
    })
}
