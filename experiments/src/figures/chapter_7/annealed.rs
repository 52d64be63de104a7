//! Global minima at level 1 by simulated annealing, the last steps by a simplex (table 7.6).
//!
//! Annealing ends near the bottom of a valley; the simplex then goes down to it, so that minima can be compared. Run once per
//! process.

use super::optimisations::{Case, Effort, Found, searched};
use crate::item::ItemError;
use quad_dynamics::Level;
use serde::Serialize;
use std::sync::OnceLock;
use wpt_optim::Problem;
use wpt_optim::optimisers::{Annealing, AnnealingSettings, NelderMead, Report, SimplexSettings};

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

/// Annealing and the simplex after it.
pub(super) struct Minimum {
    /// The annealing, its start's cost.
    pub(super) walk: Found,
    /// The simplex from there.
    pub(super) polish: Report,
}

/// Settings of an annealing.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Settings {
    /// Of the walk.
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
        Effort::Quick => (0.6, 8, 1e-3, 1e-5),
    };
    Settings {
        annealing: AnnealingSettings {
            cooling,
            cycles,
            gain: 1e2 * cost_spread,
            seed: 7,
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
            Effort::Full => 8000,
            Effort::Quick => 2000,
        },
    }
}

/// The global minimum found. Run at the first call.
pub(super) fn minimum(global: Global, effort: Effort) -> Result<&'static Minimum, ItemError> {
    static MINIMA: [[OnceLock<Result<Minimum, String>>; 2]; 4] =
        [const { [const { OnceLock::new() }; 2] }; 4];
    let cell = &MINIMA[global as usize][effort as usize];
    let found = cell.get_or_init(|| anneal(global, effort).map_err(|error| error.to_string()));
    found.as_ref().map_err(|message| ItemError::new(message.clone()))
}

fn anneal(global: Global, effort: Effort) -> Result<Minimum, ItemError> {
    let problem = global.problem(effort)?;
    let (start, settings) = (problem.start(), settings(effort));
    let mut walk = Annealing::new(problem.variables(), &start, settings.annealing)?;
    let walk = Found {
        report: searched(&mut walk, &problem, settings.most_evaluations)?,
        start_cost: problem.evaluate(&start)?.cost,
        start,
    };
    let mut simplex = NelderMead::new(problem.variables(), walk.best(), settings.simplex)?;
    let polish = searched(&mut simplex, &problem, settings.most_evaluations)?;
    Ok(Minimum { walk, polish })
}
