//! Making items: in parallel, each guarded against panics, its claims judged and its files written.

use std::any::Any;
use std::cell::RefCell;
use std::fs;
use std::io;
use std::panic::{self, AssertUnwindSafe};
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use rayon::prelude::*;

use crate::claim::judge;
use crate::drawing::Drawing;
use crate::gallery;
use crate::item::{Context, Draw, Item, Make};
use crate::output::{self, OutputError};
use crate::reference::{self, CheckError};
use crate::summary::{Record, Status, Summary, SummaryError};

/// What a run does beside drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum References {
    /// Nothing.
    #[default]
    Ignore,
    /// Compares the data with the committed references.
    Check,
    /// Writes the references.
    Bless,
}

/// Settings of a run.
#[derive(Clone, Debug)]
pub struct Options {
    /// What every item gets.
    pub context: Context,
    /// Folder of all output.
    pub out: PathBuf,
    /// Folder of the committed references.
    pub reference: PathBuf,
    /// What to do with the references.
    pub references: References,
    /// Items made at the same time; at least one.
    pub jobs: usize,
}

/// Why a run could not start or finish, apart from what happens inside items.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The output folder cannot be made.
    #[error("cannot create the folder {path}: {source}")]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What went wrong.
        source: io::Error,
    },
    /// The threads could not be started.
    #[error("cannot start {jobs} threads: {source}")]
    Threads {
        /// Threads asked for.
        jobs: usize,
        /// What went wrong.
        source: rayon::ThreadPoolBuildError,
    },
    /// The earlier summary cannot be read.
    #[error(transparent)]
    Summary(#[from] SummaryError),
    /// Summary or gallery cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
}

/// Makes the items and keeps summary and gallery up to date after each, so that an interrupted run loses nothing.
///
/// `report` hears of each item as it ends. Returns the records of this run in the order of `items`.
///
/// # Errors
/// The output folder, summary or gallery cannot be read or written; failures of items are records.
pub fn run(
    items: &[Item],
    known: &[Item],
    options: &Options,
    report: impl Fn(&Record) + Sync,
) -> Result<Vec<Record>, RunError> {
    let folder = |source| RunError::Folder {
        path: options.out.clone(),
        source,
    };
    fs::create_dir_all(&options.out).map_err(folder)?;
    let jobs = options.jobs;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(jobs).build();
    let pool = pool.map_err(|source| RunError::Threads { jobs, source })?;
    let summary = Mutex::new(Summary::load(&options.out)?);
    let make = |item: &Item| -> Result<Record, RunError> {
        let record = make_item(item, options);
        let mut summary = summary.lock().unwrap_or_else(PoisonError::into_inner);
        summary.replace(record.clone());
        summary.arrange(known);
        summary.save(&options.out)?;
        gallery::save(known, &summary, &options.out)?;
        report(&record);
        Ok(record)
    };
    // One item per task: their run times differ by orders of magnitude.
    pool.install(|| items.par_iter().with_max_len(1).map(make).collect())
}

/// Makes one item, writes its files and judges its claims.
pub fn make_item(item: &Item, options: &Options) -> Record {
    let start = Instant::now();
    let mut record = Record {
        id: item.id.into(),
        title: item.title.into(),
        kind: item.kind,
        origin: item.origin,
        status: Status::Drawn,
        claims: Vec::new(),
        seconds: 0.0,
        quick: options.context.quick,
        files: Vec::new(),
        notes: Vec::new(),
    };
    match item.make {
        Make::NotReproducible(reason) => {
            record.status = Status::NotReproducible {
                reason: reason.into(),
            }
        }
        Make::Draw(draw) => {
            match guarded(draw, &options.context) {
                Ok(drawing) => finish(item, &drawing, options, &mut record),
                Err(status) => record.status = status,
            }
            if matches!(record.status, Status::NotReproducible { .. }) {
                record
                    .notes
                    .extend(item.claims.iter().map(|c| format!("Not checked: {}.", c.text)));
            }
            record.seconds = start.elapsed().as_secs_f64();
        }
    }
    record
}

fn finish(item: &Item, drawing: &Drawing, options: &Options, record: &mut Record) {
    let mut errors = Vec::new();
    let (claims, faults) = judge(item.claims, &drawing.findings);
    errors.extend(faults.iter().map(ToString::to_string));
    record.claims = claims;
    record.notes.clone_from(&drawing.notes);
    match output::write(&options.out, item.id, drawing) {
        Ok(files) => record.files = files,
        Err(error) => errors.push(error.to_string()),
    }
    errors.extend(compare(item.id, drawing, options));
    if !errors.is_empty() {
        record.status = Status::Failed {
            error: errors.join("; "),
        };
    }
}

fn compare(id: &str, drawing: &Drawing, options: &Options) -> Vec<String> {
    let named = drawing
        .data
        .iter()
        .map(|(name, table)| (output::csv_name(id, name), table));
    match options.references {
        References::Ignore => Vec::new(),
        References::Check => named
            .filter_map(|(file, table)| reference::check(&options.reference, &file, table).err())
            .map(|error: CheckError| error.to_string())
            .collect(),
        References::Bless => named
            .filter_map(|(file, table)| reference::bless(&options.reference, &file, table).err())
            .map(|error| error.to_string())
            .collect(),
    }
}

/// Runs an item's function; a panic becomes a failure, missing recordings do not.
fn guarded(draw: Draw, context: &Context) -> Result<Drawing, Status> {
    match panic::catch_unwind(AssertUnwindSafe(|| draw(context))) {
        Ok(Ok(drawing)) => Ok(drawing),
        Ok(Err(error)) => Err(match error.missing() {
            Some(reason) => Status::NotReproducible {
                reason: reason.to_owned(),
            },
            None => Status::Failed {
                error: error.to_string(),
            },
        }),
        Err(payload) => Err(Status::Failed {
            error: format!("panic: {}", message_of(payload.as_ref())),
        }),
    }
}

thread_local! {
    static PLACE: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Keeps panics off the terminal, where they would break the progress bar; their message and place go to the record.
pub fn quiet_panics() {
    panic::set_hook(Box::new(|info| {
        PLACE.with(|place| *place.borrow_mut() = info.location().map(ToString::to_string));
    }));
}

fn message_of(payload: &(dyn Any + Send)) -> String {
    let words = payload.downcast_ref::<&str>().map(|s| (*s).to_owned());
    let words = words
        .or_else(|| payload.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "no message".into());
    match PLACE.with(|place| place.borrow_mut().take()) {
        Some(place) => format!("{words} (at {place})"),
        None => words,
    }
}
