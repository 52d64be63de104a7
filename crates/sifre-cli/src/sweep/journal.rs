//! The journal of a sweep: a line that says which sweep, then a line per run as it is flown, each with its check sum before it.
//!
//! ```text
//! af63dc4c8601ec8c {"sifre_sweep":"85944171f73967e8"}
//! cbf29ce484222325 {"run":0,"end":"completed","exit_code":0,...}
//! ```
//!
//! A last line that was cut off is flown again. Any other line that is not as it was written is an error, and so is a run that the sweep
//! does not have. What a run varies is not in its line: it follows from the run's number.

use super::{Plan, Row};
use crate::exit::{Exit, Failure};
use output::checksum;
use std::fs::{self, File};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};

/// An open journal.
#[derive(Debug)]
pub(crate) struct Journal {
    /// The rows that it has, in order.
    pub(crate) rows: Vec<Row>,
    path: PathBuf,
    file: File,
}

/// The journal of a table.
pub(super) fn path_of(out: &Path) -> PathBuf {
    let mut name = out.as_os_str().to_owned();
    name.push(".journal");
    name.into()
}

impl Journal {
    /// Opens the journal of a table for this program alone, and reads what it has of this sweep.
    pub(super) fn open(out: &Path, plan: &Plan<'_>, restart: bool) -> Result<Self, Failure> {
        let path = path_of(out);
        let refuse = |source| Failure::Write {
            path: path.clone(),
            source,
        };
        let mut file = output::continue_alone(&path).map_err(refuse)?;
        if restart {
            file.set_len(0).map_err(refuse)?;
        }
        let text = complete_lines(&mut file).map_err(|source| Failure::Read {
            path: path.clone(),
            source,
        })?;
        let header = serde_json::json!({ "sifre_sweep": plan.fingerprint() }).to_string();
        let rows =
            read(&text, &header, plan).map_err(|why| Failure::Usage(format!("{}: {why}", path.display())))?;
        if text.is_empty() {
            file.write_all(line(&header).as_bytes()).map_err(refuse)?;
        }
        Ok(Self { rows, path, file })
    }

    /// Adds a row, on disk first.
    pub(super) fn add(&mut self, row: Row) -> Result<(), Failure> {
        // Numbers in rows are finite or absent, so there is nothing that JSON can't hold.
        let text = serde_json::to_string(&row).unwrap_or_default();
        self.file
            .write_all(line(&text).as_bytes())
            .map_err(|source| Failure::Write {
                path: self.path.clone(),
                source,
            })?;
        self.rows.push(row);
        Ok(())
    }

    /// Removes the journal of a table that is complete.
    pub(super) fn remove(out: &Path) {
        // A journal that stays does no harm.
        let _ = fs::remove_file(path_of(out));
    }
}

/// The complete lines of a journal; what follows the last of them, which was being written when the program ended, is cut off the file.
fn complete_lines(file: &mut File) -> io::Result<String> {
    let mut bytes = Vec::new();
    file.rewind()?;
    file.read_to_end(&mut bytes)?;
    let end = bytes
        .iter()
        .rposition(|byte| *byte == b'\n')
        .map_or(0, |end| end + 1);
    bytes.truncate(end);
    file.set_len(end as u64)?;
    String::from_utf8(bytes)
        .map_err(|_| io::Error::new(io::ErrorKind::InvalidData, format!("not UTF-8; {BEGIN_ANEW}")))
}

/// What to do about a journal that can't be used.
const BEGIN_ANEW: &str = "pass --restart to start again, or another --out";

/// The rows of a journal's complete lines; an empty text has none.
fn read(text: &str, header: &str, plan: &Plan<'_>) -> Result<Vec<Row>, String> {
    let mut lines = (1..).zip(text.lines());
    let damaged = |number: usize| format!("line {number} is damaged; {BEGIN_ANEW}");
    if let Some((_, first)) = lines.next() {
        match intact(first) {
            Some(found) if found == header => {}
            Some(found) if found.contains("sifre_sweep") => {
                return Err(format!("it belongs to another sweep; {BEGIN_ANEW}"));
            }
            _ => return Err(damaged(1)),
        }
    }
    let mut rows: Vec<Row> = Vec::new();
    for (number, line) in lines {
        let row = intact(line).and_then(|json| serde_json::from_str(json).ok());
        let mut row: Row = row.ok_or_else(|| damaged(number))?;
        if row.run >= plan.count {
            return Err(format!(
                "line {number} has run {}, but the sweep has {} runs; {BEGIN_ANEW}",
                row.run, plan.count
            ));
        }
        if ![Exit::Done, Exit::Early, Exit::BadInput]
            .map(Exit::code)
            .contains(&row.exit_code)
        {
            return Err(format!(
                "line {number} has the unknown exit code {}; {BEGIN_ANEW}",
                row.exit_code
            ));
        }
        row.inputs = plan.inputs(row.run);
        rows.push(row);
    }
    rows.sort_by_key(|row| row.run);
    rows.dedup_by_key(|row| row.run);
    Ok(rows)
}

/// The text of a line whose check sum fits.
fn intact(line: &str) -> Option<&str> {
    let (sum, text) = line.split_once(' ')?;
    (sum == checksum(text.as_bytes())).then_some(text)
}

fn line(text: &str) -> String {
    format!("{} {text}\n", checksum(text.as_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_a_line_cut_inside_a_letter_costs_that_line_only() {
        let path = std::env::temp_dir().join(format!("sifre-journal-{}", std::process::id()));
        fs::write(&path, b"{\"complete\":1}\n{\"name\":\"\xc3").unwrap();
        let mut file = output::continue_alone(&path).unwrap();
        assert_eq!(complete_lines(&mut file).unwrap(), "{\"complete\":1}\n");
        assert_eq!(fs::read(&path).unwrap(), b"{\"complete\":1}\n");
        fs::write(&path, b"\xff\n").unwrap();
        assert!(complete_lines(&mut file).is_err());
        fs::remove_file(&path).unwrap();
    }

    #[test]
    fn exact_a_changed_line_is_noticed() {
        let written = line("{\"run\":1}");
        assert_eq!(intact(written.trim_end()), Some("{\"run\":1}"));
        for changed in [written.replace('1', "2"), "{\"run\":1}".to_owned(), String::new()] {
            assert_eq!(intact(changed.trim_end()), None);
        }
    }
}
