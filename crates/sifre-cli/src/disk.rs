//! Files on disk: scenarios, and the vehicles and stations that they name.

use crate::exit::Failure;
use scenario::Files;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Files next to a scenario.
#[derive(Debug)]
pub(crate) struct Beside {
    folder: PathBuf,
}

impl Beside {
    /// Files relative to the folder of this scenario.
    pub(crate) fn of(scenario: &Path) -> Self {
        Self {
            folder: scenario.parent().map_or_else(PathBuf::new, Path::to_path_buf),
        }
    }
}

impl Files for Beside {
    fn text(&self, name: &str) -> Result<String, io::Error> {
        fs::read_to_string(self.folder.join(name))
    }
}

/// The text of a file.
pub(crate) fn read(path: &Path) -> Result<String, Failure> {
    fs::read_to_string(path).map_err(|source| Failure::Read {
        path: path.to_owned(),
        source,
    })
}

/// Writes a file anew.
pub(crate) fn write(path: &Path, content: impl AsRef<[u8]>) -> Result<(), Failure> {
    fs::write(path, content).map_err(|source| Failure::Write {
        path: path.to_owned(),
        source,
    })
}
