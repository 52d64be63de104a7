//! Files on disk: scenarios, and the vehicles and stations that they name.

use crate::exit::Failure;
use output::TEXT_LIMIT;
use scenario::{Files, Scenario};
use std::cell::RefCell;
use std::collections::BTreeMap;
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

    /// The path of a file by its name in the scenario.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }
}

impl Files for Beside {
    fn text(&self, name: &str) -> Result<String, io::Error> {
        output::read_text(&self.path(name), TEXT_LIMIT)
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

/// The text of a file that people write.
pub(crate) fn read(path: &Path) -> Result<String, Failure> {
    read_up_to(path, TEXT_LIMIT)
}

/// The text of a file that the program wrote, up to so many bytes.
pub(crate) fn read_up_to(path: &Path, limit: u64) -> Result<String, Failure> {
    output::read_text(path, limit).map_err(|source| Failure::Read {
        path: path.to_owned(),
        source,
    })
}

/// The files that a run reads: its scenario, and what that names.
pub(crate) fn inputs(path: &Path, scenario: &Scenario) -> Vec<PathBuf> {
    let beside = Beside::of(path);
    let named = scenario.named_files().map(|name| beside.path(name));
    std::iter::once(path.to_owned()).chain(named).collect()
}

/// Refuses outputs that are inputs or each other, and outputs that can't be written: to be asked before the first of them is opened.
pub(crate) fn check_outputs(inputs: &[PathBuf], outputs: &[PathBuf]) -> Result<(), Failure> {
    output::keep_apart(inputs, outputs)?;
    outputs.iter().try_for_each(|path| {
        output::can_be_written(path).map_err(|source| Failure::Write {
            path: path.clone(),
            source,
        })
    })
}

/// Writes a file atomically: whenever the program ends, the old or the new one is complete.
pub(crate) fn replace(path: &Path, content: impl AsRef<[u8]>) -> Result<(), Failure> {
    output::replace(path, content).map_err(|source| Failure::Write {
        path: path.to_owned(),
        source,
    })
}
