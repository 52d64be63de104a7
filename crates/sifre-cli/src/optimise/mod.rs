//! `sifre optimise`: finds the values of a scenario's keys that minimise the cost.
//!
//! Candidates that a search proposes at the same time are flown side by side; it receives answers in the order of its questions, so that
//! neither threads nor interruptions change the result. A flight that fails costs what its share of a failure is, a finite number;
//! one that can't be flown costs [`FAILED_COST`].

mod output;
mod problem;
mod state;

use crate::exit::{Exit, Failure};
use crate::varied::setting;
use crate::{disk, interrupt, report};
use indicatif::{ProgressBar, ProgressStyle};
use optim::{Candidate, FAILED_COST, StopReason};
use problem::{Flown, Problem};
use rayon::prelude::*;
use scenario::{Keep, Setting};
use state::{Course, Row, State};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// How it is used, as `--help` shows it.
const EXAMPLE: &str = "\
Example:
  sifre optimise scenarios/optimise-transmission.toml --out optimum
  sifre optimise scenarios/optimise-transmission.toml --out optimum --resume    # after Ctrl-C

Into the folder --out go best.toml, history.csv, history.svg, best.csv (the best flight) and best.svg; with `levels`, one of each per
level (best-level-3.toml). --resume continues from state.json.";

/// Arguments of `sifre optimise`.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Arguments {
    /// Scenario file with a table `[optimise]`.
    scenario: PathBuf,
    /// Folder of the outputs.
    #[arg(long, short, default_value = "optimum")]
    out: PathBuf,
    /// Resume from the state in the folder.
    #[arg(long)]
    resume: bool,
    /// Set a key of the scenario: `--set optimise.budget=500`. May be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = setting)]
    settings: Vec<Setting>,
    /// Show no progress bar.
    #[arg(long, short)]
    quiet: bool,
}

/// Least time between two writings of the state.
const SAVE_EVERY: Duration = Duration::from_millis(500);

/// Failures after which a search that has had no success gives up.
const GIVE_UP: usize = 200;

/// Optimises.
pub(crate) fn run(arguments: &Arguments, json: bool) -> Result<Exit, Failure> {
    let problem = Problem::read(&arguments.scenario, &arguments.settings)?;
    if problem.file.budget == 0 {
        return Err(Failure::Usage(
            "optimise.budget must be at least 1, got 0".to_owned(),
        ));
    }
    let path = arguments.out.join("state.json");
    let outputs: Vec<PathBuf> = output::names(&problem)
        .map(|name| arguments.out.join(name))
        .chain([path.clone()])
        .collect();
    let scenario = problem.template.with([])?;
    ::output::keep_apart(&disk::inputs(&arguments.scenario, &scenario), &outputs)?;
    let mut state = match (arguments.resume, path.exists()) {
        (true, _) => State::read(&path, &problem)?,
        (false, true) => {
            return Err(Failure::Usage(format!(
                "{}: already exists; pass --resume to continue from it, or another --out to start again",
                path.display()
            )));
        }
        (false, false) => State::new(&problem)?,
    };
    let refuse = |source| Failure::Write {
        path: arguments.out.clone(),
        source,
    };
    std::fs::create_dir_all(&arguments.out).map_err(refuse)?;
    let _alone = ::output::lock_folder(&arguments.out).map_err(refuse)?;
    interrupt::listen();
    let hidden = arguments.quiet || json;
    for k in 0..state.courses.len() {
        let bar = progress_bar(problem.file.budget, hidden);
        let ran = search(&problem, &mut state, k, &path, &bar);
        bar.finish_and_clear();
        state.write(&path)?;
        ran?;
        if state.courses[k].stop == Some(StopReason::Interrupted) {
            report::complain(format!(
                "interrupted after {} flights; repeat the command with --resume to continue",
                state.courses[k].rows.len()
            ));
            return Ok(Exit::Interrupted);
        }
    }
    let Some(summary) = output::write(&problem, &state, &arguments.out)? else {
        return Ok(Exit::Interrupted);
    };
    if json {
        report::print(&summary.json())?;
    } else {
        report::say(summary.text())?;
    }
    Ok(Exit::Done)
}

/// Searches at one level until the search or its budget ends, or Ctrl-C.
fn search(
    problem: &Problem,
    state: &mut State,
    k: usize,
    path: &Path,
    bar: &ProgressBar,
) -> Result<(), Failure> {
    let (began, before_s) = (Instant::now(), state.courses[k].elapsed_s);
    let mut saved = began;
    state.courses[k].search().renew();
    state.courses[k].stop = None;
    let threads = rayon::current_num_threads();
    loop {
        let course = &mut state.courses[k];
        let left = problem.file.budget.saturating_sub(course.rows.len() as u64);
        course.stop = step(problem, course, threads.min(left as usize))?;
        course.elapsed_s = before_s + began.elapsed().as_secs_f64();
        bar.set_position(course.rows.len() as u64);
        if let Some((_, cost)) = course.best() {
            bar.set_message(format!("{cost:.6}"));
        }
        if course.stop.is_some() {
            return all_failed(course);
        }
        if course.best().is_none() && course.failed() >= GIVE_UP {
            return all_failed(course);
        }
        if saved.elapsed() >= SAVE_EVERY {
            state.write(path)?;
            saved = Instant::now();
        }
    }
}

/// Flies the next candidates; why the search is over, if it is.
fn step(problem: &Problem, course: &mut Course, most: usize) -> Result<Option<StopReason>, Failure> {
    if let Some(ending) = course.search().ending() {
        return Ok(Some(ending));
    }
    let evaluations = course.rows.len() as u64;
    if most == 0 {
        return Ok(Some(StopReason::Budget { evaluations }));
    }
    let batch: Vec<Candidate> = std::iter::from_fn(|| course.search().ask()).take(most).collect();
    if batch.is_empty() {
        return Ok(Some(StopReason::Stalled { iterations: 0 }));
    }
    let level = course.level;
    let flown: Vec<Option<Flown>> = batch
        .par_iter()
        .map(|candidate| problem.fly(&candidate.values, level, Keep::COSTS))
        .collect();
    for (candidate, flown) in batch.iter().zip(flown) {
        // An interrupted candidate is proposed again when the search resumes.
        let Some(flown) = flown else {
            return Ok(Some(StopReason::Interrupted));
        };
        let cost = flown
            .outcome
            .map(|outcome| outcome.cost)
            .filter(|c| c.is_finite());
        course
            .search()
            .tell(candidate, cost.unwrap_or(FAILED_COST))
            .map_err(|error| Failure::Usage(error.to_string()))?;
        course.rows.push(Row {
            candidate: candidate.id,
            values: candidate.values.clone(),
            cost,
            failure: flown.failure,
        });
    }
    Ok(interrupt::asked().then_some(StopReason::Interrupted))
}

/// A search in which every flight failed has no result.
fn all_failed(course: &Course) -> Result<(), Failure> {
    match course.rows.last() {
        Some(last) if course.best().is_none() && course.stop != Some(StopReason::Interrupted) => {
            Err(Failure::Usage(format!(
                "all {} flights failed, the last one: {}; check the bounds and the scenario with `sifre run`",
                course.rows.len(),
                last.failure.as_deref().unwrap_or("its cost is not finite")
            )))
        }
        _ => Ok(()),
    }
}

fn progress_bar(budget: u64, hidden: bool) -> ProgressBar {
    let bar = if hidden {
        ProgressBar::hidden()
    } else {
        ProgressBar::new(budget)
    };
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} flights  best {msg}  {eta} left");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar
}
