//! `sifre sweep`: a scenario flown many times with keys varied.
//!
//! Every run is a pure function of its number: the grid's point is `n / runs`, the draw `n mod runs`. Draw d takes its
//! numbers from stream d of a ChaCha8 generator of the sweep's seed, key by key, and flies with the scenario's seed
//! plus d; so all points of a grid see the same draws, and neither threads nor interruptions change a row. Rows go to a journal
//! (`<out>.journal`) as they come and to the table, in order, at the end.

pub(crate) mod axes;
mod journal;
mod table;

use crate::disk::{self, Beside, Remembering};
use crate::exit::{Exit, Failure};
use crate::varied;
use crate::{interrupt, report};
use axes::{Axis, Draw};
use indicatif::{ProgressBar, ProgressStyle};
use journal::Journal;
use rayon::prelude::*;
use scenario::{End, Files, Keep, Setting, Template};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// Arguments of `sifre sweep`.
///
/// Grids: every combination of --set and --range is flown. Random: --normal and --uniform are drawn --runs times for
/// each combination.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Scenario file.
    scenario: PathBuf,
    /// Values of a key: `--set quadrotor.alpha.level=1,3,5`. May be repeated.
    #[arg(long = "set", value_name = "KEY=A,B,C", value_parser = axes::set)]
    sets: Vec<Axis>,
    /// Evenly spaced values of a key, both ends included: `--range quadrotor.alpha.reference.x_0_m=3:7:9`. May be repeated.
    #[arg(long = "range", value_name = "KEY=LOW:HIGH:N", value_parser = axes::range)]
    ranges: Vec<Axis>,
    /// A key drawn from a normal distribution: `--normal quadrotor.alpha.parameters.airframe.mass_kg=1.4:0.05`. May be repeated.
    #[arg(long = "normal", value_name = "KEY=MEAN:DEVIATION", value_parser = axes::normal)]
    normals: Vec<Draw>,
    /// A key drawn from an interval: `--uniform quadrotor.alpha.start.yaw_deg=-180:180`. May be repeated.
    #[arg(long = "uniform", value_name = "KEY=LOW:HIGH", value_parser = axes::uniform)]
    uniforms: Vec<Draw>,
    /// Number of draws for each combination of the grid.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    runs: u32,
    /// Seed of the draws.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Write the table to this file, .parquet or .csv.
    #[arg(long, short, default_value = "sweep.parquet")]
    out: PathBuf,
    /// Number of threads [default: number of cores].
    #[arg(long)]
    jobs: Option<usize>,
    /// Start again, even if a journal of this sweep exists.
    #[arg(long)]
    restart: bool,
    /// Largest number of runs; their rows are held in memory until the table is written, about a kilobyte each.
    #[arg(long, value_name = "N", default_value_t = MOST_RUNS)]
    most_runs: u64,
}

/// Most runs without being asked for more: a gigabyte of rows.
pub(crate) const MOST_RUNS: u64 = 1_000_000;

/// Refuses more runs than a limit, which may be raised.
pub(crate) fn check_count(count: Option<u64>, most: u64) -> Result<u64, Failure> {
    match count {
        Some(count) if count <= most => Ok(count),
        Some(count) => Err(Failure::Usage(format!(
            "at most {most} runs are allowed, got {count}: vary less, or raise the limit with --most-runs {count}"
        ))),
        None => Err(Failure::Usage("too many runs to count: vary less".to_owned())),
    }
}

/// One run: a row of the table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Row {
    /// Its number.
    pub(crate) run: u64,
    /// Values of the keys that are varied, in the order of the arguments; they follow from the number.
    #[serde(skip)]
    pub(crate) inputs: Vec<toml::Value>,
    /// How it ended.
    pub(crate) end: String,
    /// The exit code that `sifre run` would give.
    pub(crate) exit_code: u8,
    /// When it ended, s; nothing if it could not be flown.
    pub(crate) time_s: Option<f64>,
    /// Summary metrics.
    pub(crate) metrics: Vec<(String, Option<f64>)>,
}

