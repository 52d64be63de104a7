//! The trajectory optimisations of the chapter: which variables from where, by which method; each run once per process.
//!
//! The levels of a case run side by side on threads of their own, so that items which wait for the same case never hold up the
//! threads that work on it. Results depend neither on the number of threads nor on who asks first.

use super::annealed;
use crate::item::ItemError;
use optim::{
    Limits, LineSearch, LineSearchSettings, NelderMead, Optimiser, Report, RunError, SimplexSettings,
    minimise,
};
use quad_dynamics::Level;
use serde::Serialize;
use sifre::StepSize;
use std::sync::OnceLock;
use std::thread;
use wpt_optim::{Choice, Decision, Objective, Problem};

/// Made at the first call, for each effort; an error as its words, because errors can't be copied.
pub(super) type Once<T> = OnceLock<Result<T, String>>;

/// An optimisation of the chapter, at all levels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Case {
    /// Two variables, 10 s.
    TwoIn10,
    /// Two variables, 20 s.
    TwoIn20,
    /// Four variables from rest.
    Four,
    /// Four variables from another start.
    FourMoving,
    /// Six variables, the whole box.
    SixArbitrary,
    /// Six variables, a box about level 1's global minimum.
    SixNarrowed,
}

/// How much is spent: the study's runs, or short ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Effort {
    /// Declared steps, tight tolerances.
    Full,
    /// Steps of 4 ms, loose tolerances, smaller budgets.
    Quick,
}

/// What a case searches with.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Method {
    /// Nelder and Mead's simplex.
    Simplex(SimplexSettings),
    /// A line search along one variable after the other.
    LineSearch(LineSearchSettings),
}

/// The settings of a case, as they are written beside its figures.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Settings {
    duration_s: f64,
    step_s: f64,
    station_step_s: f64,
    most_evaluations: u64,
    method: Method,
    starts: Vec<Vec<f64>>,
    variables: Vec<Decision>,
}

/// One search from one start.
pub(super) struct Found {
    /// Where it started.
    pub(super) start: Vec<f64>,
    /// What that costs.
    pub(super) start_cost: f64,
    /// What it found.
    pub(super) report: Report,
}

/// A level's searches: the first is the study's, others show further minima.
pub(super) struct Solved {
    /// The problem.
    pub(super) problem: Problem,
    /// The searches.
    pub(super) searches: Vec<Found>,
}

/// Step of vehicle and station in short runs.
pub(super) const QUICK_STEP: StepSize = StepSize::MILLISECOND.times(4);
/// Evaluations after which a search is given up: more than any should need.
const MOST_EVALUATIONS: u64 = 1500;
/// Share of each variable's width that the narrowed box keeps: *choice*.
const NARROWED: f64 = 0.25;

impl Effort {
    /// Of a run that is or isn't quick.
    pub(super) fn of(quick: bool) -> Self {
        if quick { Self::Quick } else { Self::Full }
    }
}

impl Solved {
    /// The study's search.
    pub(super) fn first(&self) -> &Found {
        &self.searches[0]
    }
}

impl Found {
    /// The decision found.
    pub(super) fn best(&self) -> &[f64] {
        &self.report.best.candidate.values
    }

    /// What it costs.
    pub(super) fn cost(&self) -> f64 {
        self.report.best.cost
    }
}

/// The side of the station on which the vehicle crosses the plane y = 0, half-way: the basin of a decision.
pub(super) fn basin(problem: &Problem, x: &[f64]) -> Result<&'static str, ItemError> {
    let middle = 0.5 * problem.mission().duration_s;
    let crossing = problem.path_of(x)?.leg.flat_output(middle).position.x;
    Ok(if crossing >= 0.0 { "north" } else { "south" })
}

impl Case {
    fn choice(self) -> Choice {
        match self {
            Self::TwoIn10 | Self::TwoIn20 => Choice::Two,
            Self::Four => Choice::Four,
            Self::FourMoving => Choice::FourMoving,
            Self::SixArbitrary | Self::SixNarrowed => Choice::Six,
        }
    }

    /// Duration of the crossing, s.
    pub(super) fn duration_s(self) -> f64 {
        match self {
            Self::TwoIn10 => 10.0,
            _ => 20.0,
        }
    }

    /// The problem at a level over the whole box.
    pub(super) fn whole(self, level: Level, effort: Effort) -> Result<Problem, ItemError> {
        let nominal = Problem::nominal(self.choice(), self.duration_s(), level)?;
        if effort == Effort::Full {
            return Ok(nominal);
        }
        stepped(&nominal, QUICK_STEP)
    }

