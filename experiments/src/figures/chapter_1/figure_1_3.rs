//! Figure 1.3: the scenario of wireless power transmission.

use crate::drawing::Drawing;
use crate::figures::glyphs;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::diagram::{ARROW, Block, GREEN_TINT};
use crate::plot::sketch::{Eye, Sketch};
use crate::plot::style::{GREEN, Look};
use crate::plot::svg::at;
use crate::station::{NOMINAL_STATION, load_station};
use crate::vehicle::{NOMINAL_VEHICLE, load_vehicle};
use ets::{Aperture, Ets, Receiver};
use nalgebra::Vector3;
use quad_kinematics::EulerAngles;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "1.3",
    title: "Scenario of wireless power transmission",
    description: "A ground supply feeds a laser emitter on a gimbal; its beam follows the airborne vehicle, whose photovoltaic sensor \
                  turns the light into electrical power. Directions are those of the geometry types: the platform looks at the \
                  sensor, the vehicle's nose at the station. Not to scale.",
    kind: Kind::Diagram,
    origin: Origin::Schematic,
    claims: &[],
    make: Make::Draw(draw),
};

/// How much larger than true the vehicle is drawn.
const MAGNIFIED: f64 = 3.2;

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let vehicle = load_vehicle(context, NOMINAL_VEHICLE)?;
    let mut station = load_station(context, NOMINAL_STATION)?;
    let true_size = station.receiver;
    station.receiver = Receiver {
        aperture: Aperture::Rectangle {
            half_width: 0.34,
            half_height: 0.3,
        },
        offset: true_size.offset.map(|x| x * MAGNIFIED),
        ..true_size
    };
    let ets = Ets::<f64>::new(&station);
    let eye = Eye {
        azimuth_deg: -58.0,
        elevation_deg: 14.0,
        scale: 108.0,
        origin: at(225.0, 228.0),
    };
    let mut sketch = Sketch::new(660.0, 312.0, eye);
    let position = Vector3::new(1.6, 3.0, -1.75);
    let towards_station = EulerAngles::level(glyphs::heading_home(&position))
        .rotation()
        .matrix;
    let face = ets.receiver.on(&position, &towards_station);
    let gimbal = glyphs::looking_at(&ets, &face.centre);
    let diagram = &mut sketch.diagram;
    diagram.hatched(at(28.0, 290.0), at(640.0, 290.0));
    let supply = diagram.block(
        Block {
            centre: at(84.0, 262.0),
            size: (96.0, 46.0),
            fill: GREEN_TINT,
        },
        "ground\nsupply",
    );
    diagram.arrow(&[supply.right(), at(221.0, supply.centre.y)], ARROW);
    diagram.text(at(160.0, 278.0), "power");
    glyphs::quadrotor(&mut sketch, &vehicle, position, &towards_station, MAGNIFIED);
    glyphs::face(&mut sketch, &face, &ets.receiver.aperture);
    let ray = ets.ray(&gimbal);
    let start = ray.origin + ray.direction * 0.32;
    sketch.arrow(&[start, face.centre], Look::solid(GREEN, 3.0));
    glyphs::station(&mut sketch, &ets, &gimbal, 0.3, 0.5);
    sketch.label(&ray.origin, (-88.0, -26.0), "laser emitter\nand camera");
    sketch.label(&((start + face.centre) / 2.0), (-52.0, -12.0), "beam, 532 nm");
    sketch.label(&position, (34.0, -52.0), "airborne vehicle");
    sketch.label(&face.centre, (-8.0, 62.0), "photovoltaic sensor");
    Ok(Drawing::picture(sketch.finish()))
}
