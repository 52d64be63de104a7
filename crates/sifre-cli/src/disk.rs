//! Files on disk: scenarios, and the vehicles and stations that they name.

use crate::exit::Failure;
use scenario::Files;
use std::cell::RefCell;
use std::collections::BTreeMap;
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

/// Files that remember what was read of them.
#[derive(Debug)]
pub(crate) struct Remembering<'a> {
    files: &'a Beside,
    /// The texts by the names of their files.
    pub(crate) read: RefCell<BTreeMap<String, String>>,
}

impl<'a> Remembering<'a> {
    /// Nothing read yet.
    pub(crate) fn of(files: &'a Beside) -> Self {
        Self {
            files,
            read: RefCell::default(),
        }
    }
}

impl Files for Remembering<'_> {
    fn text(&self, name: &str) -> Result<String, io::Error> {
        let text = self.files.text(name)?;
        self.read.borrow_mut().insert(name.to_owned(), text.clone());
        Ok(text)
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
