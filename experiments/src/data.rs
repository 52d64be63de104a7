//! Tables of numbers and words: the CSV of the data drawn.

use std::io;

/// Default tolerance of `--check`, relative to the range of each column.
///
/// Runs on one platform repeat bit for bit; other platforms differ in the last bits of sine, cosine and fused
/// operations, which a stable closed loop does not amplify. 1e-6 of a curve's range is far below a pixel.
pub const DEFAULT_TOLERANCE: f64 = 1e-6;

/// A tidy table: one observation per row, units in the column names (`t_s`, `z_m`, `u_col`).
#[derive(Clone, Debug, PartialEq)]
pub struct DataTable {
    /// Column names, with units.
    pub columns: Vec<String>,
    /// Rows, each as long as `columns`.
    pub rows: Vec<Vec<Cell>>,
    /// Tolerance of `--check`, relative to the range of each column of numbers.
    pub tolerance: f64,
    /// Columns that `--check` leaves out, because they hold wall-clock times and the like.
    pub volatile: Vec<String>,
}

/// A cell of a [`DataTable`].
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A number, written with all its digits.
    Number(f64),
    /// A word.
    Text(String),
}

impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl From<&str> for Cell {
    fn from(value: &str) -> Self {
        Self::Text(value.to_owned())
    }
}

impl From<String> for Cell {
    fn from(value: String) -> Self {
        Self::Text(value)
    }
}

impl From<u8> for Cell {
    fn from(value: u8) -> Self {
        Self::Number(f64::from(value))
    }
}

impl From<usize> for Cell {
    /// Exact up to 2⁵³, which no table reaches.
    fn from(value: usize) -> Self {
        Self::Number(value as f64)
    }
}

impl Cell {
    /// The cell as CSV text: numbers in the shortest form that reads back to the same bits.
    pub fn to_text(&self) -> String {
        match self {
            Self::Number(value) if *value == 0.0 => "0".into(),
            Self::Number(value) if (1e-4..1e9).contains(&value.abs()) => value.to_string(),
            Self::Number(value) => format!("{value:e}"),
            Self::Text(text) => text.clone(),
        }
    }
}

impl DataTable {
    /// An empty table with these columns.
    pub fn new<S: Into<String>>(columns: impl IntoIterator<Item = S>) -> Self {
        Self {
            columns: columns.into_iter().map(Into::into).collect(),
            rows: Vec::new(),
            tolerance: DEFAULT_TOLERANCE,
            volatile: Vec::new(),
        }
    }

    /// A table from whole columns of numbers; the shortest column sets the number of rows.
    pub fn from_columns(columns: &[(&str, &[f64])]) -> Self {
        let mut table = Self::new(columns.iter().map(|(name, _)| *name));
        let length = columns.iter().map(|(_, values)| values.len()).min().unwrap_or(0);
        table.rows = (0..length)
            .map(|i| columns.iter().map(|(_, values)| values[i].into()).collect())
            .collect();
        table
    }

    /// Appends a row. A row of another length than the header fails the item when it is written.
    pub fn push<const N: usize>(&mut self, row: [Cell; N]) {
        self.rows.push(row.into());
    }

    /// Sets the tolerance of `--check`, relative to each column's range. Say why beside the call.
    pub fn with_tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// Leaves a column out of `--check` (wall-clock times).
    pub fn with_volatile(mut self, column: &str) -> Self {
        self.volatile.push(column.to_owned());
        self
    }

    /// The table as CSV.
    ///
    /// # Errors
    /// A row of another length than the header.
    pub fn to_csv(&self) -> Result<Vec<u8>, csv::Error> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(&self.columns)?;
        for row in &self.rows {
            writer.write_record(row.iter().map(Cell::to_text))?;
        }
        writer
            .into_inner()
            .map_err(|error| csv::Error::from(io::Error::other(error.to_string())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_numbers_survive_the_round_trip() {
        for value in [0.0, -0.1, 1.0 / 3.0, 6.02e23, 1e-300, 123_456.789] {
            let text = Cell::Number(value).to_text();
            assert_eq!(text.parse::<f64>().ok(), Some(value), "{text}");
        }
    }

    #[test]
    fn exact_csv_of_a_small_table() {
        let mut table = DataTable::new(["level", "t_s", "note"]);
        table.push([1u8.into(), 0.5.into(), "a, b".into()]);
        let csv = table.to_csv().expect("row as long as the header");
        assert_eq!(String::from_utf8_lossy(&csv), "level,t_s,note\n1,0.5,\"a, b\"\n");
    }

    #[test]
    fn prop_a_ragged_row_is_an_error() {
        let mut table = DataTable::new(["a", "b"]);
        table.push([1.0.into()]);
        assert!(table.to_csv().is_err());
    }
}
