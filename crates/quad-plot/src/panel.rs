//! A panel: one pair of axes with lines, markers, error bars, bands, bars, contours, coloured cells and reference lines.

use std::cmp::Ordering::Greater;

use super::axis::{Axis, Scale};
pub use super::layer::{BandPoint, Bar, Cells, Contours, ErrorBar};
use super::layer::{Layer, Note, Rule};
use super::legend::{Entry, Sample};
use super::style::{Look, reference_style};

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

impl Panel {
    /// An empty panel with axis labels: symbol and unit, as in `Panel::new("Time *t*, s", "Height *z*, m")`.
    pub fn new(x_label: impl Into<String>, y_label: impl Into<String>) -> Self {
        let axis = |label: String| Axis {
            label,
            ..Axis::default()
        };
        Self {
            x: axis(x_label.into()),
            y: axis(y_label.into()),
            ..Self::default()
        }
    }

    /// Adds a line through the points. An empty label keeps it out of the legend; points that are not finite leave
    /// a gap; long series are thinned when drawn.
    pub fn line(
        mut self,
        label: impl Into<String>,
        look: Look,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        let points = points.into_iter().collect();
        self.layers.push(Layer::Line {
            label: label.into(),
            look,
            points,
        });
        self
    }

    /// Adds markers at the points.
    pub fn markers(
        self,
        label: impl Into<String>,
        look: Look,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        self.error_bars(
            label,
            look,
            points.into_iter().map(|(x, y)| ErrorBar {
                x,
                y,
                half_width: 0.0,
            }),
        )
    }

    /// Adds markers with error bars along y.
    pub fn error_bars(
        mut self,
        label: impl Into<String>,
        look: Look,
        points: impl IntoIterator<Item = ErrorBar>,
    ) -> Self {
        let points = points.into_iter().collect();
        self.layers.push(Layer::Markers {
            label: label.into(),
            look,
            points,
        });
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
        self.layers.push(Layer::Band {
            label: label.into(),
            look,
            points,
        });
        self
    }

    /// Adds bars of this width, in units of the horizontal axis.
    pub fn bars(mut self, label: impl Into<String>, width: f64, bars: impl IntoIterator<Item = Bar>) -> Self {
        self.layers.push(Layer::Bars {
            label: label.into(),
            width,
            bars: bars.into_iter().collect(),
        });
        self
    }

    /// Adds the contours of a field, the bands between them, or both.
    pub fn contours(mut self, contours: Contours) -> Self {
        self.layers.push(Layer::Contours(contours));
        self
    }

    /// Adds coloured rectangles, such as those of a matrix.
    pub fn cells(mut self, cells: Cells) -> Self {
        self.layers.push(Layer::Cells(cells));
        self
    }

    /// Adds a thin dashed line at this ordinate; its label, if any, is in the legend.
    pub fn horizontal(mut self, y: f64, label: impl Into<String>) -> Self {
        self.rules.push(Rule {
            value: y,
            vertical: false,
            label: label.into(),
        });
        self.included.push((f64::NAN, y));
        self
    }

    /// Adds a thin dashed line at this abscissa; its label, if any, is in the legend.
    pub fn vertical(mut self, x: f64, label: impl Into<String>) -> Self {
        self.rules.push(Rule {
            value: x,
            vertical: true,
            label: label.into(),
        });
        self.included.push((x, f64::NAN));
        self
    }

    /// Writes words centred just above a point of the panel.
    pub fn annotate(mut self, x: f64, y: f64, text: impl Into<String>) -> Self {
        self.notes.push(Note {
            x,
            y,
            text: text.into(),
        });
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
        self.included
            .iter()
            .copied()
            .chain(self.layers.iter().flat_map(Layer::extent))
            .collect()
    }

    /// Whether every line runs from left to right, as a function of time does; such an axis needs no padding.
    pub(super) fn runs_along_x(&self) -> bool {
        let lines: Vec<_> = self.layers.iter().filter_map(Layer::line_points).collect();
        let rises = |points: &&[(f64, f64)]| {
            points
                .windows(2)
                .all(|pair| pair[0].0.partial_cmp(&pair[1].0) != Some(Greater))
        };
        !lines.is_empty() && lines.iter().all(rises)
    }

    /// Whether a field or a matrix fills the axes to their ends, so that they need no padding.
    pub(super) fn is_filled(&self) -> bool {
        self.layers.iter().any(Layer::fills_the_area)
    }

    /// Legend entries of this panel, in order; those of reference lines last.
    pub(super) fn entries(&self) -> Vec<Entry> {
        let rules = self.rules.iter().map(|rule| Entry {
            label: rule.label.clone(),
            look: reference_style(),
            sample: Sample::Line,
        });
        let entries = self.layers.iter().filter_map(Layer::entry).chain(rules);
        entries.filter(|entry| !entry.label.is_empty()).collect()
    }
}
