//! Contours of a field on a grid: marching squares whose segments are joined to closed curves.
//!
//! A level's region holds the nodes with values of at least that level; its boundary crosses the edges of the grid where linear
//! interpolation meets the level. Around the grid, and wherever a value is not finite, lies the outside, which belongs to no region; so every
//! boundary is closed. Where two opposite corners of a cell are inside and two are not, the mean of the four decides whether they join.
//! On a coarse grid a boundary has corners that the field has not: cutting them repeatedly (Chaikin, Comput. Graph. Image Process. 3, 1974)
//! leaves a smooth curve that stays within its polygon, and straight lines as they are.

use super::svg::{Point, at};

/// A field on a grid whose nodes are placed on the page.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    /// Abscissae of the columns, px.
    pub(super) x: Vec<f64>,
    /// Ordinates of the rows, px.
    pub(super) y: Vec<f64>,
    /// Values row by row.
    pub(super) values: Vec<f64>,
    /// How often corners of boundaries are cut.
    pub(super) cuts: usize,
}

/// A point of a boundary.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    point: Point,
    /// Whether a value crosses the level here; otherwise the region meets the outside.
    on_level: bool,
    /// Whether the boundary keeps its corner here: where it meets the outside.
    kept: bool,
}

/// No edge follows.
const NONE: usize = usize::MAX;

impl Grid {
    /// The region of values of at least `level`, or of all finite values without one, as closed curves; a point is inside if an odd
    /// number of them surround it.
    pub(super) fn region(&self, level: Option<f64>) -> Vec<Vec<Point>> {
        let boundaries = self.boundaries(level);
        boundaries
            .iter()
            .map(|boundary| boundary.iter().map(|c| c.point).collect())
            .collect()
    }

    /// The curves along which the field crosses a level; closed ones end where they begin.
    pub(super) fn lines(&self, level: f64) -> Vec<Vec<Point>> {
        self.boundaries(Some(level))
            .iter()
            .flat_map(|b| on_level(b))
            .collect()
    }

    /// Nodes per row and rows, with a frame of nodes that lie outside.
    fn framed(&self) -> (usize, usize) {
        (self.x.len() + 2, self.y.len() + 2)
    }

    /// A node of the framed grid: its place and its value; NaN outside.
    fn node(&self, (i, j): (usize, usize)) -> (Point, f64) {
        let inner = |k: usize, count: usize| k.saturating_sub(1).min(count - 1);
        let (column, row) = (inner(i, self.x.len()), inner(j, self.y.len()));
        let inside = (1..=self.x.len()).contains(&i) && (1..=self.y.len()).contains(&j);
        let value = self.values.get(row * self.x.len() + column).copied();
        let value = value.filter(|v| inside && v.is_finite()).unwrap_or(f64::NAN);
        (at(self.x[column], self.y[row]), value)
    }

    fn boundaries(&self, level: Option<f64>) -> Vec<Vec<Crossing>> {
        if self.x.is_empty() || self.y.is_empty() {
            return Vec::new();
        }
        let mut next = self.successors(level);
        let mut boundaries = Vec::new();
        for start in 0..next.len() {
            let mut boundary = Vec::new();
            let mut edge = start;
            while next[edge] != NONE {
                boundary.push(self.crossing(edge, level));
                edge = std::mem::replace(&mut next[edge], NONE);
            }
            if !boundary.is_empty() {
                boundaries.push(smoothed(boundary, self.cuts));
            }
        }
        boundaries
    }

    /// For each edge of the framed grid, the edge to which the boundary goes from it. Edge `2 n` leads from node `n` to the right, edge
    /// `2 n + 1` from it to the next row.
    fn successors(&self, level: Option<f64>) -> Vec<usize> {
        let (columns, rows) = self.framed();
        let mut next = vec![NONE; 2 * columns * rows];
        for j in 0..rows - 1 {
            for i in 0..columns - 1 {
                let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|node| self.node(node).1);
                let n = j * columns + i;
                let edges = [2 * n, 2 * (n + 1) + 1, 2 * (n + columns), 2 * n + 1];
                for (from, to) in cell(corners, level) {
                    next[edges[from]] = edges[to];
                }
            }
        }
        next
    }

    /// Where the boundary crosses an edge: between two values by linear interpolation, between a value and the outside halfway.
    fn crossing(&self, edge: usize, level: Option<f64>) -> Crossing {
        let columns = self.framed().0;
        let (i, j) = (edge / 2 % columns, edge / 2 / columns);
        let other = if edge.is_multiple_of(2) {
            (i + 1, j)
        } else {
            (i, j + 1)
        };
        let ((p, from), (q, to)) = (self.node((i, j)), self.node(other));
        // Halves, since the difference of two numbers may be too large for one.
        let share = level.map(|level| (0.5 * level - 0.5 * from) / (0.5 * to - 0.5 * from));
        let share = share.filter(|t| t.is_finite());
        let t = share.unwrap_or(0.5).clamp(0.0, 1.0);
        Crossing {
            point: at(p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)),
            on_level: share.is_some(),
            kept: share.is_none(),
        }
    }
}

