//! The state of an optimisation on disk: what was flown, and the searches as they are.
//!
//! It has a check sum and is replaced atomically, so that a complete one exists at any time.

use super::problem::Problem;
use crate::disk;
use crate::exit::Failure;
use optim::{
    Annealing, AnnealingSettings, Evolution, EvolutionSettings, LineSearch, LineSearchSettings, NelderMead,
    Optimiser, SetupError, SimplexSettings, StopReason,
};
use quad_dynamics::Level;
use scenario::Algorithm;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Most bytes of a state: ten million flights.
const LONGEST_STATE: u64 = 1 << 30;

/// Everything that is known.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct State {
    /// Of the rest.
    check_sum: String,
    /// The question; another question is another state.
    fingerprint: String,
    /// One search per level.
    pub(super) courses: Vec<Course>,
}

/// The search at one level.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Course {
    /// The level; as the scenario has it where none.
    pub(super) level: Option<Level>,
    search: AnySearch,
    /// What was flown.
    pub(super) rows: Vec<Row>,
    /// Time that it took, s.
    pub(super) elapsed_s: f64,
    /// Why it ended, if it has.
    pub(super) stop: Option<StopReason>,
}

/// One flight.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Row {
    /// Number of the candidate.
    pub(super) candidate: u64,
    /// Values of the variables.
    pub(super) values: Vec<f64>,
    /// Cost; nothing if it could not be flown.
    pub(super) cost: Option<f64>,
    /// Why it failed, if it did.
    pub(super) failure: Option<String>,
}

/// A search of any kind.
#[derive(Debug, Serialize, Deserialize)]
enum AnySearch {
    NelderMead(NelderMead),
    LineSearch(LineSearch),
    Annealing(Annealing),
    Evolution(Evolution),
}

impl State {
    /// Nothing flown yet.
    pub(super) fn new(problem: &Problem) -> Result<Self, Failure> {
        let course = |level| {
            let search = AnySearch::new(problem)?;
            Ok(Course {
                level,
                search,
                rows: Vec::new(),
                elapsed_s: 0.0,
                stop: None,
            })
        };
        let courses: Result<Vec<Course>, SetupError> = problem.levels().into_iter().map(course).collect();
        Ok(Self {
            check_sum: String::new(),
            fingerprint: fingerprint(problem),
            courses: courses.map_err(|error| Failure::Usage(format!("optimise: {error}")))?,
        })
    }

    /// The state of this problem on disk.
    pub(super) fn read(path: &Path, problem: &Problem) -> Result<Self, Failure> {
        let text = disk::read_up_to(path, LONGEST_STATE)?;
        let refuse = |why: &str| Failure::Usage(format!("{}: not a saved search: {why}", path.display()));
        let state: Self = serde_json::from_str(&text).map_err(|error| refuse(&error.to_string()))?;
        if state.check_sum != state.sum().map_err(|error| refuse(&error.to_string()))? {
            return Err(refuse(
                "it is damaged (its check sum differs); start again with another --out",
            ));
        }
        if state.fingerprint != fingerprint(problem) {
            return Err(Failure::Usage(format!(
                "{} is of another scenario or vehicle: only `budget` may change before --resume",
                path.display()
            )));
        }
        Ok(state)
    }

    /// Writes it atomically.
    pub(super) fn write(&mut self, path: &Path) -> Result<(), Failure> {
        let refuse = |error: serde_json::Error| Failure::Write {
            path: path.to_owned(),
            source: error.into(),
        };
        self.check_sum = self.sum().map_err(refuse)?;
        disk::replace(path, serde_json::to_string(self).map_err(refuse)?)
    }

    /// The check sum of all but itself. Numbers come back from JSON bit for bit, so it is the same after reading.
    fn sum(&self) -> Result<String, serde_json::Error> {
        let all = serde_json::to_string(&(&self.fingerprint, &self.courses))?;
        Ok(output::checksum(all.as_bytes()))
    }
}

/// What makes this problem another than the next. A budget may grow.
fn fingerprint(problem: &Problem) -> String {
    let mut table = problem.template.table().clone();
    if let Some(toml::Value::Table(optimise)) = table.get_mut("optimise") {
        optimise.remove("budget");
    }
    format!("{table} {:?} of {}", problem.read, env!("CARGO_PKG_VERSION"))
}

impl Course {
    /// The search.
    pub(super) fn search(&mut self) -> &mut dyn Optimiser {
        match &mut self.search {
            AnySearch::NelderMead(search) => search,
            AnySearch::LineSearch(search) => search,
            AnySearch::Annealing(search) => search,
            AnySearch::Evolution(search) => search,
        }
    }

    /// Flights that failed.
    pub(super) fn failed(&self) -> usize {
        self.rows.iter().filter(|row| row.failure.is_some()).count()
    }

    /// The best flight that did not fail.
    pub(super) fn best(&self) -> Option<(&Row, f64)> {
        let sound = self.rows.iter().filter(|row| row.failure.is_none());
        let costs = sound.filter_map(|row| row.cost.filter(|c| c.is_finite()).map(|cost| (row, cost)));
        costs.min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.candidate.cmp(&b.0.candidate)))
    }
}

/// What the names of a level's files have in them; nothing where the level is the scenario's.
pub(super) fn label(level: Option<Level>) -> String {
    level.map_or_else(String::new, |level| format!("-level-{}", level.number()))
}

impl AnySearch {
    fn new(problem: &Problem) -> Result<Self, SetupError> {
        let (variables, start, seed) = (problem.variables.clone(), &problem.start, problem.file.seed);
        Ok(match problem.file.algorithm {
            Algorithm::NelderMead => {
                let settings = SimplexSettings {
                    // A cost of a few digits is what a flight is worth.
                    spread: 1e-4,
                    cost_spread: 1e-6,
                    ..SimplexSettings::default()
                };
                Self::NelderMead(NelderMead::new(variables, start, settings)?)
            }
            Algorithm::LineSearch => {
                let settings = LineSearchSettings {
                    spread: 1e-4,
                    gain: 1e-6,
                    ..LineSearchSettings::default()
                };
                Self::LineSearch(LineSearch::new(variables, start, settings)?)
            }
            Algorithm::Annealing => {
                let settings = AnnealingSettings {
                    seed,
                    ..AnnealingSettings::default()
                };
                Self::Annealing(Annealing::new(variables, start, settings)?)
            }
            Algorithm::Evolution => {
                let settings = EvolutionSettings {
                    seed,
                    ..EvolutionSettings::default()
                };
                Self::Evolution(Evolution::new(variables, settings)?)
            }
        })
    }
}
