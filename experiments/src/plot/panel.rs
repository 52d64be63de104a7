//! A panel: one pair of axes with lines, markers, error bars, bands and reference lines, drawn by kuva.

use kuva::plot::{BandPlot, LinePlot, LineStyle, MarkerShape, ScatterPlot};
use kuva::render::plots::Plot;

use super::axis::{Axis, Scale, SettledAxis};
use super::decimate::{Resolution, decimate};
use super::legend::{Entry, Sample};
use super::style::{Look, Marker};

/// One pair of axes and what is drawn in it. Later layers lie above earlier ones.
#[derive(Clone, Debug, Default)]
pub struct Panel {
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Words above the panel, after its letter. Rich text.
    pub caption: String,
    /// Whether one unit is as long on both axes.
    pub equal_aspect: bool,
    pub(super) layers: Vec<Layer>,
    pub(super) rules: Vec<Rule>,
    pub(super) notes: Vec<Note>,
    pub(super) included: Vec<(f64, f64)>,
}

/// A measured point with the half-width of its interval along y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorBar {
    /// Abscissa.
    pub x: f64,
    /// Ordinate.
    pub y: f64,
    /// Half-width of the interval along y.
    pub half_width: f64,
}

/// A point of a band: its lower and upper limit at `x`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BandPoint {
    /// Abscissa.
    pub x: f64,
    /// Lower limit.
    pub lower: f64,
    /// Upper limit.
    pub upper: f64,
}

#[derive(Clone, Debug)]
pub(super) enum Layer {
    Line { label: String, look: Look, points: Vec<(f64, f64)> },
    Markers { label: String, look: Look, points: Vec<ErrorBar> },
    Band { label: String, look: Look, points: Vec<BandPoint> },
    Kuva { plot: Box<Plot>, bounds: Option<((f64, f64), (f64, f64))> },
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

impl Panel {
    /// An empty panel with axis labels: symbol and unit, as in `Panel::new("Time *t*, s", "Height *z*, m")`.
    pub fn new(x_label: impl Into<String>, y_label: impl Into<String>) -> Self {
        let axis = |label: String| Axis { label, ..Axis::default() };
        Self { x: axis(x_label.into()), y: axis(y_label.into()), ..Self::default() }
    }

    /// Adds a line through the points. An empty label keeps it out of the legend; points that are not finite leave
    /// a gap; long series are thinned when drawn.
    pub fn line(mut self, label: impl Into<String>, look: Look, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let points = points.into_iter().collect();
        self.layers.push(Layer::Line { label: label.into(), look, points });
        self
    }

    /// Adds markers at the points.
    pub fn markers(self, label: impl Into<String>, look: Look, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        self.error_bars(label, look, points.into_iter().map(|(x, y)| ErrorBar { x, y, half_width: 0.0 }))
    }

    /// Adds markers with error bars along y.
    pub fn error_bars(
        mut self,
        label: impl Into<String>,
        look: Look,
        points: impl IntoIterator<Item = ErrorBar>,
    ) -> Self {
        let points = points.into_iter().collect();
        self.layers.push(Layer::Markers { label: label.into(), look, points });
        self
    }

    /// Adds a shaded band, such as a confidence interval.
    pub fn band(
        mut self,
        label: impl Into<String>,
        look: Look,
        points: impl IntoIterator<Item = BandPoint>,
    ) -> Self {
        let points = points.into_iter().collect();
        self.layers.push(Layer::Band { label: label.into(), look, points });
        self
    }

    /// Adds any plot of kuva's (contours, heat maps, bars, arrows); set the ranges if kuva states no bounds for it.
    pub fn kuva(mut self, plot: Plot) -> Self {
        let bounds = plot.bounds();
        self.layers.push(Layer::Kuva { plot: Box::new(plot), bounds });
        self
    }

