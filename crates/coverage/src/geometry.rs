//! The room, places on its walls, and what a camera there sees.

use crate::CoverageError;
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

pub(crate) fn positive(what: &'static str, value_m: f64) -> Result<(), CoverageError> {
    if value_m > 0.0 && value_m.is_finite() {
        Ok(())
    } else {
        Err(CoverageError::NonPositiveLength { what, value_m })
    }
}

impl Lens {
    pub(crate) fn check(&self) -> Result<(), CoverageError> {
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
    pub(crate) fn check(&self) -> Result<(), CoverageError> {
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

    pub(crate) fn size(&self) -> [f64; 3] {
        [self.length_m, self.width_m, self.height_m]
    }

    /// Whether a point is in the room or on its walls, to rounding.
    pub(crate) fn holds(&self, p: &Vector3<f64>) -> bool {
        let slack = 1e-9 * (self.length_m + self.width_m + self.height_m);
        p.x.abs() <= 0.5 * self.length_m + slack
            && p.y.abs() <= 0.5 * self.width_m + slack
            && (-slack..=self.height_m + slack).contains(&-p.z)
    }
}

/// Axis, right and up of a camera, unit vectors in W.
pub(crate) struct Axes {
    pub(crate) forward: Vector3<f64>,
    pub(crate) right: Vector3<f64>,
    pub(crate) up: Vector3<f64>,
}

impl Camera {
    pub(crate) fn axes(&self) -> Axes {
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
