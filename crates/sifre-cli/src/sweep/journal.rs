//! The journal of a sweep: a line that says which sweep, then a line per run as it is flown.
//!
//! A last line that was cut off is flown again.

use super::Row;
use crate::exit::Failure;
use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

/// An open journal.
#[derive(Debug)]
pub(crate) struct Journal {
    /// The rows that it has.
    pub(crate) rows: Vec<Row>,
    path: PathBuf,
    file: File,
}

fn path_of(out: &Path) -> PathBuf {
    let mut name = out.as_os_str().to_owned();
    name.push(".journal");
    name.into()
}

impl Journal {
    /// Opens the journal of a table, and reads what it has of this sweep.
    pub(crate) fn open(out: &Path, fingerprint: &str, restart: bool) -> Result<Self, Failure> {
        let path = path_of(out);
        let mut text = if restart {
            String::new()
        } else {
            fs::read_to_string(&path).unwrap_or_default()
        };
        // What is not a whole line was being written when the program ended.
        text.truncate(text.rfind('\n').map_or(0, |end| end + 1));
        let header = serde_json::json!({ "sifre_sweep": fingerprint }).to_string();
        let mut lines = text.lines();
        match lines.next() {
            Some(first) if first != header => {
                return Err(Failure::Usage(format!(
                    "{} is of another sweep: give --restart to begin anew, or another --out",
                    path.display()
                )));
            }
            _ => {}
        }
        let mut rows: Vec<Row> = lines.map_while(|line| serde_json::from_str(line).ok()).collect();
        rows.sort_by_key(|row| row.run);
        rows.dedup_by_key(|row| row.run);
        let refuse = |source| Failure::Write {
            path: path.clone(),
            source,
        };
        let mut file = OpenOptions::new()
            .create(true)
            .write(true)
            .truncate(true)
            .open(&path)
            .map_err(refuse)?;
        let mut whole = format!("{header}\n");
        for row in &rows {
            whole += &line(row);
        }
        file.write_all(whole.as_bytes()).map_err(refuse)?;
        Ok(Self { rows, path, file })
    }

    /// Adds a row, on disk first.
    pub(crate) fn add(&mut self, row: Row) -> Result<(), Failure> {
        self.file
            .write_all(line(&row).as_bytes())
            .map_err(|source| Failure::Write {
                path: self.path.clone(),
                source,
            })?;
        self.rows.push(row);
        Ok(())
    }

    /// Removes the journal of a table that is complete.
    pub(crate) fn remove(out: &Path) {
        // A journal that stays does no harm.
        let _ = fs::remove_file(path_of(out));
    }
}

fn line(row: &Row) -> String {
    // Numbers in rows are finite or absent, so there is nothing that JSON can't hold.
    serde_json::to_string(row).map_or_else(|_| String::new(), |text| text + "\n")
}
