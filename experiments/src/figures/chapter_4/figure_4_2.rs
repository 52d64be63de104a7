//! Figure 4.2: the forces at the centre of mass and at three support points.

use super::supports;
use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::diagram::{ARROW, BLUE_TINT, Diagram};
use crate::plot::style::{BLUE, FAINT, GREY, Look, VERMILION};
use crate::plot::svg::{Point, at};
use nalgebra::Vector3;
use sysid::laboratory::supports::icosahedral_cage;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "4.2",
    title: "Forces at the centre of mass and at three support points",
    description: "The vehicle, in a cage, stands upright on three scales. Their forces *F*_{i} (vermilion, to scale) and the \
                  weight *m g* at the centre of mass G (blue, to a third of that scale) are those of the virtual laboratory without \
                  sensor errors; C is the centre of pressure below G. The cage is a stand-in, an icosahedron of radius 0.35 m; the \
                  centre of mass is drawn ten times as far from the middle in the horizontal as it is.",
    kind: Kind::Diagram,
    origin: Origin::VirtualLaboratory,
    claims: &[BALANCE],
    make: Make::Draw(draw),
};

const BALANCE: Claim = Claim::holds("the three forces balance the weight and its moments");

/// Pixels per metre and per newton; where the middle of the cage is drawn.
const SCALE: f64 = 520.0;
const NEWTON: f64 = 20.0;
const MIDDLE: Point = Point { x: 300.0, y: 190.0 };
/// How much farther from the middle the centre of mass is drawn than it is.
const EXAGGERATION: f64 = 10.0;

/// Airframe axes (forward, right, down) to the page, seen from behind, right and above, orthographic.
fn page(p: &Vector3<f64>) -> Point {
    let (azimuth, elevation) = (12.0_f64.to_radians(), 20.0_f64.to_radians());
    let right = p.y * azimuth.cos() + p.x * azimuth.sin();
    let away = p.x * azimuth.cos() - p.y * azimuth.sin();
    let up = -p.z * elevation.cos() + away * elevation.sin();
    MIDDLE.offset(SCALE * right, -SCALE * up)
}

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let test = supports::test(context, supports::perfect_rig())?;
    let placing = test.placings[0];
    let (points, forces) = (placing.points(), placing.forces());
    let truth = test.vehicle.airframe.centre_of_mass;
    let weight = test.vehicle.weight();
    let mut diagram = Diagram::new(530.0, 485.0);
    for face in icosahedral_cage(supports::CAGE_RADIUS_M) {
        let [a, b, c] = face.map(|p| page(&p));
        diagram.line(&[a, b, c, a], Look::solid(FAINT, 1.1));
    }
    diagram.polygon(&points.map(|p| page(&p)), BLUE_TINT);
    for hub in &test.vehicle.hubs() {
        rotor(&mut diagram, hub);
    }
    let drawn = |p: Vector3<f64>| Vector3::new(EXAGGERATION * p.x, EXAGGERATION * p.y, p.z);
    let (g, c) = (
        page(&drawn(truth)),
        page(&drawn(test.found.lines[0].centre_of_pressure)),
    );
    diagram.line(&[g, c], Look::solid(GREY, 1.2).dashed("4 3"));
    diagram.arrow(&[g, g.offset(0.0, NEWTON * weight / 3.0)], Look::solid(BLUE, 2.4));
    diagram.text(g.offset(24.0, NEWTON * weight / 3.0 - 6.0), "*m g*");
    diagram.circle(g, 4.5, BLUE);
    diagram.text(g.offset(-14.0, -6.0), "G");
    diagram.circle(c, 3.5, "#ffffff");
    diagram.text(c.offset(14.0, 12.0), "C");
    for (i, (point, force)) in points.iter().zip(forces).enumerate() {
        let foot = page(point);
        let tail = foot.offset(0.0, NEWTON * force);
        diagram.arrow(&[tail, foot], Look::solid(VERMILION, 2.2));
        let words = format!("*F*_{{{}}} = {force:.2} N", i + 1);
        diagram.text(tail.offset(0.0, 16.0), &words);
    }
    axes(&mut diagram);
    let moment: Vector3<f64> = points
        .iter()
        .zip(forces)
        .map(|(p, f)| (p - truth).cross(&Vector3::new(0.0, 0.0, -f)))
        .sum();
    let missing = forces.iter().sum::<f64>() - weight;
    Ok(Drawing::picture(diagram.finish())
        .data(supports::table(&test.placings[..1]))
        .settings(&test.settings)?
        // Rounding of newtons and of their moments on arms of 0.35 m.
        .check(
            BALANCE,
            missing.abs() < 1e-12 && moment.norm() < 1e-12,
            format!("{missing:.0e} N and {:.0e} N m are left over", moment.norm()),
        ))
}

fn rotor(diagram: &mut Diagram, hub: &Vector3<f64>) {
    diagram.line(&[page(&Vector3::zeros()), page(hub)], Look::solid(GREY, 4.0));
    // Radius of the ten-inch propeller.
    let rim = |k: i32| {
        let (sine, cosine) = (f64::from(k) * std::f64::consts::TAU / 48.0).sin_cos();
        page(&(hub + Vector3::new(cosine, sine, 0.0) * 0.127))
    };
    diagram.line(&(0..=48).map(rim).collect::<Vec<_>>(), Look::solid(GREY, 1.2));
}

/// The airframe's axes, beside the vehicle.
fn axes(diagram: &mut Diagram) {
    let origin = at(70.0, 380.0);
    for (axis, name) in [
        (Vector3::x(), "*x*_{B}"),
        (Vector3::y(), "*y*_{B}"),
        (Vector3::z(), "*z*_{B}"),
    ] {
        let tip = page(&(axis * 0.1));
        let (dx, dy) = (tip.x - MIDDLE.x, tip.y - MIDDLE.y);
        diagram.arrow(&[origin, origin.offset(dx, dy)], ARROW);
        diagram.text(origin.offset(1.3 * dx, 1.3 * dy + 4.0), name);
    }
}
