//! Markers: the signs of single points.

use super::style::{Look, Marker};
use super::svg::{Point, Svg};

/// Radius of a dot, of a marker's.
const DOT: f64 = 0.5;

/// Draws a marker of this radius, px.
pub(super) fn draw_marker(svg: &mut Svg, centre: Point, look: &Look, radius: f64) {
    let corners = |offsets: &[(f64, f64)]| -> Vec<Point> {
        let corner = |(dx, dy): &(f64, f64)| centre.offset(dx * radius, dy * radius);
        offsets.iter().map(corner).collect()
    };
    let mut polygon = |offsets: &[(f64, f64)]| svg.polygon(&corners(offsets), look.colour, None);
    match look.marker {
        Marker::Square => polygon(&[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)]),
        Marker::Triangle => polygon(&[(-1.0, 0.8), (1.0, 0.8), (0.0, -1.1)]),
        Marker::TriangleDown => polygon(&[(-1.0, -0.8), (1.0, -0.8), (0.0, 1.1)]),
        Marker::Diamond => polygon(&[(0.0, -1.2), (1.0, 0.0), (0.0, 1.2), (-1.0, 0.0)]),
        Marker::Circle => svg.circle(centre, radius, look.colour, None),
        Marker::Dot => svg.circle(centre, DOT * radius, look.colour, None),
        Marker::Cross => {
            let pen = Look::solid(look.colour, 1.5);
            svg.polyline(&corners(&[(-0.9, -0.9), (0.9, 0.9)]), &pen);
            svg.polyline(&corners(&[(-0.9, 0.9), (0.9, -0.9)]), &pen);
        }
    }
}
