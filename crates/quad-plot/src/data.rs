//! The data of a panel, drawn: each layer inside the frame of its axes.

use std::collections::HashSet;

use super::contour::Grid;
use super::frame::{Frame, thinned};
use super::layer::{BandPoint, Bar, Cells, Contours, ErrorBar, Layer};
use super::marker::draw_marker;
use super::style::Look;
use super::svg::{Point, Svg, at};

/// Radius of markers, px.
const MARKER_SIZE: f64 = 3.2;
/// Opacity of bands.
const BAND_OPACITY: f64 = 0.22;
/// Half-width of the caps of error bars, px.
const CAP: f64 = 2.5;
/// Width of error bars, px.
const ERROR_BAR: f64 = 1.0;
/// Markers nearer to an earlier one than this, px, are not seen.
const APART: f64 = 0.25;
/// Cells of a grid longer than this, px, show as corners of contours, which are cut.
const COARSE: f64 = 2.5;
/// How often these corners are cut: to an eighth of their angle.
const CUTS: usize = 3;

/// Draws a layer.
pub(super) fn draw(svg: &mut Svg, layer: &Layer, frame: &Frame<'_>) {
    match layer {
        Layer::Line { look, points, .. } => {
            for piece in frame.line(points) {
                svg.polyline(&piece, look);
            }
        }
        Layer::Markers { look, points, .. } => markers(svg, look, points, frame),
        Layer::Band { look, points, .. } => band(svg, look, points, frame),
        Layer::Bars { width, bars, .. } => draw_bars(svg, *width, bars, frame),
        Layer::Contours(contours) => draw_contours(svg, contours, frame),
        Layer::Cells(cells) => draw_cells(svg, cells, frame),
    }
}

fn markers(svg: &mut Svg, look: &Look, points: &[ErrorBar], frame: &Frame<'_>) {
    let pen = Look::solid(look.colour, ERROR_BAR);
    let rect = frame.rect();
    let mut seen = HashSet::new();
    for p in points {
        let Some(centre) = frame.place((p.x, p.y)) else {
            continue;
        };
        if p.half_width > 0.0 {
            let end = |y: f64| at(centre.x, frame.up(frame.y.place_or_end(y)));
            let ends = [end(p.y - p.half_width), end(p.y + p.half_width)];
            for piece in rect.pieces(&ends) {
                svg.polyline(&piece, &pen);
            }
            for end in ends.into_iter().filter(|end| rect.contains(*end)) {
                svg.polyline(&[end.offset(-CAP, 0.0), end.offset(CAP, 0.0)], &pen);
            }
        }
        let place = (
            (centre.x / APART).round() as i64,
            (centre.y / APART).round() as i64,
        );
        if rect.contains(centre) && seen.insert(place) {
            draw_marker(svg, centre, look, MARKER_SIZE);
        }
    }
}

fn band(svg: &mut Svg, look: &Look, points: &[BandPoint], frame: &Frame<'_>) {
    let limits = |p: &BandPoint| -> Option<(Point, Point)> {
        let x = frame.across(frame.x.place(p.x)?);
        // A band must have two limits; on a logarithmic axis a lower one that is not positive lies at the bottom.
        let finite = p.lower.is_finite() && p.upper.is_finite();
        let [lower, upper] = [p.lower, p.upper].map(|y| at(x, frame.up(frame.y.place_or_end(y))));
        finite.then_some((lower, upper))
    };
    let placed: Vec<Option<(Point, Point)>> = points.iter().map(limits).collect();
    let mut regions = Vec::new();
    for run in placed.split(Option::is_none).filter(|run| run.len() > 1) {
        let (lower, upper): (Vec<Point>, Vec<Point>) = run.iter().copied().flatten().unzip();
        let mut outline = thinned(&upper);
        outline.extend(thinned(&lower).into_iter().rev());
        regions.push(frame.rect().polygon(&outline));
    }
    svg.region(&regions, look.colour, BAND_OPACITY);
}

