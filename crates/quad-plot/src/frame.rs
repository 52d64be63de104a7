//! A data area with settled axes: where values lie on the page, and what of lines and regions lies inside.

use super::axis::SettledAxis;
use super::clip::Rect;
use super::decimate::{Resolution, decimate};
use super::svg::{Point, at};

/// A data area: its upper left corner and its size, px.
#[derive(Clone, Copy, Debug)]
pub(super) struct Area {
    pub(super) origin: Point,
    pub(super) size: (f64, f64),
}

/// A data area and its axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame<'a> {
    pub(super) x: &'a SettledAxis,
    pub(super) y: &'a SettledAxis,
    pub(super) area: Area,
}

/// Points are drawn on the page: thinning keeps what a pixel shows.
const PIXELS: Resolution = Resolution { x: 1.0, y: 1.0 };

impl Frame<'_> {
    /// The place of a point; none if a coordinate is not finite, or not positive on a logarithmic axis.
    pub(super) fn place(&self, (x, y): (f64, f64)) -> Option<Point> {
        Some(at(self.across(self.x.place(x)?), self.up(self.y.place(y)?)))
    }

    /// The page's abscissa at a fraction of the horizontal axis.
    pub(super) fn across(&self, fraction: f64) -> f64 {
        self.area.origin.x + self.area.size.0 * fraction
    }

    /// The page's ordinate at a fraction of the vertical axis.
    pub(super) fn up(&self, fraction: f64) -> f64 {
        self.area.origin.y + self.area.size.1 * (1.0 - fraction)
    }

    /// The area as a rectangle.
    pub(super) fn rect(&self) -> Rect {
        let (width, height) = self.area.size;
        Rect {
            low: self.area.origin,
            high: self.area.origin.offset(width, height),
        }
    }

    /// What of a line lies inside, thinned; points that have no place leave gaps.
    pub(super) fn line(&self, points: &[(f64, f64)]) -> Vec<Vec<Point>> {
        let placed: Vec<Option<Point>> = points.iter().map(|p| self.place(*p)).collect();
        let runs = placed.split(Option::is_none);
        runs.flat_map(|run| {
            let run: Vec<Point> = run.iter().copied().flatten().collect();
            self.rect().pieces(&run)
        })
        .map(|piece| thinned(&piece))
        .collect()
    }
}

/// The points that a polyline on the page needs.
pub(super) fn thinned(points: &[Point]) -> Vec<Point> {
    let pairs: Vec<(f64, f64)> = points.iter().map(|p| (p.x, p.y)).collect();
    let runs = decimate(&pairs, PIXELS);
    runs.concat().into_iter().map(|(x, y)| at(x, y)).collect()
}
