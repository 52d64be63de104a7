//! `--check` and `--bless`: committed samples of the CSVs, and the comparison with them.
//!
//! A reference holds at most [`MAX_ROWS`] rows of its CSV, evenly spread, each with its row number. Numbers agree
//! when they differ by at most `tolerance · range`, `range` being that of the reference's column, or by [`ROUNDING`].

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::data::{Cell, DataTable};
use crate::output::{OutputError, save_file};

/// Difference that is always allowed: several roundings of numbers of order one (m, rad, N, duty). A column that should be
/// constant or zero holds nothing but rounding, and its range would ask for the same rounding again.
pub const ROUNDING: f64 = 1e-15;

/// Most rows of a reference file.
pub const MAX_ROWS: usize = 60;

/// Why data do not agree with their reference.
#[derive(Debug, thiserror::Error)]
pub enum CheckError {
    /// There is no reference.
    #[error("the reference {path} is missing; `--bless` writes it")]
    Missing {
        /// The file.
        path: PathBuf,
    },
    /// The reference cannot be read.
    #[error("cannot read {path}: {source}")]
    Read {
        /// The file.
        path: PathBuf,
        /// What went wrong.
        source: csv::Error,
    },
    /// The columns are others.
    #[error("{file}: the columns are {found}, expected {expected} as in the reference")]
    Columns {
        /// The file's name.
        file: String,
        /// Columns of this run.
        found: String,
        /// Columns of the reference.
        expected: String,
    },
    /// The number of rows is another.
    #[error("{file}: {found} rows, expected {expected} as for the reference")]
    Rows {
        /// The file's name.
        file: String,
        /// Rows of this run.
        found: usize,
        /// Rows the reference was taken from.
        expected: usize,
    },
    /// A value differs.
    #[error("{file}, row {row}, {column}: got {found}, expected {expected} (tolerance {allowed:e})")]
    Value {
        /// The file's name.
        file: String,
        /// Row number, from 0.
        row: usize,
        /// The column.
        column: String,
        /// Value of this run.
        found: String,
        /// Value of the reference.
        expected: String,
        /// Largest difference allowed; zero for words.
        allowed: f64,
    },
}

/// Name of the column of row numbers in a reference; it also tells how many rows the CSV had.
const ROW: &str = "row_of_";

/// Row numbers of a sample of at most [`MAX_ROWS`] of `count` rows, first and last among them.
pub fn sample(count: usize) -> Vec<usize> {
    if count <= MAX_ROWS {
        return (0..count).collect();
    }
    (0..MAX_ROWS).map(|i| i * (count - 1) / (MAX_ROWS - 1)).collect()
}

/// Writes the reference of a table.
///
/// # Errors
/// A ragged table, or a file that cannot be written.
pub fn bless(folder: &Path, file: &str, table: &DataTable) -> Result<(), OutputError> {
    let create = |source: io::Error| OutputError::Write {
        path: folder.to_owned(),
        source,
    };
    fs::create_dir_all(folder).map_err(create)?;
    let kept = kept_columns(table);
    let mut columns = vec![format!("{ROW}{}", table.rows.len())];
    columns.extend(kept.iter().map(|&c| table.columns[c].clone()));
    let mut reference = DataTable::new(columns);
    for row in sample(table.rows.len()) {
        let mut cells = vec![Cell::from(row)];
        cells.extend(kept.iter().filter_map(|&c| table.rows[row].get(c).cloned()));
        reference.rows.push(cells);
    }
    let content = reference.to_csv().map_err(|source| OutputError::Csv {
        file: file.to_owned(),
        source,
    })?;
    save_file(&folder.join(file), &content)
}

/// Compares a table with its reference.
///
/// # Errors
/// The first difference beyond the table's tolerance.
pub fn check(folder: &Path, file: &str, table: &DataTable) -> Result<(), CheckError> {
    let path = folder.join(file);
    if !path.exists() {
        return Err(CheckError::Missing { path });
    }
    let (header, rows) = read(&path).map_err(|source| CheckError::Read { path, source })?;
    let file = file.to_owned();
    let kept = kept_columns(table);
    let found: Vec<&str> = kept.iter().map(|&c| table.columns[c].as_str()).collect();
    if header.get(1..).unwrap_or_default() != found {
        let expected = header.get(1..).unwrap_or_default().join(", ");
        return Err(CheckError::Columns {
            file,
            found: found.join(", "),
            expected,
        });
    }
    let expected = header[0]
        .strip_prefix(ROW)
        .and_then(|n| n.parse().ok())
        .unwrap_or(0);
    if table.rows.len() != expected {
        return Err(CheckError::Rows {
            file,
            found: table.rows.len(),
            expected,
        });
    }
    for (k, &column) in kept.iter().enumerate() {
        let references: Vec<&str> = rows.iter().map(|row| row[k + 1].as_str()).collect();
        let allowed = (table.tolerance * range(&references)).max(ROUNDING);
        for (&row, expected) in sample(expected).iter().zip(references) {
            let found = &table.rows[row][column];
            if !agrees(found, expected, allowed) {
                let (column, found) = (table.columns[column].clone(), found.to_text());
                return Err(CheckError::Value {
                    file,
                    row,
                    column,
                    found,
                    expected: expected.into(),
                    allowed,
                });
            }
        }
    }
    Ok(())
}

