//! The agents of the power transmission in sketches: quadrotor, sensor and station, from the geometry types.

use crate::plot::diagram::{BLUE_TINT, ORANGE_TINT, QUIET};
use crate::plot::sketch::{Sketch, arc};
use crate::plot::style::{GREY, INK, Look};
use ets::{Aperture, Ets, Face, GimbalState};
use nalgebra::{Matrix3, Vector3};
use quad_dynamics::Vehicle;
use std::f64::consts::TAU;

/// Radius of a propeller in arm lengths: 0.127 m on 0.2 m.
const PROPELLER: f64 = 0.635;

/// A quadrotor: arms and rotor discs, magnified about its centre of mass.
pub(super) fn quadrotor(
    sketch: &mut Sketch,
    vehicle: &Vehicle,
    position: Vector3<f64>,
    r_wb: &Matrix3<f64>,
    magnified: f64,
) {
    let arm = vehicle.airframe.arm_length * magnified;
    let hubs = vehicle.hubs();
    for hub in &hubs {
        let hub = position + r_wb * hub * magnified;
        sketch.line(&[position, hub], Look::solid(GREY, 4.0));
    }
    for hub in &hubs {
        let hub = position + r_wb * (hub * magnified);
        let plane = (r_wb.column(0).into_owned(), r_wb.column(1).into_owned());
        let disc = arc(hub, plane, PROPELLER * arm, (0.0, TAU));
        sketch.line(&disc, Look::solid(GREY, 1.0));
    }
    sketch.solid(position, r_wb, [0.22 * arm, 0.22 * arm, 0.1 * arm], QUIET);
}

/// The sensitive face of a receiver.
pub(super) fn face(sketch: &mut Sketch, face: &Face<f64>, aperture: &Aperture<f64>) {
    let outline: Vec<Vector3<f64>> = outline(aperture)
        .into_iter()
        .map(|[x_1, x_2]| face.centre + face.axes * Vector3::new(x_1, x_2, 0.0))
        .collect();
    sketch.polygon(&outline, BLUE_TINT);
}

/// Outline of an aperture in its own plane, m.
pub(super) fn outline(aperture: &Aperture<f64>) -> Vec<[f64; 2]> {
    match *aperture {
        Aperture::Disc { radius } => (0..=48)
            .map(|k| TAU * f64::from(k) / 48.0)
            .map(|a| [radius * a.cos(), radius * a.sin()])
            .collect(),
        Aperture::Rectangle {
            half_width: w,
            half_height: h,
        } => vec![[-w, -h], [w, -h], [w, h], [-w, h], [-w, -h]],
    }
}

/// The station: a mast on the ground `height` below the crossing of the axes, and the platform of half-length `size`.
pub(super) fn station(
    sketch: &mut Sketch,
    ets: &Ets<f64>,
    gimbal: &GimbalState<f64>,
    size: f64,
    height: f64,
) {
    let origin = ets.pedestal.origin();
    let foot = origin + Vector3::z() * height;
    let ground = (Vector3::x(), Vector3::y());
    sketch.polygon(&arc(foot, ground, 0.9 * size, (0.0, TAU)), QUIET);
    sketch.line(&[foot, origin], Look::solid(GREY, 5.0));
    let r_we = ets.pedestal.rotation(gimbal).matrix;
    sketch.solid(origin, &r_we, [size, 0.45 * size, 0.4 * size], ORANGE_TINT);
    // The lens, on the front of the platform.
    let front = origin + r_we.column(0) * size;
    let plane = (r_we.column(1).into_owned(), r_we.column(2).into_owned());
    sketch.line(&arc(front, plane, 0.25 * size, (0.0, TAU)), Look::solid(INK, 1.2));
}

/// The heading of a vehicle at a position in W whose nose looks at the origin, rad.
pub(super) fn heading_home(position: &Vector3<f64>) -> f64 {
    quad_math::atan2(-position.y, -position.x)
}

/// The angles at which the platform looks at a point in W, at rest.
pub(super) fn looking_at(ets: &Ets<f64>, point: &Vector3<f64>) -> GimbalState<f64> {
    let d = point - ets.pedestal.origin();
    GimbalState::at_rest(
        quad_math::atan2(d.y, d.x) - ets.pedestal.heading,
        quad_math::atan2(-d.z, d.xy().norm()),
    )
}
