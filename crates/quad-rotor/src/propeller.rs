//! The propeller's static law.
//!
//! `T = C_T ρ n² D⁴` and `Q = C_Q ρ n² D⁵` with `n` in revolutions per second, that is `T = k_T Ω²` and
//! `Q = k_Q Ω²` with `k_T = C_T ρ D⁴ / (2π)²`. The torque coefficient follows from the power coefficient
//! of wind-tunnel tables as `C_Q = C_P / 2π`. Assumes still air and constant coefficients; measured ones
//! rise by about a fifth from 2400 to 6500 rpm for the propeller of the Qball-X4. Source: Brandt and
//! Selig, *Propeller Performance Data at Low Reynolds Numbers*, AIAA 2011-1255.

use quad_math::{Real, constant, sqrt};
use std::f64::consts::TAU;

/// Speed below which the law `Ω = √(T/k_T)` is not inverted, rad/s: under it a propeller idles.
const IDLE_SPEED: f64 = 10.0;

/// The static law of one propeller, `T = k_T Ω²`, `Q = k_Q Ω²`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Propeller<R: Real> {
    /// `k_T`, N s²: thrust per squared speed in rad/s.
    pub thrust_per_speed_squared: R,
    /// `k_Q`, N m s²: torque per squared speed in rad/s.
    pub torque_per_speed_squared: R,
}

impl<R: Real> Propeller<R> {
    /// From the dimensionless coefficients `C_T`, `C_Q`, the diameter `D` in m and the air density `ρ`
    /// in kg/m³.
    pub fn from_coefficients(thrust_coefficient: R, torque_coefficient: R, diameter: R, density: R) -> Self {
        let d2 = diameter * diameter;
        let common = density * d2 * d2 / constant(TAU * TAU);
        Self {
            thrust_per_speed_squared: thrust_coefficient * common,
            torque_per_speed_squared: torque_coefficient * common * diameter,
        }
    }

    /// Thrust `T = k_T Ω²`, N, of a propeller turning at `Ω`, rad/s.
    #[inline(always)]
    pub fn thrust(&self, speed: R) -> R {
        self.thrust_per_speed_squared * speed * speed
    }

    /// Aerodynamic torque `Q = k_Q Ω²`, N m, against the spin, of a propeller turning at `Ω`, rad/s.
    #[inline(always)]
    pub fn torque(&self, speed: R) -> R {
        self.torque_per_speed_squared * speed * speed
    }

    /// Speed `Ω = √(T/k_T)`, rad/s, that gives the thrust; 0 for negative thrust (a kink at `T = 0`).
    ///
    /// Below 10 rad/s the root is replaced by the line to zero (a kink): the slope of the root is infinite at
    /// zero, and a derivative of this function must be a number for every thrust.
    #[inline(always)]
    pub fn speed_for_thrust(&self, thrust: R) -> R {
        let speed_squared = thrust.simd_max(R::zero()) / self.thrust_per_speed_squared;
        speed_squared / sqrt(speed_squared.simd_max(constant(IDLE_SPEED * IDLE_SPEED)))
    }

    /// Spin acceleration `Ω̇ = Ṫ / (2 k_T Ω)`, rad/s², of a propeller whose thrust changes at `Ṫ`, N/s.
    ///
    /// Below 10 rad/s the divisor is held (a kink): the law says nothing about an idling propeller.
    #[inline(always)]
    pub fn speed_rate_for_thrust_rate(&self, speed: R, thrust_rate: R) -> R {
        let divisor = speed.simd_max(constant(IDLE_SPEED));
        thrust_rate / (self.thrust_per_speed_squared * divisor * constant(2.0))
    }
}
