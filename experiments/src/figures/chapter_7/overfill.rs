//! The sensor under an off-centre, oblique beam: how much passes it, and the sketch of it.

use crate::plot::diagram::{BLUE_TINT, Diagram, ORANGE_TINT};
use crate::plot::sketch::arc;
use crate::plot::style::{GREEN, INK, Look, VERMILION};
use crate::plot::svg::{Point, Svg, at};
use ets::{Face, PowerBudget, Ray, Station};
use nalgebra::Vector3;
use quad_kinematics::EulerAngles;
use std::f64::consts::PI;

/// A sensor at the range limit, turned by `incidence` (rad) about its own e_2, hit at `spot` (m) on its plane.
pub(super) struct Overfill {
    pub(super) face: Face<f64>,
    pub(super) ray: Ray<f64>,
}

impl Overfill {
    pub(super) fn new(station: &Station, incidence: f64, spot: [f64; 2]) -> Self {
        let turned = EulerAngles::level(PI + incidence).rotation().matrix;
        let axes = turned * station.receiver.axes();
        let hit = Vector3::new(station.limits.range, 0.0, 0.0);
        Self {
            face: Face {
                centre: hit - axes * Vector3::new(spot[0], spot[1], 0.0),
                axes,
            },
            ray: Ray {
                origin: Vector3::zeros(),
                direction: Vector3::x(),
            },
        }
    }

    /// Where the power goes, W.
    pub(super) fn budget(&self, station: &Station) -> PowerBudget<f64> {
        let light = station.beam.through(&station.atmosphere);
        let receiver = &station.receiver;
        light.budget(&self.ray, &self.face, &receiver.aperture, receiver.efficiency)
    }

    /// Irradiance on the plane of the sensor (through its own area) at a point of it, W/m².
    pub(super) fn on_plane(&self, station: &Station, x: [f64; 2]) -> f64 {
        let light = station.beam.through(&station.atmosphere);
        let q = self.face.centre + self.face.axes * Vector3::new(x[0], x[1], 0.0) - self.ray.origin;
        let z = q.dot(&self.ray.direction);
        let cos = -self.face.axes.column(2).dot(&self.ray.direction);
        light.irradiance(q.norm_squared() - z * z, z) * cos
    }
}

/// Pixels per half sensor, incidence, spot offset and beam radius in half sensors, of the sketch.
const HALF: f64 = 62.0;
const INCIDENCE: f64 = 0.6;
const SPOT: f64 = 0.55;
const RADIUS: f64 = 0.72;

/// The sketch, seen along e_2: the part of the beam that lands and the part that passes.
pub(super) fn sketch() -> Svg {
    let mut diagram = Diagram::new(640.0, 190.0);
    let hit = at(330.0, 92.0);
    // Along the sensor, up the page; the beam comes from the left.
    let (s, c) = INCIDENCE.sin_cos();
    let along = |from: Point, x: f64| from.offset(-HALF * s * x, -HALF * c * x);
    let centre = along(hit, -SPOT);
    let (top, bottom) = (along(centre, 1.0), along(centre, -1.0));
    let w = HALF * RADIUS;
    let on_plane = |y: f64| at(hit.x + (y - hit.y) * s / c, y);
    let (left, right, high, low) = (92.0, 600.0, hit.y - w, hit.y + w);
    let edge = top.y.max(high);
    let landing = [at(left, low), at(left, edge), on_plane(edge), on_plane(low)];
    diagram.polygon(&landing, BLUE_TINT);
    diagram.polygon(
        &[at(left, edge), at(left, high), at(right, high), at(right, edge)],
        ORANGE_TINT,
    );
    diagram.arrow(&[at(left - 50.0, hit.y), hit], Look::solid(GREEN, 1.6));
    diagram.arrow(
        &[
            at(right - 60.0, (edge + high) / 2.0),
            at(right + 30.0, (edge + high) / 2.0),
        ],
        Look::solid(VERMILION, 1.8),
    );
    diagram.line(&[top, bottom], Look::solid(INK, 5.0));
    let normal = centre.offset(-105.0 * c, 105.0 * s);
    diagram.arrow(&[centre, normal], Look::solid(INK, 1.2));
    diagram.text(normal.offset(-10.0, 4.0), "*n*");
    // The angle between normal and incoming light, at the centre of the sensor.
    let parallel = centre.offset(-105.0, 0.0);
    diagram.line(&[centre, parallel], crate::plot::diagram::CONSTRUCTION);
    let page = arc(
        Vector3::zeros(),
        (-Vector3::x(), Vector3::y()),
        70.0,
        (0.0, INCIDENCE),
    );
    let angle: Vec<Point> = page.iter().map(|p| centre.offset(p.x, p.y)).collect();
    diagram.line(&angle, Look::solid(INK, 1.0));
    diagram.text(centre.offset(-82.0, 28.0), "*α*");
    // The spot offset, beside the sensor.
    let beside = |p: Point| p.offset(14.0 * c, -14.0 * s);
    diagram.arrow(&[beside(centre), beside(hit)], Look::solid(INK, 1.2));
    diagram.text(beside(along(centre, SPOT / 2.0)).offset(14.0, 8.0), "*s*");
    diagram.text(at(58.0, hit.y - 8.0), "beam");
    diagram.text(at(500.0, high - 8.0), "missed: overfill");
    diagram.text(bottom.offset(34.0, 8.0), "sensor");
    diagram.line(
        &[at(left + 14.0, hit.y), at(left + 14.0, low)],
        Look::solid(INK, 1.0),
    );
    diagram.text(at(left + 28.0, hit.y + w / 2.0 + 4.0), "*w*");
    diagram.finish()
}
