//! What a decision costs: the scenario with the variables' values in it, flown by the engine.

use crate::disk::{Beside, Remembering};
use crate::exit::Failure;
use crate::varied::{Setting, Template};
use crate::{interrupt, model};
use optim::{Space, Variable};
use quad_dynamics::Level;
use scenario::{AgentKind, Built, End, OptimiseFile, Scenario};
use sifre::black_box::MemoryBox;
use sifre::{Recording, StepSize};
use std::collections::BTreeMap;
use std::path::Path;
use toml::Value;
use wpt_optim::{CostBox, Outcome, Pair, Penalties, Span, Weights};

/// The scenario, what is decided on, and what it is judged by.
pub(super) struct Problem {
    pub(super) template: Template,
    pub(super) file: OptimiseFile,
    pub(super) variables: Vec<Variable>,
    pub(super) start: Vec<f64>,
    /// The files that the scenario names, and what stands in them.
    pub(super) read: BTreeMap<String, String>,
    files: Beside,
    pair: Pair,
    step: StepSize,
}

/// A flight that was judged.
pub(super) struct Flown {
    /// Its cost; nothing if it could not be flown.
    pub(super) outcome: Option<Outcome>,
    /// Why it failed, if it did.
    pub(super) failure: Option<String>,
    /// Its recording, where one was asked for.
    pub(super) recording: Option<Recording>,
}

/// Whether a flight is kept.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Keep {
    Nothing,
    Recording,
}

