//! The sketch of the bifilar pendulum in figure 4.5.

use crate::plot::diagram::{ARROW, BLUE_TINT, CONSTRUCTION, Diagram};
use crate::plot::style::{BLUE, GREY, INK, Look, VERMILION};
use crate::plot::svg::{Point, Svg, at};

/// Width of the sketch, px.
pub(super) const WIDTH: f64 = 250.0;

/// The pendulum from aside and above, at rest (grey) and turned.
pub(super) fn draw(height: f64) -> Svg {
    let mut diagram = Diagram::new(WIDTH, height);
    let (middle, ceiling, floor, b) = (120.0, 48.0, 270.0, 72.0);
    let turn = 50.0_f64.to_radians();
    // Radii of the circle of the string ends, seen from above at a slant.
    let end = |angle: f64, y: f64| at(middle + b * angle.cos(), y + 0.38 * b * angle.sin());
    diagram.hatched(at(middle + 1.5 * b, ceiling), at(middle - 1.5 * b, ceiling));
    let (low, high) = (floor, floor - 34.0);
    body(
        &mut diagram,
        [end(std::f64::consts::PI, low), end(0.0, low)],
        Look::solid(GREY, 2.0),
    );
    for side in [0.0, std::f64::consts::PI] {
        let hook = at(middle + b * side.cos(), ceiling);
        diagram.line(&[hook, end(side, low)], CONSTRUCTION);
        diagram.line(&[hook, end(side + turn, high)], Look::solid(INK, 1.2));
    }
    body(
        &mut diagram,
        [end(std::f64::consts::PI + turn, high), end(turn, high)],
        Look::solid(BLUE, 4.0),
    );
    let axis = [at(middle, ceiling), at(middle, low + 34.0)];
    diagram.line(&axis, Look::solid(GREY, 0.8).dashed("8 3 2 3"));
    let arc = Diagram::arc(at(middle, low), (0.62 * b, 0.24 * b), 0.0, -50.0);
    diagram.arrow(&arc, ARROW);
    diagram.text(at(middle + 0.78 * b, low + 20.0), "*θ*");
    diagram.arrow(
        &[at(middle, high), at(middle, high + 92.0)],
        Look::solid(VERMILION, 2.0),
    );
    diagram.text(at(middle - 20.0, high + 94.0), "*m g*");
    dimension(
        &mut diagram,
        at(middle, ceiling - 22.0),
        at(middle + b, ceiling - 22.0),
        "*b*",
    );
    diagram.text(at(middle + b + 14.0, 150.0), "*L*");
    let edge = middle - 1.28 * b;
    diagram.line(&[at(middle, low), at(edge - 8.0, low)], CONSTRUCTION);
    diagram.line(&[at(middle, high), at(edge - 8.0, high)], CONSTRUCTION);
    diagram.arrow(&[at(edge, low), at(edge, high)], ARROW);
    diagram.text(at(edge - 12.0, 0.5 * (low + high) + 4.0), "*z*");
    diagram.finish()
}

fn body(diagram: &mut Diagram, ends: [Point; 2], look: Look) {
    diagram.line(&ends, look);
    let centre = at(0.5 * (ends[0].x + ends[1].x), 0.5 * (ends[0].y + ends[1].y));
    diagram.circle(centre, 6.0, BLUE_TINT);
}

fn dimension(diagram: &mut Diagram, from: Point, to: Point, words: &str) {
    diagram.arrow(&[from, to], ARROW);
    diagram.arrow(&[to, from], ARROW);
    diagram.text(at(0.5 * (from.x + to.x), from.y - 6.0), words);
}
