//! What a panel is made of.

use super::legend::{Entry, Sample};
use super::style::Look;

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

/// A bar from zero, or from the lower end of a logarithmic axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bar {
    /// Abscissa of its middle; 1, 2, … on an axis with categories.
    pub x: f64,
    /// Its height, below zero if it hangs.
    pub height: f64,
    /// Its colour, `#rrggbb`.
    pub colour: &'static str,
}

/// A field on a grid, drawn as contour lines, as bands between them, or both.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contours {
    /// Abscissae of the columns, ascending.
    pub x: Vec<f64>,
    /// Ordinates of the rows, ascending.
    pub y: Vec<f64>,
    /// Values, a row for each ordinate. Where one is missing or not finite, nothing is drawn.
    pub rows: Vec<Vec<f64>>,
    /// Values of the contours, ascending.
    pub levels: Vec<f64>,
    /// Colours of the bands, below the first contour, between any two, above the last; none for lines alone.
    pub fills: Vec<String>,
    /// Look of the contours, if they are drawn.
    pub line: Option<Look>,
}

/// Coloured rectangles: a matrix or a heat map.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cells {
    /// Abscissae of the edges, one more than columns, ascending.
    pub x: Vec<f64>,
    /// Ordinates of the edges, one more than rows, ascending.
    pub y: Vec<f64>,
    /// Colours, `#rrggbb`, row by row from the lowest.
    pub fills: Vec<Vec<String>>,
}

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
    Bars {
        label: String,
        width: f64,
        bars: Vec<Bar>,
    },
    Contours(Contours),
    Cells(Cells),
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

impl Layer {
    /// Points that the axes must cover; a coordinate that is not finite asks for nothing.
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
            Self::Bars { width, bars, .. } => bars
                .iter()
                .flat_map(|b| [(b.x - width / 2.0, 0.0), (b.x + width / 2.0, b.height)])
                .collect(),
            Self::Contours(Contours { x, y, .. }) | Self::Cells(Cells { x, y, .. }) => {
                let abscissae = x.iter().map(|x| (*x, f64::NAN));
                abscissae.chain(y.iter().map(|y| (f64::NAN, *y))).collect()
            }
        }
    }

    /// The points of a line.
    pub(super) fn line_points(&self) -> Option<&[(f64, f64)]> {
        match self {
            Self::Line { points, .. } => Some(points),
            _ => None,
        }
    }

    /// Whether the layer fills the axes to their ends, so that they need no room beyond it.
    pub(super) fn fills_the_area(&self) -> bool {
        matches!(self, Self::Contours(_) | Self::Cells(_))
    }

    /// The legend entry, with an empty label if it is to be left out.
    pub(super) fn entry(&self) -> Option<Entry> {
        let (label, look, sample) = match self {
            Self::Line { label, look, .. } => (label, *look, Sample::Line),
            Self::Markers { label, look, .. } => (label, *look, Sample::Marker),
            Self::Band { label, look, .. } => (label, *look, Sample::Band),
            Self::Bars { label, bars, .. } => (label, Look::solid(bars.first()?.colour, 1.0), Sample::Patch),
            Self::Contours(_) | Self::Cells(_) => return None,
        };
        Some(Entry {
            label: label.clone(),
            look,
            sample,
        })
    }
}
