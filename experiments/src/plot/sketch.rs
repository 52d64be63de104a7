//! Sketches in space: points in W (north, east, down) projected onto a diagram, orthographic.

use super::diagram::Diagram;
use super::style::Look;
use super::svg::{Point, Svg};
use nalgebra::{Matrix3, Vector3};

/// From where a sketch is seen, and where on the page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eye {
    /// Heading of the view, degrees clockwise from north.
    pub azimuth_deg: f64,
    /// Height of the eye above the horizon, degrees.
    pub elevation_deg: f64,
    /// Pixels per metre.
    pub scale: f64,
    /// Where the origin of W is drawn.
    pub origin: Point,
}

/// A diagram of things in space; draw from back to front.
#[derive(Clone, Debug)]
pub struct Sketch {
    /// The page, for words and signs.
    pub diagram: Diagram,
    eye: Eye,
}

impl Eye {
    /// The place of a point in W (m) on the page.
    pub fn page(&self, p_w: &Vector3<f64>) -> Point {
        let (sin_a, cos_a) = self.azimuth_deg.to_radians().sin_cos();
        let (sin_e, cos_e) = self.elevation_deg.to_radians().sin_cos();
        let right = p_w.y * cos_a - p_w.x * sin_a;
        let away = p_w.x * cos_a + p_w.y * sin_a;
        let up = -p_w.z * cos_e + away * sin_e;
        self.origin.offset(self.scale * right, -self.scale * up)
    }

    /// Unit vector in W from the scene to the eye.
    fn towards(&self) -> Vector3<f64> {
        let (sin_a, cos_a) = self.azimuth_deg.to_radians().sin_cos();
        let (sin_e, cos_e) = self.elevation_deg.to_radians().sin_cos();
        -Vector3::new(cos_e * cos_a, cos_e * sin_a, sin_e)
    }
}

/// Points of an arc about a centre in the plane of two unit vectors, angles in rad from the first to the second.
pub fn arc(
    centre: Vector3<f64>,
    (first, second): (Vector3<f64>, Vector3<f64>),
    radius: f64,
    (from, to): (f64, f64),
) -> Vec<Vector3<f64>> {
    const STEPS: u32 = 48;
    (0..=STEPS)
        .map(|k| from + (to - from) * f64::from(k) / f64::from(STEPS))
        .map(|a| centre + (first * a.cos() + second * a.sin()) * radius)
        .collect()
}

impl Sketch {
    /// An empty sketch of this size, px.
    pub fn new(width: f64, height: f64, eye: Eye) -> Self {
        Self {
            diagram: Diagram::new(width, height),
            eye,
        }
    }

    /// The finished picture.
    pub fn finish(self) -> Svg {
        self.diagram.finish()
    }

    fn pages(&self, points: &[Vector3<f64>]) -> Vec<Point> {
        points.iter().map(|p| self.eye.page(p)).collect()
    }

    /// Draws a line.
    pub fn line(&mut self, points: &[Vector3<f64>], look: Look) {
        let pages = self.pages(points);
        self.diagram.line(&pages, look);
    }

    /// Draws a line that ends in an arrow head.
    pub fn arrow(&mut self, points: &[Vector3<f64>], look: Look) {
        let pages = self.pages(points);
        self.diagram.arrow(&pages, look);
    }

    /// Draws a filled polygon with an outline.
    pub fn polygon(&mut self, corners: &[Vector3<f64>], fill: &'static str) {
        let pages = self.pages(corners);
        self.diagram.polygon(&pages, fill);
    }

    /// Writes words near a point, moved by px on the page.
    pub fn label(&mut self, point: &Vector3<f64>, (dx, dy): (f64, f64), words: &str) {
        let place = self.eye.page(point).offset(dx, dy);
        self.diagram.text(place, words);
    }

    /// Draws the axes of a frame with names beyond their tips; an empty name leaves its axis out.
    pub fn axes(
        &mut self,
        origin: Vector3<f64>,
        r: &Matrix3<f64>,
        length: f64,
        names: [&str; 3],
        look: Look,
    ) {
        for (i, name) in names.into_iter().enumerate().filter(|(_, name)| !name.is_empty()) {
            let tip = origin + r.column(i) * length;
            self.arrow(&[origin, tip], look);
            let (a, b) = (self.eye.page(&origin), self.eye.page(&tip));
            let size = (b.x - a.x).hypot(b.y - a.y).max(1.0);
            let gap = 15.0;
            let place = b.offset(gap * (b.x - a.x) / size, gap * (b.y - a.y) / size + 4.0);
            self.diagram.text(place, name);
        }
    }

    /// Draws a box with its axes along the columns of `r`: the faces that the eye sees.
    pub fn solid(&mut self, centre: Vector3<f64>, r: &Matrix3<f64>, half: [f64; 3], fill: &'static str) {
        let towards = self.eye.towards();
        for (i, sign) in (0..3).flat_map(|i| [(i, 1.0), (i, -1.0)]) {
            let normal = r.column(i) * sign;
            if normal.dot(&towards) <= 0.0 {
                continue;
            }
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let middle = centre + normal * half[i];
            let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
                .map(|(a, b)| middle + r.column(j) * (a * half[j]) + r.column(k) * (b * half[k]));
            self.polygon(&corners, fill);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::svg::at;

    #[test]
    fn exact_views_along_the_axes() {
        let eye = |azimuth_deg, elevation_deg| Eye {
            azimuth_deg,
            elevation_deg,
            scale: 10.0,
            origin: at(0.0, 0.0),
        };
        let close = |p: Point, x: f64, y: f64| (p.x - x).abs() < 1e-12 && (p.y - y).abs() < 1e-12;
        // Looking north from the horizon: east is right, down is down.
        assert!(close(
            eye(0.0, 0.0).page(&Vector3::new(7.0, 1.0, 2.0)),
            10.0,
            20.0
        ));
        // From above, north up the page.
        assert!(close(
            eye(0.0, 90.0).page(&Vector3::new(1.0, 2.0, 5.0)),
            20.0,
            -10.0
        ));
        // The eye's direction is seen as a point.
        let oblique = eye(30.0, 25.0);
        assert!(close(oblique.page(&(oblique.towards() * 3.0)), 0.0, 0.0));
    }
}
