//! Legends: rows of samples and words above the data, so that they never hide any.

use super::font;
use super::marker::draw_marker;
use super::style::{FAINT, Look};
use super::svg::{Point, Svg, TextLook, at};

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
    /// A filled patch.
    Patch,
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
                let own = sample_width(entry.sample) + GAP + font::width(&entry.label, SIZE);
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

    /// Width of the longest row, px.
    pub fn width(&self) -> f64 {
        self.rows.iter().map(|row| row_width(row)).fold(0.0, f64::max)
    }

    /// Draws the legend, its top at `top`, centred about `centre` as far as the room from `left` to `right` allows.
    pub fn draw(&self, svg: &mut Svg, centre: f64, top: f64, (left, right): (f64, f64)) {
        for (i, row) in self.rows.iter().enumerate() {
            let width = row_width(row);
            let mut x = (centre - width / 2.0).min(right - width).max(left);
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
        Sample::Band | Sample::Patch => {
            let opacity = if entry.sample == Sample::Band { 0.3 } else { 1.0 };
            let (w, h) = (SHORT_SAMPLE / 2.0, 4.5);
            let corners = [(-w, -h), (w, -h), (w, h), (-w, h)].map(|(dx, dy)| centre.offset(dx, dy));
            svg.raw(&format!("<g fill-opacity=\"{opacity}\">"));
            svg.polygon(&corners, entry.look.colour, Some(&Look::solid(FAINT, 0.5)));
            svg.raw("</g>");
        }
    }
}
