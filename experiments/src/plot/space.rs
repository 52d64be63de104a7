//! A space with three axes: trajectories, planes and points in an orthographic view, with shadows on the floor.
//!
//! kuva has no 3-D line; this is a box, its axes with ticks, and polylines, drawn as SVG.

use super::axis::{Axis, SettledAxis};
use super::decimate::{Resolution, decimate};
use super::figure::Area;
use super::legend::{Entry, Legend, Sample, draw_marker};
use super::style::{FAINT, INK, Look};
use super::svg::{Anchor, Point, Svg, TextLook, at};
use super::text;

/// A point in space, in the order of the axes.
pub type Point3 = [f64; 3];

/// Three axes and what is drawn between them.
///
/// The vertical axis points up: give heights, that is −z of a frame whose z axis points down.
#[derive(Clone, Debug)]
pub struct Space {
    /// Words above the picture. Rich text.
    pub caption: String,
    axes: [Axis; 3],
    view: View,
    equal: bool,
    shadows: bool,
    layers: Vec<Layer>,
}

/// Direction from which a [`Space`] is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Angle of the eye about the vertical axis from the first axis, degrees.
    pub azimuth_deg: f64,
    /// Angle of the eye above the floor, degrees, from 5 to 85.
    pub elevation_deg: f64,
}

impl Default for View {
    fn default() -> Self {
        Self { azimuth_deg: -55.0, elevation_deg: 24.0 }
    }
}

#[derive(Clone, Debug)]
enum Layer {
    Line { label: String, look: Look, points: Vec<Point3> },
    Markers { label: String, look: Look, points: Vec<Point3> },
    Surface { colour: &'static str, opacity: f64, corners: Vec<Point3> },
    Note { point: Point3, text: String },
}

/// Font sizes, px: axis labels, tick labels.
const LABEL: f64 = 12.0;
const TICK: f64 = 10.5;
/// Ticks aimed at on each axis.
const TARGET_TICKS: f64 = 4.5;
/// Heights of the box relative to its longer floor edge, if axes are scaled on their own.
const FREE_HEIGHT: f64 = 0.75;
/// Look of shadows on the floor.
const SHADOW: Look = Look::solid("#c4c4c4", 1.2);
/// Look of the edges of the box that carry ticks.
const EDGE: Look = Look::solid(INK, 0.8);
/// Look of grid lines on floor and walls.
const GRID: Look = Look::solid("#e2e2e2", 0.7);

impl Space {
    /// An empty space with axis labels, the third for the vertical axis, which points up.
    pub fn new(x: impl Into<String>, y: impl Into<String>, up: impl Into<String>) -> Self {
        let axis = |label: String| Axis { label, ..Axis::default() };
        let axes = [axis(x.into()), axis(y.into()), axis(up.into())];
        let view = View::default();
        Self { caption: String::new(), axes, view, equal: false, shadows: true, layers: Vec::new() }
    }

    /// Adds a line and its shadow.
    pub fn line(mut self, label: impl Into<String>, look: Look, points: impl IntoIterator<Item = Point3>) -> Self {
        let points = points.into_iter().filter(|p| p.iter().all(|v| v.is_finite())).collect();
        self.layers.push(Layer::Line { label: label.into(), look, points });
        self
    }

    /// Adds markers.
    pub fn markers(mut self, label: impl Into<String>, look: Look, points: impl IntoIterator<Item = Point3>) -> Self {
        let points = points.into_iter().filter(|p| p.iter().all(|v| v.is_finite())).collect();
        self.layers.push(Layer::Markers { label: label.into(), look, points });
        self
    }

    /// Adds a translucent polygon (a plane, a wall, a field of view).
    pub fn surface(
        mut self,
        colour: &'static str,
        opacity: f64,
        corners: impl IntoIterator<Item = Point3>,
    ) -> Self {
        self.layers.push(Layer::Surface { colour, opacity, corners: corners.into_iter().collect() });
        self
    }

    /// Writes words just above a point.
    pub fn annotate(mut self, point: Point3, text: impl Into<String>) -> Self {
        self.layers.push(Layer::Note { point, text: text.into() });
        self
    }

    /// Sets the direction from which the space is seen.
    pub fn view(mut self, view: View) -> Self {
        self.view = view;
        self
    }

    /// Sets the range of one axis (0, 1, 2).
    pub fn range(mut self, axis: usize, min: f64, max: f64) -> Self {
        self.axes[axis].range = Some((min, max));
        self
    }

    /// Makes one unit equally long on all axes.
    pub fn equal_aspect(mut self) -> Self {
        self.equal = true;
        self
    }

    /// Leaves out the shadows on the floor.
    pub fn without_shadows(mut self) -> Self {
        self.shadows = false;
        self
    }

    /// Sets the words above the picture. Rich text.
    pub fn caption(mut self, caption: impl Into<String>) -> Self {
        self.caption = caption.into();
        self
    }

