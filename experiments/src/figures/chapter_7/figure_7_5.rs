//! Figure 7.5: geometry of the pinhole camera.

use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::diagram::{ARROW, BLUE_TINT, CONSTRUCTION};
use crate::plot::sketch::{Eye, Sketch};
use crate::plot::style::{BLUE, GREEN, INK, Look, VERMILION};
use crate::plot::svg::at;
use crate::station::{NOMINAL_STATION, load_station};
use ets::Ets;
use nalgebra::{Matrix3, Vector2, Vector3};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "7.5",
    title: "Geometry of the pinhole camera",
    description: "A target at *p*_{C} = [*x*, *y*, *z*] in the camera frame C, *x*_{C} along the optical axis, is seen at \
                  *r*_{C} = *f* [*y*/*x*, *z*/*x*] on the image plane (drawn in front of the centre), measured in px from the principal point, to the \
                  right and down. The rectangle is the image of the nominal camera, 640 × 480 px, the target that of figure 7.6, [200, 100] px.",
    kind: Kind::Diagram,
    origin: Origin::Schematic,
    claims: &[],
    make: Make::Draw(draw),
};

/// Distance of the image plane from the centre as drawn, and depth of the target.
const PLANE: f64 = 1.6;
const DEPTH: f64 = 3.1;

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let ets = Ets::<f64>::new(&load_station(context, NOMINAL_STATION)?);
    let camera = ets.camera;
    // C as drawn: x north, y east, z down.
    let eye = Eye {
        azimuth_deg: -48.0,
        elevation_deg: 18.0,
        scale: 148.0,
        origin: at(70.0, 180.0),
    };
    let mut sketch = Sketch::new(570.0, 300.0, eye);
    let on_plane = |r: Vector2<f64>, depth: f64| {
        Vector3::new(1.0, r.x / camera.focal_length, r.y / camera.focal_length) * depth
    };
    let r = Vector2::new(200.0, 100.0);
    let [left, top] = camera.principal_point.map(|x| -x);
    let (right, bottom) = (left + camera.pixels[0], top + camera.pixels[1]);
    let corners =
        [[left, top], [right, top], [right, bottom], [left, bottom]].map(|c| on_plane(c.into(), PLANE));
    let (centre, principal) = (Vector3::zeros(), on_plane(Vector2::zeros(), PLANE));
    let (image, target) = (on_plane(r, PLANE), on_plane(r, DEPTH));

    sketch.line(&[image, target], Look::solid(GREEN, 1.8));
    sketch.line(&[principal, Vector3::x() * DEPTH], CONSTRUCTION);
    sketch.line(
        &[Vector3::x() * DEPTH, Vector3::new(DEPTH, target.y, 0.0), target],
        CONSTRUCTION,
    );
    sketch.polygon(&corners, BLUE_TINT);
    for corner in corners {
        sketch.line(&[centre, corner], CONSTRUCTION);
    }
    sketch.line(&[centre, principal], CONSTRUCTION);
    sketch.arrow(
        &[principal, Vector3::new(PLANE, 0.62, 0.0)],
        Look::solid(INK, 1.2),
    );
    sketch.arrow(&[principal, Vector3::new(PLANE, 0.0, 0.5)], Look::solid(INK, 1.2));
    sketch.label(&Vector3::new(PLANE, 0.62, 0.0), (-8.0, -10.0), "*r*_{1}");
    sketch.label(&Vector3::new(PLANE, 0.0, 0.5), (-14.0, -2.0), "*r*_{2}");
    sketch.arrow(&[principal, image], Look::solid(VERMILION, 2.0));
    sketch.label(&image, (-4.0, 20.0), "*r*_{C}");
    sketch.line(&[centre, image], Look::solid(GREEN, 1.8));
    sketch.arrow(&[centre, Vector3::x() * 0.62], Look::solid(BLUE, 2.0));
    sketch.label(&(Vector3::x() * 0.62), (-14.0, 15.0), "*x*_{C}");
    sketch.axes(
        centre,
        &Matrix3::identity(),
        0.62,
        ["", "*y*_{C}", "*z*_{C}"],
        Look::solid(BLUE, 2.0),
    );
    dot(&mut sketch, &eye, &target, "#1a1a1a");
    dot(&mut sketch, &eye, &image, VERMILION);
    dot(&mut sketch, &eye, &principal, "#1a1a1a");
    sketch.label(&target, (10.0, 22.0), "target *p*_{C}");
    sketch.label(&centre, (-24.0, -12.0), "centre");
    sketch.label(&(Vector3::x() * 1.3), (0.0, 16.0), "*f*");
    sketch.label(&corners[1], (26.0, -8.0), "image plane");
    sketch.label(&Vector3::new(DEPTH, target.y / 2.0, 0.0), (2.0, -8.0), "*y*");
    sketch.label(&Vector3::new(DEPTH, target.y, target.z / 2.0), (12.0, 2.0), "*z*");
    sketch.arrow(
        &[Vector3::x() * (DEPTH - 0.01), Vector3::x() * (DEPTH + 0.45)],
        ARROW,
    );
    sketch.label(&(Vector3::x() * (DEPTH + 0.45)), (10.0, -8.0), "optical axis");
    Ok(Drawing::picture(sketch.finish()))
}

fn dot(sketch: &mut Sketch, eye: &Eye, point: &Vector3<f64>, colour: &'static str) {
    sketch.diagram.circle(eye.page(point), 3.0, colour);
}
