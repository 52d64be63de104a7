//! Figure 4.4: support data, planes, lines and the centre of mass from them.

use super::supports::{self, SupportTest, box_edges, pictured};
use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::figure::Legends;
use crate::plot::space::View;
use crate::plot::style::{INK, Look, Marker};
use crate::plot::{Figure, Space, series_style};
use nalgebra::Vector3;
use sysid::centre_of_mass::CentreOfMass;
use sysid::laboratory::supports::SupportRig;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "4.4",
    title: "Support data, planes, lines and the centre of mass",
    description: "Five placings in each of two orientations in the virtual laboratory: scales that read to 0.01 N, points \
                  measured to 0.5 mm, planes levelled to 0.1°. (a) Support points, planes and lines; (b) the lines where they meet, with \
                  the 95 % intervals of the centre of mass along the airframe's axes and the true centre.",
    kind: Kind::Plot,
    origin: Origin::VirtualLaboratory,
    claims: &[INSIDE],
    make: Make::Draw(draw),
};

const INSIDE: Claim = Claim::holds("true centre inside the reported interval");

/// Half the width of the box of (b), m.
const NEAR_M: f64 = 0.003;

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let test = supports::test(context, SupportRig::default())?;
    let found = &test.found;
    let truth = test.vehicle.airframe.centre_of_mass;
    let inside = (0..3).all(|i| found.position[i].interval().contains(truth[i]));
    let words: Vec<String> = found
        .position
        .iter()
        .zip(truth.iter())
        .map(|(p, t)| {
            format!(
                "{:.2} ± {:.2} mm (true {:.2})",
                1e3 * p.value,
                1e3 * p.half_width(),
                1e3 * t
            )
        })
        .collect();
    let mut drawing = Drawing::picture(
        Figure::columns(2)
            .legends(Legends::EachPanel)
            .panel_size(310.0, 300.0)
            .panel(whole(&test))
            .panel(close(found, &truth))
            .draw(),
    );
    for warning in &found.warnings {
        drawing = drawing.note(warning.to_string());
    }
    Ok(drawing
        .data(supports::table(&test.placings))
        .scenario(&test.settings)?
        .check(
            INSIDE,
            inside,
            format!(
                "{}; lines miss it by {:.2} mm (standard deviation)",
                words.join(", "),
                1e3 * found.goodness.standard_deviation
            ),
        ))
}

fn space() -> Space {
    Space::new("*x*_{B}, mm", "*y*_{B}, mm", "−*z*_{B}, mm")
        .equal_aspect()
        .without_shadows()
}

const FOUND: Look = Look::solid(INK, 1.8).marked(Marker::Diamond);

fn whole(test: &SupportTest) -> Space {
    let mut space = space().caption("placings and lines");
    let centre = test.found.point();
    for (orientation, triangle) in supports::triangles().iter().enumerate() {
        let look = series_style(orientation);
        let own = || {
            let all = test.placings.iter().zip(&test.found.lines);
            all.filter(move |(p, _)| p.orientation as usize == orientation)
        };
        let supports: Vec<_> = own().flat_map(|(p, _)| p.points()).collect();
        space = space
            .surface(look.colour, 0.2, triangle.iter().map(pictured))
            .markers(
                format!("supports {}", orientation + 1),
                look,
                supports.iter().map(pictured),
            );
        for (k, (_, line)) in own().enumerate() {
            let name = if k == 0 {
                format!("lines *l*_{{{}}}", orientation + 1)
            } else {
                String::new()
            };
            let c = line.centre_of_pressure;
            let ends = [c, c + line.direction * (1.4 * line.direction.dot(&(centre - c)))];
            space = space.line(
                name,
                Look {
                    width: 0.8,
                    dash: "",
                    ..look
                },
                ends.iter().map(pictured),
            );
        }
    }
    space.markers("centre of mass", FOUND, [pictured(&centre)])
}

fn close(found: &CentreOfMass, truth: &Vector3<f64>) -> Space {
    let centre = found.point();
    let mut space = space().caption("where the lines meet").view(View {
        azimuth_deg: -38.0,
        ..View::default()
    });
    let half = found.lines.len() / 2;
    for (i, line) in found.lines.iter().enumerate() {
        let nearest = centre + line.offset_from(&centre);
        let reach = line.direction * (0.9 * NEAR_M);
        let name = match i {
            0 => "lines *l*_{1}",
            _ if i == half => "lines *l*_{2}",
            _ => "",
        };
        let look = Look {
            width: 1.0,
            dash: "",
            ..series_style(i / half.max(1))
        };
        space = space.line(
            name,
            look,
            [nearest - reach, nearest + reach].iter().map(pictured),
        );
    }
    let reach = Vector3::from_fn(|i, _| found.position[i].half_width());
    for (k, edge) in box_edges(&centre, &reach).into_iter().enumerate() {
        let name = if k == 0 { "95 % intervals" } else { "" };
        space = space.line(name, Look::solid(INK, 1.5), edge.iter().map(pictured));
    }
    space = space.markers("estimate", FOUND, [pictured(&centre)]).markers(
        "true centre",
        series_style(2).marked(Marker::Circle),
        [pictured(truth)],
    );
    for (axis, middle) in pictured(&centre).into_iter().enumerate() {
        space = space.range(axis, middle - 1e3 * NEAR_M, middle + 1e3 * NEAR_M);
    }
    space
}
