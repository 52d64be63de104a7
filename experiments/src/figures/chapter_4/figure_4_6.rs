//! Figure 4.6: the rig for characterising a rotor.

use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::diagram::{ARROW, BLUE_TINT, Block, Diagram, GREEN_TINT, ORANGE_TINT, PLAIN, QUIET};
use crate::plot::style::{BLUE, GREY, Look, VERMILION};
use crate::plot::svg::{Point, at};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "4.6",
    title: "Rig for characterising a rotor",
    description: "The rotor stands upside down, so that its wash is free and its thrust *T* presses on the thrust cell; the \
                  shaft of the mount is free to turn and the arm at its foot presses on the torque cell with *Q*/*l*. A tachometer counts \
                  blades. The command *ū*, the bus voltage *V*_{b}, the rotor speed *Ω* and both bridges go to one acquisition \
                  system on one clock. The arrangement is this project's; the virtual laboratory measures these channels.",
    kind: Kind::Diagram,
    origin: Origin::Schematic,
    claims: &[],
    make: Make::Draw(draw),
};

/// Axis of the rotor, px.
const AXIS: f64 = 170.0;

fn draw(_context: &Context) -> Result<Drawing, ItemError> {
    let mut diagram = Diagram::new(720.0, 355.0);
    mechanics(&mut diagram);
    electronics(&mut diagram);
    Ok(Drawing::picture(diagram.finish()))
}

fn block(diagram: &mut Diagram, centre: Point, size: (f64, f64), fill: &'static str, words: &str) -> Block {
    diagram.block(Block { centre, size, fill }, words)
}

fn mechanics(diagram: &mut Diagram) {
    // Propeller: two blades and a hub above the motor.
    let disc = at(AXIS, 70.0);
    for side in [-1.0, 1.0] {
        let blade = [
            disc,
            disc.offset(side * 30.0, -5.0),
            disc.offset(side * 105.0, -2.0),
            disc.offset(side * 105.0, 3.0),
            disc.offset(side * 30.0, 5.0),
        ];
        diagram.polygon(&blade, QUIET);
    }
    block(diagram, at(AXIS, 100.0), (54.0, 40.0), BLUE_TINT, "motor");
    diagram.circle(disc, 6.0, PLAIN);
    // Shaft in a bearing, arm, cells, base.
    block(diagram, at(AXIS, 175.0), (12.0, 110.0), QUIET, "");
    block(diagram, at(AXIS, 170.0), (48.0, 26.0), PLAIN, "");
    diagram.text(at(AXIS - 62.0, 174.0), "bearing");
    block(diagram, at(AXIS + 55.0, 236.0), (122.0, 12.0), QUIET, "");
    diagram.line(
        &[at(AXIS, 258.0), at(AXIS + 105.0, 258.0)],
        Look::solid(GREY, 0.9),
    );
    diagram.text(at(AXIS + 60.0, 273.0), "arm *l*");
    block(
        diagram,
        at(AXIS, 310.0),
        (84.0, 46.0),
        ORANGE_TINT,
        "thrust\ncell",
    );
    block(diagram, at(AXIS, 264.0), (12.0, 46.0), QUIET, "");
    block(
        diagram,
        at(AXIS + 140.0, 236.0),
        (48.0, 46.0),
        ORANGE_TINT,
        "torque\ncell",
    );
    diagram.hatched(at(AXIS - 110.0, 333.0), at(AXIS + 180.0, 333.0));
    block(diagram, at(AXIS + 140.0, 296.0), (12.0, 74.0), QUIET, "");
    // Forces.
    diagram.arrow(
        &[disc.offset(-64.0, 16.0), disc.offset(-64.0, 74.0)],
        Look::solid(VERMILION, 2.2),
    );
    diagram.text(disc.offset(-78.0, 50.0), "*T*");
    let wash = [-96.0, -82.0, 82.0, 96.0];
    for x in wash {
        diagram.arrow(
            &[disc.offset(x, -10.0), disc.offset(x, -38.0)],
            Look::solid(BLUE, 1.1),
        );
    }
    diagram.text(disc.offset(0.0, -34.0), "wash, upwards");
    let turn = Diagram::arc(at(AXIS, 130.0), (44.0, 11.0), 200.0, 340.0);
    diagram.arrow(&turn, Look::solid(VERMILION, 2.0));
    diagram.text(at(AXIS + 58.0, 138.0), "*Q*");
}

fn electronics(diagram: &mut Diagram) {
    let size = (118.0, 42.0);
    let tachometer = block(diagram, at(420.0, 70.0), size, GREEN_TINT, "tachometer");
    let controller = block(diagram, at(420.0, 140.0), size, PLAIN, "motor controller");
    let supply = block(diagram, at(610.0, 140.0), size, PLAIN, "power supply");
    let amplifier = block(diagram, at(420.0, 290.0), size, GREEN_TINT, "bridge\namplifiers");
    let acquisition = block(
        diagram,
        at(610.0, 250.0),
        (118.0, 110.0),
        BLUE_TINT,
        "acquisition\nand\ncommand",
    );
    // Light to the blades.
    diagram.line(
        &[tachometer.left(), at(282.0, 70.0)],
        Look::solid(VERMILION, 1.0).dashed("3 3"),
    );
    diagram.arrow(
        &[
            controller.left(),
            at(240.0, 140.0),
            at(240.0, 104.0),
            at(198.0, 104.0),
        ],
        ARROW,
    );
    diagram.arrow(&[supply.left(), controller.right()], ARROW);
    diagram.text(at(512.0, 133.0), "*V*_{b}");
    diagram.arrow(&[supply.bottom(), acquisition.top()], ARROW);
    diagram.text(at(628.0, 182.0), "*V*_{b}");
    // Command up to the controller, tachometer across the top.
    diagram.arrow(&[at(551.0, 222.0), at(420.0, 222.0), controller.bottom()], ARROW);
    diagram.text(at(486.0, 214.0), "command *ū*");
    diagram.arrow(
        &[
            tachometer.right(),
            at(696.0, 70.0),
            at(696.0, 250.0),
            acquisition.right(),
        ],
        ARROW,
    );
    diagram.text(at(560.0, 62.0), "speed *Ω*");
    diagram.arrow(&[amplifier.right(), at(551.0, 290.0)], ARROW);
    diagram.text(at(515.0, 282.0), "*T*, *Q*");
    diagram.line(&[at(334.0, 236.0), at(346.0, 236.0), at(346.0, 282.0)], ARROW);
    diagram.arrow(&[at(346.0, 282.0), at(361.0, 282.0)], ARROW);
    diagram.line(&[at(212.0, 318.0), at(290.0, 318.0)], ARROW);
    diagram.arrow(
        &[
            at(290.0, 318.0),
            at(346.0, 318.0),
            at(346.0, 298.0),
            at(361.0, 298.0),
        ],
        ARROW,
    );
}
