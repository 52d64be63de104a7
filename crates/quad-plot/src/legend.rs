//! Legends: rows of samples and words above the data, so that they never hide any.

use super::style::{FAINT, Look, Marker};
use super::svg::{Point, Svg, TextLook, at};
use super::text;

/// An entry of a legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Words. Rich text.
    pub label: String,
    /// Look of the sample.
    pub look: Look,
    /// What the sample shows.
    pub sample: Sample,
}

/// What the sample of an [`Entry`] shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sample {
    /// A piece of line.
    Line,
    /// A marker.
    Marker,
    /// A shaded patch.
    Band,
}

/// Font size of legends, px.
const SIZE: f64 = 11.0;
/// Width of a sample of line, px: long enough for two periods of the longest dash.
const LINE_SAMPLE: f64 = 32.0;
/// Width of a marker or a patch, px.
const SHORT_SAMPLE: f64 = 14.0;
/// Space between sample and words, px.
const GAP: f64 = 6.0;
/// Space between entries, px.
const ENTRY_GAP: f64 = 16.0;
/// Height of a row, px.
const ROW: f64 = 18.0;

/// A legend broken into rows that fit a width.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    rows: Vec<Vec<(Entry, f64)>>,
}

impl Legend {
    /// Breaks the entries, less repetitions, into as few rows of about equal number as fit the width, px.
    pub fn new(entries: impl IntoIterator<Item = Entry>, width: f64) -> Self {
        let mut measured: Vec<(Entry, f64)> = Vec::new();
        for entry in entries {
            if measured.iter().all(|(known, _)| *known != entry) {
                let own = sample_width(entry.sample) + GAP + text::width(&entry.label, SIZE);
                measured.push((entry, own));
            }
        }
        let count = measured.len();
        let split = |rows: usize| {
            measured
                .chunks(count.div_ceil(rows))
                .map(<[_]>::to_vec)
                .collect::<Vec<_>>()
        };
        let fits = |rows: &Vec<Vec<(Entry, f64)>>| rows.iter().all(|row| row_width(row) <= width);
        let rows = (1..count).map(split).find(fits);
        Self {
            rows: rows.unwrap_or_else(|| measured.iter().map(|entry| vec![entry.clone()]).collect()),
        }
    }

    /// Height of the legend, px; zero if it is empty.
    pub fn height(&self) -> f64 {
        if self.rows.is_empty() {
            0.0
        } else {
            self.rows.len() as f64 * ROW + 4.0
        }
    }

    /// Draws the legend centred about `centre`, its top at `top`.
    pub fn draw(&self, svg: &mut Svg, centre: f64, top: f64) {
        for (i, row) in self.rows.iter().enumerate() {
            let mut x = centre - row_width(row) / 2.0;
            let y = top + ROW * (i as f64 + 0.5);
            for (entry, width) in row {
                draw_sample(svg, entry, at(x, y));
                let words = at(x + sample_width(entry.sample) + GAP, y + 0.36 * SIZE);
                svg.text(
                    words,
                    &entry.label,
                    TextLook {
                        size: SIZE,
                        ..TextLook::default()
                    },
                );
                x += width + ENTRY_GAP;
            }
        }
    }
}

fn row_width(row: &[(Entry, f64)]) -> f64 {
    row.iter().map(|(_, width)| width + ENTRY_GAP).sum::<f64>() - ENTRY_GAP
}

fn sample_width(sample: Sample) -> f64 {
    if sample == Sample::Line {
        LINE_SAMPLE
    } else {
        SHORT_SAMPLE
    }
}

fn draw_sample(svg: &mut Svg, entry: &Entry, left: Point) {
    let right = left.offset(sample_width(entry.sample), 0.0);
    let centre = left.offset(SHORT_SAMPLE / 2.0, 0.0);
    match entry.sample {
        Sample::Line => svg.polyline(&[left, right], &entry.look),
        Sample::Marker => draw_marker(svg, centre, &entry.look, 3.6),
        Sample::Band => {
            let (w, h) = (SHORT_SAMPLE / 2.0, 4.5);
            let corners = [(-w, -h), (w, -h), (w, h), (-w, h)].map(|(dx, dy)| centre.offset(dx, dy));
            svg.raw("<g fill-opacity=\"0.3\">");
            svg.polygon(&corners, entry.look.colour, Some(&Look::solid(FAINT, 0.5)));
            svg.raw("</g>");
        }
    }
}

/// Radius of a dot, of a marker's.
pub(super) const DOT: f64 = 0.4;

/// Draws a marker of this radius, px.
pub(super) fn draw_marker(svg: &mut Svg, centre: Point, look: &Look, radius: f64) {
    let corners = |offsets: &[(f64, f64)]| -> Vec<Point> {
        offsets
            .iter()
            .map(|(dx, dy)| centre.offset(dx * radius, dy * radius))
            .collect()
    };
    match look.marker {
        Marker::Circle => svg.circle(centre, radius, look.colour, None),
        Marker::Square => {
            svg.polygon(
                &corners(&[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)]),
                look.colour,
                None,
            );
        }
        Marker::Triangle => svg.polygon(
            &corners(&[(-1.0, 0.8), (1.0, 0.8), (0.0, -1.1)]),
            look.colour,
            None,
        ),
        Marker::TriangleDown => svg.polygon(
            &corners(&[(-1.0, -0.8), (1.0, -0.8), (0.0, 1.1)]),
            look.colour,
            None,
        ),
        Marker::Diamond => {
            svg.polygon(
                &corners(&[(0.0, -1.2), (1.0, 0.0), (0.0, 1.2), (-1.0, 0.0)]),
                look.colour,
                None,
            );
        }
        Marker::Dot => svg.circle(centre, DOT * radius, look.colour, None),
        Marker::Cross => {
            let pen = Look::solid(look.colour, 1.5);
            svg.polyline(&corners(&[(-0.9, -0.9), (0.9, 0.9)]), &pen);
            svg.polyline(&corners(&[(-0.9, 0.9), (0.9, -0.9)]), &pen);
        }
    }
}
