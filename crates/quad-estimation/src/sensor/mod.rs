//! The sensors on board: what each would read if it were perfect.
//!
//! ```text
//! accelerometer   f_B = F/m, everything but gravity           [0, 0, −g] in hover, 0 in free fall
//! gyroscope       ω
//! magnetometer    R_WBᵀ m_W
//! sonar           h / (z_W · z_B), looking along z_B at flat ground in z_W = 0
//! barometer       h = −z
//! position fix    r_W
//! ```
//!
//! All sit in the centre of mass and look along the body's axes. Pure functions of what can be measured, generic in
//! the scalar: the filter's Jacobians come from the same code. Source: Beard and McLain, *Small Unmanned Aircraft*
//! (2012), chapter 7.

mod imperfect;
mod quality;
mod suite;

pub use imperfect::{Sensor, SensorError};
pub use quality::{EARTH_FIELD_UT, Quality};
pub use suite::{Measurement, SensorSuite, SuiteState};

use nalgebra::Vector3;
use quad_dynamics::{AnyQuadrotor, Input};
use quad_math::{Real, constant};
use serde::{Deserialize, Serialize};
use std::fmt;

/// Least cosine of the tilt that a sonar's range is computed with; beyond 84° the range stays as there (a kink).
const LEAST_COSINE: f64 = 0.1;

/// A kind of sensor.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Instrument {
    /// Specific force along B, m/s².
    Accelerometer,
    /// Body rates, rad/s.
    Gyroscope,
    /// Magnetic field along B, µT.
    Magnetometer {
        /// The field along W, µT.
        field_ut: [f64; 3],
    },
    /// Range to the ground along `z_B`, m.
    Sonar,
    /// Height, m.
    Barometer,
    /// Position in W, m, from outside: motion capture, a satellite receiver.
    PositionFix,
}

impl fmt::Display for Instrument {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Accelerometer => "accelerometer",
            Self::Gyroscope => "gyroscope",
            Self::Magnetometer { .. } => "magnetometer",
            Self::Sonar => "sonar",
            Self::Barometer => "barometer",
            Self::PositionFix => "position fix",
        })
    }
}

/// What there is to be seen of a flight at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen<R: Real> {
    /// Position in W, m.
    pub position: Vector3<R>,
    /// `R_WB`.
    pub rotation: nalgebra::Matrix3<R>,
    /// Body rates, rad/s.
    pub body_rates: Vector3<R>,
    /// Specific force along B, m/s².
    pub specific_force: Vector3<R>,
}

impl<R: Real> Seen<R> {
    /// What a quadrotor under this input shows.
    pub fn of(quadrotor: &AnyQuadrotor<R>, input: &Input<R>) -> Self {
        let flight = quadrotor.flight();
        Self {
            position: flight.position,
            rotation: flight.rotation.matrix,
            body_rates: flight.body_rates,
            specific_force: quadrotor.specific_force(input),
        }
    }
}

/// One to three readings taken at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reading<R: Real> {
    /// Of an instrument with one axis.
    Scalar(R),
    /// Of an instrument with three.
    Vector(Vector3<R>),
}

impl<R: Real> Reading<R> {
    /// The readings as a slice.
    pub fn as_slice(&self) -> &[R] {
        match self {
            Self::Scalar(value) => std::slice::from_ref(value),
            Self::Vector(vector) => vector.as_slice(),
        }
    }
}

impl Instrument {
    /// How many readings it gives at once.
    pub const fn readings(&self) -> usize {
        match self {
            Self::Sonar | Self::Barometer => 1,
            Self::Accelerometer | Self::Gyroscope | Self::Magnetometer { .. } | Self::PositionFix => 3,
        }
    }

    /// What it reads if it is perfect.
    pub fn ideal<R: Real>(&self, seen: &Seen<R>) -> Reading<R> {
        match self {
            Self::Accelerometer => Reading::Vector(seen.specific_force),
            Self::Gyroscope => Reading::Vector(seen.body_rates),
            Self::Magnetometer { field_ut } => {
                let m_w = Vector3::from(field_ut.map(constant::<R>));
                Reading::Vector(seen.rotation.transpose() * m_w)
            }
            Self::Sonar => {
                let cosine = seen.rotation.m33.simd_max(constant(LEAST_COSINE));
                Reading::Scalar(-seen.position.z / cosine)
            }
            Self::Barometer => Reading::Scalar(-seen.position.z),
            Self::PositionFix => Reading::Vector(seen.position),
        }
    }
}
