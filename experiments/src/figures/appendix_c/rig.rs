//! A rig of motion-capture cameras on the walls of a laboratory, and what an optimiser may move of it.

use nalgebra::Vector3;
use serde::Serialize;
use sifre::Variable;
use sysid::coverage::{Camera, Coverage, CoverageError, Lens, Mount, Room, Task, Volume};

/// The laboratory, the volume flown in, the cameras and the search, as written to the resolved scenario. Room, volume and
/// number of cameras are assumptions; the lens is that of table B.1.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Settings {
    pub(super) room: Room,
    pub(super) lens: Lens,
    pub(super) volume_centre_m: [f64; 3],
    pub(super) volume_size_m: [f64; 3],
    /// Cameras that must see a marker.
    pub(super) needed: u32,
    /// Edge of a cell of the counting grid, m.
    pub(super) spacing_m: f64,
    pub(super) seed: u64,
    pub(super) evaluations: u64,
}

impl Settings {
    pub(super) fn nominal(evaluations: u64) -> Self {
        // 46° by 35°: 640 by 480 square pixels.
        let half_field = 23_f64.to_radians();
        Self {
            room: Room {
                length_m: 10.0,
                width_m: 8.0,
                height_m: 4.0,
            },
            lens: Lens {
                horizontal_field_rad: 2.0 * half_field,
                vertical_field_rad: 2.0 * (0.75 * half_field.tan()).atan(),
                near_m: 0.5,
                far_m: 8.0,
            },
            volume_centre_m: [0.0, 0.0, -1.5],
            volume_size_m: [5.0, 4.0, 2.4],
            needed: 3,
            spacing_m: 0.2,
            seed: 1,
            evaluations,
        }
    }

    pub(super) fn task(&self) -> Result<Task, CoverageError> {
        let volume = Volume {
            centre_m: Vector3::from(self.volume_centre_m),
            size_m: Vector3::from(self.volume_size_m),
        };
        Task::new(self.room, volume, self.lens, self.needed, self.spacing_m)
    }
}

/// Cameras of one quarter of the room; the others are their mirror images at the middle planes.
const OF_A_QUARTER: usize = 2;
/// Limits of height, m, and of pan and tilt, rad.
const HEIGHT_M: [f64; 2] = [1.0, 3.8];
const PAN_RAD: [f64; 2] = [-1.2, 1.2];
const TILT_RAD: [f64; 2] = [-0.8, 0.2];

/// The first guess: a camera every eighth of the walls, 2.5 m up, looking straight across.
pub(super) fn initial(room: &Room) -> Vec<f64> {
    let pitch = 0.25 * room.circumference_m() / OF_A_QUARTER as f64;
    (0..OF_A_QUARTER)
        .flat_map(|k| [first(room) + (k as f64 + 0.5) * pitch, 2.5, 0.0, 0.0])
        .collect()
}

/// What the optimiser decides on: place, height, pan and tilt of the cameras of the quarter between the middles of the
/// north and the east wall.
pub(super) fn variables(room: &Room) -> Vec<Variable> {
    let along = [first(room), first(room) + 0.25 * room.circumference_m()];
    let bounds = [
        ("along", "m", along),
        ("height", "m", HEIGHT_M),
        ("pan", "rad", PAN_RAD),
        ("tilt", "rad", TILT_RAD),
    ];
    (1..=OF_A_QUARTER)
        .flat_map(|k| {
            bounds.map(|(name, unit, [lower, upper])| Variable {
                name: format!("{name}_{k}"),
                unit: unit.to_owned(),
                lower,
                upper,
            })
        })
        .collect()
}

/// The middle of the north wall.
fn first(room: &Room) -> f64 {
    0.5 * room.width_m
}

/// The cameras of a decision vector, mirrored into all four quarters.
pub(super) fn cameras(room: &Room, decision: &[f64]) -> Vec<Camera> {
    decision
        .chunks_exact(4)
        .map(|v| {
            room.camera(&Mount {
                along_m: v[0],
                height_m: v[1],
                pan_rad: v[2],
                tilt_rad: v[3],
            })
        })
        .flat_map(|c| {
            [
                c,
                mirrored(c, [-1.0, 1.0]),
                mirrored(c, [1.0, -1.0]),
                mirrored(c, [-1.0, -1.0]),
            ]
        })
        .collect()
}

/// The image of a camera, its x and y each kept or reversed.
fn mirrored(camera: Camera, [x, y]: [f64; 2]) -> Camera {
    let (sin, cos) = camera.azimuth_rad.sin_cos();
    Camera {
        position_m: camera.position_m.component_mul(&Vector3::new(x, y, 1.0)),
        azimuth_rad: (y * sin).atan2(x * cos),
        ..camera
    }
}

/// What an optimiser is told: what is missing of the coverage, and a tenth of what is missing on the way to it.
pub(super) fn cost(coverage: &Coverage) -> f64 {
    (1.0 - coverage.fraction) + 0.1 * (1.0 - coverage.progress)
}
