//! The box of a space: its projection onto the page, its walls, axes, ticks and labels.

use super::axis::{Axis, SettledAxis};
use super::chart::Area;
use super::decimate::{Resolution, decimate};
use super::space::{Point3, Space, View};
use super::style::{FAINT, INK, Look};
use super::svg::{Anchor, Point, Svg, TextLook, at};
use super::text;

/// Font sizes, px: axis labels, tick labels.
const LABEL: f64 = 12.0;
const TICK: f64 = 10.5;
/// Ticks aimed at on each axis.
const TARGET_TICKS: f64 = 4.5;
/// Room for labels around the box, px: left, right, above, below.
const LEFT: f64 = 56.0;
const RIGHT: f64 = 34.0;
pub(super) const TOP: f64 = 8.0;
pub(super) const BOTTOM: f64 = 46.0;
/// Height of the box relative to its longer floor edge, if axes are scaled on their own.
const FREE_HEIGHT: f64 = 0.75;
/// Look of the edges of the box that carry ticks.
const EDGE: Look = Look::solid(INK, 0.8);
/// Look of grid lines on floor and walls.
const GRID: Look = Look::solid("#e2e2e2", 0.7);

/// Settled axes and the projection of a [`Space`] into an area.
pub(super) struct Scene {
    pub(super) axes: [SettledAxis; 3],
    /// Edges of the box, in units of the projection.
    edges: Point3,
    view: View,
    scale: f64,
    centre: Point,
}

impl Scene {
    /// Settles the axes and fits the box into the area.
    pub(super) fn new(space: &Space, area: Area) -> Self {
        let axes = [0, 1, 2].map(|i| space.axes[i].settle(space.extent(i).into_iter(), true, TARGET_TICKS));
        let lengths = [0, 1, 2].map(|i| axes[i].max - axes[i].min);
        let longest = lengths.iter().copied().fold(0.0, f64::max);
        let edges = if space.equal {
            lengths.map(|l| l / longest)
        } else {
            [1.0, 1.0, FREE_HEIGHT]
        };
        let mut scene = Self {
            axes,
            edges,
            view: space.view,
            scale: 1.0,
            centre: at(0.0, 0.0),
        };
        scene.fit(area);
        scene
    }

    /// Scales and centres the box in the area, with room for labels.
    fn fit(&mut self, area: Area) {
        let (low, high) = self.bounds();
        let (width, height) = (area.size.0 - LEFT - RIGHT, area.size.1 - TOP - BOTTOM);
        let scale = (width / (high.x - low.x)).min(height / (high.y - low.y));
        let middle = area.origin.offset(LEFT + width / 2.0, TOP + height / 2.0);
        self.centre = middle.offset(-scale * (low.x + high.x) / 2.0, -scale * (low.y + high.y) / 2.0);
        self.scale = scale;
    }

    /// Upper left and lower right corner of the projected box.
    fn bounds(&self) -> (Point, Point) {
        let corners = (0..8u8).map(|i| self.project_fraction(corner(i)));
        corners.fold(
            (at(f64::MAX, f64::MAX), at(f64::MIN, f64::MIN)),
            |(low, high), p| {
                (
                    at(low.x.min(p.x), low.y.min(p.y)),
                    at(high.x.max(p.x), high.y.max(p.y)),
                )
            },
        )
    }

    /// Height of the projected box, px.
    pub(super) fn height(&self) -> f64 {
        let (low, high) = self.bounds();
        high.y - low.y
    }

    /// Projects fractions (0 to 1) of the box.
    fn project_fraction(&self, f: Point3) -> Point {
        let [x, y, z] = [0, 1, 2].map(|i| (f[i] - 0.5) * self.edges[i]);
        let (sin_a, cos_a) = self.view.azimuth_deg.to_radians().sin_cos();
        let (sin_e, cos_e) = self.view.elevation_deg.to_radians().sin_cos();
        let across = -sin_a * x + cos_a * y;
        let towards = cos_a * x + sin_a * y;
        at(
            self.centre.x + self.scale * across,
            self.centre.y - self.scale * (cos_e * z - sin_e * towards),
        )
    }

    /// The place of a point on the page.
    pub(super) fn project(&self, p: Point3) -> Point {
        self.project_fraction([0, 1, 2].map(|i| self.axes[i].fraction(p[i])))
    }

