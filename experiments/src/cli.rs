//! The command line: which items, where to, and what the exit code says.

use std::io::IsTerminal;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use clap::{Parser, Subcommand};
use indicatif::{ProgressBar, ProgressStyle};

use crate::claim::{Claim, Expected};
use crate::figures;
use crate::identify::Coverage;
use crate::item::{Context, Item, Make, repository_root};
use crate::run::{self, Options, References};
use crate::summary::{Counts, Record, Status};

/// Exit code when an item failed or a claim's outcome differs from the registered one.
const DIFFERS: u8 = 1;
/// Exit code for bad usage.
const USAGE: u8 = 2;

/// Draw the figures and tables of the study and check their claims.
///
/// Exit codes: 0 if every outcome is as registered; 1 if an item failed or the outcome of a claim differs
/// from the registered one; 2 for bad usage.
#[derive(Clone, Debug, Parser)]
#[command(name = "reproduce-figures", version, args_conflicts_with_subcommands = true)]
pub struct Arguments {
    /// A chore other than figures.
    #[command(subcommand)]
    chore: Option<Chore>,
    /// Items to draw, such as `6.4 F.1 table-4.3` [default: all].
    ids: Vec<String>,
    /// Draw only the items of this chapter or appendix (`6`, `F`), or those not in the source (`beyond`, `est`). May be repeated.
    #[arg(long, value_name = "N")]
    chapter: Vec<String>,
    /// List the items with their claims; draw nothing.
    #[arg(long)]
    list: bool,
    /// Number of items drawn at the same time [default: number of cores].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// Compare the data with the committed references.
    #[arg(long, conflicts_with_all = ["quick", "bless"])]
    check: bool,
    /// Write the references that `--check` compares with.
    #[arg(long, conflicts_with = "quick")]
    bless: bool,
    /// Use shorter runs; every claim is still checked.
    #[arg(long)]
    quick: bool,
    /// Folder of the output [default: target/figures].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// What the program does besides figures.
#[derive(Clone, Debug, Subcommand)]
enum Chore {
    /// Measure the vehicle in the virtual laboratory, identify it, and fly the identified vehicle.
    ///
    /// Writes the raw measurements, the vehicle file, a report and a plot. Exit codes: 0 if the identified vehicle meets the
    /// claims of figure 6.14; 1 if it does not, or something failed; 2 for bad usage.
    Identify {
        /// Seed of the measurements' noise.
        #[arg(long, default_value_t = 1)]
        seed: u64,
        /// Folder of the output [default: target/identify].
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
        /// Repeat the identification over this many seeds and count the intervals that contain the truth; write nothing.
        #[arg(long, value_name = "SEEDS", value_parser = clap::value_parser!(u32).range(1..))]
        coverage: Option<u32>,
    },
}

fn coverage(seed: u64, runs: u32) -> ExitCode {
    match Coverage::count(&Context::new(repository_root(), false), seed, runs) {
        Ok(counted) => {
            print!("{counted}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(DIFFERS)
        }
    }
}

fn identify(seed: u64, out: Option<PathBuf>) -> ExitCode {
    let root = repository_root();
    let out = out.unwrap_or_else(|| root.join("target/identify"));
    match crate::identify::run(&Context::new(root, false), seed, &out) {
        Ok(outcome) => {
            println!("{}\nwritten to {}", outcome.report, outcome.out.display());
            ExitCode::from(if outcome.claims_hold { 0 } else { DIFFERS })
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(DIFFERS)
        }
    }
}

/// Runs the program and returns its exit code.
pub fn main() -> ExitCode {
    let arguments = Arguments::parse();
    if let Some(Chore::Identify {
        seed,
        out,
        coverage: runs,
    }) = arguments.chore
    {
        return runs.map_or_else(|| identify(seed, out), |runs| coverage(seed, runs));
    }
    let known = figures::all();
    let items = match select(&known, &arguments.ids, &arguments.chapter) {
        Ok(items) => items,
        Err(error) => {
            eprintln!("error: {error}");
            return ExitCode::from(USAGE);
        }
    };
    if arguments.list {
        print!("{}", listing(&items));
        return ExitCode::SUCCESS;
    }
    let options = options(&arguments);
    run::quiet_panics();
    let progress = Progress::new(items.len());
    match run::run(&items, &known, &options, |record| progress.ended(record)) {
        Ok(records) => {
            progress.finish();
            println!("{}", closing(&records));
            match options.references {
                References::Check => println!("data compared with {}", options.reference.display()),
                References::Bless => println!("references written to {}", options.reference.display()),
                References::Ignore => {}
            }
            println!("gallery: {}", options.out.join("index.html").display());
            ExitCode::from(exit_code(&records))
        }
        Err(error) => {
            progress.finish();
            eprintln!("error: {error}");
            ExitCode::from(DIFFERS)
        }
    }
}

fn options(arguments: &Arguments) -> Options {
    let root = repository_root();
    let references = match (arguments.check, arguments.bless) {
        (true, _) => References::Check,
        (_, true) => References::Bless,
        _ => References::Ignore,
    };
    let cores = || thread::available_parallelism().map_or(1, usize::from);
    Options {
        out: arguments
            .out
            .clone()
            .unwrap_or_else(|| root.join("target/figures")),
        reference: root.join("experiments/reference"),
        references,
        jobs: arguments.jobs.map_or_else(cores, usize::from),
        context: Context::new(root, arguments.quick),
    }
}

/// Why the items asked for cannot be selected.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SelectError {
    /// There is no such item.
    #[error("unknown item \"{id}\"; known: {known}")]
    UnknownItem {
        /// The identifier asked for.
        id: String,
        /// All identifiers.
        known: String,
    },
    /// There is no such chapter.
    #[error("unknown chapter \"{chapter}\"; known: {known}")]
    UnknownChapter {
        /// The chapter asked for.
        chapter: String,
        /// All chapters.
        known: String,
    },
}

/// The items named by `ids` and those of `chapters`; all if both are empty.
///
/// # Errors
/// An identifier or chapter that does not exist.
pub fn select(known: &[Item], ids: &[String], chapters: &[String]) -> Result<Vec<Item>, SelectError> {
    for id in ids {
        if !known.iter().any(|item| item.id == id) {
            let known = known.iter().map(|item| item.id).collect::<Vec<_>>().join(" ");
            return Err(SelectError::UnknownItem {
                id: id.clone(),
                known,
            });
        }
    }
    for chapter in chapters {
        if !known.iter().any(|item| item.chapter() == chapter) {
            let mut all: Vec<_> = known.iter().map(Item::chapter).collect();
            all.dedup();
            return Err(SelectError::UnknownChapter {
                chapter: chapter.clone(),
                known: all.join(" "),
            });
        }
    }
    let everything = ids.is_empty() && chapters.is_empty();
    let wanted = |item: &&Item| {
        everything || ids.iter().any(|id| id == item.id) || chapters.iter().any(|c| c == item.chapter())
    };
    Ok(known.iter().filter(wanted).copied().collect())
}

/// The exit code that the records of a run call for.
pub fn exit_code(records: &[Record]) -> u8 {
    if records.iter().all(Record::is_as_registered) {
        0
    } else {
        DIFFERS
    }
}

fn listing(items: &[Item]) -> String {
    let line = |claim: &Claim| match claim.expected {
        Expected::Holds => format!("           claim: {}\n", claim.text),
        Expected::DoesNotHold { reason } => {
            format!(
                "           claim, registered as not holding: {} (because {reason})\n",
                claim.text
            )
        }
    };
    let entry = |item: &Item| {
        let reason = match item.make {
            Make::NotReproducible(reason) => format!(" [not reproducible: {reason}]"),
            Make::Draw(_) => String::new(),
        };
        let claims: String = item.claims.iter().map(line).collect();
        format!("{:<10} {}{reason}\n{claims}", item.id, item.title)
    };
    items.iter().map(entry).collect()
}

/// One line about an item, and one about each claim with an unexpected or a registered negative outcome.
fn lines(record: &Record) -> Vec<String> {
    let how = match &record.status {
        Status::Drawn => format!("drawn in {:.2} s, {} claims", record.seconds, record.claims.len()),
        Status::NotReproducible { reason } => format!("not reproducible: {reason}"),
        Status::Failed { error } => format!("FAILED: {error}"),
    };
    let mut lines = vec![format!("{:<10} {how}", record.id)];
    for claim in record
        .claims
        .iter()
        .filter(|claim| !claim.pass || !claim.as_registered())
    {
        let because = claim
            .reason
            .as_ref()
            .map(|reason| format!(", because {reason}"))
            .unwrap_or_default();
        let (text, verdict, measured) = (&claim.text, claim.verdict(), &claim.measured);
        lines.push(format!(
            "           {text}: {verdict}: measured {measured}{because}"
        ));
    }
    lines
}

fn closing(records: &[Record]) -> String {
    let count = |wanted: fn(&Status) -> bool| records.iter().filter(|r| wanted(&r.status)).count();
    let drawn = count(|s| matches!(s, Status::Drawn));
    let photographs = count(|s| matches!(s, Status::NotReproducible { .. }));
    let failed = count(|s| matches!(s, Status::Failed { .. }));
    let Counts {
        held,
        not_held,
        differing,
    } = Counts::of(records);
    format!(
        "{drawn} drawn, {photographs} not reproducible, {failed} failed; claims: {held} hold, {not_held} do not hold \
         as registered, {differing} differ from what is registered"
    )
}

/// A bar on a terminal, plain lines otherwise.
struct Progress {
    bar: Option<ProgressBar>,
    total: usize,
    ended: AtomicUsize,
}

impl Progress {
    fn new(total: usize) -> Self {
        let bar = std::io::stderr().is_terminal().then(|| {
            let bar = ProgressBar::new(total as u64);
            if let Ok(style) = ProgressStyle::with_template("{bar:32} {pos}/{len} {elapsed} {msg}") {
                bar.set_style(style);
            }
            bar
        });
        Self {
            bar,
            total,
            ended: AtomicUsize::new(0),
        }
    }

    fn ended(&self, record: &Record) {
        let number = self.ended.fetch_add(1, Ordering::Relaxed) + 1;
        let width = self.total.to_string().len();
        for (i, line) in lines(record).into_iter().enumerate() {
            let head = if i == 0 {
                format!("[{number:>width$}/{}] ", self.total)
            } else {
                String::new()
            };
            match &self.bar {
                Some(bar) => bar.println(format!("{head}{line}")),
                None => println!("{head}{line}"),
            }
        }
        if let Some(bar) = &self.bar {
            bar.inc(1);
            bar.set_message(record.id.clone());
        }
    }

    fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

#[cfg(test)]
mod tests;
