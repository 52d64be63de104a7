//! The air that a quadrotor flies in, and the noise that acts on it: what its models' phenomena are fed with.
//!
//! ```text
//! wind(t, h) = gain(h) (constant + steps(t)) + gust      gain 1 where wind-shear is off, gust 0 where turbulence is off
//! ω_air      = rotation of the gusts                     where turbulence is on, unless it is left out
//! ```
//!
//! Velocities of the air in W: a wind of `[-5, 0, 0]` blows to the south and pushes to the south. How gusts continue: `gusts.rs`.

use super::gusts::{Normals, PROCESS_NOISE_STREAM};
use crate::agent::Moment;
use crate::schedule::Schedule;
use nalgebra::Vector3;
use quad_dynamics::{Kick, Phenomenon, ProcessNoise, Shear};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use serde::{Deserialize, Serialize};

/// Fastest wind, m/s, that is believed: the strongest gust measured outside a tornado was 113 m/s (Barrow Island, 1996).
pub const STRONGEST_WIND_M_S: f64 = 120.0;

/// The wind about a quadrotor.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Wind {
    /// Mean wind in W, m/s.
    pub constant_m_s: [f64; 3],
    /// Steps: a wind that is added from its time on, m/s in W.
    pub steps_m_s: Schedule<[f64; 3]>,
    /// How the mean wind grows with height; the same at all heights by default. Felt where `wind-shear` is on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear: Option<Shear>,
    /// Gusts about the mean wind. Felt where `turbulence` is on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turbulence: Option<Turbulence>,
}

/// Dryden's turbulence at low altitude.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Turbulence {
    /// Wind 20 ft above the ground `W_20`, m/s, which sets the intensity: 7.7 is light, 15 moderate, 23 severe.
    pub w20_m_s: f64,
    /// Seed of the gusts.
    pub seed: u64,
    /// Which gusts there are; all by default.
    #[serde(default)]
    pub gusts: Gusts,
}

/// Which of the gusts of MIL-F-8785C there are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Gusts {
    /// Velocity and rotation of the air, `u, v, w` and `p, q, r`, as the specification has them.
    #[default]
    All,
    /// Velocity alone. It is the same as with rotation: this draws from numbers of its own.
    Linear,
}

/// White noise on the accelerations. Acts where `process-noise` is on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProcessNoiseSource {
    /// σ_a, m/s²/√Hz per axis.
    pub acceleration_m_s2_sqrt_hz: f64,
    /// σ_α, rad/s²/√Hz per axis.
    pub angular_acceleration_rad_s2_sqrt_hz: f64,
    /// Seed of the noise.
    pub seed: u64,
}

/// Why a wind or a noise can't be.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum AirError {
    /// A wind that no one has seen.
    #[error(
        "the wind must be finite and at most {STRONGEST_WIND_M_S} m/s, got {speed_m_s} m/s; is it in another unit?"
    )]
    TooStrong {
        /// Its speed, m/s.
        speed_m_s: f64,
    },
    /// A profile that can't be.
    #[error(transparent)]
    Shear(#[from] quad_dynamics::ShearError),
    /// An intensity below zero or not finite.
    #[error("the intensity of the process noise must be finite and not negative, got {value}")]
    Intensity {
        /// The number.
        value: f64,
    },
    /// A phenomenon is switched on that nothing feeds.
    #[error(
        "{phenomenon} is switched on, but the script has no {wanted}: add it, or switch {phenomenon} off"
    )]
    NoSource {
        /// The phenomenon.
        phenomenon: Phenomenon,
        /// What the script lacks.
        wanted: &'static str,
    },
    /// A start below the ground where a phenomenon needs a height above it.
    #[error(
        "with {phenomenon} it must start above the ground (z of W points down), got an altitude of {altitude_m} m"
    )]
    BelowGround {
        /// The altitude, −z, m.
        altitude_m: f64,
        /// The phenomenon.
        phenomenon: Phenomenon,
    },
}

impl Wind {
    /// Whether nothing blows.
    pub fn is_still(&self) -> bool {
        *self == Self::default()
    }

    /// Mean wind at an instant, ns, at the reference height, m/s in W.
    pub fn mean(&self, time_ns: u64) -> Vector3<f64> {
        let step = self.steps_m_s.at(time_ns).copied().unwrap_or_default();
        Vector3::from(self.constant_m_s) + Vector3::from(step)
    }

    pub(super) fn check(&self) -> Result<(), AirError> {
        let constant = Vector3::from(self.constant_m_s);
        check_speed(constant.norm())?;
        for step in self.steps_m_s.values() {
            check_speed((constant + Vector3::from(*step)).norm())?;
        }
        if let Some(shear) = &self.shear {
            shear.check()?;
        }
        self.turbulence.map_or(Ok(()), |t| check_speed(t.w20_m_s))
    }
}

/// Checks a wind's speed, m/s.
pub(super) fn check_speed(speed_m_s: f64) -> Result<(), AirError> {
    if (0.0..=STRONGEST_WIND_M_S).contains(&speed_m_s) {
        Ok(())
    } else {
        Err(AirError::TooStrong { speed_m_s })
    }
}

impl ProcessNoiseSource {
    pub(super) fn check(&self) -> Result<(), AirError> {
        let intensities = [
            self.acceleration_m_s2_sqrt_hz,
            self.angular_acceleration_rad_s2_sqrt_hz,
        ];
        match intensities.into_iter().find(|x| !(x.is_finite() && *x >= 0.0)) {
            Some(value) => Err(AirError::Intensity { value }),
            None => Ok(()),
        }
    }

    /// What acts on the vehicle over the step that begins at this instant.
    pub(super) fn kick(&self, now: &Moment<'_>) -> Kick<f64> {
        let mut normals = Normals::of_step(self.seed, PROCESS_NOISE_STREAM | step_number(now));
        let noise = ProcessNoise {
            acceleration: self.acceleration_m_s2_sqrt_hz,
            angular_acceleration: self.angular_acceleration_rad_s2_sqrt_hz,
        };
        noise.kick(now.step_s, [normals.vector(), normals.vector()])
    }
}

/// Which of the agent's steps begins at this instant.
pub(super) fn step_number(now: &Moment<'_>) -> u64 {
    now.time_ns / now.step.ns()
}

/// The generator of a stream of a seed.
pub(super) fn random(seed: u64, stream: u64) -> ChaCha8Rng {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    generator.set_stream(stream);
    generator
}
