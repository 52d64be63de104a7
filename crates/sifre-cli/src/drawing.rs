//! Pictures on disk.

use crate::disk;
use crate::exit::Failure;
use quad_plot::{Figure, raster};
use std::path::{Path, PathBuf};

/// Writes a figure, as PNG or SVG by the path's ending.
pub(crate) fn write(path: &Path, figure: &Figure) -> Result<(), Failure> {
    let svg = figure.draw();
    if is_png(path)? {
        let png =
            raster::png(&svg).map_err(|error| Failure::Usage(format!("{}: {error}", path.display())))?;
        disk::replace(path, png)
    } else {
        disk::replace(path, svg.document())
    }
}

/// Refuses a picture that can't be written, or that would be written over one of these inputs, before anything is flown.
pub(crate) fn check(picture: Option<&Path>, inputs: &[PathBuf]) -> Result<(), Failure> {
    let Some(path) = picture else {
        return Ok(());
    };
    is_png(path)?;
    disk::check_outputs(inputs, &[path.to_owned()])
}

/// Whether a picture is PNG or SVG, by its path's ending.
pub(crate) fn is_png(path: &Path) -> Result<bool, Failure> {
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("png") => Ok(true),
        Some("svg") => Ok(false),
        _ => Err(Failure::Usage(format!(
            "{}: a plot must end in .svg or .png",
            path.display()
        ))),
    }
}
