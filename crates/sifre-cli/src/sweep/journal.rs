//! The journal of a sweep: a line that says which sweep, then a line per run as it is flown.
//!
//! A last line that was cut off is flown again.

use super::Row;
use crate::disk;
use crate::exit::Failure;
use std::fs::{self, File, OpenOptions};
use std::io::{ErrorKind, Write};
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
        let text = if restart {
            String::new()
        } else {
            whole_lines(&path)?
        };
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
        let mut whole = format!("{header}\n");
        for row in &rows {
            whole += &line(row);
        }
        disk::replace(&path, whole)?;
        let file = OpenOptions::new().append(true).open(&path).map_err(refuse)?;
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

/// The whole lines of a journal, none if there is no journal: what follows the last of them was being written when the
/// program ended.
fn whole_lines(path: &Path) -> Result<String, Failure> {
    let read = |source| Failure::Read {
        path: path.to_owned(),
        source,
    };
    let mut bytes = match fs::read(path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == ErrorKind::NotFound => Vec::new(),
        Err(error) => return Err(read(error)),
    };
    bytes.truncate(
        bytes
            .iter()
            .rposition(|byte| *byte == b'\n')
            .map_or(0, |end| end + 1),
    );
    String::from_utf8(bytes).map_err(|_| {
        Failure::Usage(format!(
            "{} is damaged: give --restart to begin anew, or another --out",
            path.display()
        ))
    })
}

fn line(row: &Row) -> String {
    // Numbers in rows are finite or absent, so there is nothing that JSON can't hold.
    serde_json::to_string(row).map_or_else(|_| String::new(), |text| text + "\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_a_line_cut_inside_a_letter_costs_that_line_only() {
        let out = std::env::temp_dir().join(format!("sifre-journal-{}.csv", std::process::id()));
        let path = path_of(&out);
        fs::write(&path, b"{\"whole\":1}\n{\"name\":\"\xc3").unwrap();
        assert_eq!(whole_lines(&path).unwrap(), "{\"whole\":1}\n");
        fs::write(&path, b"\xff\n").unwrap();
        assert!(whole_lines(&path).unwrap_err().to_string().contains("damaged"));
        fs::remove_file(&path).unwrap();
        assert_eq!(whole_lines(&path).unwrap(), "");
    }
}
