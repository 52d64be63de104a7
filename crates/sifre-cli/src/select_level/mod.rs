//! `sifre select-level`: which level of resolution is enough for what is asked.
//!
//! The scenario is flown at all levels, in every case; [`study::selection`] compares the numbers with the highest level's. The price of
//! a level is its computing time per simulated second, the least of some repeats, the mean over the cases.

mod output;

use crate::attribute::{self, Question};
use crate::disk::{self, Beside};
use crate::exit::{Exit, Failure};
use crate::sweep::axes::{self, Axis};
use crate::varied;
use crate::{drawing, interrupt, model, report};
use quad_dynamics::Level;
use scenario::{End, Keep, Scenario, Setting};
use std::path::PathBuf;
use study::selection::{Answer, Selection, SelectionError, Tolerance, select};

/// How it is used, as `--help` shows it.
const EXAMPLE: &str = "\
Example: which level knows the position error to a centimetre, and what do those below lack?
  sifre select-level scenarios/horizontal-step.toml --metric position_error_rms_m --tolerance 0.01 --why";

/// Arguments of `sifre select-level`.
///
/// A level agrees if in every case its number is within tolerance + relative · |level 5's number| of level 5's.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Arguments {
    /// Scenario file.
    scenario: PathBuf,
    /// Metric to compare, as `sifre run` prints it: `alpha.position_error_rms_m`, step metrics (`alpha.z.overshoot`) or a
    /// station's cost (`station.phi`). The agent's name may be omitted if only one agent has the metric. May be repeated.
    #[arg(long = "metric", required = true)]
    metrics: Vec<String>,
    /// Allowed difference from level 5, in the metric's unit.
    #[arg(long, required_unless_present = "relative", default_value_t = 0.0)]
    tolerance: f64,
    /// Allowed difference from level 5, as a fraction of its value; added to --tolerance.
    #[arg(long, default_value_t = 0.0)]
    relative: f64,
    /// Values of a key, each a case that must agree: `--set quadrotor.alpha.wind.velocity_m_s=[0,0,0],[-5,0,0]`. May be
    /// repeated; all combinations are cases.
    #[arg(long = "set", value_name = "KEY=A,B,C", value_parser = axes::set)]
    sets: Vec<Axis>,
    /// Number of timings of each flight; the shortest counts.
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..))]
    repeats: u32,
    /// Also name the phenomenon that the next level down is missing.
    #[arg(long)]
    why: bool,
    /// Plot to this file, .svg or .png.
    #[arg(long, short)]
    plot: Option<PathBuf>,
    /// Keep the scenario's controllers where they can fly the level, instead of using the inversion of each level.
    #[arg(long)]
    keep_controllers: bool,
}

/// Most cases: each is flown at five levels before there is an answer.
const MOST_CASES: u64 = 10_000;

/// A number that is asked for, in one case.
#[derive(Clone, Debug)]
pub(crate) struct Case {
    pub(crate) metric: String,
    pub(crate) settings: Vec<Setting>,
}

/// A level's answers, and how its flights ended where they didn't come to their end.
struct Flown {
    answer: Answer,
    ends: Vec<Option<String>>,
}

/// All that is known in the end.
pub(crate) struct Evidence {
    pub(crate) cases: Vec<Case>,
    pub(crate) selection: Selection,
    pub(crate) tolerance: Tolerance,
    /// Per level and case: how a flight ended that did not finish.
    pub(crate) ends: Vec<Vec<Option<String>>>,
    /// The command that names the decisive phenomenon; nothing where level 1 is enough.
    pub(crate) hint: Option<String>,
    /// What it would report.
    pub(crate) why: Option<attribute::Pair>,
    /// The metric that it is about.
    pub(crate) why_metric: String,
}

