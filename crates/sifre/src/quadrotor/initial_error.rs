//! The error of a filter's initial estimate.
//!
//! ```text
//! r̂ = r + e_r,  v̂ = v + e_v    along W
//! R̂ = R exp([e_θ]×)            a turn about the body's axes; the velocity along B follows
//! ```
//!
//! Each error is fixed or drawn, `e = σ n` with n standard normal per axis; everything is drawn whatever is used of it, so that
//! one error can't change another. What the filter says of its own uncertainty is another matter
//! ([`Estimation::uncertainty`](super::Estimation::uncertainty)): to be consistent it says at least as much.

use nalgebra::Vector3;
use quad_dynamics::Snapshot;
use quad_kinematics::Quaternion;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use serde::{Deserialize, Serialize};

/// Errors of a filter's first belief: belief less flight.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct InitialError {
    /// Of the position, m, along W.
    pub position_m: VectorError,
    /// Of the velocity, m/s, along W.
    pub velocity_m_s: VectorError,
    /// Of the attitude: a turn about the axes of B, rad.
    pub attitude_rad: VectorError,
}

/// An error along three axes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum VectorError {
    /// This one.
    Fixed([f64; 3]),
    /// Drawn with this standard deviation on each axis, from the seed of the sensors.
    Drawn(f64),
}

/// Why an error can't be.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum InitialErrorFault {
    /// An error that is not finite.
    #[error("the initial error of the {what} must be finite, got {value}")]
    NotFinite {
        /// What it is the error of.
        what: &'static str,
        /// The number.
        value: f64,
    },
    /// A standard deviation below zero or not finite.
    #[error(
        "the standard deviation of the {what}'s initial error must be finite and not negative, got {value}"
    )]
    Deviation {
        /// What it is the error of.
        what: &'static str,
        /// The number.
        value: f64,
    },
}

impl Default for VectorError {
    /// None.
    fn default() -> Self {
        Self::Fixed([0.0; 3])
    }
}

impl VectorError {
    fn check(&self, what: &'static str) -> Result<(), InitialErrorFault> {
        match *self {
            Self::Fixed(error) => match error.into_iter().find(|e| !e.is_finite()) {
                Some(value) => Err(InitialErrorFault::NotFinite { what, value }),
                None => Ok(()),
            },
            Self::Drawn(value) if value.is_finite() && value >= 0.0 => Ok(()),
            Self::Drawn(value) => Err(InitialErrorFault::Deviation { what, value }),
        }
    }

    fn draw(&self, generator: &mut ChaCha8Rng) -> Vector3<f64> {
        let normal = Vector3::from_fn(|_, _| StandardNormal.sample(generator));
        match *self {
            Self::Fixed(error) => error.into(),
            Self::Drawn(deviation) => normal * deviation,
        }
    }
}

impl InitialError {
    /// Checks its numbers.
    ///
    /// # Errors
    /// The first that can't be, by what it is the error of.
    pub fn check(&self) -> Result<(), InitialErrorFault> {
        self.position_m.check("position")?;
        self.velocity_m_s.check("velocity")?;
        self.attitude_rad.check("attitude")
    }

    /// The wrong initial estimate of a flight.
    pub(super) fn told(&self, flight: &Snapshot<f64>, generator: &mut ChaCha8Rng) -> Snapshot<f64> {
        let [position, velocity, turn] =
            [self.position_m, self.velocity_m_s, self.attitude_rad].map(|error| error.draw(generator));
        if *self == Self::default() {
            return *flight;
        }
        let mut told = *flight;
        let body = &flight.body;
        told.body.position += position;
        if let Some(axis) = turn.try_normalize(0.0) {
            let turn = Quaternion::from_axis_angle(&axis, turn.norm());
            told.body.attitude = body.attitude.product(&turn);
        }
        let velocity = body.attitude.rotate(&body.velocity) + velocity;
        told.body.velocity = told.body.attitude.conjugate().rotate(&velocity);
        told
    }
}
