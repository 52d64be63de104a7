//! `sifre run`: flies a scenario and records it.

use crate::disk::{self, Beside};
use crate::exit::{Exit, Failure};
use crate::report::{self, Report};
use crate::saved::Origin;
use crate::varied::{self, setting};
use crate::{interrupt, recorder, saved};
use indicatif::{ProgressBar, ProgressStyle};
use scenario::{End, Flown, Format, Keep, Run, Scenario, Setting};
use sifre::{Event, Observer, Progress, RunStatus};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

/// Arguments of `sifre run`.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Scenario file.
    scenario: PathBuf,
    /// Record to this file (.csv, .parquet or .jsonl) [default: `output.path` of the scenario].
    #[arg(long, short)]
    out: Option<String>,
    /// Record nothing.
    #[arg(long, conflicts_with = "out")]
    no_output: bool,
    /// Save the state of the flight when it ends or is interrupted, for --resume.
    #[arg(long, value_name = "FILE")]
    save: Option<PathBuf>,
    /// Resume a saved flight; give a later `duration_s` if it had finished. Agents resume from their saved states, so the scenario's
    /// start (positions, levels, pan and tilt) is ignored. The recording and the metrics cover the resumed part only; the
    /// recording needs its own file name.
    #[arg(long, value_name = "FILE")]
    resume: Option<PathBuf>,
    /// Set a key of the scenario: `--set quadrotor.alpha.level=5`. May be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = setting)]
    settings: Vec<Setting>,
    /// Show no progress bar.
    #[arg(long, short)]
    quiet: bool,
}

/// Flies a scenario.
pub(crate) fn run(arguments: &Arguments, json: bool) -> Result<Exit, Failure> {
    let template = varied::read(&arguments.scenario)?;
    let mut scenario = template.with(&arguments.settings)?;
    if let Some(out) = &arguments.out {
        scenario.output.path = Some(out.clone());
        scenario.output.format = None;
    }
    if arguments.no_output {
        scenario.output.path = None;
    }
    interrupt::listen();
    let bar = if arguments.quiet || json {
        ProgressBar::hidden()
    } else {
        progress_bar(scenario.duration_s)
    };
    let report = fly(&scenario, arguments, &bar)?;
    bar.finish_and_clear();
    for note in &report.flown.notes {
        report::complain(format!("note: {note}"));
    }
    if json {
        report::print(&report.json())?;
    } else {
        report::say(report.text())?;
    }
    if report.exit() != Exit::Done {
        report::complain(format!("error: {}", report.flown.ending.report.status));
    }
    Ok(report.exit())
}

/// Flies a scenario to its end and records it where it says.
fn fly(scenario: &Scenario, arguments: &Arguments, bar: &ProgressBar) -> Result<Report, Failure> {
    let beside = Beside::of(&arguments.scenario);
    let built = scenario.build(&beside)?;
    check_outputs(scenario, arguments)?;
    let selection = built.selection();
    let origin = Origin::of(scenario, &beside)?;
    let mut run = match &arguments.resume {
        Some(from) => saved::resume(built, &origin, from)?,
        None => built.start()?,
    };
    if arguments.resume.is_some() {
        let resumed = saved::notes(&run);
        run.notes.extend(resumed);
    }
    let (step, path) = (run.output.step_s, run.output.path.clone());
    if let Some(path) = &path {
        if arguments.resume.is_some() {
            saved::leave_alone(Path::new(path))?;
        }
        let format = scenario.output.form().unwrap_or(Format::Csv);
        recorder::attach(&mut run.simulation, Path::new(path), format, step, selection)?;
    }
    let mut flown: Flown = run.fly(&Keep::METRICS, &mut Bar { bar })?;
    finish(&mut run, path.as_deref(), flown.ending.end)?;
    let diverged = matches!(flown.ending.report.status, RunStatus::Diverged { .. });
    match &arguments.save {
        Some(to) if diverged => {
            let note = format!("{} not written: the flight diverged", to.display());
            flown.notes.push(note);
        }
        Some(to) => saved::save(&run, origin, to)?,
        None => {}
    }
    Ok(Report {
        scenario: scenario.name.clone(),
        flown,
        output: path,
        saved: arguments.save.clone().filter(|_| !diverged),
    })
}

/// Refuses a recording and a saved flight that would be written over an input or each other, and a scenario's recording that would replace a
/// file of another kind: who starts a scenario of somebody else's has not chosen its outputs.
fn check_outputs(scenario: &Scenario, arguments: &Arguments) -> Result<(), Failure> {
    let mut inputs = disk::inputs(&arguments.scenario, scenario);
    inputs.extend(arguments.resume.clone());
    let recording = scenario.output.path.as_ref().map(PathBuf::from);
    let outputs: Vec<PathBuf> = recording.into_iter().chain(arguments.save.clone()).collect();
    disk::check_outputs(&inputs, &outputs)?;
    if let Some(path) = scenario
        .output
        .path
        .as_ref()
        .map(Path::new)
        .filter(|_| arguments.out.is_none())
        && !recorder::may_be_replaced(path)
    {
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        return Err(Failure::Usage(format!(
            "{}: already exists and is not a recording; pass --out to record to another file",
            path.display()
        )));
    }
    Ok(())
}

/// Completes the recording; an earlier failure has been reported.
fn finish(run: &mut Run, path: Option<&str>, end: End) -> Result<(), Failure> {
    match (run.simulation.finish_recordings(), path) {
        (Err(source), Some(path)) if end != End::RecordingFailed => Err(Failure::Recording {
            path: path.into(),
            source,
        }),
        _ => Ok(()),
    }
}

/// A bar of simulated milliseconds with the time left.
fn progress_bar(duration_s: f64) -> ProgressBar {
    let bar = ProgressBar::new((duration_s * 1e3) as u64);
    let style = ProgressStyle::with_template("{bar:40} {percent:>3} %  {msg}  {eta} left");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar
}

/// Shows progress, and ends the run at Ctrl-C.
struct Bar<'a> {
    bar: &'a ProgressBar,
}

impl Observer for Bar<'_> {
    fn progress(&mut self, progress: &Progress) -> ControlFlow<()> {
        self.bar.set_position((progress.time_s * 1e3) as u64);
        interrupt::flow()
    }

    fn event(&mut self, event: &Event) {
        self.bar.set_message(report::in_words(event));
    }
}
