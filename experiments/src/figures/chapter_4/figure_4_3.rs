//! Figure 4.3: the centre of mass as the intersection of two lines.

use super::supports::{self, pictured};
use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::style::{INK, Look, Marker};
use crate::plot::{Space, series_style};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "4.3",
    title: "The centre of mass at the intersection of two lines",
    description: "The vehicle stands on two faces of its cage in turn, upright and tilted by 70.5°. In each orientation the \
                  line through the centre of pressure of the three supports, square to their plane, contains the centre of mass. \
                  Virtual laboratory without sensor errors, drawn in the airframe's axes.",
    kind: Kind::Plot,
    origin: Origin::VirtualLaboratory,
    claims: &[NORMAL, MEET],
    make: Make::Draw(draw),
};

const NORMAL: Claim = Claim::holds("lines normal to the planes of each orientation");
const MEET: Claim = Claim::holds("the lines meet in the true centre of mass");

/// How far the lines are drawn beyond the centre of mass, as a share of the way from the plane.
const BEYOND: f64 = 1.45;

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let test = supports::test(context, supports::perfect_rig())?;
    let truth = test.vehicle.airframe.centre_of_mass;
    let mut space = Space::new("Forward *x*_{B}, mm", "Left −*y*_{B}, mm", "Up −*z*_{B}, mm")
        .equal_aspect()
        .without_shadows()
        .view(supports::VIEW);
    let mut sideways = 0.0_f64;
    let mut missed = 0.0_f64;
    for (i, (placing, line)) in test.placings.iter().zip(&test.found.lines).enumerate() {
        let (points, c) = (placing.points(), line.centre_of_pressure);
        let look = series_style(i);
        let number = i + 1;
        space = space
            .surface(look.colour, 0.22, points.iter().map(pictured))
            .markers(format!("supports {number}"), look, points.iter().map(pictured))
            .line(
                format!("line *l*_{{{number}}}"),
                look,
                [c, c + (truth - c) * BEYOND].iter().map(pictured),
            );
        // From the centre of pressure to the true centre of mass, against the sides of the triangle.
        let way = (truth - c).normalize();
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            sideways = sideways.max((points[b] - points[a]).normalize().dot(&way).abs());
        }
        missed = missed.max(line.offset_from(&truth).norm());
    }
    let found = test.found.point();
    space = space.markers(
        "centre of mass",
        Look::solid(INK, 2.0).marked(Marker::Diamond),
        [pictured(&found)],
    );
    Ok(Drawing::picture(space.draw())
        .data(supports::table(&test.placings))
        .settings(&test.settings)?
        // Rounding of coordinates of 0.35 m.
        .check(
            NORMAL,
            sideways < 1e-12,
            format!(
                "cosine of the angle between the way to the true centre of mass and any side of a support triangle at most {sideways:.0e}; \
                 the lines cross at {:.1}°",
                test.found.angle_rad.to_degrees()
            ),
        )
        .check(
            MEET,
            missed < 1e-12 && (found - truth).norm() < 1e-12,
            format!(
                "lines pass within {missed:.0e} m, their intersection lies {:.0e} m away",
                (found - truth).norm()
            ),
        ))
}
