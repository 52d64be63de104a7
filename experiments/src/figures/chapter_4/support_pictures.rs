//! The two views of figure 4.4: placings and lines, and where the lines meet.

use super::supports::{self, SupportTest, box_edges, pictured};
use crate::plot::space::View;
use crate::plot::style::{INK, Look, Marker};
use crate::plot::{Space, series_style};
use nalgebra::Vector3;
use sysid::centre_of_mass::CentreOfMass;

/// Half the width of the box of the close view, m.
const NEAR_M: f64 = 0.003;

fn space() -> Space {
    Space::new("*x*_{B}, mm", "−*y*_{B}, mm", "−*z*_{B}, mm")
        .equal_aspect()
        .without_shadows()
        .view(supports::VIEW)
}

const FOUND: Look = Look::solid(INK, 1.8).marked(Marker::Diamond);

/// Support points, planes and lines of a test.
pub(super) fn whole(test: &SupportTest) -> Space {
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

/// The lines where they meet, with the intervals and the true centre.
pub(super) fn close(found: &CentreOfMass, truth: &Vector3<f64>) -> Space {
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
