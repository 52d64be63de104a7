//! A rig of cameras on the walls of a room, and what a search may move of it.
//!
//! Each camera has four variables: its way along the walls and its height, m, pan and tilt, rad (see [`Mount`]). A rig of a multiple
//! of four cameras is symmetrical: those of the quarter between the middles of the north and the east wall are decided on, the
//! others are their mirror images at the room's middle planes. Of any other number each camera is decided on by itself.

use crate::{Camera, Coverage, CoverageError, Mount, Room, Task};
use nalgebra::Vector3;
use optim::Variable;
use std::ops::RangeInclusive;

/// Limits of pan and tilt, rad: *choice*.
const PAN_RAD: RangeInclusive<f64> = -1.2..=1.2;
const TILT_RAD: RangeInclusive<f64> = -0.8..=0.2;

/// Height of the first guess, m, if the limits allow it.
const FIRST_HEIGHT_M: f64 = 2.5;

/// Most cameras of a rig: ten times the largest halls, and a search over 4096 variables.
const MOST_CAMERAS: usize = 1024;

/// How much of a rig's cost is [`Coverage::progress`]: enough for a direction, too little to be bought with coverage.
const PROGRESS_WEIGHT: f64 = 0.1;

/// Cameras on the walls of a room.
#[derive(Clone, Debug, PartialEq)]
pub struct WallRig {
    room: Room,
    cameras: usize,
    height_m: RangeInclusive<f64>,
}

impl WallRig {
    /// So many cameras between two heights over the floor, m.
    ///
    /// # Errors
    /// No camera or more than 1024; heights that are not in order inside the room; a room without a length.
    pub fn new(room: Room, cameras: usize, height_m: RangeInclusive<f64>) -> Result<Self, CoverageError> {
        room.check()?;
        if !(1..=MOST_CAMERAS).contains(&cameras) {
            return Err(CoverageError::BadCount {
                cameras,
                limit: MOST_CAMERAS,
            });
        }
        let (least, most) = (*height_m.start(), *height_m.end());
        if !(least >= 0.0 && least < most && most <= room.height_m) {
            return Err(CoverageError::BadHeights {
                least_m: least,
                most_m: most,
                room_m: room.height_m,
            });
        }
        Ok(Self {
            room,
            cameras,
            height_m,
        })
    }

    /// Parts of the room that mirror each other: four quarters, or the whole.
    fn parts(&self) -> usize {
        if self.cameras.is_multiple_of(4) { 4 } else { 1 }
    }

    /// Where the decided part of the walls begins, the middle of the north wall, and its length, m.
    fn walls(&self) -> (f64, f64) {
        let length = self.room.circumference_m() / self.parts() as f64;
        (0.5 * self.room.width_m, length)
    }

    /// Cameras that are decided on.
    fn decided(&self) -> usize {
        self.cameras / self.parts()
    }

    /// What a search decides on, in the order of [`Self::cameras`]: `along_1`, `height_1`, `pan_1`, `tilt_1`, `along_2` ...
    pub fn variables(&self) -> Vec<Variable> {
        let (first, length) = self.walls();
        let bounds = [
            ("along", "m", first..=first + length),
            ("height", "m", self.height_m.clone()),
            ("pan", "rad", PAN_RAD),
            ("tilt", "rad", TILT_RAD),
        ];
        let of = |k: usize| {
            bounds.clone().map(|(name, unit, bounds)| Variable {
                name: format!("{name}_{k}"),
                unit: unit.to_owned(),
                lower: *bounds.start(),
                upper: *bounds.end(),
            })
        };
        (1..=self.decided()).flat_map(of).collect()
    }

    /// A first guess: cameras at equal ways along the walls, 2.5 m up, looking straight across.
    pub fn first_guess(&self) -> Vec<f64> {
        let (first, length) = self.walls();
        let pitch = length / self.decided() as f64;
        let height = FIRST_HEIGHT_M.clamp(*self.height_m.start(), *self.height_m.end());
        (0..self.decided())
            .flat_map(|k| [first + (k as f64 + 0.5) * pitch, height, 0.0, 0.0])
            .collect()
    }

    /// The cameras of a decision.
    pub fn cameras(&self, decision: &[f64]) -> Vec<Camera> {
        let camera = |v: &[f64]| {
            self.room.camera(&Mount {
                along_m: v[0],
                height_m: v[1],
                pan_rad: v[2],
                tilt_rad: v[3],
            })
        };
        const IMAGES: [[f64; 2]; 4] = [[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]];
        let images = &IMAGES[..self.parts()];
        let chunks = decision.chunks_exact(4).map(camera);
        chunks
            .flat_map(|camera| images.iter().map(move |image| mirrored(camera, *image)))
            .collect()
    }

    /// What a decision costs a search ([`Coverage::cost`]); infinite where the cameras can't be counted.
    pub fn cost(&self, task: &Task, decision: &[f64]) -> f64 {
        task.coverage(&self.cameras(decision))
            .map_or(f64::INFINITY, |coverage| coverage.cost())
    }
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

impl Coverage {
    /// What a search is to make small: what is missing of the coverage, and a tenth of what is missing on the way to it.
    pub fn cost(&self) -> f64 {
        (1.0 - self.fraction) + PROGRESS_WEIGHT * (1.0 - self.progress)
    }
}
