//! The reader of every measurement file: comma-separated numbers with documented columns and units.
//!
//! A [`Layout`] declares which columns a file must have, in which unit, and between which values they are physically
//! possible. [`scan`] streams: it holds one line of bounded length and hands each row on, so that a file of any size can be
//! decimated or averaged on the way. [`read`] collects the wanted columns as numbers, up to a stated number of rows. The
//! text itself is never held, and columns that are not wanted are not even parsed.
//!
//! Format: UTF-8; cells separated by commas and trimmed; names may be quoted, without commas inside; lines end with LF or
//! CR LF; empty lines and lines that begin with `#` are skipped; the first other line names the columns, unless the layout
//! says that there are no names. Numbers as Rust reads them; `NaN`, infinities and empty cells are errors.
//!
//! What can't be right is a [`ReadError`] with its line number. What may be right but should be known is a [`Remark`]:
//! gaps in time, a measured column that sits at an extreme for long (saturated or stuck), a column that never changes.
//!
//! ```
//! use sysid::measurement::{Column, Layout, read};
//!
//! let columns = [Column::new("t_s", "s", 0.0, 1e6), Column::new("thrust_n", "N", -1.0, 20.0)];
//! let text = "# bench 1\nt_s,note,thrust_n\n0.0,a,1.5\n0.1,b,1.6\n";
//! let table = read(text.as_bytes(), &Layout::timed(&columns, 0.2))?;
//! assert_eq!(table.column(1), [1.5, 1.6]);
//!
//! let refused = read("t_s,thrust_n\n0.0,1.5\n0.1,900\n".as_bytes(), &Layout::timed(&columns, 0.2));
//! assert!(refused.unwrap_err().to_string().contains("line 3"));
//! # Ok::<(), sysid::measurement::ReadError>(())
//! ```

mod error;
mod header;
mod lines;
pub(crate) mod watch;

pub use error::{FileKind, ReadError, Remark};

use std::io::Read;
use std::ops::ControlFlow;

/// Rows that [`read`] collects by default: with ten columns of eight bytes and a line number each, half a gigabyte at most.
pub const DEFAULT_ROW_LIMIT: usize = 6_000_000;

/// Where a column's numbers come from, which decides what is suspicious about them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Signal {
    /// A sensor: one that repeats its extreme for long is saturated or stuck.
    Measured,
    /// The experimenter or a controller (a duty, a set point, a hung weight): it may hold any value for any time.
    Commanded,
}

/// A column that a file must have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// Its name in the header, as the file writes it.
    pub name: &'static str,
    /// Its unit in the file, for messages.
    pub unit: &'static str,
    /// Smallest value that is physically possible, in this unit.
    pub minimum: f64,
    /// Largest value that is physically possible, in this unit.
    pub maximum: f64,
    /// Whether it was measured or commanded.
    pub signal: Signal,
}

impl Column {
    /// A measured column with its name, unit and range.
    pub const fn new(name: &'static str, unit: &'static str, minimum: f64, maximum: f64) -> Self {
        Self {
            name,
            unit,
            minimum,
            maximum,
            signal: Signal::Measured,
        }
    }

    /// A commanded column with its name, unit and range.
    pub const fn commanded(name: &'static str, unit: &'static str, minimum: f64, maximum: f64) -> Self {
        Self {
            signal: Signal::Commanded,
            ..Self::new(name, unit, minimum, maximum)
        }
    }
}

/// How a file tells which column is which.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Header {
    /// The first line names the columns, in any order and with others among them.
    #[default]
    Named,
    /// There are no names: exactly the layout's columns in the layout's order.
    Absent,
}

/// What a file must look like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layout<'a> {
    /// The columns wanted.
    pub columns: &'a [Column],
    /// Whether they are named.
    pub header: Header,
    /// Longest step, s, of the first column that is not yet a gap; `None` if the rows are no time series. In a time
    /// series the first column is time and must rise from row to row.
    pub longest_step: Option<f64>,
    /// Most rows that [`read`] collects.
    pub row_limit: usize,
}

impl<'a> Layout<'a> {
    /// A table of named columns in no particular order of rows.
    pub const fn table(columns: &'a [Column]) -> Self {
        Self {
            columns,
            header: Header::Named,
            longest_step: None,
            row_limit: DEFAULT_ROW_LIMIT,
        }
    }