    /// The problem at a level.
    pub(super) fn problem(self, level: Level, effort: Effort) -> Result<Problem, ItemError> {
        let whole = self.whole(level, effort)?;
        if self != Self::SixNarrowed {
            return Ok(whole);
        }
        let centre = annealed::minimum(annealed::Global::Six, effort)?.best();
        let narrowed = whole.decisions().iter().zip(centre).map(|(d, &start)| {
            let half = 0.5 * NARROWED * (d.upper - d.lower);
            Decision {
                lower: d.lower.max(start - half),
                upper: d.upper.min(start + half),
                start,
                ..*d
            }
        });
        Ok(whole.deciding(narrowed.collect())?)
    }

    /// Starts of the searches: the study's first; two variables from further corners, too.
    fn starts(self, problem: &Problem) -> Vec<Vec<f64>> {
        let mut starts = vec![problem.start()];
        if self.choice() == Choice::Two {
            starts.extend([vec![-5.0, -5.0], vec![5.0, -5.0]]);
        }
        starts
    }

    fn method(self, effort: Effort) -> Method {
        let (spread, cost_spread, scan) = match effort {
            Effort::Full => (1e-4, 1e-6, 11),
            Effort::Quick => (2e-3, 1e-4, 7),
        };
        match self {
            Self::SixArbitrary | Self::SixNarrowed => Method::LineSearch(LineSearchSettings {
                scan,
                spread: 10.0 * spread,
                gain: 10.0 * cost_spread,
                sweeps: 6,
                rounds: 1,
                ..LineSearchSettings::default()
            }),
            _ => Method::Simplex(SimplexSettings {
                spread,
                cost_spread,
                ..SimplexSettings::default()
            }),
        }
    }

    /// Gain of cost below which the case's method calls itself done.
    pub(super) fn gain(self, effort: Effort) -> f64 {
        match self.method(effort) {
            Method::Simplex(settings) => settings.cost_spread,
            Method::LineSearch(settings) => settings.gain,
        }
    }

    /// The settings, for the files beside the figures.
    pub(super) fn settings(self, effort: Effort) -> Result<Settings, ItemError> {
        let problem = self.problem(Level::One, effort)?;
        let mission = problem.mission();
        Ok(Settings {
            duration_s: mission.duration_s,
            step_s: mission.step.seconds(),
            station_step_s: mission.station_step.seconds(),
            most_evaluations: MOST_EVALUATIONS,
            method: self.method(effort),
            starts: self.starts(&problem),
            variables: problem.decisions().to_vec(),
        })
    }

    /// The searches of every level, level 1 first. Run at the first call.
    pub(super) fn solved(self, effort: Effort) -> Result<&'static [Solved], ItemError> {
        static SOLVED: [[Once<Vec<Solved>>; 2]; 6] = [const { [const { OnceLock::new() }; 2] }; 6];
        let solved = SOLVED[self as usize][effort as usize].get_or_init(|| {
            thread::scope(|scope| {
                let levels = Level::ALL.map(|level| scope.spawn(move || self.solve(level, effort)));
                let joined = levels.into_iter().map(|thread| match thread.join() {
                    Ok(solved) => solved.map_err(|error| error.to_string()),
                    Err(_) => Err("a search panicked".to_owned()),
                });
                joined.collect()
            })
        });
        match solved {
            Ok(solved) => Ok(solved),
            Err(message) => Err(ItemError::new(message.clone())),
        }
    }

    fn solve(self, level: Level, effort: Effort) -> Result<Solved, ItemError> {
        let problem = self.problem(level, effort)?;
        let mut searches = Vec::new();
        for start in self.starts(&problem) {
            let report = self.search(&problem, &start, effort)?;
            let start_cost = problem.evaluate(&start)?.cost;
            searches.push(Found {
                start,
                start_cost,
                report,
            });
        }
        Ok(Solved { problem, searches })
    }

    fn search(self, problem: &Problem, start: &[f64], effort: Effort) -> Result<Report, ItemError> {
        let variables = problem.variables();
        Ok(match self.method(effort) {
            Method::Simplex(settings) => searched(
                &mut NelderMead::new(variables, start, settings)?,
                problem,
                MOST_EVALUATIONS,
            )?,
            Method::LineSearch(settings) => searched(
                &mut LineSearch::new(variables, start, settings)?,
                problem,
                MOST_EVALUATIONS,
            )?,
        })
    }
}

/// The same problem with another step of vehicle and station.
pub(super) fn stepped(problem: &Problem, step: StepSize) -> Result<Problem, ItemError> {
    let mut mission = problem.mission().clone();
    (mission.step, mission.station_step) = (step, step);
    let decisions = problem.decisions().to_vec();
    Ok(Problem::new(
        mission,
        problem.level(),
        decisions,
        &Default::default(),
        &Default::default(),
    )?)
}

/// Runs a search on a problem's cost.
pub(super) fn searched(
    search: &mut impl Optimiser,
    problem: &Problem,
    most: u64,
) -> Result<Report, RunError> {
    let objective = Objective::new(problem);
    minimise(search, |x: &[f64]| objective.cost(x), Limits::evaluations(most))
}