impl Problem {
    /// Reads the problem of a scenario; all that can be wrong is told here, before anything is flown.
    pub(super) fn read(path: &Path, settings: &[Setting]) -> Result<Self, Failure> {
        let template = Template::read(path)?.set(settings)?;
        let scenario = template.with([])?;
        let file = scenario.optimise.clone().ok_or_else(|| {
            Failure::Usage(format!(
                "{}: there is no table [optimise]; `sifre new --from optimise-transmission` has one",
                path.display()
            ))
        })?;
        let (pair, step) = pair(&scenario, &file)?;
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
            step,
        };
        // Names, bounds and starts are the optimisers' to check; a key that doesn't exist shows when the start is built.
        let space = Space::new(problem.variables.clone());
        space
            .and_then(|space| space.admit(&problem.start))
            .map_err(|error| Failure::Usage(format!("optimise.variables: {error}")))?;
        let first = problem.levels().first().copied().flatten();
        let scenario = problem.scenario(&problem.start, first)?;
        let files = Remembering::of(&problem.files);
        let built = scenario.build(&files)?;
        let read = files.read.into_inner();
        problem.cost(&built)?;
        built.fly()?;
        problem.read = read;
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
        let setting = |(variable, value): (&Variable, &f64)| Setting {
            key: variable.name.clone(),
            value: Value::Float(*value),
        };
        pairs.map(setting).collect()
    }

    fn scenario(&self, x: &[f64], level: Option<Level>) -> Result<Scenario, Failure> {
        let scenario = self
            .template
            .with(&self.settings(x))
            .map_err(|error| match error {
                Failure::Key(error) => Failure::Usage(format!("optimise.variables: {error}")),
                other => other,
            })?;
        Ok(match level {
            Some(level) => model::at(&scenario, level, None, &model::laws(&scenario, level, false)),
            None => scenario,
        })
    }

    fn cost(&self, built: &Built) -> Result<CostBox, Failure> {
        let kind = |name: &str| built.agents.iter().find(|a| a.name == name).map(|a| &a.kind);
        let (Some(AgentKind::Ets { station, .. }), Some(AgentKind::Quadrotor { vehicle, .. })) =
            (kind(&self.pair.station), kind(&self.pair.quadrotor))
        else {
            return Err(Failure::Usage(format!(
                "optimise: \"{}\" is no station or \"{}\" no quadrotor of the scenario",
                self.pair.station, self.pair.quadrotor
            )));
        };
        let (mut station, limits) = (station.as_ref().clone(), &self.file.limits);
        station.limits.range = limits.range_m.unwrap_or(station.limits.range);
        let incidence = limits.incidence_deg.map(f64::to_radians);
        station.limits.incidence = incidence.unwrap_or(station.limits.incidence);
        station.limits.spot = limits.spot_m.unwrap_or(station.limits.spot);
        let (w, weights, penalties) = (&self.file.weights, Weights::default(), Penalties::default());
        let weights = Weights {
            range: w.range.unwrap_or(weights.range),
            incidence: w.incidence.unwrap_or(weights.incidence),
            spot: w.spot.unwrap_or(weights.spot),
        };
        let penalties = Penalties {
            lost_target: w.lost_target.unwrap_or(penalties.lost_target),
            overfill: w.overfill.unwrap_or(penalties.overfill),
            ground: w.ground.unwrap_or(penalties.ground),
            saturation: w.saturation.unwrap_or(penalties.saturation),
            least_height_m: limits.least_height_m.unwrap_or(penalties.least_height_m),
        };
        CostBox::new(self.pair.clone(), &station, vehicle, &weights, &penalties)
            .map_err(|error| Failure::Usage(format!("optimise: {error}")))
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
        let scenario = self.scenario(x, level)?;
        let built = scenario.build(&self.files)?;
        let cost = self.cost(&built)?;
        let mut flight = built.fly()?;
        let id = flight.simulation.attach(self.step, cost)?;
        let rows = match keep {
            Keep::Nothing => None,
            Keep::Recording => {
                let step = flight.output.step_s;
                Some(flight.simulation.attach(step, MemoryBox::default())?)
            }
        };
        let ending = flight.run(&mut interrupt::watch())?;
        if ending.end == End::Interrupted {
            return Ok(None);
        }
        let cost = flight.simulation.detach::<CostBox>(id).and_then(Result::ok);
        let is_whole = ending.end == End::Done && cost.as_ref().is_some_and(|cost| !cost.has_failed());
        let span = if is_whole {
            Span::Recorded
        } else {
            Span::Planned(scenario.duration_s)
        };
        let rows = rows.and_then(|id| flight.simulation.detach::<MemoryBox>(id)?.ok());
        let report = &ending.report;
        Ok(Some(Flown {
            outcome: cost.map(|cost| cost.outcome(span)),
            failure: (!is_whole).then(|| match ending.end {
                End::Done => "beyond all limits".to_owned(),
                _ => format!("{} at {} s", report.status, report.time_s),
            }),
            recording: rows.map(|memory| memory.recording),
        }))
    }
}

/// Whose cost counts, and the station's step.
fn pair(scenario: &Scenario, file: &OptimiseFile) -> Result<(Pair, StepSize), Failure> {
    let names: Vec<&str> = scenario.ets.iter().map(|ets| ets.name.as_str()).collect();
    let wanted = file.station.as_deref();
    let station = match (wanted, &scenario.ets[..]) {
        (None, [only]) => Some(only),
        (None, _) => None,
        (Some(name), all) => all.iter().find(|ets| ets.name == name),
    };
    let station = station.ok_or_else(|| {
        Failure::Usage(format!(
            "optimise.station = \"{}\": the cost is that of a station of the scenario, which has {}",
            wanted.unwrap_or_default(),
            if names.is_empty() {
                "none".to_owned()
            } else {
                names.join(", ")
            }
        ))
    })?;
    let quadrotor = file.quadrotor.clone().unwrap_or_else(|| station.tracks.clone());
    let pair = Pair {
        quadrotor,
        station: station.name.clone(),
    };
    Ok((pair, station.step_s))
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
                "the scenario has no number there to start from: check the key, or give `start`",
            )
        })
    };
    file.variables.iter().map(start).collect()
}

fn refused(key: &str, why: &str) -> Failure {
    Failure::Usage(format!("optimise.variables: `{key}`: {why}"))
}
