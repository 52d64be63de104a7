//! Gains of the PID cascade, and the limits of its parts.

use super::LOOPS;
use crate::SettingsError;
use quad_math::{Real, constant};
use serde::{Deserialize, Serialize};

/// Gains of one PID loop, whose output is an acceleration (m/s² or rad/s²).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PidGains {
    /// `k_p`, 1/s².
    pub proportional: f64,
    /// `k_i`, 1/s³.
    pub integral: f64,
    /// `k_d`, 1/s.
    pub derivative: f64,
}

/// Gains and limits of the cascade.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PidSettings {
    /// Height loop.
    pub height: PidGains,
    /// Yaw loop.
    pub yaw: PidGains,
    /// Horizontal position loops, x and y alike.
    pub position: PidGains,
    /// Roll and pitch loops.
    pub attitude: PidGains,
    /// Bandwidth N of the derivative filters, rad/s.
    pub filter_bandwidth_rad_s: f64,
    /// Largest demanded tilt `√(φ² + θ²)`, rad.
    pub tilt_limit_rad: f64,
    /// Rate `k_w` of the back-calculation, 1/s.
    pub anti_windup_per_s: f64,
    /// Set-point weight `b` of all loops with integral action, above 0 and up to 1.
    #[serde(default = "whole")]
    pub set_point_weight: f64,
}

/// The set point without a weight.
const fn whole() -> f64 {
    1.0
}

/// The gains that come with the project, rounded from what [`super::tune`] finds with seed 1 at level 5 of the Qball-X4 at constant
/// voltage, commands limited. They are per unit of mass and inertia, so that they carry over to other vehicles.
impl Default for PidSettings {
    fn default() -> Self {
        let gains = |proportional, integral, derivative| PidGains {
            proportional,
            integral,
            derivative,
        };
        Self {
            height: gains(16.2, 13.0, 6.81),
            yaw: gains(32.2, 25.5, 12.0),
            position: gains(4.27, 1.32, 4.26),
            attitude: gains(72.5, 110.0, 15.1),
            filter_bandwidth_rad_s: 100.0,
            tilt_limit_rad: std::f64::consts::FRAC_PI_6,
            anti_windup_per_s: 2.0,
            set_point_weight: 0.5,
        }
    }
}

impl PidGains {
    /// Gains that place the poles of `ÿ = u` at `(s + ω)² (s + a)`, given `ω` and `a`, rad/s: `k_p = ω² + 2ωa`,
    /// `k_i = a ω²`, `k_d = 2ω + a`. The set-point weight that belongs to them is `ω²/k_p`.
    pub fn placed(omega: f64, integral_pole: f64) -> Self {
        Self {
            proportional: omega * (omega + 2.0 * integral_pole),
            integral: omega * omega * integral_pole,
            derivative: 2.0 * omega + integral_pole,
        }
    }
}

impl PidSettings {
    pub(super) fn check(&self) -> Result<(), SettingsError> {
        let gains = [
            ("height", &self.height),
            ("yaw", &self.yaw),
            ("position", &self.position),
            ("attitude", &self.attitude),
        ];
        for (key, g) in gains {
            for value in [g.proportional, g.integral, g.derivative] {
                if !(value.is_finite() && value >= 0.0) {
                    return Err(SettingsError::NegativeGain { key, value });
                }
            }
        }
        for (key, value) in [
            ("filter_bandwidth_rad_s", self.filter_bandwidth_rad_s),
            ("tilt_limit_rad", self.tilt_limit_rad),
            ("anti_windup_per_s", self.anti_windup_per_s),
        ] {
            if !(value.is_finite() && value > 0.0) {
                return Err(SettingsError::NotPositive { key, value });
            }
        }
        if self.tilt_limit_rad >= std::f64::consts::FRAC_PI_2 {
            return Err(SettingsError::TiltLimit {
                tilt_limit_rad: self.tilt_limit_rad,
            });
        }
        if !(self.set_point_weight > 0.0 && self.set_point_weight <= 1.0) {
            return Err(SettingsError::SetPointWeight {
                set_point_weight: self.set_point_weight,
            });
        }
        Ok(())
    }

    /// One value per loop `[x, y, z, φ, θ, ψ]`.
    pub(super) fn per_loop<R: Real>(&self, f: impl Fn(&PidGains) -> f64) -> [R; LOOPS] {
        [
            &self.position,
            &self.position,
            &self.height,
            &self.attitude,
            &self.attitude,
            &self.yaw,
        ]
        .map(|gains| constant(f(gains)))
    }
}
