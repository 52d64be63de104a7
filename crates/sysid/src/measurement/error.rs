//! What can be wrong with a measurement file, and what should be known about one that is right.

use std::fmt;
use std::io;

/// Kinds of file that are mistaken for measurements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// Bytes that are no text.
    Binary,
    /// HTML or XML: often the page that a download gave instead of the file.
    Markup,
    /// JSON.
    Json,
    /// TOML or another list of keys and values.
    KeysAndValues,
    /// A table with tabs or semicolons between its cells.
    OtherSeparator,
}

impl fmt::Display for FileKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Binary => "bytes that are no UTF-8 text",
            Self::Markup => "HTML or XML, perhaps a web page saved instead of the file",
            Self::Json => "JSON",
            Self::KeysAndValues => "keys and values, as in a TOML or YAML file",
            Self::OtherSeparator => "a table separated by tabs or semicolons instead of commas",
        })
    }
}

/// Why a measurement file is refused. Lines count from 1.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The bytes could not be read.
    #[error("line {line}: the file could not be read: {source}")]
    Io {
        /// Line being read.
        line: u64,
        /// What went wrong.
        source: io::Error,
    },
    /// Nothing but comments and empty lines.
    #[error("the file is empty: it needs a header line with the names of its columns")]
    Empty,
    /// A header without rows.
    #[error("the file has a header but no rows")]
    NoRows,
    /// Another kind of file.
    #[error("line {line}: not a CSV file (looks like {kind})")]
    OtherKind {
        /// Where it was noticed.
        line: u64,
        /// What it seems to be.
        kind: FileKind,
    },
    /// A line longer than any row of measurements.
    #[error("line {line} is longer than {limit} bytes: not a table of measurements")]
    LineTooLong {
        /// The line.
        line: u64,
        /// Longest line accepted, bytes.
        limit: usize,
    },
    /// Columns are missing.
    #[error("line {line}: column {} missing; wanted: {}; found: {}", quoted(.missing), quoted(.wanted), quoted(.found))]
    MissingColumns {
        /// Line of the header.
        line: u64,
        /// Names that are missing.
        missing: Vec<String>,
        /// All names wanted.
        wanted: Vec<String>,
        /// Names in the file; the first forty.
        found: Vec<String>,
    },
    /// A wanted name stands twice in the header.
    #[error("line {line}: column \"{name}\" appears {times} times in the header; found: {}", quoted(.found))]
    DuplicateColumn {
        /// Line of the header.
        line: u64,
        /// The name.
        name: String,
        /// How often.
        times: usize,
        /// Names in the file; the first forty.
        found: Vec<String>,
    },
    /// A row with more or fewer cells than there are columns.
    #[error("line {line} has {cells} cells, expected {columns}")]
    Ragged {
        /// The line.
        line: u64,
        /// Cells in it.
        cells: usize,
        /// Cells expected.
        columns: usize,
    },
    /// An empty cell.
    #[error("line {line}, column \"{column}\": the cell is empty")]
    EmptyCell {
        /// The line.
        line: u64,
        /// The column.
        column: &'static str,
    },
    /// A cell that is not a number.
    #[error("line {line}, column \"{column}\": \"{text}\" is not a number")]
    NotANumber {
        /// The line.
        line: u64,
        /// The column.
        column: &'static str,
        /// The first characters of the cell.
        text: String,
    },
    /// NaN or an infinity.
    #[error("line {line}, column \"{column}\": must be finite, got {value}")]
    NotFinite {
        /// The line.
        line: u64,
        /// The column.
        column: &'static str,
        /// The value.
        value: f64,
    },
    /// A value that is physically impossible in the column's unit.
    #[error(
        "line {line}, column \"{column}\": must lie in {minimum} to {maximum} {unit}, got {value} {unit}; is it in another unit?"
    )]
    OutsideRange {
        /// The line.
        line: u64,
        /// The column.
        column: &'static str,
        /// The value.
        value: f64,
        /// The column's unit.
        unit: &'static str,
        /// Smallest possible value.
        minimum: f64,
        /// Largest possible value.
        maximum: f64,
    },
    /// Time that stands still or runs back.
    #[error("line {line}: time must increase from row to row, got {after} s after {before} s")]
    TimeNotRising {
        /// The line.
        line: u64,
        /// Time of the row before, s.
        before: f64,
        /// Time of this row, s.
        after: f64,
    },
    /// Four numbers that are no attitude.
    #[error("line {line}: the quaternion of the attitude must have length 1, got {length}")]
    NoAttitude {
        /// The line.
        line: u64,
        /// Its length.
        length: f64,
    },
    /// More rows than are held in memory.
    #[error(
        "the file has more than {limit} rows: stream it with `scan` and average or decimate, or raise the layout's limit"
    )]
    TooManyRows {
        /// The limit.
        limit: usize,
    },
}

fn quoted(names: &[String]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    names.join(", ")
}

/// Something a user should know about data that were accepted. Lines count from 1.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Remark {
    /// Steps in time longer than the layout's.
    #[error("{gaps} gaps in time, the longest {longest_s:.4} s, ends at line {line}")]
    Gaps {
        /// How many.
        gaps: usize,
        /// The longest, s.
        longest_s: f64,
        /// Line after the longest.
        line: u64,
    },
    /// A measured column repeats its largest or smallest value for many rows: a saturated or stuck sensor.
    #[error("column \"{column}\" stays at its extreme {value} {unit} for {rows} rows up to line {line}")]
    Saturated {
        /// The column.
        column: &'static str,
        /// The value that repeats.
        value: f64,
        /// The column's unit.
        unit: &'static str,
        /// Rows of the longest stretch.
        rows: usize,
        /// Last line of that stretch.
        line: u64,
    },
    /// A column never changes.
    #[error("column \"{column}\" is {value} {unit} throughout: nothing can be identified from it")]
    Constant {
        /// The column.
        column: &'static str,
        /// The value.
        value: f64,
        /// The column's unit.
        unit: &'static str,
    },
}
