//! A laboratory with motion-capture cameras on its walls.

use coverage::{CoverageError, Lens, Room, Task, Volume, WallRig};
use nalgebra::Vector3;
use serde::Serialize;

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

    /// The cameras that are moved: eight.
    pub(super) fn rig(&self) -> Result<WallRig, CoverageError> {
        WallRig::new(self.room, CAMERAS, HEIGHT_M[0]..=HEIGHT_M[1])
    }
}

const CAMERAS: usize = 8;
/// Limits of height, m.
const HEIGHT_M: [f64; 2] = [1.0, 3.8];
