//! Coverage of a flight volume by motion-capture cameras on the walls of a room.
//!
//! A camera at `p` with axis `a`, right `b` and up `c` (unit vectors in W) sees a point `q`, with `d = q − p`, if
//!
//! - `d·a > 0`, `|d·b| ≤ d·a tan(h/2)`, `|d·c| ≤ d·a tan(v/2)`: inside the pyramid of its fields of view h and v;
//! - `near ≤ |d| ≤ far`: where a marker is neither blurred nor smaller than the camera resolves.
//!
//! A marker is located by the cameras that see it; the coverage of a volume is the part of it that enough of them see.
//! It is counted on a grid of the middles of equal cells, so its error falls with the cells' size.
//!
//! Assumptions: nothing stands in the way; lenses don't distort; every camera is equal. Two cameras that stand side by side
//! count as two, although their rays hardly cross.
//!
//! Frames: W with its origin on the floor in the middle of the room, x along its length, y along its width, z
//! down. Source: geometry; figure C.1 of the thesis shows such a simulation.

mod error;
mod rig;

pub use error::CoverageError;
pub use rig::{RigVariable, WallRig};

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// What a camera sees, whichever way it looks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lens {
    /// Horizontal field of view h, rad, between 0 and π.
    pub horizontal_field_rad: f64,
    /// Vertical field of view v, rad, between 0 and π.
    pub vertical_field_rad: f64,
    /// Smallest distance of a marker, m.
    pub near_m: f64,
    /// Greatest distance of a marker, m.
    pub far_m: f64,
}

/// A room: a box that stands on the floor `z = 0`, its middle at the origin.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Room {
    /// Along x, m.
    pub length_m: f64,
    /// Along y, m.
    pub width_m: f64,
    /// Up, m.
    pub height_m: f64,
}

/// A place on the walls, and where a camera there looks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mount {
    /// Way along the walls, m: from the north-west corner (+x, −y) along the north wall, clockwise seen from above. Wraps round
    /// after one circumference, so that any number is a place.
    pub along_m: f64,
    /// Height above the floor, m.
    pub height_m: f64,
    /// Angle of the axis from the wall's inward normal, rad, positive clockwise seen from above.
    pub pan_rad: f64,
    /// Elevation of the axis, rad, positive up.
    pub tilt_rad: f64,
}

/// A camera in W.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it stands, W, m.
    pub position_m: Vector3<f64>,
    /// Azimuth of its axis, rad, from x towards y (clockwise seen from above).
    pub azimuth_rad: f64,
    /// Elevation of its axis, rad, positive up.
    pub elevation_rad: f64,
}

/// A box that should be covered, its edges along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Volume {
    /// Its middle, W, m: z is negative above the floor.
    pub centre_m: Vector3<f64>,
    /// Its edges along x, y and z, m.
    pub size_m: Vector3<f64>,
}

/// Most grid points of a [`Task`].
const MOST_POINTS: usize = 2_000_000;

fn positive(what: &'static str, value_m: f64) -> Result<(), CoverageError> {
    if value_m > 0.0 && value_m.is_finite() {
        Ok(())
    } else {
        Err(CoverageError::NonPositiveLength { what, value_m })
    }
}

impl Lens {
    fn check(&self) -> Result<(), CoverageError> {
        for (which, value_rad) in [
            ("horizontal", self.horizontal_field_rad),
            ("vertical", self.vertical_field_rad),
        ] {
            if !(value_rad > 0.0 && value_rad < std::f64::consts::PI) {
                return Err(CoverageError::BadField { which, value_rad });
            }
        }
        let Self { near_m, far_m, .. } = *self;
        if near_m >= 0.0 && near_m < far_m && far_m.is_finite() {
            Ok(())
        } else {
            Err(CoverageError::BadRange { near_m, far_m })
        }
    }
}

impl Room {
    fn check(&self) -> Result<(), CoverageError> {
        let names = ["the room's length", "the room's width", "the room's height"];
        names
            .into_iter()
            .zip(self.size())
            .try_for_each(|(what, value)| positive(what, value))
    }

    /// Length of all walls together, m.
    pub fn circumference_m(&self) -> f64 {
        2.0 * (self.length_m + self.width_m)
    }

    /// The camera at a place on the walls.
    pub fn camera(&self, mount: &Mount) -> Camera {
        use std::f64::consts::{FRAC_PI_2, PI};
        let (half_length, half_width) = (0.5 * self.length_m, 0.5 * self.width_m);
        let s = mount.along_m.rem_euclid(self.circumference_m());
        // Walls in the order of the way, with the azimuth of the inward normal.
        let (x, y, normal) = if s < self.width_m {
            (half_length, s - half_width, PI)
        } else if s < self.width_m + self.length_m {
            (half_length - (s - self.width_m), half_width, -FRAC_PI_2)
        } else if s < 2.0 * self.width_m + self.length_m {
            (-half_length, half_width - (s - self.width_m - self.length_m), 0.0)
        } else {
            (
                s - 2.0 * self.width_m - 1.5 * self.length_m,
                -half_width,
                FRAC_PI_2,
            )
        };
        Camera {
            position_m: Vector3::new(x, y, -mount.height_m),
            azimuth_rad: normal + mount.pan_rad,
            elevation_rad: mount.tilt_rad,
        }
    }

    fn size(&self) -> [f64; 3] {
        [self.length_m, self.width_m, self.height_m]
    }

    /// Whether a point is in the room or on its walls, to rounding.
    fn holds(&self, p: &Vector3<f64>) -> bool {
        let slack = 1e-9 * (self.length_m + self.width_m + self.height_m);
        p.x.abs() <= 0.5 * self.length_m + slack
            && p.y.abs() <= 0.5 * self.width_m + slack
            && (-slack..=self.height_m + slack).contains(&-p.z)
    }
}

/// Axis, right and up of a camera, unit vectors in W.
struct Axes {
    forward: Vector3<f64>,
    right: Vector3<f64>,
    up: Vector3<f64>,
}

impl Camera {
    fn axes(&self) -> Axes {
        let (sin_a, cos_a) = self.azimuth_rad.sin_cos();
        let (sin_e, cos_e) = self.elevation_rad.sin_cos();
        let forward = Vector3::new(cos_e * cos_a, cos_e * sin_a, -sin_e);
        let right = Vector3::new(-sin_a, cos_a, 0.0);
        // z points down: forward × right points down in the picture.
        Axes {
            forward,
            right,
            up: right.cross(&forward),
        }
    }

    /// The corners of what it sees at a depth (m along its axis): the base of its pyramid, W, m.
    pub fn field(&self, lens: &Lens, depth_m: f64) -> [Vector3<f64>; 4] {
        let Axes { forward, right, up } = self.axes();
        let b = depth_m * (0.5 * lens.horizontal_field_rad).tan();
        let c = depth_m * (0.5 * lens.vertical_field_rad).tan();
        [(-b, c), (b, c), (b, -c), (-b, -c)]
            .map(|(b, c)| self.position_m + forward * depth_m + right * b + up * c)
    }
}

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

#[cfg(test)]
mod tests;
