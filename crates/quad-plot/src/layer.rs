//! What a panel is made of, and how kuva draws it.

use std::fmt;
use std::sync::Arc;

use kuva::plot::{BandPlot, LinePlot, LineStyle, MarkerShape, ScatterPlot};
use kuva::render::plots::Plot;

use super::axis::{Scale, SettledAxis};
use super::decimate::{Resolution, decimate};
use super::legend::{DOT, Entry, Sample};
use super::panel::{BandPoint, ErrorBar};
use super::style::{Look, Marker};

/// One thing drawn in a panel.
#[derive(Clone, Debug)]
pub(super) enum Layer {
    Line {
        label: String,
        look: Look,
        points: Vec<(f64, f64)>,
    },
    Markers {
        label: String,
        look: Look,
        points: Vec<ErrorBar>,
    },
    Band {
        label: String,
        look: Look,
        points: Vec<BandPoint>,
    },
    Kuva {
        plot: Factory,
        bounds: Option<((f64, f64), (f64, f64))>,
    },
}

/// Makes a plot of kuva's, which cannot be cloned.
#[derive(Clone)]
pub(super) struct Factory(Arc<dyn Fn() -> Plot + Send + Sync>);

impl Factory {
    pub(super) fn new(plot: impl Fn() -> Plot + Send + Sync + 'static) -> Self {
        Self(Arc::new(plot))
    }
}

impl fmt::Debug for Factory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Factory")
    }
}

/// A line across the whole panel.
#[derive(Clone, Debug)]
pub(super) struct Rule {
    pub(super) value: f64,
    pub(super) vertical: bool,
    pub(super) label: String,
}

/// Words at a point of the panel.
#[derive(Clone, Debug)]
pub(super) struct Note {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) text: String,
}

/// Radius of markers, px.
const MARKER_SIZE: f64 = 3.2;
/// Opacity of bands.
const BAND_OPACITY: f64 = 0.22;

impl Layer {
    /// Points that the axes must cover.
    pub(super) fn extent(&self) -> Vec<(f64, f64)> {
        match self {
            Self::Line { points, .. } => points.clone(),
            Self::Markers { points, .. } => points
                .iter()
                .flat_map(|p| [(p.x, p.y - p.half_width), (p.x, p.y + p.half_width)])
                .collect(),
            Self::Band { points, .. } => points
                .iter()
                .flat_map(|p| [(p.x, p.lower), (p.x, p.upper)])
                .collect(),
            Self::Kuva {
                bounds: Some(((x0, x1), (y0, y1))),
                ..
            } => vec![(*x0, *y0), (*x1, *y1)],
            Self::Kuva { bounds: None, .. } => Vec::new(),
        }
    }

    /// The points of a line.
    pub(super) fn line_points(&self) -> Option<&[(f64, f64)]> {
        match self {
            Self::Line { points, .. } => Some(points),
            _ => None,
        }
    }

    /// The legend entry, with an empty label if it is to be left out.
    pub(super) fn entry(&self) -> Option<Entry> {
        let (label, look, sample) = match self {
            Self::Line { label, look, .. } => (label, look, Sample::Line),
            Self::Markers { label, look, .. } => (label, look, Sample::Marker),
            Self::Band { label, look, .. } => (label, look, Sample::Band),
            Self::Kuva { .. } => return None,
        };
        Some(Entry {
            label: label.clone(),
            look: *look,
            sample,
        })
    }

    /// The layer as kuva's plots.
    pub(super) fn plots(&self, axes: (&SettledAxis, &SettledAxis), size: (f64, f64)) -> Vec<Plot> {
        match self {
            Self::Line { look, points, .. } => thinned(points, axes, size)
                .into_iter()
                .map(|run| Plot::Line(line_plot(look, run)))
                .collect(),
            Self::Markers { look, points, .. } => vec![Plot::Scatter(scatter_plot(look, points))],
            Self::Band { look, points, .. } => vec![Plot::Band(band_plot(look, points))],
            Self::Kuva { plot, .. } => vec![(plot.0)()],
        }
    }
}

/// Runs of the points that a reader can tell apart, in data units.
fn thinned(
    points: &[(f64, f64)],
    axes: (&SettledAxis, &SettledAxis),
    size: (f64, f64),
) -> Vec<Vec<(f64, f64)>> {
    let along = |value: f64, scale: Scale| if scale == Scale::Log { value.log10() } else { value };
    let back = |value: f64, scale: Scale| {
        if scale == Scale::Log {
            10f64.powf(value)
        } else {
            value
        }
    };
    let length = |axis: &SettledAxis| along(axis.max, axis.scale) - along(axis.min, axis.scale);
    let resolution = Resolution {
        x: size.0 / length(axes.0),
        y: size.1 / length(axes.1),
    };
    let scaled: Vec<_> = points
        .iter()
        .map(|p| (along(p.0, axes.0.scale), along(p.1, axes.1.scale)))
        .collect();
    let mut runs = decimate(&scaled, resolution);
    for point in runs.iter_mut().flatten() {
        *point = (back(point.0, axes.0.scale), back(point.1, axes.1.scale));
    }
    runs
}

fn line_plot(look: &Look, points: Vec<(f64, f64)>) -> LinePlot {
    let style = if look.dash.is_empty() {
        LineStyle::Solid
    } else {
        LineStyle::Custom(look.dash.into())
    };
    LinePlot::new()
        .with_data(points)
        .with_color(look.colour)
        .with_stroke_width(look.width)
        .with_line_style(style)
}

fn scatter_plot(look: &Look, points: &[ErrorBar]) -> ScatterPlot {
    let plot = ScatterPlot::new()
        .with_data(points.iter().map(|p| (p.x, p.y)))
        .with_color(look.colour)
        .with_size(size(look.marker))
        .with_marker(shape(look.marker));
    if points.iter().any(|p| p.half_width > 0.0) {
        plot.with_y_err(points.iter().map(|p| p.half_width))
    } else {
        plot
    }
}

fn band_plot(look: &Look, points: &[BandPoint]) -> BandPlot {
    let column = |value: fn(&BandPoint) -> f64| points.iter().map(value).collect::<Vec<_>>();
    BandPlot::new(column(|p| p.x), column(|p| p.lower), column(|p| p.upper))
        .with_color(look.colour)
        .with_opacity(BAND_OPACITY)
}

/// Size of a marker, px.
fn size(marker: Marker) -> f64 {
    match marker {
        Marker::Dot => DOT * MARKER_SIZE,
        _ => MARKER_SIZE,
    }
}

/// kuva's name of a marker.
fn shape(marker: Marker) -> MarkerShape {
    match marker {
        Marker::Circle | Marker::Dot => MarkerShape::Circle,
        Marker::Square => MarkerShape::Square,
        Marker::Triangle => MarkerShape::Triangle,
        Marker::Diamond => MarkerShape::Diamond,
        Marker::TriangleDown => MarkerShape::TriangleDown,
        Marker::Cross => MarkerShape::Cross,
    }
}
