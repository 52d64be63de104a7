//! `sifre attribute`: which phenomenon makes the difference between neighbouring levels.
//!
//! ```text
//! from below   v({i}) − v(∅)            switched on alone
//! from above   v(N) − v(N ∖ {i})        taken away
//! Shapley      adds up to v(N) − v(∅)
//! ```
//!
//! All models between two levels are flown by the controller of the lower one, so that the difference is the models' alone. Where
//! another controller belongs to the upper level, the effect of the change of controller is listed separately. Source: Shapley 1953.

mod output;

use crate::disk::{self, Beside};
use crate::exit::{Exit, Failure};
use crate::varied::{self, setting};
use crate::{drawing, interrupt, model, report};
use quad_dynamics::{Level, PhenomenonSet};
use quad_ndi::Law;
use scenario::{End, Files, Keep, Scenario, Setting};
use std::path::PathBuf;
use study::attribution::{Attribution, AttributionError, Parts};

/// How it is used, as `--help` shows it.
const EXAMPLE: &str = "\
Example:
  sifre attribute scenarios/horizontal-step.toml --metric position_error_rms_m --plot why.svg";

/// Arguments of `sifre attribute`.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Arguments {
    /// Scenario file.
    scenario: PathBuf,
    /// Metric to explain, as `sifre run` prints it: `alpha.position_error_rms_m`, step metrics
    /// (`alpha.z.overshoot`) or a station's cost (`station.phi`). The agent's name may be omitted if only one agent has the metric.
    #[arg(long)]
    metric: String,
    /// Lower level [default: all pairs of adjacent levels].
    #[arg(long, value_parser = level_number())]
    from: Option<u8>,
    /// Upper level [default: the next above --from].
    #[arg(long, requires = "from", value_parser = level_number())]
    to: Option<u8>,
    /// Set a key of the scenario: `--set duration_s=5`. May be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = setting)]
    settings: Vec<Setting>,
    /// Plot to this file, .svg or .png.
    #[arg(long, short)]
    plot: Option<PathBuf>,
    /// Keep the scenario's controllers where they can fly the level, instead of using the inversion of each level.
    #[arg(long)]
    keep_controllers: bool,
}

/// What makes the difference between two levels.
#[derive(Clone, Debug)]
pub(crate) struct Explained {
    pub(crate) lower: Level,
    pub(crate) upper: Level,
    /// The difference and its parts, the controllers the lower level's.
    pub(crate) models: Attribution,
    /// What the upper level's controllers add, if they are others.
    pub(crate) controllers: Option<Controllers>,
}

/// What a change of controllers adds.
#[derive(Clone, Debug)]
pub(crate) struct Controllers {
    /// Those of the lower level.
    pub(crate) lower: Vec<Law>,
    /// Those of the upper level.
    pub(crate) upper: Vec<Law>,
    /// What they add to the number.
    pub(crate) adds: f64,
}

/// Two levels and what is between them, or why that is unknown.
pub(crate) type Pair = (Level, Level, Result<Explained, String>);

/// Why a run gave no number.
enum Stop {
    Interrupted,
    Failure(Failure),
    /// It ended early, for this reason.
    Early(String),
}

/// What is explained, and the models flown so far: neighbouring pairs share theirs.
pub(crate) struct Question<'a> {
    pub(crate) scenario: &'a Scenario,
    pub(crate) files: &'a dyn Files,
    pub(crate) metric: &'a str,
    pub(crate) keep_controllers: bool,
    known: Vec<(Model, f64)>,
}

#[derive(PartialEq)]
struct Model {
    level: Level,
    phenomena: PhenomenonSet,
    laws: Vec<Law>,
}

/// Explains the differences between levels.
pub(crate) fn run(arguments: &Arguments, json: bool) -> Result<Exit, Failure> {
    let scenario = varied::read(&arguments.scenario)?.with(&arguments.settings)?;
    model::check(&scenario)?;
    drawing::check(
        arguments.plot.as_deref(),
        &disk::inputs(&arguments.scenario, &scenario),
    )?;
    interrupt::listen();
    let files = Beside::of(&arguments.scenario);
    let mut question = Question::new(&scenario, &files, &arguments.metric, arguments.keep_controllers);
    let mut pairs = Vec::new();
    for (lower, upper) in asked(arguments)? {
        match question.explain(lower, upper)? {
            Some(explained) => pairs.push((lower, upper, explained)),
            None => return Ok(Exit::Interrupted),
        }
    }
    if let Some(path) = &arguments.plot {
        drawing::write(path, &output::figure(&arguments.metric, &pairs))?;
    }
    if json {
        report::print(&output::json(&arguments.metric, &pairs))?;
    } else {
        report::say(output::text(&arguments.metric, &pairs))?;
        if let Some(path) = &arguments.plot {
            report::say(format!("drawn: {}\n", path.display()))?;
        }
    }
    let all = pairs.iter().all(|(.., explained)| explained.is_ok());
    Ok(if all { Exit::Done } else { Exit::Early })
}

