//! What a decision costs: the scenario with the variables' values in it, flown by the engine.

use crate::disk::{Beside, Remembering};
use crate::exit::Failure;
use crate::{interrupt, model, varied};
use optim::{Space, Variable};
use quad_dynamics::Level;
use scenario::{
    End, Keep, KeyError, OptimiseFile, Outcome, Pair, Scenario, ScenarioError, Setting, Template,
};
use sifre::Recording;
use std::collections::BTreeMap;
use std::path::Path;

/// The scenario, what is decided on, and what it is judged by.
pub(super) struct Problem {
    pub(super) template: Template,
    pub(super) file: OptimiseFile,
    pub(super) variables: Vec<Variable>,
    pub(super) start: Vec<f64>,
    /// The files that the scenario names, and their contents.
    pub(super) read: BTreeMap<String, String>,
    files: Beside,
    pair: Pair,
}

/// A flight that was judged.
pub(super) struct Flown {
    /// Its cost; nothing if it could not be flown.
    pub(super) outcome: Option<Outcome>,
    /// Why it failed, if it did.
    pub(super) failure: Option<String>,
    /// Its recording, if requested.
    pub(super) recording: Option<Recording>,
}

impl Problem {
    /// Reads the problem of a scenario; every error is reported here, before anything is flown.
    pub(super) fn read(path: &Path, settings: &[Setting]) -> Result<Self, Failure> {
        let template = varied::read(path)?.set(settings)?;
        let scenario = template.scenario();
        let file = scenario.optimise.clone().ok_or_else(|| {
            Failure::Usage(format!(
                "{}: the table [optimise] is missing; `sifre new --from optimise-transmission` prints an example",
                path.display()
            ))
        })?;
        let pair = scenario.optimised_pair()?;
        let variable = |v: &scenario::VariableFile| Variable {
            name: v.key.clone(),
            // Units stand in the keys.
            unit: String::new(),
            lower: v.lower,
            upper: v.upper,
        };
        let mut problem = Self {
            read: BTreeMap::new(),
            variables: file.variables.iter().map(variable).collect(),
            start: starts(&template, &file)?,
            files: Beside::of(path),
            template,
            file,
            pair,
        };
        // Names, bounds and starts are the optimisers' to check; a key that doesn't exist shows when the start is built.
        let space = Space::new(problem.variables.clone());
        space
            .and_then(|space| space.admit(&problem.start))
            .map_err(|error| Failure::Usage(format!("optimise.variables: {error}")))?;
        let first = problem.levels().first().copied().flatten();
        let scenario = problem.scenario(&problem.start, first)?;
        let files = Remembering::of(&problem.files);
        scenario.build(&files)?.start()?;
        problem.read = files.read.into_inner();
        Ok(problem)
    }

    /// The levels to optimise at; one that is none stands for those that the scenario has.
    pub(super) fn levels(&self) -> Vec<Option<Level>> {
        if self.file.levels.is_empty() {
            return vec![None];
        }
        self.file.levels.iter().copied().map(Some).collect()
    }

    /// Whose cost counts.
    pub(super) fn pair(&self) -> &Pair {
        &self.pair
    }

    /// The keys of a decision.
    pub(super) fn settings(&self, x: &[f64]) -> Vec<Setting> {
        let pairs = self.variables.iter().zip(x);
        let setting = |(variable, value): (&Variable, &f64)| Setting::new(&variable.name, *value);
        pairs.map(setting).collect()
    }

    fn scenario(&self, x: &[f64], level: Option<Level>) -> Result<Scenario, Failure> {
        let scenario = self
            .template
            .with(&self.settings(x))
            .map_err(|error| match error {
                ScenarioError::Key(error) => refused_key(&error),
                other => other.into(),
            })?;
        Ok(match level {
            Some(level) => model::at(&scenario, level, None, &model::laws(&scenario, level, false)),
            None => scenario,
        })
    }

    /// Flies a decision; nothing if it was interrupted. One that can't be flown has no cost, one that fails on its way a finite one.
    pub(super) fn fly(&self, x: &[f64], level: Option<Level>, keep: Keep) -> Option<Flown> {
        self.judged(x, level, keep).unwrap_or_else(|failure| {
            Some(Flown {
                outcome: None,
                failure: Some(failure.to_string()),
                recording: None,
            })
        })
    }

    fn judged(&self, x: &[f64], level: Option<Level>, keep: Keep) -> Result<Option<Flown>, Failure> {
        let mut flown = interrupt::fly(&self.scenario(x, level)?, &self.files, &keep)?;
        if flown.ending.end == End::Interrupted {
            return Ok(None);
        }
        let place = flown.costs.iter().position(|cost| cost.pair == self.pair);
        let cost = place.map(|place| flown.costs.swap_remove(place));
        let is_complete = cost.as_ref().is_some_and(|cost| cost.is_complete);
        Ok(Some(Flown {
            outcome: cost.map(|cost| cost.outcome),
            failure: (!is_complete).then(|| match flown.ending.end {
                End::Done => "beyond all limits".to_owned(),
                _ => flown.ending.to_string(),
            }),
            recording: keep.rows.map(|_| flown.recording),
        }))
    }
}

/// Where the search begins.
fn starts(template: &Template, file: &OptimiseFile) -> Result<Vec<f64>, Failure> {
    let start = |v: &scenario::VariableFile| {
        if let Some(start) = v.start {
            return Ok(start);
        }
        let value = template.get(&v.key);
        let number = value.and_then(|value| value.as_float().or(value.as_integer().map(|n| n as f64)));
        number.ok_or_else(|| {
            refused(
                &v.key,
                "the scenario has no number at this key to start from: check the key, or give `start`",
            )
        })
    };
    file.variables.iter().map(start).collect()
}

fn refused_key(error: &KeyError) -> Failure {
    Failure::Usage(format!("optimise.variables: {error}"))
}

fn refused(key: &str, why: &str) -> Failure {
    Failure::Usage(format!("optimise.variables: `{key}`: {why}"))
}
