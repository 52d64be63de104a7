//! Where recorded flights are found: they are not part of the repository (see `data/README.md`).
//!
//! The folder that the environment variable `QUAD_DATA` names, else `data/external/`. With neither, an item that needs
//! them is *not reproducible on this machine*, which is no failure. A folder that was named, or exists, must hold the
//! file: if not, the item fails, so that a build server that has the recordings can't leave them out unnoticed.

use std::fs::File;
use std::path::{Path, PathBuf};

use sysid::recorded::{InertialLog, MotionCaptureFlight, read_arpl, read_nanobench};

use crate::item::{Context, ItemError};

/// Name of the environment variable that names the folder.
pub const VARIABLE: &str = "QUAD_DATA";

/// Opens a recorded file by its path below the folder.
///
/// # Errors
/// Missing data where there is no folder; a failure where the folder lacks the file.
pub fn open(context: &Context, relative: &str) -> Result<File, ItemError> {
    let named = std::env::var_os(VARIABLE).map(PathBuf::from);
    open_in(named.as_deref(), &context.data("external"), relative)
}

fn open_in(named: Option<&Path>, own: &Path, relative: &str) -> Result<File, ItemError> {
    let Some(folder) = named.or_else(|| own.is_dir().then_some(own)) else {
        return Err(ItemError::missing_data(format!(
            "the recorded flights are missing: set {VARIABLE} to their folder or fill data/external/ \
             (see data/README.md)"
        )));
    };
    let path = folder.join(relative);
    File::open(&path).map_err(|error| ItemError::new(format!("{}: {error}", path.display())))
}

/// A flight of the ARPL set, by the name of its file.
///
/// # Errors
/// As [`open`]; a file that can't be read.
pub fn arpl(context: &Context, name: &str) -> Result<InertialLog, ItemError> {
    Ok(read_arpl(open(
        context,
        &format!("arpl_crazyflie_sysid/{name}"),
    )?)?)
}

/// A flight of the NanoBench set, by the name of its file.
///
/// # Errors
/// As [`open`]; a file that can't be read.
pub fn nanobench(context: &Context, name: &str) -> Result<MotionCaptureFlight, ItemError> {
    Ok(read_nanobench(open(context, &format!("nanobench/{name}"))?)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_no_folder_is_missing_data_and_a_folder_without_the_file_a_failure() {
        let nowhere = Path::new("/nowhere/at/all");
        let absent = open_in(None, nowhere, "a.csv").expect_err("no folder");
        assert!(absent.missing().is_some_and(|reason| reason.contains(VARIABLE)));
        let named = open_in(Some(nowhere), nowhere, "a.csv").expect_err("no file");
        assert!(named.missing().is_none() && named.to_string().contains("a.csv"));
    }
}
