//! The box of a space: its projection onto the page, its walls, axes, ticks and labels.

use super::axis::SettledAxis;
use super::decimate::{Resolution, decimate};
use super::font;
use super::frame::Area;
use super::style::{FAINT, INK, Look};
use super::svg::{Anchor, Point, Svg, TextLook, at};

/// A point in space, in the order of the axes.
pub type Point3 = [f64; 3];

/// Direction from which a space is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Angle of the eye about the vertical axis from the first axis, degrees.
    pub azimuth_deg: f64,
    /// Angle of the eye above the floor, degrees, from 5 to 85.
    pub elevation_deg: f64,
}

impl Default for View {
    fn default() -> Self {
        Self {
            azimuth_deg: -55.0,
            elevation_deg: 24.0,
        }
    }
}

/// Font sizes, px: axis labels, tick labels.
const LABEL: f64 = 12.0;
const TICK: f64 = 10.5;
/// Least room around the box and its labels, px.
const BORDER: f64 = 4.0;
/// Room for labels around the box before their size is known, px.
const FIRST_ROOM: f64 = 40.0;
/// Least share of the area that the box itself gets, however long its labels.
const LEAST_BOX: f64 = 0.3;
/// Height of the box relative to its longer floor edge, if axes are scaled on their own.
const FREE_HEIGHT: f64 = 0.75;
/// Look of the edges of the box that carry ticks.
const EDGE: Look = Look::solid(INK, 0.8);
/// Look of grid lines on floor and walls.
const GRID: Look = Look::solid("#e2e2e2", 0.7);

/// What a box shows: its settled axes with their labels, and how it is seen.
#[derive(Clone, Debug)]
pub(super) struct Setup<'a> {
    pub(super) axes: [SettledAxis; 3],
    pub(super) labels: [&'a str; 3],
    pub(super) view: View,
    /// Whether a unit is as long on all axes.
    pub(super) equal: bool,
}

/// Settled axes and their projection into an area.
pub(super) struct Scene<'a> {
    setup: Setup<'a>,
    /// Edges of the box, in units of the projection.
    edges: Point3,
    scale: f64,
    centre: Point,
}

/// Words beside the box.
struct Words {
    point: Point,
    text: String,
    look: TextLook,
}

impl<'a> Scene<'a> {
    /// Fits the box and its labels into the area.
    pub(super) fn new(setup: Setup<'a>, area: Area) -> Self {
        let lengths = [0, 1, 2].map(|i| 0.5 * setup.axes[i].max - 0.5 * setup.axes[i].min);
        let longest = lengths.iter().copied().fold(0.0, f64::max);
        let edges = if setup.equal {
            lengths.map(|l| l / longest)
        } else {
            [1.0, 1.0, FREE_HEIGHT]
        };
        let mut scene = Self {
            setup,
            edges,
            scale: 1.0,
            centre: at(0.0, 0.0),
        };
        scene.fit(area, [FIRST_ROOM; 4]);
        // Labels keep their size and their distance from edges of the box, so the room that they take beside it changes by at most half of
        // what the box does: five rounds leave less than a thirtieth of the first error.
        for _ in 0..5 {
            let room = scene.room();
            scene.fit(area, room);
        }
        scene
    }

    /// The lower end of the vertical axis.
    pub(super) fn floor(&self) -> f64 {
        self.setup.axes[2].min
    }

    /// Height of the box with its labels, px.
    pub(super) fn height(&self) -> f64 {
        let (low, high) = self.bounds();
        let [_, _, above, below] = self.room();
        high.y - low.y + above + below
    }

    /// Room that the labels take beside the box, px: left, right, above, below.
    fn room(&self) -> [f64; 4] {
        let (low, high) = self.bounds();
        let least = [BORDER; 4];
        self.words()
            .iter()
            .map(Words::extent)
            .fold(least, |room, (from, to)| {
                let beside = [low.x - from.x, to.x - high.x, low.y - from.y, to.y - high.y];
                std::array::from_fn(|i| room[i].max(beside[i] + BORDER))
            })
    }