    /// Draws a line through points in space.
    pub(super) fn polyline(&self, svg: &mut Svg, points: &[Point3], look: &Look) {
        let projected: Vec<(f64, f64)> = points
            .iter()
            .map(|p| self.project(*p))
            .map(|p| (p.x, p.y))
            .collect();
        for run in decimate(&projected, Resolution { x: 1.0, y: 1.0 }) {
            let run: Vec<Point> = run.into_iter().map(|(x, y)| at(x, y)).collect();
            svg.polyline(&run, look);
        }
    }

    /// The sides (fractions 0 or 1) of the first two axes that face the eye.
    fn near(&self) -> (f64, f64) {
        let (sin_a, cos_a) = self.view.azimuth_deg.to_radians().sin_cos();
        (
            if cos_a > 0.0 { 1.0 } else { 0.0 },
            if sin_a > 0.0 { 1.0 } else { 0.0 },
        )
    }

    /// Floor and far walls with grid lines, and the three edges with ticks and labels.
    pub(super) fn draw_box(&self, svg: &mut Svg, axes: &[Axis; 3]) {
        let (near_x, near_y) = self.near();
        let (far_x, far_y) = (1.0 - near_x, 1.0 - near_y);
        let mut line = |a: Point3, b: Point3, look: &Look| {
            svg.polyline(&[self.project_fraction(a), self.project_fraction(b)], look);
        };
        let fractions = |i: usize| {
            self.axes[i]
                .ticks()
                .into_iter()
                .map(move |t| self.axes[i].fraction(t))
        };
        for f in fractions(0) {
            line([f, 0.0, 0.0], [f, 1.0, 0.0], &GRID);
            line([f, far_y, 0.0], [f, far_y, 1.0], &GRID);
        }
        for f in fractions(1) {
            line([0.0, f, 0.0], [1.0, f, 0.0], &GRID);
            line([far_x, f, 0.0], [far_x, f, 1.0], &GRID);
        }
        for f in fractions(2) {
            line([far_x, 0.0, f], [far_x, 1.0, f], &GRID);
            line([0.0, far_y, f], [1.0, far_y, f], &GRID);
        }
        let outline = Look::solid(FAINT, 0.8);
        line([far_x, 0.0, 1.0], [far_x, 1.0, 1.0], &outline);
        line([0.0, far_y, 1.0], [1.0, far_y, 1.0], &outline);
        line([far_x, far_y, 0.0], [far_x, far_y, 1.0], &outline);
        line([far_x, 0.0, 0.0], [far_x, 1.0, 0.0], &outline);
        line([0.0, far_y, 0.0], [1.0, far_y, 0.0], &outline);
        self.draw_axis(svg, 0, [0.0, near_y, 0.0], &axes[0].label);
        self.draw_axis(svg, 1, [near_x, 0.0, 0.0], &axes[1].label);
        let (left_x, left_y) = self.leftmost(near_x, near_y);
        self.draw_axis(svg, 2, [left_x, left_y, 0.0], &axes[2].label);
        // The vertical edge on the other side closes the far wall.
        let (right_x, right_y) = if left_x == near_x {
            (far_x, near_y)
        } else {
            (near_x, far_y)
        };
        svg.polyline(
            &[[right_x, right_y, 0.0], [right_x, right_y, 1.0]].map(|f| self.project_fraction(f)),
            &outline,
        );
    }

    /// The vertical edge that lies farthest to the left; it bounds one far wall.
    fn leftmost(&self, near_x: f64, near_y: f64) -> (f64, f64) {
        let candidates = [(near_x, 1.0 - near_y), (1.0 - near_x, near_y)];
        let left = |c: &(f64, f64)| self.project_fraction([c.0, c.1, 0.0]).x;
        if left(&candidates[0]) < left(&candidates[1]) {
            candidates[0]
        } else {
            candidates[1]
        }
    }

