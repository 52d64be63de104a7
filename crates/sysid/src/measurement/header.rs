//! Which cell of a line belongs to which wanted column, and the numbers in them.

use super::{Column, ReadError};

/// Names of a file that a message lists at most.
const NAMES_LISTED: usize = 40;
/// Characters of a cell that a message quotes at most.
const CHARACTERS_QUOTED: usize = 40;

/// Where the wanted columns stand in a line.
pub(super) struct Places {
    /// For each cell of a line, the wanted column that it holds.
    wanted: Vec<Option<usize>>,
}

impl Places {
    /// The wanted columns and no others, in their order.
    pub(super) fn in_order(columns: usize) -> Self {
        Self {
            wanted: (0..columns).map(Some).collect(),
        }
    }

    /// From the line that names the columns.
    pub(super) fn from_names(line: u64, text: &str, columns: &[Column]) -> Result<Self, ReadError> {
        let names: Vec<&str> = text.split(',').map(unquoted).collect();
        let found = || names.iter().take(NAMES_LISTED).map(|n| shortened(n)).collect();
        let times = |column: &Column| names.iter().filter(|name| **name == column.name).count();
        let missing: Vec<String> = columns
            .iter()
            .filter(|column| times(column) == 0)
            .map(|column| column.name.to_owned())
            .collect();
        if !missing.is_empty() {
            return Err(ReadError::MissingColumns {
                line,
                missing,
                wanted: columns.iter().map(|column| column.name.to_owned()).collect(),
                found: found(),
            });
        }
        if let Some(column) = columns.iter().find(|column| times(column) > 1) {
            return Err(ReadError::DuplicateColumn {
                line,
                name: column.name.to_owned(),
                times: times(column),
                found: found(),
            });
        }
        let place = |name: &&str| columns.iter().position(|column| column.name == *name);
        Ok(Self {
            wanted: names.iter().map(place).collect(),
        })
    }

    /// Parses the wanted cells of a line.
    pub(super) fn parse(
        &self,
        line: u64,
        text: &str,
        columns: &[Column],
        values: &mut [f64],
    ) -> Result<(), ReadError> {
        let cells = text.split(',').count();
        if cells != self.wanted.len() {
            return Err(ReadError::Ragged {
                line,
                cells,
                columns: self.wanted.len(),
            });
        }
        for (cell, wanted) in text.split(',').zip(&self.wanted) {
            if let Some(index) = *wanted {
                values[index] = number(line, cell.trim(), &columns[index])?;
            }
        }
        Ok(())
    }
}

fn number(line: u64, cell: &str, column: &Column) -> Result<f64, ReadError> {
    let name = column.name;
    if cell.is_empty() {
        return Err(ReadError::EmptyCell { line, column: name });
    }
    let value: f64 = cell.parse().map_err(|_| ReadError::NotANumber {
        line,
        column: name,
        text: shortened(cell),
    })?;
    if !value.is_finite() {
        return Err(ReadError::NotFinite {
            line,
            column: name,
            value,
        });
    }
    if value < column.minimum || value > column.maximum {
        return Err(ReadError::OutsideRange {
            line,
            column: name,
            value,
            unit: column.unit,
            minimum: column.minimum,
            maximum: column.maximum,
        });
    }
    Ok(value)
}

fn unquoted(name: &str) -> &str {
    let name = name.trim();
    name.strip_prefix('"')
        .and_then(|n| n.strip_suffix('"'))
        .unwrap_or(name)
}

fn shortened(text: &str) -> String {
    text.chars().take(CHARACTERS_QUOTED).collect()
}