/// Flies a scenario many times.
pub(crate) fn run(arguments: &Arguments, json: bool) -> Result<Exit, Failure> {
    table::check(&arguments.out)?;
    let plan = Plan::of(arguments)?;
    let outputs = [arguments.out.clone(), journal::path_of(&arguments.out)];
    disk::check_outputs(&plan.inputs_on_disk(&arguments.scenario)?, &outputs)?;
    interrupt::listen();
    let journal = Journal::open(&arguments.out, &plan, arguments.restart)?;
    let done = journal.rows.len();
    let bar = progress_bar(plan.count, done as u64, json);
    let rows = plan.fly_all(journal, arguments.jobs, &bar)?;
    bar.finish_and_clear();
    if (rows.len() as u64) < plan.count {
        let left = plan.count - rows.len() as u64;
        report::complain(format!(
            "interrupted with {left} of {} runs left; repeat the command to continue",
            plan.count
        ));
        return Ok(Exit::Interrupted);
    }
    table::write(&arguments.out, &plan.keys(), &rows)?;
    Journal::remove(&arguments.out);
    let flown = |exit: Exit| rows.iter().filter(|row| row.exit_code == exit.code()).count();
    let refused = flown(Exit::BadInput);
    if json {
        report::print(&serde_json::json!({
            "runs": rows.len(), "done": flown(Exit::Done), "ended_early": flown(Exit::Early),
            "refused": refused, "taken_from_journal": done, "output": arguments.out,
        }))?;
    } else {
        report::say(format!(
            "{} runs: {} done, {} ended early, {refused} could not be flown\nrecorded in {}\n",
            rows.len(),
            flown(Exit::Done),
            flown(Exit::Early),
            arguments.out.display()
        ))?;
    }
    match rows.first() {
        Some(row) if refused == rows.len() => {
            Err(Failure::Usage(format!("no run could be flown: {}", row.end)))
        }
        _ => Ok(Exit::Done),
    }
}

/// All there is to fly.
struct Plan<'a> {
    template: Template,
    axes: Vec<&'a Axis>,
    draws: Vec<&'a Draw>,
    runs: u64,
    seed: u64,
    count: u64,
    files: Beside,
}

impl<'a> Plan<'a> {
    fn of(arguments: &'a Arguments) -> Result<Self, Failure> {
        let axes: Vec<&Axis> = arguments.sets.iter().chain(&arguments.ranges).collect();
        let sizes = axes.iter().map(|axis| axis.values.len() as u64);
        let runs = u64::from(arguments.runs);
        let count = sizes.chain([runs]).try_fold(1_u64, u64::checked_mul);
        let plan = Self {
            template: varied::read(&arguments.scenario)?,
            axes,
            draws: arguments.normals.iter().chain(&arguments.uniforms).collect(),
            runs,
            seed: arguments.seed,
            count: check_count(count, arguments.most_runs)?,
            files: Beside::of(&arguments.scenario),
        };
        // Unknown keys are reported before anything is flown.
        plan.template.with(&plan.settings(0))?;
        Ok(plan)
    }

    /// The keys that are varied.
    fn keys(&self) -> Vec<String> {
        let axes = self.axes.iter().map(|axis| axis.key.clone());
        axes.chain(self.draws.iter().map(|draw| draw.key.clone()))
            .collect()
    }

    /// What makes this sweep another than the next: what is varied, the scenario, and the files that it or a varied key names.
    fn fingerprint(&self) -> String {
        let files = Remembering::of(&self.files);
        // A scenario that can't be built is reported when it is flown.
        let _ = self
            .template
            .with(&self.settings(0))
            .map(|scenario| scenario.build(&files));
        for name in self.axes.iter().flat_map(|axis| axis.values.texts()) {
            // Not every word is a file's name.
            let _ = files.text(name);
        }
        let all = format!(
            "{:?} {:?} {} {:?} {:?} runs {} seed {} of {}",
            self.axes,
            self.draws,
            self.template.origin(),
            self.template.table(),
            files.read.borrow(),
            self.runs,
            self.seed,
            env!("CARGO_PKG_VERSION")
        );
        output::checksum(all.as_bytes())
    }

