//! Pictures on disk.

use crate::disk;
use crate::exit::Failure;
use quad_plot::{Figure, raster};
use std::path::Path;

/// Writes a figure, as PNG or SVG by the path's ending.
pub(crate) fn write(path: &Path, figure: &Figure) -> Result<(), Failure> {
    let svg = figure.draw();
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("png") => {
            let png =
                raster::png(&svg).map_err(|error| Failure::Usage(format!("{}: {error}", path.display())))?;
            disk::write(path, png)
        }
        Some("svg") => disk::write(path, svg.document()),
        _ => Err(Failure::Usage(format!(
            "{}: a picture ends in .svg or .png",
            path.display()
        ))),
    }
}

/// Refuses a path that no picture can be written to, before anything is flown.
pub(crate) fn check(path: &Path) -> Result<(), Failure> {
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("png" | "svg") => Ok(()),
        _ => Err(Failure::Usage(format!(
            "{}: a picture ends in .svg or .png",
            path.display()
        ))),
    }
}
