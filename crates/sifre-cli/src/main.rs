//! `sifre`: the command line of the simulation engine.
// Those macros panic on a closed stream; use `report::say` and `report::complain`.
#![deny(clippy::print_stdout, clippy::print_stderr)]

mod animate;
mod attribute;
mod cameras;
mod disk;
mod doctor;
mod drawing;
mod exit;
mod interrupt;
mod levels;
mod model;
mod new;
mod optimise;
mod plot;
mod recorder;
mod report;
mod run;
mod saved;
mod schema;
mod select_level;
mod sweep;
mod uncertainty;
mod varied;

use clap::{CommandFactory, Parser, Subcommand};
use clap_complete::Shell;
use exit::{Exit, Failure};
use std::io::ErrorKind;
use std::process::ExitCode;

/// Exit codes, as `--help` shows them.
const EXIT_CODES: &str = "\
Exit codes:
  0    done
  1    a flight ended early (diverged, below the ground, outside its box, target lost), or a check of `doctor` failed
  2    bad usage or bad input: nothing was flown
  3    an output could not be written
  130  interrupted (Ctrl-C); recordings are complete up to that point";

/// Simulate scenarios with quadrotors at five levels of resolution, ground stations and targets.
///
/// First flight: `sifre run scenarios/hover.toml`
#[derive(Debug, Parser)]
#[command(name = "sifre", version, after_help = EXIT_CODES, after_long_help = EXIT_CODES)]
struct Arguments {
    #[command(subcommand)]
    what: What,
    /// Print machine-readable output: one JSON value on standard output instead of text.
    #[arg(long, global = true)]
    json: bool,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Fly a scenario and record it.
    Run(run::Arguments),
    /// Fly a scenario at all five levels of resolution and compare them.
    Levels(levels::Arguments),
    /// Find the cheapest level of resolution that agrees with level 5 on the chosen metric.
    SelectLevel(select_level::Arguments),
    /// Attribute the difference between adjacent levels to single phenomena.
    Attribute(attribute::Arguments),
    /// Find the values of a scenario's keys that minimise the cost; an interrupted search can be resumed.
    Optimise(optimise::Arguments),
    /// Fly a scenario many times with keys varied on a grid or at random; an interrupted sweep resumes where it stopped.
    Sweep(sweep::Arguments),
    /// Propagate the vehicle file's standard errors to every metric.
    Uncertainty(uncertainty::Arguments),
    /// Place motion-capture cameras on the walls of a room so that they see most of the flight volume.
    Cameras(cameras::Arguments),
    /// Plot a recording.
    Plot(plot::Arguments),
    /// Write an animated web page of a flight.
    Animate(animate::Arguments),
    /// Write a commented scenario to start from.
    New(new::Arguments),
    /// Print the JSON schema of scenario files for editors.
    Schema,
    /// Check that the installation works.
    Doctor,
    /// Print a shell completion script: `sifre completions bash > ~/.local/share/bash-completion/completions/sifre`.
    Completions {
        /// The shell.
        shell: Shell,
    },
}

fn main() -> ExitCode {
    let Arguments { what, json } = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => return usage(&error),
    };
    let outcome = match what {
        What::Run(arguments) => run::run(&arguments, json),
        What::Levels(arguments) => levels::run(&arguments, json),
        What::SelectLevel(arguments) => select_level::run(&arguments, json),
        What::Attribute(arguments) => attribute::run(&arguments, json),
        What::Optimise(arguments) => optimise::run(&arguments, json),
        What::Sweep(arguments) => sweep::run(&arguments, json),
        What::Uncertainty(arguments) => uncertainty::run(&arguments, json),
        What::Cameras(arguments) => cameras::run(&arguments, json),
        What::Plot(arguments) => plot::run(&arguments, json),
        What::Animate(arguments) => animate::run(&arguments, json),
        What::New(arguments) => new::run(&arguments, json),
        What::Schema => schema::run(),
        What::Doctor => doctor::run(json),
        What::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Arguments::command(), "sifre", &mut script);
            report::say(String::from_utf8_lossy(&script)).map(|()| Exit::Done)
        }
    };
    let exit = outcome.unwrap_or_else(|failure| tell(&failure, json));
    exit.into()
}

/// Prints help, the version, or what is wrong with the arguments.
fn usage(error: &clap::Error) -> ExitCode {
    let printed = error.print();
    let lost = printed.is_err_and(|why| why.kind() != ErrorKind::BrokenPipe);
    match (error.use_stderr(), lost) {
        (true, _) => Exit::BadInput,
        (false, true) => Exit::NotWritten,
        (false, false) => Exit::Done,
    }
    .into()
}

/// Reports what went wrong.
fn tell(failure: &Failure, json: bool) -> Exit {
    let exit = failure.exit();
    report::complain(format!("error: {failure}"));
    if json {
        // Standard output may be what went wrong.
        let _ = report::print(&serde_json::json!({ "error": failure.to_string(), "exit_code": exit.code() }));
    }
    exit
}