/// The pieces of boundary in a cell with these corner values, each from one edge (0 to 3, edge `k` after corner `k`) to another.
fn cell(corners: [f64; 4], level: Option<f64>) -> impl Iterator<Item = (usize, usize)> {
    let within = |v: f64| v.is_finite() && level.is_none_or(|level| v >= level);
    let inside = corners.map(within);
    let enters = move |k: usize| !inside[k] && inside[(k + 1) % 4];
    let leaves = move |k: usize| inside[k] && !inside[(k + 1) % 4];
    let joined = within(corners.iter().map(|v| 0.25 * v).sum());
    (0..4).filter(move |k| enters(*k)).filter_map(move |from| {
        // Joined corners share the cell's centre: the boundary cuts off the corners before it. Others are cut off themselves.
        let mut others = (1..4).map(|turn| (if joined { from + 4 - turn } else { from + turn }) % 4);
        others.find(|k| leaves(*k)).map(|to| (from, to))
    })
}

/// The boundary with its corners cut, except beside the outside.
fn smoothed(boundary: Vec<Crossing>, cuts: usize) -> Vec<Crossing> {
    let around = |b: &[Crossing], i: usize| [b[(i + b.len() - 1) % b.len()], b[i], b[(i + 1) % b.len()]];
    let beside_outside = |i| around(&boundary, i).iter().any(|c| !c.on_level);
    let kept = |i: usize| Crossing {
        kept: beside_outside(i),
        ..boundary[i]
    };
    let mut smooth: Vec<Crossing> = (0..boundary.len()).map(kept).collect();
    if cuts > 0 {
        smooth = evened(&smooth);
    }
    for _ in 0..cuts {
        let cut = |i: usize| {
            let [before, corner, after] = around(&smooth, i);
            let towards = |other: Crossing| Crossing {
                point: at(
                    0.75 * corner.point.x + 0.25 * other.point.x,
                    0.75 * corner.point.y + 0.25 * other.point.y,
                ),
                ..corner
            };
            if corner.kept {
                vec![corner]
            } else {
                vec![towards(before), towards(after)]
            }
        };
        smooth = (0..smooth.len()).flat_map(cut).collect();
    }
    smooth
}

/// The boundary without points much nearer to the one before than most: a cut beside a short piece would leave most of the corner.
fn evened(boundary: &[Crossing]) -> Vec<Crossing> {
    const SHORT: f64 = 0.5;
    let apart = |a: &Crossing, b: &Crossing| (a.point.x - b.point.x).hypot(a.point.y - b.point.y);
    let next = boundary.iter().cycle().skip(1);
    let lengths = boundary.iter().zip(next).map(|(a, b)| apart(a, b));
    let least = SHORT * lengths.sum::<f64>() / boundary.len() as f64;
    let mut even: Vec<Crossing> = Vec::with_capacity(boundary.len());
    for c in boundary {
        if c.kept || even.last().is_none_or(|last| apart(last, c) >= least) {
            even.push(*c);
        }
    }
    even
}