    /// Adds a thin dashed line at this ordinate, with words at its right end (or none).
    pub fn horizontal(mut self, y: f64, label: impl Into<String>) -> Self {
        self.rules.push(Rule { value: y, vertical: false, label: label.into() });
        self.included.push((f64::NAN, y));
        self
    }

    /// Adds a thin dashed line at this abscissa, with words at its top (or none).
    pub fn vertical(mut self, x: f64, label: impl Into<String>) -> Self {
        self.rules.push(Rule { value: x, vertical: true, label: label.into() });
        self.included.push((x, f64::NAN));
        self
    }

    /// Writes words centred just above a point of the panel.
    pub fn annotate(mut self, x: f64, y: f64, text: impl Into<String>) -> Self {
        self.notes.push(Note { x, y, text: text.into() });
        self
    }

    /// Sets the range of the horizontal axis.
    pub fn x_range(mut self, min: f64, max: f64) -> Self {
        self.x.range = Some((min, max));
        self
    }

    /// Sets the range of the vertical axis.
    pub fn y_range(mut self, min: f64, max: f64) -> Self {
        self.y.range = Some((min, max));
        self
    }

    /// Widens the vertical axis so that it shows this value.
    pub fn y_include(mut self, y: f64) -> Self {
        self.included.push((f64::NAN, y));
        self
    }

    /// Sets the distance between ticks of the horizontal axis.
    pub fn x_step(mut self, step: f64) -> Self {
        self.x.step = Some(step);
        self
    }

    /// Sets the distance between ticks of the vertical axis.
    pub fn y_step(mut self, step: f64) -> Self {
        self.y.step = Some(step);
        self
    }

    /// Makes the horizontal axis logarithmic; values that are not positive are left out.
    pub fn log_x(mut self) -> Self {
        self.x.scale = Scale::Log;
        self
    }

    /// Makes the vertical axis logarithmic; values that are not positive are left out.
    pub fn log_y(mut self) -> Self {
        self.y.scale = Scale::Log;
        self
    }

    /// Names the categories at abscissae 1, 2, … (for bars) instead of numbers.
    pub fn x_categories<S: Into<String>>(mut self, names: impl IntoIterator<Item = S>) -> Self {
        self.x.categories = names.into_iter().map(Into::into).collect();
        self
    }

    /// Makes one unit equally long on both axes.
    pub fn equal_aspect(mut self) -> Self {
        self.equal_aspect = true;
        self
    }

    /// Sets the words above the panel. Rich text.
    pub fn caption(mut self, caption: impl Into<String>) -> Self {
        self.caption = caption.into();
        self
    }

    /// All abscissae and ordinates that the axes must cover.
    pub(super) fn extent(&self) -> Vec<(f64, f64)> {
        let mut extent = self.included.clone();
        for layer in &self.layers {
            match layer {
                Layer::Line { points, .. } => extent.extend(points),
                Layer::Markers { points, .. } => {
                    extent.extend(points.iter().flat_map(|p| [(p.x, p.y - p.half_width), (p.x, p.y + p.half_width)]));
                }
                Layer::Band { points, .. } => {
                    extent.extend(points.iter().flat_map(|p| [(p.x, p.lower), (p.x, p.upper)]));
                }
                Layer::Kuva { bounds: Some(((x0, x1), (y0, y1))), .. } => extent.extend([(*x0, *y0), (*x1, *y1)]),
                Layer::Kuva { bounds: None, .. } => {}
            }
        }
        extent
    }

    /// Whether every line runs from left to right, as a function of time does; such an axis needs no padding.
    pub(super) fn runs_along_x(&self) -> bool {
        let mut lines = self.layers.iter().filter_map(|layer| match layer {
            Layer::Line { points, .. } => Some(points),
            _ => None,
        });
        let rises = |points: &Vec<(f64, f64)>| points.windows(2).all(|pair| pair[1].0 >= pair[0].0 || pair[1].0.is_nan());
        let mut any = false;
        let all = lines.all(|points| {
            any = true;
            rises(points)
        });
        any && all
    }

