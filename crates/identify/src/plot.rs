//! The picture of an identification: data with the fit, and the residuals below.

use quad_plot::figure::Legends;
use quad_plot::style::{INK, Look};
use quad_plot::{Figure, Panel, raster, series_style};
use std::error::Error;
use std::path::{Path, PathBuf};

/// Look of the measurements, of the fit and of the residuals.
pub(crate) const DATA: Look = series_style(0);
pub(crate) const FIT: Look = Look::solid(INK, 1.4);
/// Markers more than this hide each other: a line shows the data better.
const MOST_MARKERS: usize = 400;
/// Points of a drawn curve.
const CURVE_POINTS: u32 = 200;

/// Checks that the end of a file's name says a format that can be drawn.
pub(crate) fn path(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    match format(&path) {
        Some(_) => Ok(path),
        None => Err("a plot must end in .svg or .png".to_owned()),
    }
}

#[derive(Clone, Copy)]
enum Format {
    Svg,
    Png,
}

fn format(path: &Path) -> Option<Format> {
    let end = path.extension()?.to_str()?.to_ascii_lowercase();
    match end.as_str() {
        "svg" => Some(Format::Svg),
        "png" => Some(Format::Png),
        _ => None,
    }
}

/// A figure as the bytes of the file of this name.
pub(crate) fn drawn(path: &Path, figure: &Figure) -> Result<Vec<u8>, Box<dyn Error>> {
    let svg = figure.draw();
    Ok(match format(path) {
        Some(Format::Png) => raster::png(&svg)?,
        _ => svg.document().into_bytes(),
    })
}

/// An empty figure of so many columns.
pub(crate) fn figure(columns: usize) -> Figure {
    Figure::columns(columns)
        .legends(Legends::EachPanel)
        .panel_size(if columns == 1 { 560.0 } else { 380.0 }, 210.0)
}

/// Measured points: markers, or a line if there are too many.
pub(crate) fn measured(panel: Panel, points: Vec<(f64, f64)>) -> Panel {
    if points.len() > MOST_MARKERS {
        panel.line("measured", Look { width: 1.2, ..DATA }, points)
    } else {
        panel.markers("measured", DATA, points)
    }
}

/// Residuals over an abscissa, with the line of zero.
pub(crate) fn residuals(panel: Panel, points: Vec<(f64, f64)>) -> Panel {
    let panel = if points.len() > MOST_MARKERS {
        panel.line("", Look { width: 1.0, ..DATA }, points)
    } else {
        panel.markers("", DATA, points)
    };
    panel.horizontal(0.0, "")
}

/// A curve over a range.
pub(crate) fn curve(from: f64, to: f64, value: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    let step = (to - from) / f64::from(CURVE_POINTS);
    let x = (0..=CURVE_POINTS).map(|k| from + step * f64::from(k));
    x.map(|x| (x, value(x))).collect()
}

/// Free space at each end of an axis, as a share of it: a marker at the end is not cut.
const PADDING: f64 = 0.04;

/// The same horizontal range, a little wider than the numbers, for panels that stand above each other.
pub(crate) fn wide(panel: Panel, values: impl Iterator<Item = f64> + Clone) -> Panel {
    let (from, to) = span(values);
    let padding = PADDING * (to - from);
    panel.x_range(from - padding, to + padding)
}

/// Smallest and largest of some numbers.
pub(crate) fn span(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    (
        values.clone().fold(f64::INFINITY, f64::min),
        values.fold(f64::NEG_INFINITY, f64::max),
    )
}