/// The pieces of a boundary that lie on the level, not on the edge of the field.
fn on_level(boundary: &[Crossing]) -> Vec<Vec<Point>> {
    let closed = |mut points: Vec<Point>| {
        points.extend(points.first().copied());
        points
    };
    let Some(first) = boundary.iter().position(|c| !c.on_level) else {
        return vec![closed(boundary.iter().map(|c| c.point).collect())];
    };
    let turned: Vec<Crossing> = boundary[first..]
        .iter()
        .chain(&boundary[..first])
        .copied()
        .collect();
    let runs = turned.split(|c| !c.on_level).filter(|run| run.len() > 1);
    runs.map(|run| run.iter().map(|c| c.point).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn grid(count: usize, field: impl Fn(f64, f64) -> f64) -> Grid {
        let axis: Vec<f64> = (0..count).map(|i| i as f64).collect();
        let values = axis.iter().flat_map(|&y| axis.iter().map(move |&x| (x, y)));
        Grid {
            values: values.map(|(x, y)| field(x, y)).collect(),
            x: axis.clone(),
            y: axis,
            cuts: 0,
        }
    }

    fn area(curves: &[Vec<Point>]) -> f64 {
        let twice = |c: &Vec<Point>| -> f64 {
            let next = c.iter().cycle().skip(1);
            c.iter().zip(next).map(|(a, b)| a.x * b.y - b.x * a.y).sum()
        };
        (curves.iter().map(twice).sum::<f64>() / 2.0).abs()
    }

    #[test]
    fn exact_a_plane_is_met_exactly() {
        // Linear interpolation knows a plane: x + 2 y = 7 over 0..=10 cuts off a triangle of legs 7 and 3.5.
        let plane = grid(11, |x, y| x + 2.0 * y);
        let lines = plane.lines(7.0);
        assert_eq!(lines.len(), 1);
        for p in &lines[0] {
            assert!((p.x + 2.0 * p.y - 7.0).abs() < 1e-12, "{p:?}");
        }
        assert!((area(&plane.region(Some(7.0))) - (100.0 - 7.0 * 3.5 / 2.0)).abs() < 1e-9);
        assert!((area(&plane.region(None)) - 100.0).abs() < 1e-12);
    }

    #[test]
    fn exact_a_cone_has_circles() {
        let cone = grid(41, |x, y| -(x - 20.0).hypot(y - 20.0));
        let lines = cone.lines(-10.0);
        assert_eq!(lines.len(), 1);
        assert_eq!(lines[0].first(), lines[0].last());
        for p in &lines[0] {
            // Linear interpolation along an edge of length 1 errs by at most 1/8 of the curvature, 1/r.
            assert!(((p.x - 20.0).hypot(p.y - 20.0) - 10.0).abs() < 0.125 / 9.0);
        }
    }

    #[test]
    fn exact_cut_corners_make_a_coarse_circle_smooth_and_leave_planes() {
        // Six nodes across, none of them on the contour; each cut halves the corners of its polygon.
        let mut coarse = grid(9, |x, y| -(x - 4.1).hypot(y - 3.8));
        let sharpest = |grid: &Grid| {
            let line = grid.lines(-3.0).concat();
            let turn = |p: &[Point]| {
                let (a, b) = (
                    (p[1].y - p[0].y).atan2(p[1].x - p[0].x),
                    (p[2].y - p[1].y).atan2(p[2].x - p[1].x),
                );
                let turn = (a - b).abs();
                turn.min(std::f64::consts::TAU - turn)
            };
            line.windows(3).map(turn).fold(0.0, f64::max)
        };
        let raw = sharpest(&coarse);
        coarse.cuts = 3;
        assert!(sharpest(&coarse) < 0.3 * raw, "{} of {raw}", sharpest(&coarse));
        let mut plane = grid(5, |x, y| x + y);
        plane.cuts = 3;
        let line = plane.lines(3.5).concat();
        assert!(line.iter().all(|p| (p.x + p.y - 3.5).abs() < 1e-12));
        // The ends stay on the edge of the field.
        assert!(line.iter().any(|p| p.x == 0.0) && line.iter().any(|p| p.y == 0.0));
    }

    #[test]
    fn exact_a_gap_belongs_to_no_region() {
        let holed = grid(5, |x, y| if (x, y) == (2.0, 2.0) { f64::NAN } else { 1.0 });
        let region = holed.region(Some(0.0));
        // The hole reaches halfway to the neighbours: a square on its corner with diagonals of 1.
        assert_eq!(region.len(), 2);
        assert!((area(&region) - (16.0 - 0.5)).abs() < 1e-12);
        assert!(holed.lines(0.0).is_empty());
    }

    #[test]
    fn exact_a_saddle_is_settled_by_its_mean() {
        let saddle = |value: f64| grid(2, move |x, y| if x == y { 1.0 } else { value });
        // Corners of 1 and -0.5: the mean 0.25 joins the corners above 0; with -2 the mean keeps them apart.
        assert_eq!(saddle(-0.5).region(Some(0.0)).len(), 1);
        assert_eq!(saddle(-2.0).region(Some(0.0)).len(), 2);
    }

    proptest! {
        #[test]
        fn prop_areas_of_regions_and_complements_add_up(values in prop::collection::vec(-1.0..1.0_f64, 36), level in -1.0..1.0_f64) {
            let mut field = grid(6, |_, _| 0.0);
            field.values = values;
            let above = area(&field.region(Some(level)));
            field.values.iter_mut().for_each(|v| *v = -*v);
            let below = area(&field.region(Some(-level)));
            prop_assert!((above + below - 25.0).abs() < 1e-9, "{above} {below}");
        }

        #[test]
        fn prop_any_values_give_finite_curves(values in prop::collection::vec(any::<f64>(), 16), level in any::<f64>()) {
            let mut field = grid(4, |_, _| 0.0);
            field.values = values;
            let finite = |p: &Point| p.x.is_finite() && p.y.is_finite();
            prop_assert!(field.region(Some(level)).concat().iter().all(finite));
            prop_assert!(field.lines(level).concat().iter().all(finite));
        }
    }
}