/// Selects a level.
pub(crate) fn run(arguments: &Arguments, json: bool) -> Result<Exit, Failure> {
    let template = varied::read(&arguments.scenario)?;
    let sizes = arguments.sets.iter().map(|axis| axis.values.len() as u64);
    let cases = sizes
        .chain([arguments.metrics.len() as u64])
        .try_fold(1, u64::checked_mul);
    if cases.is_none_or(|cases| cases > MOST_CASES) {
        return Err(Failure::Usage(format!(
            "--set and --metric must give at most {MOST_CASES} cases: split the comparison"
        )));
    }
    let points = grid(&arguments.sets);
    let scenarios: Vec<Scenario> = points
        .iter()
        .map(|settings| template.with(settings))
        .collect::<Result<_, _>>()?;
    for scenario in &scenarios {
        model::check(scenario)?;
    }
    let inputs: Vec<PathBuf> = scenarios
        .iter()
        .flat_map(|scenario| disk::inputs(&arguments.scenario, scenario))
        .collect();
    drawing::check(arguments.plot.as_deref(), &inputs)?;
    let tolerance = Tolerance {
        absolute: arguments.tolerance,
        relative: arguments.relative,
    };
    check(tolerance)?;
    interrupt::listen();
    let mut flown = Vec::new();
    for level in Level::ALL {
        match fly(arguments, &scenarios, level)? {
            Some(one) => flown.push(one),
            None => return Ok(Exit::Interrupted),
        }
    }
    let answers: Vec<Answer> = flown.iter().map(|one| one.answer.clone()).collect();
    let ends: Vec<_> = flown.into_iter().map(|one| one.ends).collect();
    let cases: Vec<Case> = points
        .iter()
        .flat_map(|settings| {
            arguments.metrics.iter().map(|metric| Case {
                metric: metric.clone(),
                settings: settings.clone(),
            })
        })
        .collect();
    let selection = select(&answers, tolerance).map_err(|error| refused(&error, &cases, &ends))?;
    let evidence = explained(arguments, &scenarios, cases, selection, tolerance, ends)?;
    let Some(evidence) = evidence else {
        return Ok(Exit::Interrupted);
    };
    if let Some(path) = &arguments.plot {
        drawing::write(path, &output::figure(&evidence))?;
    }
    if json {
        report::print(&output::json(&evidence))?;
    } else {
        report::say(output::text(&evidence))?;
        if let Some(path) = &arguments.plot {
            report::say(format!("drawn: {}\n", path.display()))?;
        }
    }
    Ok(Exit::Done)
}

/// Every combination of the values; a single one without settings if no key varies. The last key runs fastest.
fn grid(axes: &[Axis]) -> Vec<Vec<Setting>> {
    axes.iter()
        .fold(vec![Vec::new()], |points: Vec<Vec<Setting>>, axis| {
            let longer = |point: &Vec<Setting>| {
                let point = point.clone();
                (0..axis.values.len()).map(move |k| [point.clone(), vec![axis.setting(k)]].concat())
            };
            points.iter().flat_map(longer).collect()
        })
}

/// An invalid tolerance is reported before anything is flown.
fn check(tolerance: Tolerance) -> Result<(), Failure> {
    let reference = Answer {
        level: Level::HIGHEST,
        values: vec![0.0],
        price: 0.0,
    };
    select(&[reference], tolerance)
        .map(drop)
        .map_err(|error| Failure::Usage(error.to_string()))
}

/// A reference level without a value has ended early; nothing else is possible, since levels and cases are ours.
fn refused(error: &SelectionError, cases: &[Case], ends: &[Vec<Option<String>>]) -> Failure {
    let SelectionError::BadReference { case, .. } = error else {
        return Failure::Usage(error.to_string());
    };
    let metric = cases.get(*case).map_or("", |case| case.metric.as_str());
    let end = ends.last().and_then(|ends| ends.get(*case).cloned().flatten());
    Failure::Flight(format!(
        "{} has no {metric} to compare with: {}",
        Level::HIGHEST,
        end.unwrap_or_else(|| "it never settles".to_owned())
    ))
}

