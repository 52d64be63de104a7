//! Recordings on disk.

use crate::exit::Failure;
use scenario::Format;
use sifre::black_box::{CsvBox, JsonLinesBox, ParquetBox, Recovered, Selected, Selection};
use sifre::{BlackBox, BlackBoxError, Recording, Simulation, StepSize};
use std::fs::File;
use std::path::Path;

/// Opens a file for a recording and attaches it.
pub(crate) fn attach(
    simulation: &mut Simulation,
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
    let file = File::create(path).map_err(|source| Failure::Write {
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

/// Reads what is whole of a recording.
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
