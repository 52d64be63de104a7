//! Global minima at level 1 by simulated annealing, the last steps by a simplex (table 7.6).
//!
//! Annealing ends near the bottom of a valley; the simplex then goes down to it, so that minima can be compared. Several walks, each
//! with a seed of its own, because valleys differ by less than the cost of changing them; the best counts. Run once per process.

use super::optimisations::{Case, Effort, Found, Once, searched};
use crate::item::ItemError;
use optim::{Annealing, AnnealingSettings, NelderMead, Report, SimplexSettings};
use quad_dynamics::Level;
use serde::Serialize;
use std::sync::OnceLock;
use std::thread;
use wpt_optim::Problem;

/// The problems whose global minimum is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Global {
    /// Two variables, 10 s.
    TwoIn10,
    /// Two variables, 20 s.
    TwoIn20,
    /// Four variables, 20 s.
    Four,
    /// Six variables, 20 s.
    Six,
}

/// All walks of a problem together.
pub(super) struct Walks {
    /// Evaluations.
    pub(super) evaluations: u64,
    /// Time, s, added up.
    pub(super) time_s: f64,
    /// Where each ended.
    pub(super) costs: Vec<f64>,
}

/// Annealing and the simplex after it.
pub(super) struct Minimum {
    /// The annealing, its start's cost.
    pub(super) walk: Found,
    /// The simplex from there.
    pub(super) polish: Report,
    /// With the other walks.
    pub(super) all: Walks,
}

/// Settings of an annealing.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Settings {
    /// Seeds of the walks.
    pub(super) seeds: [u64; 3],
    /// Of each walk, but for the seed.
    pub(super) annealing: AnnealingSettings,
    /// Of what follows.
    pub(super) simplex: SimplexSettings,
    /// Most evaluations of each.
    pub(super) most_evaluations: u64,
}

impl Minimum {
    /// The decision found.
    pub(super) fn best(&self) -> &[f64] {
        &self.polish.best.candidate.values
    }

    /// What it costs.
    pub(super) fn cost(&self) -> f64 {
        self.polish.best.cost
    }

    fn evaluations(&self) -> u64 {
        self.all.evaluations
    }

    fn time_s(&self) -> f64 {
        self.all.time_s
    }
}

impl Global {
    /// All of them.
    pub(super) const ALL: [Self; 4] = [Self::TwoIn10, Self::TwoIn20, Self::Four, Self::Six];

    /// In words.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::TwoIn10 => "two, 10 s",
            Self::TwoIn20 => "two, 20 s",
            Self::Four => "four, 20 s",
            Self::Six => "six, 20 s",
        }
    }

    /// The local searches over the same variables and box.
    pub(super) fn local(self) -> &'static [Case] {
        match self {
            Self::TwoIn10 => &[Case::TwoIn10],
            Self::TwoIn20 => &[Case::TwoIn20],
            Self::Four => &[Case::Four, Case::FourMoving],
            Self::Six => &[Case::SixArbitrary, Case::SixNarrowed],
        }
    }

    /// The problem.
    pub(super) fn problem(self, effort: Effort) -> Result<Problem, ItemError> {
        self.local()[0].whole(Level::One, effort)
    }
}

/// The settings of every annealing.
pub(super) fn settings(effort: Effort) -> Settings {
    let (cooling, cycles, spread, cost_spread) = match effort {
        Effort::Full => (0.75, 10, 1e-5, 1e-8),
        Effort::Quick => (0.7, 8, 1e-3, 1e-5),
    };
    Settings {
        seeds: [1, 2, 3],
        annealing: AnnealingSettings {
            cooling,
            cycles,
            gain: 10.0 * cost_spread,
            ..AnnealingSettings::default()
        },
        simplex: SimplexSettings {
            step: 0.05,
            spread,
            cost_spread,
            restarts: 2,
            ..SimplexSettings::default()
        },
        most_evaluations: match effort {
            Effort::Full => 6000,
            Effort::Quick => 2500,
        },
    }
}

/// The global minimum found. Run at the first call.
pub(super) fn minimum(global: Global, effort: Effort) -> Result<&'static Minimum, ItemError> {
    static MINIMA: [[Once<Minimum>; 2]; 4] = [const { [const { OnceLock::new() }; 2] }; 4];
    let cell = &MINIMA[global as usize][effort as usize];
    let found = cell.get_or_init(|| anneal(global, effort).map_err(|error| error.to_string()));
    found.as_ref().map_err(|message| ItemError::new(message.clone()))
}

/// The best of all walks, with the evaluations and the time of all of them.
fn anneal(global: Global, effort: Effort) -> Result<Minimum, ItemError> {
    let walks: Vec<Minimum> = thread::scope(|scope| {
        let walks = settings(effort)
            .seeds
            .map(|seed| scope.spawn(move || walk(global, effort, seed)));
        let join = |walk: thread::ScopedJoinHandle<'_, _>| {
            walk.join()
                .unwrap_or_else(|_| Err(ItemError::new("a walk panicked")))
        };
        walks.into_iter().map(join).collect::<Result<_, _>>()
    })?;
    let evaluations = walks.iter().map(Minimum::evaluations).sum();
    let time_s = walks.iter().map(Minimum::time_s).sum();
    let costs = walks.iter().map(Minimum::cost).collect();
    let best = walks.into_iter().min_by(|a, b| a.cost().total_cmp(&b.cost()));
    let best = best.ok_or_else(|| ItemError::new("no walk was made"))?;
    Ok(Minimum {
        all: Walks {
            evaluations,
            time_s,
            costs,
        },
        ..best
    })
}

fn walk(global: Global, effort: Effort, seed: u64) -> Result<Minimum, ItemError> {
    let problem = global.problem(effort)?;
    let (start, settings) = (problem.start(), settings(effort));
    let annealing = AnnealingSettings {
        seed,
        ..settings.annealing
    };
    let mut walk = Annealing::new(problem.variables(), &start, annealing)?;
    let walk = Found {
        report: searched(&mut walk, &problem, settings.most_evaluations)?,
        start_cost: problem.evaluate(&start)?.cost,
        start,
    };
    let mut simplex = NelderMead::new(problem.variables(), walk.best(), settings.simplex)?;
    let polish = searched(&mut simplex, &problem, settings.most_evaluations)?;
    let evaluations = walk.report.evaluations + polish.evaluations;
    let time_s = (walk.report.elapsed + polish.elapsed).as_secs_f64();
    let costs = vec![polish.best.cost];
    Ok(Minimum {
        walk,
        polish,
        all: Walks {
            evaluations,
            time_s,
            costs,
        },
    })
}