    /// Scales and centres the box in the area, with this room beside it.
    fn fit(&mut self, area: Area, [left, right, above, below]: [f64; 4]) {
        let (low, high) = self.bounds();
        let free = |size: f64, taken: f64| (size - taken).max(LEAST_BOX * size);
        let (width, height) = (free(area.size.0, left + right), free(area.size.1, above + below));
        let grow = (width / (high.x - low.x)).min(height / (high.y - low.y));
        let (across, up) = (
            0.5 * (low.x + high.x) - self.centre.x,
            0.5 * (low.y + high.y) - self.centre.y,
        );
        let middle = area.origin.offset(left + width / 2.0, above + height / 2.0);
        self.centre = middle.offset(-grow * across, -grow * up);
        self.scale *= grow;
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

    /// Projects fractions (0 to 1) of the box.
    fn project_fraction(&self, f: Point3) -> Point {
        let [x, y, z] = [0, 1, 2].map(|i| (f[i] - 0.5) * self.edges[i]);
        let (sin_a, cos_a) = self.setup.view.azimuth_deg.to_radians().sin_cos();
        let (sin_e, cos_e) = self.setup.view.elevation_deg.to_radians().sin_cos();
        let across = -sin_a * x + cos_a * y;
        let towards = cos_a * x + sin_a * y;
        at(
            self.centre.x + self.scale * across,
            self.centre.y - self.scale * (cos_e * z - sin_e * towards),
        )
    }

    /// The place of a point on the page.
    pub(super) fn project(&self, p: Point3) -> Point {
        self.project_fraction([0, 1, 2].map(|i| self.setup.axes[i].place_or_end(p[i])))
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
        let (sin_a, cos_a) = self.setup.view.azimuth_deg.to_radians().sin_cos();
        (
            if cos_a > 0.0 { 1.0 } else { 0.0 },
            if sin_a > 0.0 { 1.0 } else { 0.0 },
        )
    }

    /// Floor and far walls with grid lines, and the three edges with ticks and labels.
    pub(super) fn draw_box(&self, svg: &mut Svg) {
        let (near_x, near_y) = self.near();
        let (far_x, far_y) = (1.0 - near_x, 1.0 - near_y);
        let mut line = |a: Point3, b: Point3, look: &Look| {
            svg.polyline(&[self.project_fraction(a), self.project_fraction(b)], look);
        };
        let fractions = |i: usize| {
            let axis = &self.setup.axes[i];
            axis.ticks().into_iter().map(move |t| axis.fraction(t))
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
        // The vertical edge on the other side closes the far wall.
        let (left_x, _) = self.leftmost();
        let (right_x, right_y) = if left_x == near_x {
            (far_x, near_y)
        } else {
            (near_x, far_y)
        };
        line([right_x, right_y, 0.0], [right_x, right_y, 1.0], &outline);
        for (axis, start) in self.carriers().into_iter().enumerate() {
            self.draw_edge(svg, axis, start);
        }
        for words in self.words() {
            svg.text(words.point, &words.text, words.look);
        }
    }

    /// The lower ends, in fractions, of the edges that carry the axes.
    fn carriers(&self) -> [Point3; 3] {
        let (near_x, near_y) = self.near();
        let (left_x, left_y) = self.leftmost();
        [[0.0, near_y, 0.0], [near_x, 0.0, 0.0], [left_x, left_y, 0.0]]
    }

    /// The vertical edge that lies farthest to the left; it bounds one far wall.
    fn leftmost(&self) -> (f64, f64) {
        let (near_x, near_y) = self.near();
        let candidates = [(near_x, 1.0 - near_y), (1.0 - near_x, near_y)];
        let left = |c: &(f64, f64)| self.project_fraction([c.0, c.1, 0.0]).x;
        if left(&candidates[0]) < left(&candidates[1]) {
            candidates[0]
        } else {
            candidates[1]
        }
    }

    /// A point of the edge that carries an axis.
    fn on_edge(&self, axis: usize, start: Point3, fraction: f64) -> Point {
        let mut f = start;
        f[axis] = fraction;
        self.project_fraction(f)
    }

    /// One edge with its ticks; `start` is its lower end, in fractions.
    fn draw_edge(&self, svg: &mut Svg, axis: usize, start: Point3) {
        let ends = [0.0, 1.0].map(|f| self.on_edge(axis, start, f));
        svg.polyline(&ends, &EDGE);
        let out = self.outwards(ends[0], ends[1]);
        for tick in self.setup.axes[axis].ticks() {
            let foot = self.on_edge(axis, start, self.setup.axes[axis].fraction(tick));
            svg.polyline(&[foot, foot.offset(4.0 * out.0, 4.0 * out.1)], &EDGE);
        }
    }

    /// All words beside the box.
    fn words(&self) -> Vec<Words> {
        let carriers = self.carriers().into_iter().enumerate();
        carriers
            .flat_map(|(axis, start)| self.words_of(axis, start))
            .collect()
    }

    /// The numbers and the label of an axis.
    fn words_of(&self, axis: usize, start: Point3) -> Vec<Words> {
        let settled = &self.setup.axes[axis];
        let outwards = self.outwards(self.on_edge(axis, start, 0.0), self.on_edge(axis, start, 1.0));
        let beside = |point: Point, distance: f64, text: String, size: f64| Words {
            point: point.offset(distance * outwards.0, distance * outwards.1 + tick_drop(outwards)),
            look: label_look(size, outwards),
            text,
        };
        let numbers = settled.ticks().into_iter().map(|tick| {
            let foot = self.on_edge(axis, start, settled.fraction(tick));
            beside(foot, 8.0, settled.tick_label(tick), TICK)
        });
        let mut words: Vec<Words> = numbers.collect();
        let widest = words
            .iter()
            .map(|w| font::width(&w.text, TICK))
            .fold(0.0, f64::max);
        let middle = self.on_edge(axis, start, 0.5);
        let label = [self.setup.labels[axis], &settled.exponent_label()].join(" ");
        words.push(if axis == 2 {
            Words {
                point: middle.offset(-(widest + 20.0), 0.0),
                text: label,
                look: TextLook {
                    size: LABEL,
                    anchor: Anchor::Middle,
                    rotation: -90.0,
                    ..TextLook::default()
                },
            }
        } else {
            let distance = 16.0 + TICK + widest * outwards.0.abs();
            beside(middle, distance, label, LABEL)
        });
        words
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

impl Words {
    /// Upper left and lower right corner.
    fn extent(&self) -> (Point, Point) {
        let (width, size) = (font::width(self.text.trim(), self.look.size), self.look.size);
        let before = match self.look.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => width / 2.0,
            Anchor::End => width,
        };
        // Above and below the base line, in font sizes: with accents and subscripts.
        let (above, below) = (0.9 * size, 0.35 * size);
        if self.look.rotation == 0.0 {
            (
                self.point.offset(-before, -above),
                self.point.offset(width - before, below),
            )
        } else {
            (
                self.point.offset(-above, before - width),
                self.point.offset(below, before),
            )
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
mod tests;
