//! `summary.json`: what each item's last run gave.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::claim::ClaimRecord;
use crate::item::{Item, Kind, Origin};
use crate::output::{OutputError, save_file};

/// Name of the file in the output folder.
pub const FILE: &str = "summary.json";

/// The last result of each item.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// One record per item, in reading order.
    pub items: Vec<Record>,
}

/// The last result of one item.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Identifier.
    pub id: String,
    /// Title.
    pub title: String,
    /// What kind of thing it is.
    pub kind: Kind,
    /// Where its data come from.
    pub origin: Origin,
    /// How the run ended.
    #[serde(flatten)]
    pub status: Status,
    /// The claims that were checked.
    pub claims: Vec<ClaimRecord>,
    /// Run time, s.
    pub seconds: f64,
    /// Whether it was a shorter run.
    pub quick: bool,
    /// Names of the files written, in the output folder.
    pub files: Vec<String>,
    /// Remarks.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

/// How the run of an item ended.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "status", rename_all = "kebab-case")]
pub enum Status {
    /// It was made.
    Drawn,
    /// It cannot be made.
    NotReproducible {
        /// Why not.
        reason: String,
    },
    /// It should have been made and was not.
    Failed {
        /// What went wrong.
        error: String,
    },
}

impl Record {
    /// Whether the item was made and all its claims came out as registered; photographs are as they should be.
    pub fn is_as_registered(&self) -> bool {
        !matches!(self.status, Status::Failed { .. }) && self.claims.iter().all(ClaimRecord::as_registered)
    }
}

/// How the claims of a run came out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Those that hold, as registered.
    pub held: usize,
    /// Those that do not hold, as registered.
    pub not_held: usize,
    /// Those that differ from what is registered.
    pub differing: usize,
}

impl Counts {
    /// Of all claims of these items.
    pub fn of(records: &[Record]) -> Self {
        let mut counts = Self::default();
        for claim in records.iter().flat_map(|record| &record.claims) {
            *match (claim.as_registered(), claim.pass) {
                (false, _) => &mut counts.differing,
                (true, true) => &mut counts.held,
                (true, false) => &mut counts.not_held,
            } += 1;
        }
        counts
    }

    /// All.
    pub fn total(&self) -> usize {
        self.held + self.not_held + self.differing
    }
}

/// Why the previous summary could not be read.
#[derive(Debug, thiserror::Error)]
pub enum SummaryError {
    /// The file exists but cannot be read.
    #[error("cannot read {path}: {source}")]
    Read {
        /// The file.
        path: PathBuf,
        /// What went wrong.
        source: io::Error,
    },
    /// The file is not a summary.
    #[error("{path} is not a summary of this program: {source}; delete it to start again")]
    Parse {
        /// The file.
        path: PathBuf,
        /// What went wrong.
        source: serde_json::Error,
    },
}

impl Summary {
    /// The summary of an earlier run in this folder, empty if there was none.
    ///
    /// # Errors
    /// A file that cannot be read or is no summary.
    pub fn load(folder: &Path) -> Result<Self, SummaryError> {
        let path = folder.join(FILE);
        match fs::read(&path) {
            Ok(bytes) => {
                serde_json::from_slice(&bytes).map_err(|source| SummaryError::Parse { path, source })
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Self::default()),
            Err(source) => Err(SummaryError::Read { path, source }),
        }
    }

    /// Puts a new record in the place of the item's old one.
    pub fn replace(&mut self, record: Record) {
        self.items.retain(|old| old.id != record.id);
        self.items.push(record);
    }

    /// Drops records of items that exist no more, and puts the others in reading order.
    pub fn arrange(&mut self, items: &[Item]) {
        let position = |record: &Record| items.iter().position(|item| item.id == record.id);
        self.items.retain(|record| position(record).is_some());
        self.items.sort_by_key(position);
    }

    /// The record of an item.
    pub fn get(&self, id: &str) -> Option<&Record> {
        self.items.iter().find(|record| record.id == id)
    }

    /// Writes the summary into the folder.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn save(&self, folder: &Path) -> Result<(), OutputError> {
        let path = folder.join(FILE);
        let text = serde_json::to_string_pretty(self).map_err(|error| OutputError::Write {
            path: path.clone(),
            source: io::Error::other(error),
        })?;
        save_file(&path, (text + "\n").as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures;

    fn record(id: &str, seconds: f64) -> Record {
        Record {
            id: id.into(),
            title: "title".into(),
            kind: Kind::Diagram,
            origin: Origin::Schematic,
            status: Status::NotReproducible {
                reason: "photograph".into(),
            },
            claims: vec![],
            seconds,
            quick: false,
            files: vec![],
            notes: vec![],
        }
    }

    #[test]
    fn prop_a_subset_keeps_the_other_results() {
        let mut summary = Summary {
            items: vec![record("6.1", 1.0), record("gone", 1.0), record("5.1", 1.0)],
        };
        summary.replace(record("6.1", 2.0));
        summary.arrange(&figures::all());
        let found: Vec<_> = summary.items.iter().map(|r| (r.id.as_str(), r.seconds)).collect();
        assert_eq!(found, [("5.1", 1.0), ("6.1", 2.0)]);
    }

    #[test]
    fn prop_round_trip_and_keys() {
        let summary = Summary {
            items: vec![record("1.1", 0.5)],
        };
        let json = serde_json::to_string(&summary).expect("plain data");
        assert!(
            json.contains(r#""status":"not-reproducible","reason":"photograph""#),
            "{json}"
        );
        assert_eq!(
            serde_json::from_str::<Summary>(&json).expect("our own text"),
            summary
        );
    }
}
