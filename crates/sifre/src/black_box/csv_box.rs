//! Recordings as CSV: a comment line that describes the channels, a line of names, a line per row.
//!
//! ```text
//! # {"sifre_recording":1,"channels":[{"name":"alpha.position.x","role":"state","unit":"m","frame":"world"}]}
//! time_s,alpha.position.x
//! 0.000000000,0.5
//! ```
//!
//! Times have nine decimals, exactly the nanoseconds; numbers have as many digits as bring them back bit for bit
//! (NaN comes back as a NaN).

use super::recovered::LastByte;
use super::{BlackBox, BlackBoxError, Channel, Header, Recording, Recovered};
use std::fmt::Write as _;
use std::io::{BufRead, BufReader, Read, Write};

/// Nanoseconds in a second.
const NS: u64 = 1_000_000_000;

/// Mark of the comment line.
const COMMENT: &str = "# ";

/// Streams a recording as CSV.
#[derive(Debug)]
pub struct CsvBox<W: Write> {
    file: File<W>,
    field: String,
}

/// Before the comment line there is no table.
#[derive(Debug)]
enum File<W: Write> {
    Blank(W),
    Table(Box<csv::Writer<W>>),
    Lost,
}

impl<W: Write> CsvBox<W> {
    /// Writes to a file, a pipe or memory; buffers by itself.
    pub fn new(to: W) -> Self {
        Self {
            file: File::Blank(to),
            field: String::with_capacity(32),
        }
    }

    /// What it wrote to, with all rows in it.
    ///
    /// # Errors
    /// If the rest can't be written.
    pub fn into_inner(self) -> Result<W, BlackBoxError> {
        match self.file {
            File::Blank(to) => Ok(to),
            File::Table(table) => table
                .into_inner()
                .map_err(|error| BlackBoxError::Io(error.into_error())),
            File::Lost => Err(NOT_BEGUN),
        }
    }
}

const NOT_BEGUN: BlackBoxError = BlackBoxError::NoHeader {
    expected: "the beginning of the recording",
};

/// Writes a field by way of a buffer.
fn put<W: Write>(
    table: &mut csv::Writer<W>,
    field: &mut String,
    text: std::fmt::Arguments<'_>,
) -> Result<(), BlackBoxError> {
    field.clear();
    field.write_fmt(text).map_err(std::io::Error::other)?;
    Ok(table.write_field(field.as_str())?)
}

impl<W: Write + Send + 'static> BlackBox for CsvBox<W> {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), BlackBoxError> {
        let File::Blank(mut to) = std::mem::replace(&mut self.file, File::Lost) else {
            return Err(BlackBoxError::NoHeader {
                expected: "a file that is not begun yet",
            });
        };
        writeln!(to, "{COMMENT}{}", Header::text(channels)?)?;
        let mut table = csv::Writer::from_writer(to);
        table.write_field("time_s")?;
        for channel in channels {
            table.write_field(&channel.name)?;
        }
        table.write_record(None::<&[u8]>)?;
        self.file = File::Table(Box::new(table));
        Ok(())
    }

    fn record(&mut self, time_ns: u64, row: &[f64]) -> Result<(), BlackBoxError> {
        let (File::Table(table), field) = (&mut self.file, &mut self.field) else {
            return Err(NOT_BEGUN);
        };
        put(table, field, format_args!("{}.{:09}", time_ns / NS, time_ns % NS))?;
        for value in row {
            put(table, field, format_args!("{value:?}"))?;
        }
        Ok(table.write_record(None::<&[u8]>)?)
    }

    fn finish(&mut self) -> Result<(), BlackBoxError> {
        match &mut self.file {
            File::Table(table) => Ok(table.flush()?),
            File::Blank(_) | File::Lost => Ok(()),
        }
    }
}

impl Recording {
    /// Reads what a [`CsvBox`] wrote.
    ///
    /// # Errors
    /// If it can't be read, or is not what a [`CsvBox`] writes; the error names the row.
    pub fn from_csv(from: impl Read) -> Result<Self, BlackBoxError> {
        Self::recover_csv(from)?.whole()
    }

    /// Reads the complete rows of what a [`CsvBox`] wrote.
    ///
    /// # Errors
    /// If there is no description of the channels.
    pub fn recover_csv(from: impl Read) -> Result<Recovered, BlackBoxError> {
        let mut from = BufReader::new(LastByte::new(from));
        let mut first = String::new();
        from.read_line(&mut first)?;
        let header = first.strip_prefix(COMMENT).ok_or(BlackBoxError::NoHeader {
            expected: "a first line with `# ` and the channels",
        })?;
        let mut recording = Self::new(Header::channels(header)?);
        let read = read_rows(&mut recording, from);
        Ok(Recovered::of(recording, read))
    }
}

/// Reads the rows until the end or the first that is wrong.
fn read_rows<R: Read>(recording: &mut Recording, from: BufReader<LastByte<R>>) -> Result<(), BlackBoxError> {
    let mut reader = csv::ReaderBuilder::new().flexible(true).from_reader(from);
    let mut values = vec![0.0; recording.channels().len()];
    let [mut record, mut next] = [csv::StringRecord::new(), csv::StringRecord::new()];
    let mut is_there = reader.read_record(&mut record)?;
    for row in 1.. {
        if !is_there {
            break;
        }
        // The reader knows a record to be the last one only when it looks for the next.
        let more = reader.read_record(&mut next);
        if matches!(more, Ok(false)) && !reader.get_ref().get_ref().ends_with_a_line() {
            return Err(BlackBoxError::CutOff { row });
        }
        read_row(recording, row, &record, &mut values)?;
        is_there = more?;
        std::mem::swap(&mut record, &mut next);
    }
    Ok(())
}

fn read_row(
    recording: &mut Recording,
    row: usize,
    record: &csv::StringRecord,
    values: &mut [f64],
) -> Result<(), BlackBoxError> {
    if record.len() != values.len() + 1 {
        return Err(BlackBoxError::RowLength {
            row,
            expected: values.len(),
            found: record.len().saturating_sub(1),
        });
    }
    for (value, text) in values.iter_mut().zip(record.iter().skip(1)) {
        *value = text.parse().map_err(|_| not(row, text, "number"))?;
    }
    let time_ns = nanoseconds(&record[0]).ok_or_else(|| not(row, &record[0], "time in s"))?;
    recording.push(time_ns, values)
}

fn not(row: usize, text: &str, expected: &'static str) -> BlackBoxError {
    BlackBoxError::NotANumber {
        row,
        text: text.to_owned(),
        expected,
    }
}

/// The nanoseconds of a time with nine decimals.
fn nanoseconds(text: &str) -> Option<u64> {
    let (whole, decimals) = text.split_once('.')?;
    let decimals: u64 = (decimals.len() == 9).then(|| decimals.parse().ok())??;
    whole.parse::<u64>().ok()?.checked_mul(NS)?.checked_add(decimals)
}
