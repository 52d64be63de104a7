//! Counting: which of the points of a volume enough cameras see.

use crate::geometry::{Axes, positive};
use crate::{Camera, CoverageError, Lens, Room, Volume};
use nalgebra::Vector3;

/// Most grid points of a [`Task`].
const MOST_POINTS: usize = 2_000_000;

/// What should be covered: a volume in a room, by cameras of one kind, each marker seen by so many.
#[derive(Clone, Debug)]
pub struct Task {
    room: Room,
    lens: Lens,
    needed: u32,
    points: Vec<Vector3<f64>>,
}

/// How well a volume is covered.
#[derive(Clone, Debug, PartialEq)]
pub struct Coverage {
    /// How many cameras see each point of [`Task::points`].
    pub seen_by: Vec<u32>,
    /// Part of the points that enough cameras see, 0 to 1.
    pub fraction: f64,
    /// Mean over the points of cameras that see it, as far as they are needed, over those needed: 1 where all is covered. It
    /// rises before [`Self::fraction`] does, which helps an optimiser on its way.
    pub progress: f64,
}

impl Task {
    /// A task, its volume divided into cells of about `spacing_m`.
    ///
    /// # Errors
    /// Lengths that aren't positive, a lens that isn't one, a volume outside the room, too fine a grid, nobody needed.
    pub fn new(
        room: Room,
        volume: Volume,
        lens: Lens,
        needed: u32,
        spacing_m: f64,
    ) -> Result<Self, CoverageError> {
        room.check()?;
        for value in volume.size_m.iter() {
            positive("each edge of the volume", *value)?;
        }
        positive("the spacing", spacing_m)?;
        lens.check()?;
        if needed == 0 {
            return Err(CoverageError::NobodyNeeded);
        }
        let half = volume.size_m * 0.5;
        for reach in [volume.centre_m - half, volume.centre_m + half] {
            if !room.holds(&reach) {
                return Err(CoverageError::VolumeOutside {
                    reach_m: reach.into(),
                    room_m: room.size(),
                });
            }
        }
        let cells = volume.size_m.map(|edge| (edge / spacing_m).ceil());
        let points = cells.product();
        if points > MOST_POINTS as f64 {
            return Err(CoverageError::TooManyPoints {
                spacing_m,
                points,
                limit: MOST_POINTS,
            });
        }
        Ok(Self {
            room,
            lens,
            needed,
            points: middles(&volume, &cells),
        })
    }

    /// The room.
    pub fn room(&self) -> &Room {
        &self.room
    }

    /// The cameras' lens.
    pub fn lens(&self) -> &Lens {
        &self.lens
    }

    /// The middles of the cells, W, m: x fastest, then y, then z.
    pub fn points(&self) -> &[Vector3<f64>] {
        &self.points
    }

    /// Counts what cameras see.
    ///
    /// # Errors
    /// A camera outside the room or without a direction.
    pub fn coverage(&self, cameras: &[Camera]) -> Result<Coverage, CoverageError> {
        for (index, camera) in cameras.iter().enumerate() {
            self.check(index, camera)?;
        }
        let mut seen_by = vec![0; self.points.len()];
        let (tan_h, tan_v) = (
            (0.5 * self.lens.horizontal_field_rad).tan(),
            (0.5 * self.lens.vertical_field_rad).tan(),
        );
        let (near, far) = (self.lens.near_m.powi(2), self.lens.far_m.powi(2));
        for camera in cameras {
            let Axes { forward, right, up } = camera.axes();
            for (count, point) in seen_by.iter_mut().zip(&self.points) {
                let d = point - camera.position_m;
                let depth = d.dot(&forward);
                let seen = depth > 0.0
                    && d.dot(&right).abs() <= depth * tan_h
                    && d.dot(&up).abs() <= depth * tan_v
                    && (near..=far).contains(&d.norm_squared());
                *count += u32::from(seen);
            }
        }
        let all = self.points.len() as f64;
        let covered = seen_by.iter().filter(|n| **n >= self.needed).count();
        let sightings: u64 = seen_by.iter().map(|n| u64::from((*n).min(self.needed))).sum();
        Ok(Coverage {
            fraction: covered as f64 / all,
            progress: sightings as f64 / (all * f64::from(self.needed)),
            seen_by,
        })
    }

    fn check(&self, index: usize, camera: &Camera) -> Result<(), CoverageError> {
        let Camera {
            position_m,
            azimuth_rad,
            elevation_rad,
        } = *camera;
        if !(azimuth_rad.is_finite() && elevation_rad.is_finite()) {
            return Err(CoverageError::NoDirection {
                index,
                azimuth_rad,
                elevation_rad,
            });
        }
        if !self.room.holds(&position_m) {
            return Err(CoverageError::CameraOutside {
                index,
                position_m: position_m.into(),
                room_m: self.room.size(),
            });
        }
        Ok(())
    }
}

/// The middles of the cells of a volume.
fn middles(volume: &Volume, cells: &Vector3<f64>) -> Vec<Vector3<f64>> {
    let corner = volume.centre_m - volume.size_m * 0.5;
    let edge = volume.size_m.component_div(cells);
    let [nx, ny, nz] = [cells.x as u32, cells.y as u32, cells.z as u32];
    let mut points = Vec::with_capacity((nx * ny * nz) as usize);
    for k in 0..nz {
        for j in 0..ny {
            for i in 0..nx {
                let cell = Vector3::new(f64::from(i) + 0.5, f64::from(j) + 0.5, f64::from(k) + 0.5);
                points.push(corner + edge.component_mul(&cell));
            }
        }
    }
    points
}
