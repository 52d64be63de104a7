//! Recordings as JSON lines: a line that describes the channels, then a line per row.
//!
//! ```text
//! {"sifre_recording":1,"channels":[{"name":"alpha.position.x","role":"state","unit":"m","frame":"world"}]}
//! {"time_ns":0,"values":[0.5]}
//! ```
//!
//! Numbers come back bit for bit; non-finite numbers, which JSON does not have, are written as by [`Exact`].

use super::{BlackBox, BlackBoxError, Channel, Header, Recording, Recovered};
use crate::exact::{Exact, plain};
use serde::ser::SerializeSeq;
use serde::{Deserialize, Serialize, Serializer};
use std::io::{BufRead, BufReader, BufWriter, Read, Write};

/// Streams a recording as JSON lines.
#[derive(Debug)]
pub struct JsonLinesBox<W: Write> {
    writer: BufWriter<W>,
    line: usize,
}

#[derive(Serialize)]
struct WrittenRow<'a> {
    time_ns: u64,
    #[serde(serialize_with = "exactly")]
    values: &'a [f64],
}

#[derive(Deserialize)]
struct ReadRow {
    time_ns: u64,
    values: Vec<Exact>,
}

fn exactly<S: Serializer>(values: &[f64], serializer: S) -> Result<S::Ok, S::Error> {
    let mut list = serializer.serialize_seq(Some(values.len()))?;
    for &value in values {
        list.serialize_element(&Exact(value))?;
    }
    list.end()
}

impl<W: Write> JsonLinesBox<W> {
    /// Writes to a file, a pipe or memory; buffers by itself.
    pub fn new(to: W) -> Self {
        Self {
            writer: BufWriter::new(to),
            line: 1,
        }
    }

    /// What it wrote to, with all rows in it.
    ///
    /// # Errors
    /// If the rest can't be written.
    pub fn into_inner(self) -> Result<W, BlackBoxError> {
        self.writer
            .into_inner()
            .map_err(|error| BlackBoxError::Io(error.into_error()))
    }
}

impl<W: Write + Send + 'static> BlackBox for JsonLinesBox<W> {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), BlackBoxError> {
        Ok(writeln!(self.writer, "{}", Header::text(channels)?)?)
    }

    fn record(&mut self, time_ns: u64, values: &[f64]) -> Result<(), BlackBoxError> {
        self.line += 1;
        let line = self.line;
        serde_json::to_writer(&mut self.writer, &WrittenRow { time_ns, values }).map_err(|source| {
            if source.is_io() {
                BlackBoxError::Io(source.into())
            } else {
                BlackBoxError::Json { line, source }
            }
        })?;
        Ok(self.writer.write_all(b"\n")?)
    }

    fn finish(&mut self) -> Result<(), BlackBoxError> {
        Ok(self.writer.flush()?)
    }
}

impl Recording {
    /// Reads what a [`JsonLinesBox`] wrote.
    ///
    /// # Errors
    /// If it can't be read, or is not what a [`JsonLinesBox`] writes; the error names the line.
    pub fn from_json_lines(from: impl Read) -> Result<Self, BlackBoxError> {
        Self::recover_json_lines(from)?.whole()
    }

    /// Reads the complete rows of what a [`JsonLinesBox`] wrote.
    ///
    /// # Errors
    /// If there is no description of the channels.
    pub fn recover_json_lines(from: impl Read) -> Result<Recovered, BlackBoxError> {
        let mut lines = BufReader::new(from).lines();
        let first = lines.next().transpose()?.ok_or(BlackBoxError::NoHeader {
            expected: "a first line with the channels",
        })?;
        let mut recording = Self::new(Header::channels(&first)?);
        let read = lines.enumerate().try_for_each(|(k, line)| {
            // A line that is cut off is no JSON, since it lacks its closing brace.
            let row: ReadRow =
                serde_json::from_str(&line?).map_err(|source| BlackBoxError::Json { line: k + 2, source })?;
            recording.push(row.time_ns, &plain(&row.values))
        });
        Ok(Recovered::of(recording, read))
    }
}