    /// Legend entries of this panel, in order.
    pub(super) fn entries(&self) -> Vec<Entry> {
        let mut entries: Vec<Entry> = Vec::new();
        for layer in &self.layers {
            let (label, look, sample) = match layer {
                Layer::Line { label, look, .. } => (label, look, Sample::Line),
                Layer::Markers { label, look, .. } => (label, look, Sample::Marker),
                Layer::Band { label, look, .. } => (label, look, Sample::Band),
                Layer::Kuva { .. } => continue,
            };
            if !label.is_empty() {
                entries.push(Entry { label: label.clone(), look: *look, sample });
            }
        }
        entries
    }

    /// The panel's layers as kuva's plots, thinned to the resolution of the axes.
    pub(super) fn plots(&self, x: &SettledAxis, y: &SettledAxis, width: f64, height: f64) -> Vec<Plot> {
        let thin = |points: &[(f64, f64)]| thinned(points, (x, y), (width, height));
        let mut plots = Vec::new();
        for layer in &self.layers {
            match layer {
                Layer::Line { look, points, .. } => {
                    plots.extend(thin(points).into_iter().map(|run| Plot::Line(line_plot(look, run))));
                }
                Layer::Markers { look, points, .. } => plots.push(Plot::Scatter(scatter_plot(look, points))),
                Layer::Band { look, points, .. } => plots.push(Plot::Band(band_plot(look, points))),
                Layer::Kuva { plot, .. } => plots.push((**plot).clone()),
            }
        }
        plots
    }
}

/// Runs of the points that a reader can tell apart, in data units.
fn thinned(points: &[(f64, f64)], axes: (&SettledAxis, &SettledAxis), size: (f64, f64)) -> Vec<Vec<(f64, f64)>> {
    let along = |value: f64, scale: Scale| if scale == Scale::Log { value.log10() } else { value };
    let back = |value: f64, scale: Scale| if scale == Scale::Log { 10f64.powf(value) } else { value };
    let length = |axis: &SettledAxis| along(axis.max, axis.scale) - along(axis.min, axis.scale);
    let resolution = Resolution { x: size.0 / length(axes.0), y: size.1 / length(axes.1) };
    let scaled: Vec<_> = points.iter().map(|p| (along(p.0, axes.0.scale), along(p.1, axes.1.scale))).collect();
    let mut runs = decimate(&scaled, resolution);
    for point in runs.iter_mut().flatten() {
        *point = (back(point.0, axes.0.scale), back(point.1, axes.1.scale));
    }
    runs
}

fn line_plot(look: &Look, points: Vec<(f64, f64)>) -> LinePlot {
    let style = if look.dash.is_empty() { LineStyle::Solid } else { LineStyle::Custom(look.dash.into()) };
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
        .with_size(MARKER_SIZE)
        .with_marker(shape(look.marker));
    if points.iter().any(|p| p.half_width > 0.0) { plot.with_y_err(points.iter().map(|p| p.half_width)) } else { plot }
}

fn band_plot(look: &Look, points: &[BandPoint]) -> BandPlot {
    let column = |value: fn(&BandPoint) -> f64| points.iter().map(value).collect::<Vec<_>>();
    BandPlot::new(column(|p| p.x), column(|p| p.lower), column(|p| p.upper))
        .with_color(look.colour)
        .with_opacity(BAND_OPACITY)
}

/// kuva's name of a marker.
pub(super) fn shape(marker: Marker) -> MarkerShape {
    match marker {
        Marker::Circle => MarkerShape::Circle,
        Marker::Square => MarkerShape::Square,
        Marker::Triangle => MarkerShape::Triangle,
        Marker::Diamond => MarkerShape::Diamond,
        Marker::TriangleDown => MarkerShape::TriangleDown,
        Marker::Cross => MarkerShape::Cross,
    }
}
