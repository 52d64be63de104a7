//! How fast the loops are asked to be: settings in the designer's terms, gains in the loop's.

use crate::settling;
use quad_math::{Real, constant};
use serde::{Deserialize, Serialize};

/// What a controller is asked to achieve. Defaults are those of the source's captions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Height loop.
    pub height: LoopSettings,
    /// Yaw loop.
    pub yaw: LoopSettings,
    /// Horizontal position loop.
    pub position: LoopSettings,
    /// Attitude loop.
    pub attitude: AttitudeSettings,
}

/// A second-order loop by its settling time and damping, with the extra real pole of level 3.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct LoopSettings {
    /// Settling time τ_s to 2 % of a step, s, of the second-order part.
    pub settling_time_s: f64,
    /// Damping ratio ζ.
    pub damping: f64,
    /// Extra real pole `p` of the third-order loop, as a multiple of ω_n; levels 1 and 2 have none.
    pub pole_ratio: f64,
}

/// The attitude loop, relative to the position loop it serves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct AttitudeSettings {
    /// Natural frequency as a multiple of the position loop's, `ω_n,a / ω_n,p`.
    pub frequency_ratio: f64,
    /// Damping ratio ζ_a.
    pub damping: f64,
    /// Extra real pole of the third-order loop, as a multiple of ω_n,a; levels 1 and 2 have none.
    pub pole_ratio: f64,
}

impl Default for LoopSettings {
    fn default() -> Self {
        Self {
            settling_time_s: 2.0,
            damping: 1.0,
            pole_ratio: 20.0,
        }
    }
}

impl Default for AttitudeSettings {
    fn default() -> Self {
        Self {
            frequency_ratio: 10.0,
            damping: 1.0,
            pole_ratio: 5.0,
        }
    }
}

/// A setting that no controller can have.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SettingsError {
    /// A number that must be positive and finite.
    #[error("controller setting `{key}` must be positive and finite, got {value}")]
    NotPositive {
        /// Which, as in `height.settling_time_s`.
        key: &'static str,
        /// What it was.
        value: f64,
    },
    /// A PID gain that is negative, NaN or infinite.
    #[error("PID gain of the {key} loop must be finite and not negative, got {value}")]
    NegativeGain {
        /// Which loop.
        key: &'static str,
        /// What it was.
        value: f64,
    },
    /// A largest tilt of 90 degrees or more.
    #[error("tilt_limit_rad must be below π/2, got {tilt_limit_rad}")]
    TiltLimit {
        /// What it was, rad.
        tilt_limit_rad: f64,
    },
    /// A set-point weight outside 0 to 1.
    #[error("set_point_weight must be above 0 and at most 1, got {set_point_weight}")]
    SetPointWeight {
        /// What it was.
        set_point_weight: f64,
    },
    /// A settling time and damping that no natural frequency meets.
    #[error("controller setting `{key}`: {source}")]
    Settling {
        /// Which loop, as in `height`.
        key: &'static str,
        /// Why.
        source: settling::LoopError,
    },
}

/// Gains of one loop in the form of its poles: `(s² + 2ζω s + ω²)`, with `(s + p)` at level 3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopGains<R: Real> {
    /// Natural frequency ω_n, rad/s.
    pub natural_frequency: R,
    /// Damping ratio ζ.
    pub damping: R,
    /// Extra real pole p, rad/s.
    pub pole: R,
}

impl<R: Real> LoopGains<R> {
    /// `v = ÿ_d + 2ζω (ẏ_d − ẏ) + ω² (y_d − y)`.
    #[inline(always)]
    pub fn second_order(&self, error: R, error_rate: R, feed_forward: R) -> R {
        let w = self.natural_frequency;
        feed_forward + constant::<R>(2.0) * self.damping * w * error_rate + w * w * error
    }

    /// `v = y⃛_d + (2ζω + p) (ÿ_d − ÿ) + (ω² + 2ζωp) (ẏ_d − ẏ) + ω²p (y_d − y)`.
    #[inline(always)]
    pub fn third_order(&self, error: R, error_rate: R, error_acceleration: R, feed_forward: R) -> R {
        let (w, p) = (self.natural_frequency, self.pole);
        let twice = constant::<R>(2.0) * self.damping * w;
        feed_forward + (twice + p) * error_acceleration + (w * w + twice * p) * error_rate + w * w * p * error
    }
}

/// Gains of all loops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gains<R: Real> {
    /// Height.
    pub height: LoopGains<R>,
    /// Yaw.
    pub yaw: LoopGains<R>,
    /// Horizontal position; its extra pole is not used.
    pub position: LoopGains<R>,
    /// Roll and pitch.
    pub attitude: LoopGains<R>,
}

impl Settings {
    /// The gains that follow.
    ///
    /// # Errors
    /// A setting that is not positive and finite.
    pub fn gains<R: Real>(&self) -> Result<Gains<R>, SettingsError> {
        let height = self.height.frequency("height", HEIGHT_KEYS)?;
        let yaw = self.yaw.frequency("yaw", YAW_KEYS)?;
        let position = self.position.frequency("position", POSITION_KEYS)?;
        let attitude = position * positive("attitude.frequency_ratio", self.attitude.frequency_ratio)?;
        let attitude_damping = positive("attitude.damping", self.attitude.damping)?;
        let attitude_pole = attitude * positive("attitude.pole_ratio", self.attitude.pole_ratio)?;
        Ok(Gains {
            height: loop_gains(height, self.height.damping, height * self.height.pole_ratio),
            yaw: loop_gains(yaw, self.yaw.damping, yaw * self.yaw.pole_ratio),
            position: loop_gains(
                position,
                self.position.damping,
                position * self.position.pole_ratio,
            ),
            attitude: loop_gains(attitude, attitude_damping, attitude_pole),
        })
    }
}

/// Names of a loop's settings, for messages: settling time, damping, pole ratio.
type Keys = [&'static str; 3];
const HEIGHT_KEYS: Keys = ["height.settling_time_s", "height.damping", "height.pole_ratio"];
const YAW_KEYS: Keys = ["yaw.settling_time_s", "yaw.damping", "yaw.pole_ratio"];
const POSITION_KEYS: Keys = [
    "position.settling_time_s",
    "position.damping",
    "position.pole_ratio",
];

impl LoopSettings {
    /// The natural frequency, rad/s, that settles in time.
    fn frequency(&self, name: &'static str, keys: Keys) -> Result<f64, SettingsError> {
        positive(keys[0], self.settling_time_s)?;
        positive(keys[1], self.damping)?;
        positive(keys[2], self.pole_ratio)?;
        settling::natural_frequency(self.settling_time_s, self.damping)
            .map_err(|source| SettingsError::Settling { key: name, source })
    }
}

fn positive(key: &'static str, value: f64) -> Result<f64, SettingsError> {
    if value.is_finite() && value > 0.0 {
        Ok(value)
    } else {
        Err(SettingsError::NotPositive { key, value })
    }
}

fn loop_gains<R: Real>(natural_frequency: f64, damping: f64, pole: f64) -> LoopGains<R> {
    LoopGains {
        natural_frequency: constant(natural_frequency),
        damping: constant(damping),
        pole: constant(pole),
    }
}