    /// Draws the space as a picture of its own, with its legend above.
    pub fn draw(&self) -> Svg {
        let (width, height) = (520.0, 400.0);
        let legend = Legend::new(self.entries(), width - 20.0);
        let mut svg = Svg::new(width, height + legend.height() + 16.0);
        legend.draw(&mut svg, width / 2.0, 8.0);
        let origin = at(10.0, legend.height() + 8.0);
        self.draw_in(&mut svg, Area { origin, size: (width - 20.0, height) });
        svg
    }

    /// Legend entries, in order.
    pub(super) fn entries(&self) -> Vec<Entry> {
        let entry = |layer: &Layer| match layer {
            Layer::Line { label, look, .. } => Some((label.clone(), *look, Sample::Line)),
            Layer::Markers { label, look, .. } => Some((label.clone(), *look, Sample::Marker)),
            _ => None,
        };
        let entries = self.layers.iter().filter_map(entry).filter(|(label, ..)| !label.is_empty());
        entries.map(|(label, look, sample)| Entry { label, look, sample }).collect()
    }

    /// Draws the space inside an area.
    pub(super) fn draw_in(&self, svg: &mut Svg, area: Area) {
        let scene = Scene::new(self, area);
        scene.draw_box(svg, &self.axes);
        if self.shadows {
            self.draw_shadows(svg, &scene);
        }
        for layer in &self.layers {
            match layer {
                Layer::Line { look, points, .. } => scene.polyline(svg, points, look),
                Layer::Markers { look, points, .. } => {
                    for point in points {
                        draw_marker(svg, scene.project(*point), look, 4.0);
                    }
                }
                Layer::Surface { colour, opacity, corners } => {
                    let corners: Vec<_> = corners.iter().map(|p| scene.project(*p)).collect();
                    svg.raw(&format!("<g opacity=\"{opacity}\">"));
                    svg.polygon(&corners, colour, Some(&Look::solid(colour, 0.8)));
                    svg.raw("</g>");
                }
                Layer::Note { point, text } => {
                    let look = TextLook { size: 11.0, anchor: Anchor::Middle, ..TextLook::default() };
                    svg.text(scene.project(*point).offset(0.0, -8.0), text, look);
                }
            }
        }
    }

    fn draw_shadows(&self, svg: &mut Svg, scene: &Scene) {
        let floor = scene.axes[2].min;
        for layer in &self.layers {
            match layer {
                Layer::Line { points, .. } => {
                    let shadow: Vec<Point3> = points.iter().map(|p| [p[0], p[1], floor]).collect();
                    scene.polyline(svg, &shadow, &SHADOW);
                }
                Layer::Markers { points, .. } => {
                    for p in points {
                        svg.circle(scene.project([p[0], p[1], floor]), 2.2, SHADOW.colour, None);
                    }
                }
                _ => {}
            }
        }
    }

    fn extent(&self, axis: usize) -> Vec<f64> {
        let value = |layer: &Layer| -> Vec<f64> {
            match layer {
                Layer::Line { points, .. } | Layer::Markers { points, .. } => points.iter().map(|p| p[axis]).collect(),
                Layer::Surface { corners, .. } => corners.iter().map(|p| p[axis]).collect(),
                Layer::Note { point, .. } => vec![point[axis]],
            }
        };
        self.layers.iter().flat_map(value).collect()
    }
}

/// Settled axes and the projection of a [`Space`] into an area.
struct Scene {
    axes: [SettledAxis; 3],
    /// Edges of the box, in units of the projection.
    edges: Point3,
    view: View,
    scale: f64,
    centre: Point,
}

impl Scene {
    fn new(space: &Space, area: Area) -> Self {
        let axes = [0, 1, 2].map(|i| space.axes[i].settle(space.extent(i).into_iter(), true, TARGET_TICKS));
        let lengths = [0, 1, 2].map(|i| axes[i].max - axes[i].min);
        let longest = lengths.iter().copied().fold(0.0, f64::max);
        let edges = if space.equal { lengths.map(|l| l / longest) } else { [1.0, 1.0, FREE_HEIGHT] };
        let mut scene = Self { axes, edges, view: space.view, scale: 1.0, centre: at(0.0, 0.0) };
        scene.fit(area);
        scene
    }

