//! What of lines and regions lies inside a rectangle.

use super::svg::{Point, at};

/// A rectangle on the page, px, y down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rect {
    /// Upper left corner.
    pub(super) low: Point,
    /// Lower right corner.
    pub(super) high: Point,
}

impl Rect {
    /// Whether a point lies inside or on the edge, to rounding.
    pub(super) fn contains(&self, p: Point) -> bool {
        const SLACK_PX: f64 = 1e-6;
        (self.low.x - SLACK_PX..=self.high.x + SLACK_PX).contains(&p.x)
            && (self.low.y - SLACK_PX..=self.high.y + SLACK_PX).contains(&p.y)
    }

    /// The pieces of a polyline that lie inside.
    pub(super) fn pieces(&self, points: &[Point]) -> Vec<Vec<Point>> {
        let mut pieces: Vec<Vec<Point>> = Vec::new();
        for pair in points.windows(2) {
            let Some((from, to)) = self.segment(pair[0], pair[1]) else {
                continue;
            };
            match pieces.last_mut() {
                Some(piece) if piece.last() == Some(&from) => piece.push(to),
                _ => pieces.push(vec![from, to]),
            }
        }
        pieces
    }

    /// The part of a segment that lies inside (Liang and Barsky).
    fn segment(&self, a: Point, b: Point) -> Option<(Point, Point)> {
        let (dx, dy) = (b.x - a.x, b.y - a.y);
        let (mut first, mut last) = (0.0_f64, 1.0_f64);
        let edges = [
            (-dx, a.x - self.low.x),
            (dx, self.high.x - a.x),
            (-dy, a.y - self.low.y),
            (dy, self.high.y - a.y),
        ];
        for (outwards, room) in edges {
            if outwards == 0.0 {
                if room < 0.0 {
                    return None;
                }
            } else if outwards < 0.0 {
                first = first.max(room / outwards);
            } else {
                last = last.min(room / outwards);
            }
        }
        let along = |t: f64| {
            if t <= 0.0 {
                a
            } else if t >= 1.0 {
                b
            } else {
                at(a.x + t * dx, a.y + t * dy)
            }
        };
        (first <= last).then(|| (along(first), along(last)))
    }

    /// The part of a polygon that lies inside (Sutherland and Hodgman); parts that are apart stay joined along the edge.
    pub(super) fn polygon(&self, points: &[Point]) -> Vec<Point> {
        let x = |p: Point| p.x;
        let y = |p: Point| p.y;
        let mut inside = points.to_vec();
        inside = half_plane(&inside, |p| x(p) - self.low.x);
        inside = half_plane(&inside, |p| self.high.x - x(p));
        inside = half_plane(&inside, |p| y(p) - self.low.y);
        half_plane(&inside, |p| self.high.y - y(p))
    }
}

/// The part of a polygon where a linear function is not negative.
fn half_plane(points: &[Point], depth: impl Fn(Point) -> f64) -> Vec<Point> {
    let mut kept = Vec::with_capacity(points.len());
    for (i, &b) in points.iter().enumerate() {
        let a = points[(i + points.len() - 1) % points.len()];
        let (from, to) = (depth(a), depth(b));
        if (from < 0.0) != (to < 0.0) {
            let t = from / (from - to);
            kept.push(at(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)));
        }
        if to >= 0.0 {
            kept.push(b);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const UNIT: Rect = Rect {
        low: at(0.0, 0.0),
        high: at(1.0, 1.0),
    };

    /// Twice the area inside a polygon (shoelace).
    fn twice_area(points: &[Point]) -> f64 {
        let next = points.iter().cycle().skip(1);
        points.iter().zip(next).map(|(a, b)| a.x * b.y - b.x * a.y).sum()
    }

    #[test]
    fn exact_a_line_that_leaves_and_returns_is_in_two_pieces() {
        let line = [
            at(0.5, 0.5),
            at(1.5, 0.5),
            at(1.5, 0.25),
            at(0.5, 0.25),
            at(0.5, 0.1),
        ];
        let pieces = UNIT.pieces(&line);
        let expected = [
            vec![at(0.5, 0.5), at(1.0, 0.5)],
            vec![at(1.0, 0.25), at(0.5, 0.25), at(0.5, 0.1)],
        ];
        assert_eq!(pieces, expected);
        assert!(UNIT.pieces(&[at(-1.0, 2.0), at(2.0, 2.0)]).is_empty());
    }

    #[test]
    fn exact_area_of_a_clipped_triangle() {
        // Right-angled at the origin with legs of 2: the unit square lies inside it.
        let clipped = UNIT.polygon(&[at(0.0, 0.0), at(2.0, 0.0), at(0.0, 2.0)]);
        assert!((twice_area(&clipped) - 2.0).abs() < 1e-12, "{clipped:?}");
        assert!(
            UNIT.polygon(&[at(3.0, 0.0), at(4.0, 0.0), at(3.0, 1.0)])
                .is_empty()
        );
    }

    proptest! {
        #[test]
        fn prop_pieces_lie_inside_and_on_the_line(raw in prop::collection::vec((-3.0..3.0_f64, -3.0..3.0_f64), 2..12)) {
            let line: Vec<Point> = raw.into_iter().map(|(x, y)| at(x, y)).collect();
            for p in UNIT.pieces(&line).concat() {
                prop_assert!(UNIT.contains(p));
                let off = |s: &[Point]| {
                    let (dx, dy) = (s[1].x - s[0].x, s[1].y - s[0].y);
                    ((p.x - s[0].x) * dy - (p.y - s[0].y) * dx).abs() / dx.hypot(dy).max(1e-12)
                };
                // Each coordinate is computed with errors of some units in the last place of numbers up to 3.
                prop_assert!(line.windows(2).map(off).fold(f64::INFINITY, f64::min) < 1e-12);
            }
        }
    }
}