fn draw_bars(svg: &mut Svg, width: f64, bars: &[Bar], frame: &Frame<'_>) {
    let base = frame.up(frame.y.place_or_end(0.0));
    for bar in bars.iter().filter(|bar| bar.height.is_finite()) {
        let sides = [bar.x - width / 2.0, bar.x + width / 2.0].map(|x| frame.x.place(x));
        let [Some(left), Some(right)] = sides.map(|side| side.map(|f| frame.across(f))) else {
            continue;
        };
        let end = frame.up(frame.y.place_or_end(bar.height));
        let corners = [at(left, base), at(right, base), at(right, end), at(left, end)];
        svg.region(&[frame.rect().polygon(&corners)], bar.colour, 1.0);
    }
}

fn draw_contours(svg: &mut Svg, contours: &Contours, frame: &Frame<'_>) {
    let grid = placed(contours, frame);
    let rect = frame.rect();
    let starts = std::iter::once(None).chain(contours.levels.iter().copied().map(Some));
    // From the lowest band to the highest: each covers what is above it, too, so no seam shows between two.
    for (start, fill) in starts.zip(&contours.fills) {
        let region: Vec<Vec<Point>> = grid
            .region(start)
            .iter()
            .map(|c| thinned(&rect.polygon(c)))
            .collect();
        svg.region(&region, fill, 1.0);
    }
    let Some(look) = &contours.line else {
        return;
    };
    for level in &contours.levels {
        for piece in grid.lines(*level).iter().flat_map(|line| rect.pieces(line)) {
            svg.polyline(&thinned(&piece), look);
        }
    }
}

/// The field's nodes on the page; a node that has no place has no value.
fn placed(contours: &Contours, frame: &Frame<'_>) -> Grid {
    let value = |i: usize, j: usize| {
        let value = contours.rows.get(j).and_then(|row| row.get(i)).copied();
        let has_place = frame.place((contours.x[i], contours.y[j])).is_some();
        value.filter(|_| has_place).unwrap_or(f64::NAN)
    };
    let columns = 0..contours.x.len();
    let rows = 0..contours.y.len();
    let across: Vec<f64> = contours
        .x
        .iter()
        .map(|x| frame.across(frame.x.place_or_end(*x)))
        .collect();
    let up: Vec<f64> = contours
        .y
        .iter()
        .map(|y| frame.up(frame.y.place_or_end(*y)))
        .collect();
    Grid {
        values: rows
            .flat_map(|j| columns.clone().map(move |i| (i, j)))
            .map(|(i, j)| value(i, j))
            .collect(),
        cuts: if is_coarse(&across) || is_coarse(&up) {
            CUTS
        } else {
            0
        },
        x: across,
        y: up,
    }
}

/// Whether nodes lie so far apart that straight lines between them show.
fn is_coarse(nodes: &[f64]) -> bool {
    nodes.windows(2).any(|pair| (pair[1] - pair[0]).abs() > COARSE)
}

fn draw_cells(svg: &mut Svg, cells: &Cells, frame: &Frame<'_>) {
    let across: Vec<f64> = cells
        .x
        .iter()
        .map(|x| frame.across(frame.x.place_or_end(*x)))
        .collect();
    let up: Vec<f64> = cells
        .y
        .iter()
        .map(|y| frame.up(frame.y.place_or_end(*y)))
        .collect();
    // Edges on whole pixels, or a line of the ground would show between neighbours.
    svg.raw("<g shape-rendering=\"crispEdges\">");
    for (rows, y) in cells.fills.iter().zip(up.windows(2)) {
        for (fill, x) in rows.iter().zip(across.windows(2)) {
            let corners = [at(x[0], y[0]), at(x[1], y[0]), at(x[1], y[1]), at(x[0], y[1])];
            svg.region(&[frame.rect().polygon(&corners)], fill, 1.0);
        }
    }
    svg.raw("</g>");
}
