//! Figure 7.3: the reference frame E of the energy transmission system.

use crate::drawing::Drawing;
use crate::figures::glyphs;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::diagram::{ARROW, CONSTRUCTION};
use crate::plot::sketch::{Eye, Sketch, arc};
use crate::plot::style::{BLUE, Look, VERMILION};
use crate::plot::svg::at;
use crate::station::{NOMINAL_STATION, load_station};
use ets::{Ets, GimbalState};
use nalgebra::{Matrix3, Vector3};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "7.3",
    title: "Reference frame E",
    description: "The frame E is fixed on the moving platform: *x*_{E} along the optical axis and the beam, *y*_{E} to the right, *z*_{E} down, \
                  origin where the axes of the gimbal cross. Pan *ψ*_{E} turns about *z*_{W} (down), positive clockwise seen from above; tilt *θ*_{E} \
                  turns about *y*_{E}, positive upwards. Drawn from the gimbal's own rotation, heading of the pedestal zero.",
    kind: Kind::Diagram,
    origin: Origin::Schematic,
    claims: &[],
    make: Make::Draw(draw),
};

/// The angles drawn, rad.
const PAN: f64 = 1.0;
const TILT: f64 = 0.5;

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let station = load_station(context, NOMINAL_STATION)?;
    let ets = Ets::<f64>::new(&station);
    let eye = Eye {
        azimuth_deg: -8.0,
        elevation_deg: 26.0,
        scale: 150.0,
        origin: at(150.0, 160.0),
    };
    let mut sketch = Sketch::new(430.0, 370.0, eye);
    let gimbal = GimbalState::at_rest(PAN, TILT);
    let r_we = ets.pedestal.rotation(&gimbal).matrix;
    let level = ets.pedestal.rotation(&GimbalState::at_rest(PAN, 0.0)).matrix;
    let origin = ets.pedestal.origin();
    let [north, panned, axis] = [
        Vector3::x(),
        level.column(0).into_owned(),
        r_we.column(0).into_owned(),
    ];

    sketch.axes(
        origin,
        &Matrix3::identity(),
        1.3,
        ["*x*_{W} north", "", "*z*_{W} down"],
        ARROW,
    );
    sketch.arrow(&[origin, Vector3::y() * 1.3], ARROW);
    sketch.label(&(Vector3::y() * 1.3), (30.0, 2.0), "*y*_{W} east");
    sketch.line(&[origin, panned * 1.3], CONSTRUCTION);
    glyphs::station(&mut sketch, &ets, &gimbal, 0.36, 0.95);
    sketch.axes(
        origin,
        &r_we,
        1.35,
        ["*x*_{E}", "*y*_{E}", "*z*_{E}"],
        Look::solid(BLUE, 2.0),
    );
    sketch.arrow(
        &arc(origin, (north, Vector3::y()), 0.95, (0.0, PAN)),
        Look::solid(VERMILION, 1.6),
    );
    sketch.label(
        &((panned + north * 1.4).normalize() * 0.95),
        (-8.0, -20.0),
        "*ψ*_{E}",
    );
    sketch.arrow(
        &arc(origin, (panned, -Vector3::z()), 1.1, (0.0, TILT)),
        Look::solid(VERMILION, 1.6),
    );
    sketch.label(&((panned + axis) * 0.6), (16.0, 4.0), "*θ*_{E}");
    Ok(Drawing::picture(sketch.finish()))
}