/// Reads the number of a level.
fn level_number() -> impl clap::builder::TypedValueParser<Value = u8> {
    let numbers = i64::from(Level::LOWEST.number())..=i64::from(Level::HIGHEST.number());
    clap::value_parser!(u8).range(numbers)
}

/// The pairs of levels that are asked for.
fn asked(arguments: &Arguments) -> Result<Vec<(Level, Level)>, Failure> {
    let level = |number: u8| Level::try_from(number).map_err(|e| Failure::Usage(e.to_string()));
    let Some(from) = arguments.from else {
        return Ok(Level::ALL.windows(2).map(|pair| (pair[0], pair[1])).collect());
    };
    let to = arguments.to.unwrap_or(from + 1);
    if to <= from || to > Level::HIGHEST.number() {
        return Err(Failure::Usage(format!(
            "--to must be above --from {from}, got {to}"
        )));
    }
    Ok(vec![(level(from)?, level(to)?)])
}

impl<'a> Question<'a> {
    /// A question about a scenario.
    pub(crate) fn new(
        scenario: &'a Scenario,
        files: &'a dyn Files,
        metric: &'a str,
        keep_controllers: bool,
    ) -> Self {
        Self {
            scenario,
            files,
            metric,
            keep_controllers,
            known: Vec::new(),
        }
    }

    /// What makes the difference between two levels, or why it is unknown; nothing if it was interrupted.
    pub(crate) fn explain(
        &mut self,
        lower: Level,
        upper: Level,
    ) -> Result<Option<Result<Explained, String>>, Failure> {
        match self.parts(lower, upper) {
            Ok(explained) => Ok(Some(Ok(explained))),
            Err(Stop::Interrupted) => Ok(None),
            Err(Stop::Failure(failure)) => Err(failure),
            Err(Stop::Early(words)) => Ok(Some(Err(words))),
        }
    }

    fn parts(&mut self, lower: Level, upper: Level) -> Result<Explained, Stop> {
        let [before, after] =
            [lower, upper].map(|level| model::laws(self.scenario, level, self.keep_controllers));
        let parts = Parts::between_levels(lower, upper);
        let measured = parts.attribute(|level, phenomena| self.value(level, phenomena, &before));
        let models = measured.map_err(|error| match error {
            AttributionError::Run(stop) => stop,
            AttributionError::NotFinite {
                level,
                phenomena,
                value,
            } => Stop::Early(format!("the flight at {level} with {phenomena} gave {value}")),
            AttributionError::NotAbove { .. } | AttributionError::TooManyParts { .. } => {
                Stop::Early(format!("{lower} and {upper} can't be compared"))
            }
        })?;
        let controllers = if before == after {
            None
        } else {
            Some(Controllers {
                adds: self.value(upper, &upper.phenomena(), &after)? - models.top,
                lower: before,
                upper: after,
            })
        };
        Ok(Explained {
            lower,
            upper,
            models,
            controllers,
        })
    }

    /// The number of the flight at a model.
    fn value(&mut self, level: Level, phenomena: &PhenomenonSet, laws: &[Law]) -> Result<f64, Stop> {
        let model = Model {
            level,
            phenomena: phenomena.clone(),
            laws: laws.to_vec(),
        };
        if let Some((_, value)) = self.known.iter().find(|(known, _)| *known == model) {
            return Ok(*value);
        }
        let scenario = model::at(self.scenario, level, Some(phenomena), laws);
        let flown = interrupt::fly(&scenario, self.files, &Keep::METRICS).map_err(Stop::Failure)?;
        if flown.ending.end == End::Interrupted {
            return Err(Stop::Interrupted);
        }
        let value = flown
            .metric(self.metric)
            .map_err(|error| Stop::Failure(error.into()))?;
        if !value.is_finite() {
            return Err(Stop::Early(format!(
                "the flight at {level} with {phenomena} has no {}: {}",
                self.metric, flown.ending
            )));
        }
        self.known.push((model, value));
        Ok(value)
    }
}

impl Explained {
    /// The total difference, including the controllers' part.
    pub(crate) fn difference(&self) -> f64 {
        self.models.difference() + self.controllers.as_ref().map_or(0.0, |c| c.adds)
    }
}

pub(crate) use output::{json as as_json, text as as_text};
