//! Figure 3.1: body frame against world frame, forces and moments.

use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::diagram::{ARROW, CONSTRUCTION, Diagram};
use crate::plot::sketch::Eye;
use crate::plot::style::{BLUE, GREY, Look, VERMILION};
use crate::plot::svg::{Point, at};
use crate::vehicle::{NOMINAL_VEHICLE, load_vehicle};
use nalgebra::Vector3;
use quad_dynamics::RotorGeometry;
use quad_kinematics::{Body, EulerAngles, FrameVector, Rotation, World};
use quad_rotor::RotorOutput;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "3.1",
    title: "Body frame against world frame, forces and moments",
    description: "The body frame B (forward, right, down) of a quadrotor against the world frame W (north, east, down), \
                  with the thrusts *T*_{i} of its rotors, their reaction torques *Q*_{i} and the weight. Drawn from the \
                  frame types and the nominal vehicle's geometry; arcs at the rotors show the reaction torque on the airframe.",
    kind: Kind::Diagram,
    origin: Origin::Schematic,
    claims: &[ALONG_AXIS, OPPOSES],
    make: Make::Draw(draw),
};

const ALONG_AXIS: Claim = Claim::holds("thrust acts along the rotor axis");
const OPPOSES: Claim = Claim::holds("torque opposes the direction of rotation");

/// Pixels per arm length, and where the centre of mass and the world's origin are drawn.
const SCALE: f64 = 150.0;
const CENTRE: Point = Point { x: 370.0, y: 215.0 };
const ORIGIN: Point = Point { x: 92.0, y: 330.0 };

/// World components to the page: seen from the south-west and above, orthographic.
fn page(from: Point, v_w: Vector3<f64>, scale: f64) -> Point {
    let eye = Eye {
        azimuth_deg: 30.0,
        elevation_deg: 25.0,
        scale,
        origin: from,
    };
    eye.page(&v_w)
}

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let vehicle = load_vehicle(context, NOMINAL_VEHICLE)?;
    let geometry = RotorGeometry::<f64>::of(&vehicle);
    let r_wb = EulerAngles::new(0.12, 0.16, 0.35).rotation();
    let mut diagram = Diagram::new(640.0, 430.0);
    axes(
        &mut diagram,
        ORIGIN,
        &Rotation::<f64, World, World>::identity(),
        [
            ("*x*_{W} north", (-26.0, -12.0)),
            ("*y*_{W} east", (27.0, -4.0)),
            ("*z*_{W} down", (0.0, 18.0)),
        ],
        0.45,
    );
    diagram.line(&[ORIGIN, CENTRE], CONSTRUCTION);
    diagram.text(at(203.0, 274.0), "*r*");
    let arm = vehicle.airframe.arm_length;
    for (i, hub) in vehicle.hubs().into_iter().enumerate() {
        rotor(&mut diagram, &r_wb, hub / arm, geometry.spin[i], i + 1);
    }
    axes(
        &mut diagram,
        CENTRE,
        &r_wb,
        [
            ("*x*_{B}", (-15.0, 6.0)),
            ("*y*_{B}", (-3.0, -11.0)),
            ("*z*_{B}", (-11.0, -20.0)),
        ],
        0.5,
    );
    let weight = CENTRE.offset(0.0, 135.0);
    diagram.arrow(&[CENTRE, weight], Look::solid(GREY, 2.2));
    diagram.text(weight.offset(-18.0, 0.0), "*m g*");
    let (sideways, along) = extremes(&geometry);
    Ok(Drawing::picture(diagram.finish())
        .check(
            ALONG_AXIS,
            sideways == 0.0,
            format!("largest component of unit thrusts across −z_B: {sideways}"),
        )
        .check(
            OPPOSES,
            along < 0.0,
            format!("largest yaw moment of unit torques along the spin: {along}"),
        ))
}

/// Largest sideways force of a unit thrust, and largest component of a unit torque along the spin.
fn extremes(geometry: &RotorGeometry<f64>) -> (f64, f64) {
    let mut found = (0.0_f64, f64::NEG_INFINITY);
    for i in 0..4 {
        let mut rotors = [RotorOutput {
            thrust: 0.0,
            torque: 0.0,
        }; 4];
        rotors[i] = RotorOutput {
            thrust: 1.0,
            torque: 1.0,
        };
        let wrench = geometry.wrench(&rotors);
        let off_axis = (wrench.force + Vector3::z()).norm();
        found = (
            found.0.max(off_axis),
            found.1.max(wrench.moment.z * geometry.spin[i]),
        );
    }
    found
}

/// Three axes; each name stands at an offset from its tip where it is clear of rotors and arrows.
fn axes<From>(
    diagram: &mut Diagram,
    origin: Point,
    r: &Rotation<f64, From, World>,
    names: [(&str, (f64, f64)); 3],
    length: f64,
) {
    for (axis, (name, (dx, dy))) in [Vector3::x(), Vector3::y(), Vector3::z()].into_iter().zip(names) {
        let v_w = r.rotate(FrameVector::from_components(axis * length)).v;
        let tip = page(origin, v_w, SCALE);
        diagram.arrow(&[origin, tip], ARROW);
        diagram.text(tip.offset(dx, dy), name);
    }
}

/// One rotor: arm, disc, thrust, and the reaction torque as an arc against the spin.
fn rotor(
    diagram: &mut Diagram,
    r_wb: &Rotation<f64, Body, World>,
    hub: Vector3<f64>,
    spin: f64,
    number: usize,
) {
    let to_page = |v_b: Vector3<f64>| page(CENTRE, r_wb.rotate(FrameVector::from_components(v_b)).v, SCALE);
    let around = |radius: f64, from: f64, to: f64| -> Vec<Point> {
        let at_angle = |a: f64| to_page(hub + Vector3::new(radius * a.cos(), radius * a.sin(), 0.0));
        (0..=48)
            .map(|k| at_angle(from + (to - from) * f64::from(k) / 48.0))
            .collect()
    };
    diagram.line(&[CENTRE, to_page(hub)], Look::solid(GREY, 5.0));
    diagram.line(&around(0.42, 0.0, std::f64::consts::TAU), Look::solid(GREY, 1.0));
    let thrust_tip = to_page(hub - Vector3::z() * 0.62);
    diagram.arrow(&[to_page(hub), thrust_tip], Look::solid(BLUE, 2.2));
    diagram.text(thrust_tip.offset(14.0, 10.0), &format!("*T*_{{{number}}}"));
    // Positive angles about z_B go clockwise seen from above; the torque goes the other way.
    diagram.arrow(&around(0.3, 0.3, 0.3 - spin * 4.2), Look::solid(VERMILION, 1.8));
    let label = to_page(hub * 1.62);
    diagram.text(label.offset(-6.0, 5.0), &format!("*Q*_{{{number}}}"));
}
