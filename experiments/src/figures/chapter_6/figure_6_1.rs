//! Figure 6.1: the nested loops of the controllers.

use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::diagram::{ARROW, BLUE_TINT, Block, Diagram, GREEN_TINT, ORANGE_TINT, PLAIN, QUIET};
use crate::plot::svg::{Point, at};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.1",
    title: "Nested loops with linearising feedback",
    description: "The outer loop steers the position *y*, the inner loop the attitude *η*. Each is a linear law \
                  followed by a feedback that cancels the model's non-linear terms, so that each loop behaves as \
                  designed; the control matrix *C* is inverted at the end.",
    kind: Kind::Diagram,
    origin: Origin::Schematic,
    claims: &[],
    make: Make::Draw(draw),
};

/// Height of the upper row (outer loop) and of the lower one (inner loop and vehicle), px.
const OUTER: f64 = 72.0;
const INNER: f64 = 222.0;

fn draw(_: &Context) -> Result<Drawing, ItemError> {
    let mut diagram = Diagram::new(740.0, 372.0);
    let frame = |x, y, w, h| Block { centre: at(x, y), size: (w, h), fill: "#fafafa" };
    diagram.frame(frame(386.0, 72.0, 376.0, 116.0), "outer loop: position");
    diagram.frame(frame(206.0, 222.0, 384.0, 116.0), "inner loop: attitude");
    let block = |x, y, w, fill| Block { centre: at(x, y), size: (w, 52.0), fill };
    let trajectory = diagram.block(block(66.0, OUTER, 104.0, QUIET), "Reference\ntrajectory");
    let position = diagram.block(block(318.0, OUTER, 118.0, BLUE_TINT), "Linear law,\nposition");
    let outer_inverse = diagram.block(block(488.0, OUTER, 136.0, ORANGE_TINT), "Linearising\nfeedback, position");
    let attitude = diagram.block(block(154.0, INNER, 110.0, BLUE_TINT), "Linear law,\nattitude");
    let inner_inverse = diagram.block(block(314.0, INNER, 136.0, ORANGE_TINT), "Linearising\nfeedback, attitude");
    let control = diagram.block(block(456.0, INNER, 60.0, PLAIN), "*C*^{−1}");
    let limits = diagram.block(block(540.0, INNER, 60.0, PLAIN), "Limits");
    let vehicle = diagram.block(block(662.0, INNER, 108.0, GREEN_TINT), "Quadrotor\nmodel");
    let sums = (diagram.sum(at(222.0, OUTER)), diagram.sum(at(58.0, INNER)));
    for (from, to) in [
        (trajectory, sums.0),
        (sums.0, position),
        (position, outer_inverse),
        (sums.1, attitude),
        (attitude, inner_inverse),
        (inner_inverse, control),
        (control, limits),
        (limits, vehicle),
    ] {
        diagram.arrow(&[from.right(), to.left()], ARROW);
    }
    command_to_inner(&mut diagram, outer_inverse, control, sums.1);
    feedback(&mut diagram, vehicle, [sums.0, sums.1], [outer_inverse, inner_inverse]);
    label_signals(&mut diagram);
    Ok(Drawing::picture(diagram.finish()))
}

/// From the outer loop: the attitude command to the inner loop, the collective thrust straight to the inversion.
fn command_to_inner(diagram: &mut Diagram, outer: Block, control: Block, inner_sum: Block) {
    let turn = 147.0;
    let from = outer.bottom().offset(-24.0, 0.0);
    let entry = inner_sum.top();
    diagram.arrow(&[from, at(from.x, turn), at(entry.x, turn), entry], ARROW);
    diagram.text(at(430.0, turn - 7.0), "*φ*_{c}, *θ*_{c}");
    let collective = outer.right();
    let column = 576.0;
    let into = control.top();
    diagram.arrow(&[collective, at(column, collective.y), at(column, turn), at(into.x, turn), into], ARROW);
    diagram.text(at(520.0, turn - 7.0), "*u*_{col}");
}

/// From the vehicle back: position to the outer loop, attitude and rates to the inner one.
fn feedback(diagram: &mut Diagram, vehicle: Block, sums: [Block; 2], inverses: [Block; 2]) {
    let _ = (vehicle, sums, inverses);
    let low: f64 = 318.0;
    let tap = |dx| vehicle.bottom().offset(dx, 0.0);
    let into_sum: Point = sums[1].bottom();
    diagram.arrow(&[tap(-18.0), at(tap(-18.0).x, low), at(into_sum.x, low), into_sum], ARROW);
}

fn label_signals(diagram: &mut Diagram) {
    diagram.text(at(150.0, OUTER - 8.0), "*y*_{ref}");
}
