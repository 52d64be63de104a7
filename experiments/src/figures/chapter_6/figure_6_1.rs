//! Figure 6.1: the nested loops of the controllers.

use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::diagram::{ARROW, BLUE_TINT, Block, Diagram, GREEN_TINT, ORANGE_TINT, PLAIN, QUIET};
use crate::plot::svg::at;

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

/// Heights of the rows, px: outer loop; inner loop and vehicle.
const OUTER: f64 = 86.0;
const INNER: f64 = 238.0;

/// The blocks that signals run between.
struct Blocks {
    trajectory: Block,
    position_sum: Block,
    position_law: Block,
    position_inverse: Block,
    attitude_sum: Block,
    attitude_law: Block,
    attitude_inverse: Block,
    control_inverse: Block,
    limits: Block,
    vehicle: Block,
}

fn draw(_: &Context) -> Result<Drawing, ItemError> {
    let mut diagram = Diagram::new(756.0, 344.0);
    let blocks = draw_blocks(&mut diagram);
    draw_forward(&mut diagram, &blocks);
    draw_feedback(&mut diagram, &blocks);
    Ok(Drawing::picture(diagram.finish()))
}

fn draw_blocks(diagram: &mut Diagram) -> Blocks {
    let frame = |x, y, w| Block {
        centre: at(x, y),
        size: (w, 116.0),
        fill: "#fafafa",
    };
    diagram.frame(frame(366.0, OUTER, 364.0));
    diagram.frame(frame(213.0, INNER, 338.0));
    diagram.caption(at(192.0, OUTER + 50.0), "outer loop: position");
    diagram.caption(at(80.0, INNER - 42.0), "inner loop: attitude");
    let mut block = |x, y, width, fill, words| {
        diagram.block(
            Block {
                centre: at(x, y),
                size: (width, 50.0),
                fill,
            },
            words,
        )
    };
    let trajectory = block(66.0, OUTER, 104.0, QUIET, "Reference\ntrajectory");
    let position_law = block(296.0, OUTER, 104.0, BLUE_TINT, "Linear law,\nposition");
    let position_inverse = block(
        462.0,
        OUTER,
        140.0,
        ORANGE_TINT,
        "Linearising\nfeedback, position",
    );
    let attitude_law = block(151.0, INNER, 98.0, BLUE_TINT, "Linear law,\nattitude");
    let attitude_inverse = block(
        302.0,
        INNER,
        140.0,
        ORANGE_TINT,
        "Linearising\nfeedback, attitude",
    );
    let control_inverse = block(494.0, INNER, 52.0, PLAIN, "*C*^{−1}");
    let limits = block(580.0, INNER, 60.0, PLAIN, "Limits");
    let vehicle = block(692.0, INNER, 100.0, GREEN_TINT, "Quadrotor\nmodel");
    let (position_sum, attitude_sum) = (diagram.sum(at(208.0, OUTER)), diagram.sum(at(70.0, INNER)));
    Blocks {
        trajectory,
        position_sum,
        position_law,
        position_inverse,
        attitude_sum,
        attitude_law,
        attitude_inverse,
        control_inverse,
        limits,
        vehicle,
    }
}

/// From the reference through both loops to the vehicle.
fn draw_forward(diagram: &mut Diagram, b: &Blocks) {
    for (from, to) in [
        (b.trajectory, b.position_sum),
        (b.position_sum, b.position_law),
        (b.position_law, b.position_inverse),
        (b.attitude_sum, b.attitude_law),
        (b.attitude_law, b.attitude_inverse),
        (b.attitude_inverse, b.control_inverse),
        (b.control_inverse, b.limits),
        (b.limits, b.vehicle),
    ] {
        diagram.arrow(&[from.right(), to.left()], ARROW);
    }
    let lane = 162.0;
    let (tilt, thrust) = (
        b.position_inverse.bottom().offset(-32.0, 0.0),
        b.position_inverse.bottom().offset(32.0, 0.0),
    );
    let entry = b.attitude_sum.top();
    diagram.arrow(&[tilt, at(tilt.x, lane), at(entry.x, lane), entry], ARROW);
    diagram.arrow(&[thrust, b.control_inverse.top()], ARROW);
    let yaw = b.trajectory.bottom().offset(-38.0, 0.0);
    diagram.arrow(&[yaw, at(yaw.x, INNER), b.attitude_sum.left()], ARROW);
    diagram.text(at(160.0, OUTER - 8.0), "*y*_{ref}");
    diagram.text(at(48.0, 148.0), "*ψ*_{ref}");
    diagram.text(at(262.0, lane - 6.0), "*φ*_{c}, *θ*_{c}");
    diagram.text(at(512.0, 172.0), "*u*_{col}");
    diagram.text(at(424.0, INNER - 8.0), "*u*_{lat, long, yaw}");
    diagram.text(at(535.0, INNER - 8.0), "*u*");
}

/// From the vehicle back to both loops.
fn draw_feedback(diagram: &mut Diagram, b: &Blocks) {
    let (high, low) = (14.0, 326.0);
    let (up, down) = (b.vehicle.top(), b.vehicle.bottom());
    diagram.arrow(
        &[
            up,
            at(up.x, high),
            at(b.position_sum.centre.x, high),
            b.position_sum.top(),
        ],
        ARROW,
    );
    diagram.arrow(
        &[at(b.position_inverse.centre.x, high), b.position_inverse.top()],
        ARROW,
    );
    diagram.branch(at(b.position_inverse.centre.x, high));
    diagram.arrow(
        &[
            down,
            at(down.x, low),
            at(b.attitude_sum.centre.x, low),
            b.attitude_sum.bottom(),
        ],
        ARROW,
    );
    diagram.arrow(
        &[at(b.attitude_inverse.centre.x, low), b.attitude_inverse.bottom()],
        ARROW,
    );
    diagram.branch(at(b.attitude_inverse.centre.x, low));
    diagram.text(at(624.0, high + 16.0), "position *y*, velocity *ẏ*");
    diagram.text(at(548.0, low - 7.0), "attitude *η*, rates *ω*");
    diagram.text(b.position_sum.top().offset(10.0, -2.0), "−");
    diagram.text(b.attitude_sum.bottom().offset(10.0, 10.0), "−");
}
