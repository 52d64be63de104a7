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

impl Beside {
    /// The path of a file by its name in the scenario.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }
}

impl Files for Beside {
    fn text(&self, name: &str) -> Result<String, io::Error> {
        fs::read_to_string(self.path(name))
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

/// Refuses to write over a file that is read.
pub(crate) fn is_no_input(output: &Path, inputs: &[PathBuf]) -> Result<(), Failure> {
    let Ok(output) = output.canonicalize() else {
        return Ok(()); // Not there yet.
    };
    if inputs
        .iter()
        .any(|input| input.canonicalize().is_ok_and(|input| input == output))
    {
        return Err(Failure::Usage(format!(
            "{} is an input of this flight and would be written over: give the output another name",
            output.display()
        )));
    }
    Ok(())
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