fn kept_columns(table: &DataTable) -> Vec<usize> {
    (0..table.columns.len())
        .filter(|&c| !table.volatile.contains(&table.columns[c]))
        .collect()
}

fn read(path: &Path) -> Result<(Vec<String>, Vec<Vec<String>>), csv::Error> {
    let mut reader = csv::Reader::from_path(path)?;
    let words = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect::<Vec<_>>();
    let header = words(reader.headers()?);
    let rows = reader
        .records()
        .map(|record| record.map(|r| words(&r)))
        .collect::<Result<_, _>>()?;
    Ok((header, rows))
}

/// Range of a column of the reference; its magnitude where it is constant, 1 where it is zero throughout.
fn range(values: &[&str]) -> f64 {
    let numbers = values
        .iter()
        .filter_map(|v| v.parse::<f64>().ok())
        .filter(|v| v.is_finite());
    let (low, high) = numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| {
        (f64::min(l, v), f64::max(h, v))
    });
    match (high - low, low.abs().max(high.abs())) {
        (range, _) if range > 0.0 => range,
        (_, magnitude) if magnitude.is_finite() && magnitude > 0.0 => magnitude,
        _ => 1.0,
    }
}

fn agrees(found: &Cell, expected: &str, allowed: f64) -> bool {
    match (found, expected.parse::<f64>()) {
        (Cell::Number(a), Ok(b)) if a.is_finite() && b.is_finite() => (a - b).abs() <= allowed,
        _ => found.to_text() == expected,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(offset: f64) -> DataTable {
        let mut table = DataTable::new(["level", "t_s", "z_m", "wall_s"]).with_volatile("wall_s");
        for i in 0..500u16 {
            let t = f64::from(i) * 0.01;
            table.push([
                "level 1".into(),
                t.into(),
                (10.0 * t.sin() + offset).into(),
                (offset * 7.0).into(),
            ]);
        }
        table
    }

    fn folder(name: &str) -> PathBuf {
        let folder =
            std::env::temp_dir().join(format!("experiments-reference-{name}-{}", std::process::id()));
        fs::create_dir_all(&folder).expect("a folder for temporary files");
        folder
    }

    #[test]
    fn prop_the_tolerance_is_relative_to_the_range() {
        let folder = folder("range");
        bless(&folder, "x.csv", &table(0.0)).expect("blessed");
        assert_eq!(
            fs::read_to_string(folder.join("x.csv"))
                .expect("written")
                .lines()
                .count(),
            MAX_ROWS + 1
        );
        // z has a range of about 20 m, so that 1e-6 of it is 2e-5 m.
        check(&folder, "x.csv", &table(0.0)).expect("the same data agree");
        check(&folder, "x.csv", &table(1e-5)).expect("within the tolerance");
        let error = check(&folder, "x.csv", &table(1e-4)).expect_err("beyond the tolerance");
        assert!(
            matches!(&error, CheckError::Value { column, .. } if column == "z_m"),
            "{error}"
        );
        fs::remove_dir_all(folder).expect("removed");
    }

    #[test]
    fn prop_a_column_of_rounding_noise_agrees_with_another() {
        let folder = folder("rounding");
        let noise = |values: &[f64]| DataTable::from_columns(&[("height_m", values)]);
        bless(&folder, "x.csv", &noise(&[0.0, 3e-17, -5e-19])).expect("blessed");
        check(&folder, "x.csv", &noise(&[1e-17, -2e-17, 0.0])).expect("rounding agrees with rounding");
        check(&folder, "x.csv", &noise(&[1e-14, 0.0, 0.0])).expect_err("ten roundings are a difference");
        fs::remove_dir_all(folder).expect("removed");
    }

    #[test]
    fn prop_rows_columns_and_missing_files_are_noticed() {
        let folder = folder("shape");
        assert!(matches!(
            check(&folder, "x.csv", &table(0.0)),
            Err(CheckError::Missing { .. })
        ));
        bless(&folder, "x.csv", &table(0.0)).expect("blessed");
        let mut shorter = table(0.0);
        shorter.rows.pop();
        assert!(matches!(
            check(&folder, "x.csv", &shorter),
            Err(CheckError::Rows {
                found: 499,
                expected: 500,
                ..
            })
        ));
        let renamed = DataTable {
            columns: ["a", "b", "c", "wall_s"].map(String::from).into(),
            ..table(0.0)
        };
        assert!(matches!(
            check(&folder, "x.csv", &renamed),
            Err(CheckError::Columns { .. })
        ));
        fs::remove_dir_all(folder).expect("removed");
    }

    #[test]
    fn exact_samples_hold_first_and_last() {
        assert_eq!(sample(3), [0, 1, 2]);
        let rows = sample(10_001);
        assert_eq!((rows.len(), rows[0], rows[MAX_ROWS - 1]), (MAX_ROWS, 0, 10_000));
    }
}
