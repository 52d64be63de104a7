//! `sifre cameras`: where to put motion-capture cameras on the walls of a room.

mod output;

use crate::exit::{Exit, Failure};
use crate::{disk, drawing, interrupt, report, sweep};
use coverage::{Camera, Coverage, CoverageError, RoomFile, Task, WallRig};
use optim::{Evolution, EvolutionSettings, Limits, Report, StopReason, run as search};
use std::path::PathBuf;

/// Arguments of `sifre cameras`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  sifre cameras --template > room.toml
  sifre cameras room.toml --plot room.svg --out cameras.csv")]
pub(crate) struct Arguments {
    /// Room file: the room, the flight volume and the cameras.
    #[arg(required_unless_present = "template")]
    room: Option<PathBuf>,
    /// Print a commented room file to start from.
    #[arg(long, exclusive = true)]
    template: bool,
    /// Evaluate the installed cameras only; do not search.
    #[arg(long)]
    no_search: bool,
    /// Write the cameras found (with --no-search, the installed ones) to this CSV file.
    #[arg(long, short)]
    out: Option<PathBuf>,
    /// Plot the room from above to this file, .svg or .png.
    #[arg(long)]
    plot: Option<PathBuf>,
}

/// A rig and what it sees.
struct Judged {
    name: &'static str,
    cameras: Vec<Camera>,
    coverage: Coverage,
}

impl Judged {
    fn of(task: &Task, name: &'static str, cameras: Vec<Camera>) -> Result<Self, CoverageError> {
        let coverage = task.coverage(&cameras)?;
        Ok(Self {
            name,
            cameras,
            coverage,
        })
    }
}

/// Places cameras.
pub(crate) fn run(arguments: &Arguments, json: bool) -> Result<Exit, Failure> {
    let Some(path) = arguments.room.as_ref().filter(|_| !arguments.template) else {
        report::say(RoomFile::TEMPLATE)?;
        return Ok(Exit::Done);
    };
    let file = RoomFile::from_toml_str(&disk::read(path)?, &path.display().to_string())
        .map_err(|error| Failure::Usage(error.to_string()))?;
    let refuse = |error: CoverageError| Failure::Usage(format!("{}: {error}", path.display()));
    let task = file.task().map_err(refuse)?;
    let rig = file.wall_rig().map_err(refuse)?;
    if let Some(plot) = &arguments.plot {
        drawing::is_png(plot)?;
    }
    let outputs: Vec<PathBuf> = [&arguments.out, &arguments.plot]
        .into_iter()
        .flatten()
        .cloned()
        .collect();
    disk::check_outputs(std::slice::from_ref(path), &outputs)?;
    let installed = file.installed();
    let begun = if installed.is_empty() {
        Judged::of(&task, "first guess", rig.cameras(&rig.first_guess()))
    } else {
        Judged::of(&task, "as installed", installed)
    };
    let mut judged = vec![begun.map_err(refuse)?];
    let found = (!arguments.no_search)
        .then(|| placed(&task, &rig, &file, json))
        .transpose()?;
    if let Some(found) = &found {
        let cameras = rig.cameras(&found.best.candidate.values);
        judged.push(Judged::of(&task, "found", cameras).map_err(refuse)?);
    }
    if let (Some(out), Some(best)) = (&arguments.out, judged.last()) {
        disk::replace(out, output::csv(&best.cameras))?;
    }
    if let Some(plot) = &arguments.plot {
        drawing::write(plot, &output::figure(&file, &task, &judged))?;
    }
    if json {
        report::print(&output::json(&judged, found.as_ref()))?;
    } else {
        report::say(output::text(&file, &judged, found.as_ref()))?;
    }
    Ok(match found {
        Some(Report {
            stop: StopReason::Interrupted,
            ..
        }) => Exit::Interrupted,
        _ => Exit::Done,
    })
}

/// Looks for places by differential evolution.
fn placed(task: &Task, rig: &WallRig, file: &RoomFile, json: bool) -> Result<Report, Failure> {
    let settings = EvolutionSettings {
        seed: file.search.seed,
        ..EvolutionSettings::default()
    };
    let mut evolution = Evolution::new(rig.variables(), settings)
        .map_err(|error| Failure::Usage(format!("search: {error}")))?;
    interrupt::listen();
    let bar = sweep::progress_bar(file.search.evaluations, 0, json);
    let report = search(
        &mut evolution,
        |x: &[f64]| rig.cost(task, x),
        Limits::evaluations(file.search.evaluations),
        &mut |progress| {
            bar.set_position(progress.evaluations);
            interrupt::flow()
        },
    );
    bar.finish_and_clear();
    report.map_err(|error| Failure::Usage(format!("search: {error}")))
}
