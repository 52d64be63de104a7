//! Black boxes: what is recorded of a run, in which form, and read back.
//!
//! A recorder samples every agent's channels at its own rate and hands a row to its [`BlackBox`]: in memory
//! ([`MemoryBox`]), or streamed to any [`std::io::Write`] as CSV ([`CsvBox`]), JSON lines ([`JsonLinesBox`]) or
//! Parquet ([`ParquetBox`]). The streams hold at most a buffer (CSV, JSON lines) or a row group (Parquet) in
//! memory, however long the run. All of them read back as a [`Recording`], numbers bit for bit.
//!
//! A row holds each agent's state at its latest instant, and the inputs and references that it decided on there: between
//! an agent's instants its row is held, as others see it held.

mod channel;
mod csv_box;
mod json_lines;
mod memory;
#[cfg(feature = "parquet")]
mod parquet_box;
#[cfg(feature = "parquet")]
mod parquet_reader;
mod recording;
mod recovered;
mod selected;
#[cfg(test)]
mod tests;
#[cfg(feature = "parquet")]
mod thrift;

pub use channel::{Channel, Frame, Role};
pub use csv_box::CsvBox;
pub use json_lines::JsonLinesBox;
pub use memory::MemoryBox;
#[cfg(feature = "parquet")]
pub use parquet_box::ParquetBox;
#[cfg(feature = "parquet")]
pub use parquet_reader::ParquetDamage;
pub use recording::{Recording, Row};
pub use recovered::Recovered;
pub use selected::{Selected, Selection};

use serde::{Deserialize, Serialize};
use std::any::Any;

/// Where the rows of a recorder go.
pub trait BlackBox: Any + Send {
    /// Called once, before the first row, with the columns.
    ///
    /// # Errors
    /// If it can't be written.
    fn begin(&mut self, channels: &[Channel]) -> Result<(), BlackBoxError>;

    /// One row: an instant in ns and a number per channel. Rows come in order of time.
    ///
    /// # Errors
    /// If it can't be written.
    fn record(&mut self, time_ns: u64, row: &[f64]) -> Result<(), BlackBoxError>;

    /// Called once, after the last row: writes what is still in memory.
    ///
    /// # Errors
    /// If it can't be written.
    fn finish(&mut self) -> Result<(), BlackBoxError>;
}

/// Why a recording can't be written or read.
#[derive(Debug, thiserror::Error)]
pub enum BlackBoxError {
    /// The file, the pipe or the disk.
    #[error("black box: {0}")]
    Io(#[from] std::io::Error),
    /// Not the CSV that a [`CsvBox`] writes.
    #[error("black box, CSV: {0}")]
    Csv(#[from] csv::Error),
    /// Not the JSON that a black box writes.
    #[error("black box, JSON in line {line}: {source}")]
    Json {
        /// The line, from 1.
        line: usize,
        /// What is wrong.
        source: serde_json::Error,
    },
    /// Not the Parquet that a [`ParquetBox`] writes.
    #[cfg(feature = "parquet")]
    #[error("black box, Parquet: {0}")]
    Parquet(#[from] parquet::errors::ParquetError),
    /// A Parquet file without its end.
    #[cfg(feature = "parquet")]
    #[error(
        "not a finished Parquet file ({0}): such a file can be read only once it is finished, which Ctrl-C still does but a kill or a full \
         disk does not; CSV and JSON Lines keep every complete row"
    )]
    Unfinished(parquet::errors::ParquetError),
    /// A Parquet file whose parts contradict each other.
    #[cfg(feature = "parquet")]
    #[error("black box, Parquet: {0}")]
    Damaged(#[from] ParquetDamage),
    /// An instant that the clock does not have.
    #[error("row {row} of the recording is at {time_ns} ns, beyond the clock's end at 2^50 ns")]
    Time {
        /// The row, from 1.
        row: usize,
        /// The instant, ns.
        time_ns: u64,
    },
    /// No description of the channels where it should be.
    #[error("not a recording: {expected} is missing")]
    NoHeader {
        /// What should be there.
        expected: &'static str,
    },
    /// A recording of another version of the format.
    #[error("the recording has format {found}, this version reads format {expected}")]
    Version {
        /// The format read.
        expected: u32,
        /// The format found.
        found: u32,
    },
    /// A row with too many or too few numbers.
    #[error(
        "row {row} of the recording has {found} numbers, expected one for each of the {expected} channels"
    )]
    RowLength {
        /// The row, from 1.
        row: usize,
        /// How many numbers it should have.
        expected: usize,
        /// How many it has.
        found: usize,
    },
    /// A last row without the end of its line: its last number may lack digits.
    #[error("row {row} of the recording is cut off; the rows before it are complete")]
    CutOff {
        /// The row, from 1.
        row: usize,
    },
    /// A selection that selects nothing.
    #[error("unknown channel \"{pattern}\"; known: {known}")]
    NothingSelected {
        /// The pattern that fits no channel.
        pattern: String,
        /// The first of the channels there are.
        known: String,
    },
    /// Something that is not a number.
    #[error("row {row} of the recording: \"{text}\" is not a {expected}")]
    NotANumber {
        /// The row, from 1.
        row: usize,
        /// What stands there.
        text: String,
        /// What should stand there.
        expected: &'static str,
    },
}

/// The version of what black boxes write.
const FORMAT: u32 = 1;

/// The description that each form of recording begins with.
#[derive(Serialize, Deserialize)]
struct Header {
    sifre_recording: u32,
    channels: Vec<Channel>,
}

impl Header {
    /// The header of these channels as JSON in one line.
    fn text(channels: &[Channel]) -> Result<String, BlackBoxError> {
        let header = Self {
            sifre_recording: FORMAT,
            channels: channels.to_vec(),
        };
        serde_json::to_string(&header).map_err(|source| BlackBoxError::Json { line: 1, source })
    }

    /// The channels that a header describes.
    fn channels(text: &str) -> Result<Vec<Channel>, BlackBoxError> {
        let header: Self =
            serde_json::from_str(text).map_err(|source| BlackBoxError::Json { line: 1, source })?;
        if header.sifre_recording == FORMAT {
            Ok(header.channels)
        } else {
            Err(BlackBoxError::Version {
                expected: FORMAT,
                found: header.sifre_recording,
            })
        }
    }
}
