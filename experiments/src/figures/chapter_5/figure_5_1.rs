//! Figure 5.1: what must be known to map inputs to outputs.

use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::diagram::{ARROW, BLUE_TINT, Block, Diagram, QUIET};
use crate::plot::svg::at;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "5.1",
    title: "The least that must be known to map inputs to outputs",
    description: "Besides its inputs *u*, a model needs a state *x* to start from and parameters *p*; its equations \
                  then give the outputs *y*. A model of higher resolution asks for more of each.",
    kind: Kind::Diagram,
    origin: Origin::Schematic,
    claims: &[],
    make: Make::Draw(draw),
};

fn draw(_: &Context) -> Result<Drawing, ItemError> {
    let mut diagram = Diagram::new(660.0, 212.0);
    let model = Block {
        centre: at(330.0, 150.0),
        size: (276.0, 88.0),
        fill: BLUE_TINT,
    };
    let model = diagram.block(
        model,
        "Model equations\n*ẋ* = *f*(*x*, *u*, *p*)\n*y* = *h*(*x*, *u*, *p*)",
    );
    let small = |x, y| Block {
        centre: at(x, y),
        size: (120.0, 46.0),
        fill: QUIET,
    };
    let inputs = diagram.block(small(78.0, 150.0), "Inputs\n*u*");
    let states = diagram.block(small(252.0, 40.0), "Initial states\n*x*(0)");
    let parameters = diagram.block(small(408.0, 40.0), "Parameters\n*p*");
    let outputs = diagram.block(small(582.0, 150.0), "Outputs\n*y*");
    diagram.arrow(&[inputs.right(), model.left()], ARROW);
    diagram.arrow(&[model.right(), outputs.left()], ARROW);
    for source in [states, parameters] {
        let from = source.bottom();
        diagram.arrow(&[from, at(from.x, model.top().y)], ARROW);
    }
    Ok(Drawing::picture(diagram.finish()))
}
