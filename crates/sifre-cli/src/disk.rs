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

/// Writes a file beside the one of this name, then gives it the name: whenever the program ends, one of the two is whole.
pub(crate) fn replace(path: &Path, content: impl AsRef<[u8]>) -> Result<(), Failure> {
    let fresh = beside(path);
    fs::write(&fresh, content)
        .and_then(|()| fs::rename(&fresh, path))
        .map_err(|source| Failure::Write {
            path: path.to_owned(),
            source,
        })
}

/// Whether a file can be replaced, before a long flight and not after it.
pub(crate) fn can_be_replaced(path: &Path) -> Result<(), Failure> {
    let fresh = beside(path);
    fs::write(&fresh, "")
        .and_then(|()| fs::remove_file(&fresh))
        .map_err(|source| Failure::Write {
            path: path.to_owned(),
            source,
        })
}

fn beside(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".new");
    name.into()
}

/// Writes a file anew.
pub(crate) fn write(path: &Path, content: impl AsRef<[u8]>) -> Result<(), Failure> {
    fs::write(path, content).map_err(|source| Failure::Write {
        path: path.to_owned(),
        source,
    })
}
