//! A rig of cameras in its room, as figure C.1 shows it.

use super::rig::Settings;
use crate::plot::space::View;
use crate::plot::style::{INK, Look, Marker};
use crate::plot::{Space, series_style};
use coverage::{Camera, Coverage, Task};
use nalgebra::Vector3;

/// North, west, up: right-handed, as the eye expects of a box.
fn pictured(p: &Vector3<f64>) -> [f64; 3] {
    [p.x, -p.y, -p.z]
}

/// Depth to which a camera's pyramid is drawn, m.
const DEPTH_M: f64 = 1.5;

/// Half the side of the square that stands for an unseen point, m, and its opacity.
const UNSEEN_HALF_M: f64 = 0.016;
const UNSEEN_OPACITY: f64 = 0.45;

/// The room, the flight volume with what is missing of its coverage, and the cameras.
pub(super) fn picture(
    caption: &str,
    task: &Task,
    settings: &Settings,
    cameras: &[Camera],
    coverage: &Coverage,
) -> Space {
    let thin = |colour| Look::solid(colour, 0.8);
    let (accent, missing) = (series_style(0), series_style(1));
    let room = task.room();
    let whole = Vector3::new(room.length_m, room.width_m, room.height_m);
    let middle = Vector3::new(0.0, 0.0, -0.5 * room.height_m);
    let mut space = Space::new("north, m", "west, m", "height, m")
        .caption(caption)
        .equal_aspect()
        .without_shadows()
        .view(View {
            azimuth_deg: -60.0,
            elevation_deg: 35.0,
        });
    for edge in edges(&middle, &whole) {
        space = space.line("", thin("#9a9a9a"), edge);
    }
    for edge in edges(
        &Vector3::from(settings.volume_centre_m),
        &Vector3::from(settings.volume_size_m),
    ) {
        space = space.line("", thin(INK), edge);
    }
    for camera in cameras {
        let corners = camera.field(task.lens(), DEPTH_M);
        let base = corners.iter().chain(&corners[..1]).map(pictured);
        space = space.line("", thin(accent.colour), base);
        for corner in &corners {
            space = space.line(
                "",
                thin(accent.colour),
                [pictured(&camera.position_m), pictured(corner)],
            );
        }
    }
    let unseen = task
        .points()
        .iter()
        .zip(&coverage.seen_by)
        .filter(|(_, n)| **n < settings.needed);
    for (p, _) in unseen {
        space = space.surface(missing.colour, UNSEEN_OPACITY, square(p));
    }
    space
        .markers(
            "cameras",
            accent.marked(Marker::Square),
            cameras.iter().map(|c| pictured(&c.position_m)),
        )
        .markers(
            "seen by fewer than three",
            Look::solid(missing.colour, 0.6).marked(Marker::Dot),
            [],
        )
}

/// A small level square about a point: many of them overlap, and the room behind stays visible.
fn square(p: &Vector3<f64>) -> [[f64; 3]; 4] {
    [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        .map(|(a, b)| pictured(&(p + UNSEEN_HALF_M * Vector3::new(a, b, 0.0))))
}

/// The twelve edges of a box.
fn edges(centre: &Vector3<f64>, size: &Vector3<f64>) -> Vec<[[f64; 3]; 2]> {
    let corner = |k: usize| {
        centre + Vector3::from_fn(|axis, _| if k >> axis & 1 == 1 { 0.5 } else { -0.5 } * size[axis])
    };
    (0..8_usize)
        .flat_map(|k| {
            (0..3)
                .filter(move |axis| k >> axis & 1 == 0)
                .map(move |axis| (k, k | 1 << axis))
        })
        .map(|(a, b)| [pictured(&corner(a)), pictured(&corner(b))])
        .collect()
}
