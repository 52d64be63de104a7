//! `identify`: one command per identification, from measurements to a printed table, a plot and a vehicle file.

mod arguments;
mod command;
mod input;
mod output;
mod plot;
mod ulog;
mod vehicle;

use arguments::{Arguments, What};
use clap::Parser;
use output::{Answer, Found};
use std::error::Error;
use std::process::ExitCode;

/// Exit code when the data or a file are refused.
const REFUSED: u8 = 1;

fn main() -> ExitCode {
    match run(&Arguments::parse().what) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(REFUSED)
        }
    }
}

fn run(what: &What) -> Result<(), Box<dyn Error>> {
    let mut answer = Answer::default();
    let common = match what {
        What::Template { kind } => {
            print!("{}", kind.template());
            return Ok(());
        }
        What::CentreOfMass(common)
        | What::ThrustStand { common, .. }
        | What::RotorResponse(common)
        | What::Pendulum { common, .. }
        | What::LoadCell { common, .. }
        | What::Flight { common, .. } => common,
    };
    let identified = command::identify(what, &mut answer);
    // What the reader noticed may be the reason of a refusal: said in both cases.
    for warning in &answer.warnings {
        eprintln!("warning: {warning}");
    }
    identified?;
    // First what was found, so that it is not lost if a file can't be written.
    if common.json {
        println!("{}", output::json(&answer));
    } else {
        print!("{}", output::table(&answer));
    }
    if let (Some(path), Some(figure)) = (&common.plot, &answer.figure) {
        plot::save(path, figure)?;
    }
    if let (Some(vehicle), Some(out)) = (&common.vehicle, &common.out) {
        let source = |found: &Found| found.source(what.command(), &common.data);
        vehicle::write(vehicle, out, &answer.found, source)?;
    }
    Ok(())
}