/// Flies all cases at a level; nothing if it was interrupted.
fn fly(arguments: &Arguments, scenarios: &[Scenario], level: Level) -> Result<Option<Flown>, Failure> {
    let files = Beside::of(&arguments.scenario);
    let (mut values, mut ends, mut price) = (Vec::new(), Vec::new(), 0.0);
    for scenario in scenarios {
        let laws = model::laws(scenario, level, arguments.keep_controllers);
        let scenario = model::at(scenario, level, None, &laws);
        let flown = interrupt::fly(&scenario, &files, &Keep::METRICS)?;
        if flown.ending.end == End::Interrupted {
            return Ok(None);
        }
        for metric in &arguments.metrics {
            values.push(flown.metric(metric)?);
            ends.push((flown.ending.end != End::Done).then(|| flown.ending.to_string()));
        }
        let mut least = f64::INFINITY;
        for _ in 0..arguments.repeats {
            let flown = interrupt::fly(&scenario, &files, &Keep::NOTHING)?;
            if flown.ending.end == End::Interrupted {
                return Ok(None);
            }
            least = least.min(price_of(&flown));
        }
        price += least / scenarios.len() as f64;
    }
    let answer = Answer { level, values, price };
    Ok(Some(Flown { answer, ends }))
}

/// Seconds of computing per simulated second.
fn price_of(flown: &scenario::Flown) -> f64 {
    let flown_s = flown.ending.report.time_s;
    if flown_s > 0.0 {
        flown.wall_s / flown_s
    } else {
        flown.wall_s
    }
}

/// Adds why; nothing if it was interrupted.
fn explained(
    arguments: &Arguments,
    scenarios: &[Scenario],
    cases: Vec<Case>,
    selection: Selection,
    tolerance: Tolerance,
    ends: Vec<Vec<Option<String>>>,
) -> Result<Option<Evidence>, Failure> {
    let upper = selection.dependable;
    let mut evidence = Evidence {
        hint: None,
        why: None,
        why_metric: String::new(),
        cases,
        selection,
        tolerance,
        ends,
    };
    let Some(lower) = upper.below() else {
        return Ok(Some(evidence));
    };
    let worst = evidence.worst(lower);
    let case = &evidence.cases[worst];
    evidence.why_metric = case.metric.clone();
    evidence.hint = Some(hint(arguments, case, lower, upper));
    if arguments.why {
        let files = Beside::of(&arguments.scenario);
        let scenario = &scenarios[worst / arguments.metrics.len()];
        let metric = evidence.why_metric.clone();
        let mut question = Question::new(scenario, &files, &metric, arguments.keep_controllers);
        match question.explain(lower, upper)? {
            Some(found) => evidence.why = Some((lower, upper, found)),
            None => return Ok(None),
        }
    }
    Ok(Some(evidence))
}

/// The command that explains the difference between two levels in a case.
fn hint(arguments: &Arguments, case: &Case, lower: Level, upper: Level) -> String {
    let mut command = format!(
        "sifre attribute {} --metric {} --from {} --to {}",
        arguments.scenario.display(),
        case.metric,
        lower.number(),
        upper.number()
    );
    for Setting { key, value } in &case.settings {
        command += &format!(" --set '{key}={value}'");
    }
    if arguments.keep_controllers {
        command += " --keep-controllers";
    }
    command
}

impl Evidence {
    /// The case in which a level is farthest off, against what is allowed.
    fn worst(&self, level: Level) -> usize {
        let reference = self.selection.levels.last().map(|a| &a.answer.values);
        let here = self.selection.levels.iter().find(|a| a.answer.level == level);
        let (Some(reference), Some(here)) = (reference, here) else {
            return 0;
        };
        let strain = |k: usize| {
            let share = self.strain(here.answer.values[k], reference[k]);
            if share.is_finite() { share } else { f64::INFINITY }
        };
        (0..reference.len())
            .max_by(|&a, &b| strain(a).total_cmp(&strain(b)))
            .unwrap_or(0)
    }

    /// Difference over what is allowed.
    pub(crate) fn strain(&self, value: f64, reference: f64) -> f64 {
        let apart = (value - reference).abs();
        if apart == 0.0 {
            0.0
        } else {
            apart / self.allowed(reference)
        }
    }

    /// What is allowed.
    pub(crate) fn allowed(&self, reference: f64) -> f64 {
        self.tolerance.absolute + self.tolerance.relative * reference.abs()
    }
}