    /// One edge with ticks, numbers and label; `start` is its lower end, in fractions.
    fn draw_axis(&self, svg: &mut Svg, axis: usize, start: Point3, label: &str) {
        let label = &[label, &self.axes[axis].exponent_label()].join(" ");
        let place = |fraction: f64| {
            let mut f = start;
            f[axis] = fraction;
            self.project_fraction(f)
        };
        svg.polyline(&[place(0.0), place(1.0)], &EDGE);
        let outwards = self.outwards(place(0.0), place(1.0));
        let settled = &self.axes[axis];
        let mut widest: f64 = 0.0;
        for tick in settled.ticks() {
            let foot = place(settled.fraction(tick));
            svg.polyline(&[foot, foot.offset(4.0 * outwards.0, 4.0 * outwards.1)], &EDGE);
            let words = settled.tick_label(tick);
            widest = widest.max(text::width(&words, TICK));
            let at = foot.offset(8.0 * outwards.0, 8.0 * outwards.1);
            svg.text(
                at.offset(0.0, tick_drop(outwards)),
                &words,
                label_look(TICK, outwards),
            );
        }
        let middle = place(0.5);
        if axis == 2 {
            let look = TextLook {
                size: LABEL,
                anchor: Anchor::Middle,
                rotation: -90.0,
                ..TextLook::default()
            };
            svg.text(middle.offset(-(widest + 20.0), 0.0), label, look);
        } else {
            let distance = 16.0 + TICK + widest * outwards.0.abs();
            let at = middle.offset(distance * outwards.0, distance * outwards.1);
            svg.text(
                at.offset(0.0, tick_drop(outwards)),
                label,
                label_look(LABEL, outwards),
            );
        }
    }

    /// Unit vector on the page from the box outwards, square to an edge.
    fn outwards(&self, a: Point, b: Point) -> (f64, f64) {
        let length = (b.x - a.x).hypot(b.y - a.y).max(1e-9);
        let normal = ((b.y - a.y) / length, -(b.x - a.x) / length);
        let centre = self.project_fraction([0.5; 3]);
        let inwards = (centre.x - (a.x + b.x) / 2.0) * normal.0 + (centre.y - (a.y + b.y) / 2.0) * normal.1;
        if inwards > 0.0 {
            (-normal.0, -normal.1)
        } else {
            normal
        }
    }
}

/// Corner `i` of the unit cube.
fn corner(i: u8) -> Point3 {
    [0, 1, 2].map(|axis| f64::from(i >> axis & 1))
}

/// How far the base line lies below the point that words hang from.
fn tick_drop(outwards: (f64, f64)) -> f64 {
    0.36 * TICK + 0.45 * TICK * outwards.1.max(0.0)
}

/// Words that stand away from the box: to its right, to its left or below it.
fn label_look(size: f64, outwards: (f64, f64)) -> TextLook {
    const SIDEWAYS: f64 = 0.3;
    let anchor = match outwards.0 {
        x if x > SIDEWAYS => Anchor::Start,
        x if x < -SIDEWAYS => Anchor::End,
        _ => Anchor::Middle,
    };
    TextLook {
        size,
        anchor,
        ..TextLook::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Seen from above, the way from the first axis to the second is counter-clockwise, whatever the azimuth: right-handed.
    #[test]
    fn exact_the_axes_are_right_handed() {
        for azimuth_deg in [-150.0, -62.0, 10.0, 110.0] {
            let view = View {
                azimuth_deg,
                elevation_deg: 40.0,
            };
            let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            let space = Space::new("x", "y", "up").view(view).line("", EDGE, corners);
            let area = Area {
                origin: at(0.0, 0.0),
                size: (400.0, 400.0),
            };
            let scene = Scene::new(&space, area);
            let [o, x, y, up] = corners.map(|p| scene.project(p));
            // The page's y points down, so a counter-clockwise turn has a negative cross product.
            let cross = (x.x - o.x) * (y.y - o.y) - (x.y - o.y) * (y.x - o.x);
            assert!(cross < 0.0 && up.y < o.y, "{azimuth_deg}: {cross}");
        }
    }

    /// A left turn flown from north to west (heading falling, z down) is counter-clockwise from above in the picture as well.
    #[test]
    fn exact_a_left_turn_of_a_frame_with_z_down_stays_one() {
        let north = Space::of_z_down(1.0, 0.0, -2.0);
        let west = Space::of_z_down(0.0, -1.0, -2.0);
        assert_eq!((north, west), ([1.0, 0.0, 2.0], [0.0, 1.0, 2.0]));
        assert!(north[0] * west[1] - north[1] * west[0] > 0.0);
    }
}
