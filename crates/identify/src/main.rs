//! `identify`: one command per identification, from measurements to a printed table, a plot and a vehicle file.

mod arguments;
mod command;
mod input;
mod output;
mod plot;
mod ulog;
mod vehicle;

use ::output::STANDARD_INPUT;
use arguments::{Arguments, Common, What};
use clap::Parser;
use output::{Answer, Found};
use std::error::Error;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Exit code when the data or a file are rejected.
const REFUSED: u8 = 1;

/// Exit code for bad usage.
const BAD_USAGE: u8 = 2;

/// Exit code when an output can't be written.
const NOT_WRITTEN: u8 = 3;

/// Why the program ends before its work.
enum Stop {
    /// Data or a file that is rejected.
    Refused(Box<dyn Error>),
    /// An output that is an input or another output.
    Clash(::output::Clash),
    /// An output that can't be written, and why.
    NotWritten(PathBuf, io::Error),
}

impl From<Box<dyn Error>> for Stop {
    fn from(error: Box<dyn Error>) -> Self {
        Self::Refused(error)
    }
}

impl From<String> for Stop {
    fn from(error: String) -> Self {
        Self::Refused(error.into())
    }
}

fn main() -> ExitCode {
    let what = match Arguments::try_parse() {
        Ok(arguments) => arguments.what,
        Err(error) => return usage(&error),
    };
    let (code, why) = match run(&what) {
        Ok(()) => return ExitCode::SUCCESS,
        Err(Stop::Refused(error)) => (REFUSED, error.to_string()),
        Err(Stop::Clash(clash)) => (BAD_USAGE, clash.to_string()),
        Err(Stop::NotWritten(path, error)) => (
            NOT_WRITTEN,
            format!("{}: cannot be written: {error}", path.display()),
        ),
    };
    complain(&format!("error: {why}"));
    ExitCode::from(code)
}

/// Prints help, the version, or what is wrong with the arguments.
fn usage(error: &clap::Error) -> ExitCode {
    let lost = error
        .print()
        .is_err_and(|why| why.kind() != ErrorKind::BrokenPipe);
    ExitCode::from(match (error.use_stderr(), lost) {
        (true, _) => BAD_USAGE,
        (false, true) => NOT_WRITTEN,
        (false, false) => 0,
    })
}

/// Prints a line on standard error; a stream that is closed is no error of ours.
fn complain(line: &str) {
    let _ = writeln!(io::stderr(), "{}", ::output::message(line));
}

/// Prints a text on standard output.
fn say(text: &str) -> Result<(), Stop> {
    ::output::print(&::output::escaped(text))
        .map_err(|error| Stop::NotWritten("standard output".into(), error))
}

/// Writes a file atomically.
fn write(path: &Path, content: impl AsRef<[u8]>) -> Result<(), Stop> {
    ::output::replace(path, content).map_err(|error| Stop::NotWritten(path.to_owned(), error))
}

fn run(what: &What) -> Result<(), Stop> {
    let mut answer = Answer::default();
    let common = match what {
        What::Template { kind } => return say(kind.template()),
        What::CentreOfMass(common)
        | What::ThrustStand { common, .. }
        | What::RotorResponse(common)
        | What::Pendulum { common, .. }
        | What::LoadCell { common, .. }
        | What::Flight { common, .. } => common,
    };
    check_outputs(common)?;
    let identified = command::identify(what, &mut answer);
    // What the reader noticed may explain a rejection, so it is reported in both cases.
    for warning in &answer.warnings {
        complain(&format!("warning: {warning}"));
    }
    identified?;
    answer.check()?;
    // First what was found, so that it is not lost if a file can't be written, and the files all the same if it can't be printed.
    let said = say(&if common.json {
        output::json(&answer) + "\n"
    } else {
        output::table(&answer)
    });
    if let (Some(path), Some(figure)) = (&common.plot, &answer.figure) {
        write(path, plot::drawn(path, figure)?)?;
    }
    if let (Some(vehicle), Some(out)) = (&common.vehicle, &common.out) {
        let source = |found: &Found| found.source(what.command(), &common.data);
        write(out, vehicle::completed(vehicle, &answer.found, source)?)?;
    }
    said
}

/// Refuses outputs that are inputs or each other, and outputs that can't be written, before anything is read. The one input that an output may be is
/// the vehicle file, which --out completes.
fn check_outputs(common: &Common) -> Result<(), Stop> {
    let data = match input::is_standard(&common.data) {
        true => Path::new(STANDARD_INPUT).to_owned(),
        false => common.data.clone(),
    };
    let outputs: Vec<PathBuf> = [&common.out, &common.plot]
        .into_iter()
        .flatten()
        .cloned()
        .collect();
    ::output::keep_apart(std::slice::from_ref(&data), &outputs).map_err(Stop::Clash)?;
    let (vehicle, plot) = (common.vehicle.as_slice(), common.plot.as_slice());
    ::output::keep_apart(vehicle, plot).map_err(Stop::Clash)?;
    outputs
        .into_iter()
        .try_for_each(|path| match ::output::can_be_written(&path) {
            Ok(()) => Ok(()),
            Err(error) => Err(Stop::NotWritten(path, error)),
        })
}
