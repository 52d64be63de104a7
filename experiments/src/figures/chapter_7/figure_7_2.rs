//! Figure 7.2: geometry of the quadrotor and the energy transmission system.

use crate::drawing::Drawing;
use crate::figures::glyphs;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::diagram::{ARROW, CONSTRUCTION};
use crate::plot::sketch::{Eye, Sketch, arc};
use crate::plot::style::{BLUE, GREEN, INK, Look, VERMILION};
use crate::plot::svg::at;
use crate::station::{NOMINAL_STATION, load_station};
use crate::vehicle::{NOMINAL_VEHICLE, load_vehicle};
use ets::{Aperture, Ets, GimbalState, Receiver};
use nalgebra::{Matrix3, Vector3};
use quad_kinematics::EulerAngles;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "7.2",
    title: "Geometry of the quadrotor and ETS agents",
    description: "Range *R* from the emitter to the sensor's centre, angle of incidence *α* between beam and sensor normal *n*, and spot offset \
                  *s* on the sensor's plane, with the frames W, E and B. Drawn from the geometry types, the vehicle larger than true and \
                  the beam off target so that the quantities can be seen.",
    kind: Kind::Diagram,
    origin: Origin::Schematic,
    claims: &[],
    make: Make::Draw(draw),
};

const MAGNIFIED: f64 = 3.6;

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let vehicle = load_vehicle(context, NOMINAL_VEHICLE)?;
    let mut station = load_station(context, NOMINAL_STATION)?;
    station.receiver = Receiver {
        aperture: Aperture::Rectangle {
            half_width: 0.46,
            half_height: 0.42,
        },
        offset: station.receiver.offset.map(|x| x * MAGNIFIED),
        ..station.receiver
    };
    let ets = Ets::<f64>::new(&station);
    let eye = Eye {
        azimuth_deg: -62.0,
        elevation_deg: 16.0,
        scale: 118.0,
        origin: at(110.0, 278.0),
    };
    let mut sketch = Sketch::new(650.0, 385.0, eye);
    let position = Vector3::new(1.5, 3.0, -1.9);
    let r_wb = EulerAngles::new(0.0, 0.0, glyphs::heading_home(&position) + 0.5)
        .rotation()
        .matrix;
    let face = ets.receiver.on(&position, &r_wb);
    let looking = glyphs::looking_at(&ets, &face.centre);
    let gimbal = GimbalState::at_rest(looking.pan - 0.035, looking.tilt + 0.06);
    let (ray, link) = (ets.ray(&gimbal), ets.link(&gimbal, &face).geometry);
    let spot = face.centre + face.axes * Vector3::new(link.spot.x, link.spot.y, 0.0);
    let normal = face.axes.column(2).into_owned();

    sketch.axes(
        Vector3::new(1.2, 2.2, -0.3),
        &Matrix3::identity(),
        0.55,
        ["*x*_{W}", "*y*_{W}", "*z*_{W}"],
        ARROW,
    );
    glyphs::quadrotor(&mut sketch, &vehicle, position, &r_wb, MAGNIFIED);
    sketch.axes(position, &r_wb, 0.52, ["", "", "*z*_{B}"], Look::solid(BLUE, 1.4));
    let right = r_wb.column(1).into_owned();
    sketch.arrow(&[position, position + right * 0.52], Look::solid(BLUE, 1.4));
    sketch.label(&(position + right * 0.52), (-4.0, 20.0), "*y*_{B}");
    // The sensor is in front of the body.
    glyphs::face(&mut sketch, &face, &ets.receiver.aperture);
    sketch.line(&[ray.origin, face.centre], CONSTRUCTION);
    sketch.arrow(
        &[ray.origin + ray.direction * 0.34, spot],
        Look::solid(GREEN, 2.6),
    );
    glyphs::station(&mut sketch, &ets, &gimbal, 0.3, 0.55);
    let r_we = ets.pedestal.rotation(&gimbal).matrix;
    sketch.axes(
        ray.origin,
        &r_we,
        0.8,
        ["", "*y*_{E}", "*z*_{E}"],
        Look::solid(BLUE, 1.4),
    );
    sketch.label(&(ray.origin + ray.direction * 0.75), (-18.0, -8.0), "*x*_{E}");

    sketch.arrow(&[face.centre, face.centre + normal * 1.15], ARROW);
    sketch.label(&(face.centre + normal * 1.15), (-26.0, 0.0), "*n*, *x*_{B}");
    // The angle of incidence, at the spot between the incoming beam and a parallel to the normal.
    sketch.line(&[spot, spot + normal * 0.95], CONSTRUCTION);
    let back = -ray.direction;
    let across = (normal - back * normal.dot(&back)).normalize();
    sketch.line(
        &arc(spot, (back, across), 0.5, (0.0, link.incidence)),
        Look::solid(INK, 1.2),
    );
    sketch.label(&(spot + (back + normal).normalize() * 0.62), (21.0, 0.0), "*α*");
    sketch.arrow(&[face.centre, spot], Look::solid(VERMILION, 2.0));
    sketch.label(&((face.centre + spot) / 2.0), (16.0, 6.0), "*s*");
    sketch.label(&(face.centre * 0.5), (14.0, 20.0), "*R*");
    sketch.label(&position, (86.0, 70.0), "quadrotor");
    sketch.label(&(ray.origin + Vector3::z() * 0.55), (-62.0, -4.0), "ETS");
    sketch.label(&((ray.origin + spot) / 2.0), (-30.0, -10.0), "beam");
    Ok(Drawing::picture(sketch.finish()))
}