    /// Scales and centres the box in the area, with room for labels.
    fn fit(&mut self, area: Area) {
        let corners: Vec<Point> = (0..8u8).map(|i| self.project_fraction(corner(i))).collect();
        let span = |value: fn(&Point) -> f64| {
            let (low, high) = corners.iter().map(value).fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(v), h.max(v)));
            (low, high)
        };
        let ((left, right), (top, bottom)) = (span(|p| p.x), span(|p| p.y));
        let (room_x, room_y) = (64.0, 44.0);
        let (width, height) = (area.size.0 - 2.0 * room_x, area.size.1 - room_y - 10.0);
        let scale = (width / (right - left)).min(height / (bottom - top));
        let middle = area.origin.offset(area.size.0 / 2.0, 10.0 + height / 2.0);
        self.centre = middle.offset(-scale * (left + right) / 2.0, -scale * (top + bottom) / 2.0);
        self.scale = scale;
    }

    /// Projects fractions (0 to 1) of the box.
    fn project_fraction(&self, f: Point3) -> Point {
        let [x, y, z] = [0, 1, 2].map(|i| (f[i] - 0.5) * self.edges[i]);
        let (sin_a, cos_a) = self.view.azimuth_deg.to_radians().sin_cos();
        let (sin_e, cos_e) = self.view.elevation_deg.to_radians().sin_cos();
        let across = -sin_a * x + cos_a * y;
        let towards = cos_a * x + sin_a * y;
        at(self.centre.x + self.scale * across, self.centre.y - self.scale * (cos_e * z - sin_e * towards))
    }

    fn project(&self, p: Point3) -> Point {
        self.project_fraction([0, 1, 2].map(|i| self.axes[i].fraction(p[i])))
    }

    fn polyline(&self, svg: &mut Svg, points: &[Point3], look: &Look) {
        let projected: Vec<(f64, f64)> = points.iter().map(|p| self.project(*p)).map(|p| (p.x, p.y)).collect();
        for run in decimate(&projected, Resolution { x: 1.0, y: 1.0 }) {
            let run: Vec<Point> = run.into_iter().map(|(x, y)| at(x, y)).collect();
            svg.polyline(&run, look);
        }
    }

    /// The sides (fractions 0 or 1) of the first two axes that face the eye.
    fn near(&self) -> (f64, f64) {
        let (sin_a, cos_a) = self.view.azimuth_deg.to_radians().sin_cos();
        (if cos_a > 0.0 { 1.0 } else { 0.0 }, if sin_a > 0.0 { 1.0 } else { 0.0 })
    }

    /// Floor and far walls with grid lines, and the three edges with ticks and labels.
    fn draw_box(&self, svg: &mut Svg, axes: &[Axis; 3]) {
        let (near_x, near_y) = self.near();
        let (far_x, far_y) = (1.0 - near_x, 1.0 - near_y);
        let mut line = |a: Point3, b: Point3, look: &Look| {
            svg.polyline(&[self.project_fraction(a), self.project_fraction(b)], look);
        };
        let fractions = |i: usize| self.axes[i].ticks().into_iter().map(move |t| self.axes[i].fraction(t));
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
        let (right_x, right_y) = if left_x == near_x { (far_x, near_y) } else { (near_x, far_y) };
        svg.polyline(
            &[[right_x, right_y, 0.0], [right_x, right_y, 1.0]].map(|f| self.project_fraction(f)),
            &outline,
        );
    }

    /// The vertical edge that lies farthest to the left; it bounds one far wall.
    fn leftmost(&self, near_x: f64, near_y: f64) -> (f64, f64) {
        let candidates = [(near_x, 1.0 - near_y), (1.0 - near_x, near_y)];
        let left = |c: &(f64, f64)| self.project_fraction([c.0, c.1, 0.0]).x;
        if left(&candidates[0]) < left(&candidates[1]) { candidates[0] } else { candidates[1] }
    }

    /// One edge with ticks, numbers and label; `start` is its lower end, in fractions.
    fn draw_axis(&self, svg: &mut Svg, axis: usize, start: Point3, label: &str) {
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
            svg.text(at.offset(0.0, tick_drop(outwards)), &words, label_look(TICK, outwards));
        }
        let middle = place(0.5);
        if axis == 2 {
            let look = TextLook { size: LABEL, anchor: Anchor::Middle, rotation: -90.0, ..TextLook::default() };
            svg.text(middle.offset(-(widest + 20.0), 0.0), label, look);
        } else {
            let distance = 16.0 + TICK + widest * outwards.0.abs();
            let at = middle.offset(distance * outwards.0, distance * outwards.1);
            svg.text(at.offset(0.0, tick_drop(outwards)), label, label_look(LABEL, outwards));
        }
    }

    /// Unit vector on the page from the box outwards, square to an edge.
    fn outwards(&self, a: Point, b: Point) -> (f64, f64) {
        let length = (b.x - a.x).hypot(b.y - a.y).max(1e-9);
        let normal = ((b.y - a.y) / length, -(b.x - a.x) / length);
        let centre = self.project_fraction([0.5; 3]);
        let inwards = (centre.x - (a.x + b.x) / 2.0) * normal.0 + (centre.y - (a.y + b.y) / 2.0) * normal.1;
        if inwards > 0.0 { (-normal.0, -normal.1) } else { normal }
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
    TextLook { size, anchor, ..TextLook::default() }
}