    /// The files that its runs read.
    fn inputs_on_disk(&self, scenario: &Path) -> Result<Vec<PathBuf>, Failure> {
        let mut inputs = disk::inputs(scenario, &self.template.with(&self.settings(0))?);
        let named = self.axes.iter().flat_map(|axis| axis.values.texts());
        inputs.extend(named.map(|name| self.files.path(name)));
        Ok(inputs)
    }

    /// What a run varies.
    fn inputs(&self, run: u64) -> Vec<toml::Value> {
        self.settings(run)
            .into_iter()
            .map(|setting| setting.value)
            .collect()
    }

    /// The keys of a run.
    fn settings(&self, run: u64) -> Vec<Setting> {
        let (mut point, draw) = (run / self.runs, run % self.runs);
        let mut settings = Vec::new();
        // The last axis runs fastest.
        for axis in self.axes.iter().rev() {
            let size = axis.values.len() as u64;
            settings.push(axis.setting((point % size) as usize));
            point /= size;
        }
        settings.reverse();
        settings.extend(axes::draw(&self.draws, self.seed, draw));
        settings
    }

    /// Flies all runs that the journal doesn't have; all rows then, in order.
    fn fly_all(&self, journal: Journal, jobs: Option<usize>, bar: &ProgressBar) -> Result<Vec<Row>, Failure> {
        let has: Vec<u64> = journal.rows.iter().map(|row| row.run).collect();
        let journal = Mutex::new(journal);
        let one = |run: u64| -> Result<(), Failure> {
            if interrupt::asked() || has.binary_search(&run).is_ok() {
                return Ok(());
            }
            let Some(row) = self.fly(run) else {
                return Ok(());
            };
            bar.inc(1);
            // Another thread that panicked has left the earlier rows intact.
            journal
                .lock()
                .unwrap_or_else(std::sync::PoisonError::into_inner)
                .add(row)
        };
        threads(jobs)?.install(|| (0..self.count).into_par_iter().try_for_each(one))?;
        let mut rows = journal
            .into_inner()
            .unwrap_or_else(std::sync::PoisonError::into_inner)
            .rows;
        rows.sort_by_key(|row| row.run);
        Ok(rows)
    }

    /// Flies one run; nothing if it was interrupted.
    fn fly(&self, run: u64) -> Option<Row> {
        let settings = self.settings(run);
        let inputs = self.inputs(run);
        let flown = self
            .template
            .with(&settings)
            .map_err(Failure::from)
            .and_then(|mut scenario| {
                scenario.seed = scenario.seed.wrapping_add(run % self.runs);
                interrupt::fly(&scenario, &self.files, &Keep::METRICS)
            });
        match flown {
            Ok(flown) if flown.ending.end == End::Interrupted => None,
            Ok(flown) => Some(Row {
                run,
                inputs,
                end: flown.ending.report.status.to_string(),
                exit_code: Exit::from(flown.ending.end).code(),
                time_s: Some(flown.ending.report.time_s),
                // JSON has no non-finite numbers.
                metrics: flown
                    .metrics
                    .into_iter()
                    .map(|m| (m.name, Some(m.value).filter(|x| x.is_finite())))
                    .collect(),
            }),
            Err(failure) => Some(Row {
                run,
                inputs,
                end: failure.to_string(),
                exit_code: failure.exit().code(),
                time_s: None,
                metrics: Vec::new(),
            }),
        }
    }
}

/// So many threads, or as many as there are cores.
pub(crate) fn threads(jobs: Option<usize>) -> Result<rayon::ThreadPool, Failure> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(jobs.unwrap_or(0))
        .build();
    pool.map_err(|error| Failure::Usage(format!("--jobs: {error}")))
}

/// A bar for so many runs, of which some are done.
pub(crate) fn progress_bar(count: u64, done: u64, json: bool) -> ProgressBar {
    let bar = if json {
        ProgressBar::hidden()
    } else {
        ProgressBar::new(count)
    };
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len}  {eta} left");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    // Runs of before must not count for the speed of now.
    bar.set_position(done);
    bar.reset_eta();
    bar
}