    /// A time series: the first of the columns is time, and steps longer than `longest_step` are reported as gaps.
    pub const fn timed(columns: &'a [Column], longest_step: f64) -> Self {
        Self {
            longest_step: Some(longest_step),
            ..Self::table(columns)
        }
    }

    /// The same for a file without names.
    #[must_use]
    pub const fn unnamed(self) -> Self {
        Self {
            header: Header::Absent,
            ..self
        }
    }
}

/// One row as [`scan`] hands it on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row<'a> {
    /// Line number in the file, from 1.
    pub line: u64,
    /// The wanted columns in the order of the layout.
    pub values: &'a [f64],
}

/// What [`scan`] tells in the end.
#[derive(Clone, Debug, PartialEq)]
pub struct Scan {
    /// Rows handed on.
    pub rows: usize,
    /// What a user should know about the data.
    pub remarks: Vec<Remark>,
}

/// The wanted columns of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    columns: Vec<Vec<f64>>,
    lines: Vec<u64>,
    /// What a user should know about the data.
    pub remarks: Vec<Remark>,
}

impl Table {
    /// The values of a column, by its place in the layout.
    ///
    /// # Panics
    /// If the layout has no such column: a programming error.
    pub fn column(&self, index: usize) -> &[f64] {
        &self.columns[index]
    }

    /// Line number in the file, from 1, of a row, from 0.
    ///
    /// # Panics
    /// If there is no such row: a programming error.
    pub fn line(&self, row: usize) -> u64 {
        self.lines[row]
    }

    /// How many rows there are; at least one.
    pub fn rows(&self) -> usize {
        self.lines.len()
    }
}

/// Streams a file: hands each row to `on_row` until the file or the caller ends it.
///
/// Holds one line of at most 64 KiB, whatever the size of the file.
///
/// # Errors
/// A file that can't be read, is of another kind, is empty, lacks columns, or holds what can't be right; always the first
/// such thing, with its line. Rows before it have been handed on by then: throw away what was made of them.
pub fn scan(
    input: impl Read,
    layout: &Layout<'_>,
    mut on_row: impl FnMut(Row<'_>) -> ControlFlow<()>,
) -> Result<Scan, ReadError> {
    let mut lines = lines::Lines::new(input);
    let mut watch = watch::Watch::new(layout);
    let mut values = vec![0.0; layout.columns.len()];
    let mut places = match layout.header {
        Header::Named => None,
        Header::Absent => Some(header::Places::in_order(layout.columns.len())),
    };
    let mut rows = 0;
    while let Some((line, text)) = lines.next_content()? {
        let Some(places) = &places else {
            places = Some(header::Places::from_names(line, text, layout.columns)?);
            continue;
        };
        places.parse(line, text, layout.columns, &mut values)?;
        watch.see(line, &values)?;
        rows += 1;
        let values = values.as_slice();
        if on_row(Row { line, values }).is_break() {
            break;
        }
    }
    match (rows, places) {
        (0, None) => Err(ReadError::Empty),
        (0, Some(_)) => Err(ReadError::NoRows),
        _ => Ok(Scan {
            rows,
            remarks: watch.remarks(),
        }),
    }
}

/// Reads the wanted columns of a file.
///
/// # Errors
/// As [`scan`]; and more rows than the layout's limit.
pub fn read(input: impl Read, layout: &Layout<'_>) -> Result<Table, ReadError> {
    let mut columns = vec![Vec::new(); layout.columns.len()];
    let mut lines = Vec::new();
    let mut overfull = false;
    let scan = scan(input, layout, |row| {
        if lines.len() >= layout.row_limit {
            overfull = true;
            return ControlFlow::Break(());
        }
        lines.push(row.line);
        for (column, value) in columns.iter_mut().zip(row.values) {
            column.push(*value);
        }
        ControlFlow::Continue(())
    })?;
    if overfull {
        return Err(ReadError::TooManyRows {
            limit: layout.row_limit,
        });
    }
    Ok(Table {
        columns,
        lines,
        remarks: scan.remarks,
    })
}

#[cfg(test)]
mod tests;
