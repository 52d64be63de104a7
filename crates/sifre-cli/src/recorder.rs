//! Recordings on disk.

use crate::exit::Failure;
use scenario::Format;
use sifre::black_box::{CsvBox, JsonLinesBox, ParquetBox, Recovered, Selected, Selection};
use sifre::{BlackBox, BlackBoxError, Engine, Recording, StepSize};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Opens a file for a recording and attaches it.
pub(crate) fn attach(
    simulation: &mut Engine,
    path: &Path,
    format: Format,
    step: StepSize,
    selection: Selection,
) -> Result<(), Failure> {
    // A selection that fits nothing is known before a file is made.
    let refuse = |source| Failure::Recording {
        path: path.to_owned(),
        source,
    };
    selection.places(&simulation.channels()).map_err(refuse)?;
    let file = output::open_alone(path).map_err(|source| Failure::Write {
        path: path.to_owned(),
        source,
    })?;
    let inner: Box<dyn BlackBox> = match format {
        Format::Csv => Box::new(CsvBox::new(file)),
        Format::Parquet => Box::new(ParquetBox::new(file)),
        Format::Jsonl => Box::new(JsonLinesBox::new(file)),
    };
    simulation
        .attach(step, Selected::new(inner, selection))
        .map_err(|error| match error {
            sifre::SimulationError::BlackBox(source) => refuse(source),
            other => other.into(),
        })?;
    Ok(())
}

/// Whether a recording may replace this file without --force: it is missing, empty, or a recording.
pub(crate) fn may_be_replaced(path: &Path) -> bool {
    const BEGINNINGS: [&[u8]; 3] = [b"# {\"sifre_recording\"", b"{\"sifre_recording\"", b"PAR1"];
    let is_file = std::fs::metadata(path).is_ok_and(|metadata| metadata.is_file());
    let Ok(file) = File::open(path) else {
        return true; // A file that can't be opened is reported when it is written.
    };
    let mut begins = Vec::new();
    let read = file.take(64).read_to_end(&mut begins);
    !is_file || read.is_err() || begins.is_empty() || BEGINNINGS.iter().any(|b| begins.starts_with(b))
}

/// Reads the complete rows of a recording.
pub(crate) fn read(path: &Path) -> Result<Recovered, Failure> {
    let file = File::open(path).map_err(|source| Failure::Read {
        path: path.to_owned(),
        source,
    })?;
    let recovered: Result<Recovered, BlackBoxError> = match Format::of(&path.display().to_string()) {
        Some(Format::Jsonl) => Recording::recover_json_lines(file),
        Some(Format::Parquet) => Recording::recover_parquet(file),
        Some(Format::Csv) | None => Recording::recover_csv(file),
    };
    recovered.map_err(|source| Failure::Usage(format!("{}: not a recording: {source}", path.display())))
}
