//! Process noise: random forces and moments that nothing else explains.
//!
//! ```text
//! dv_W = … dt + σ_a dW_a,   dω_B = … dt + σ_α dW_α       per axis, W independent Wiener processes
//! over a step of h:  Δv = σ_a √h n,  Δω = σ_α √h n         n standard normal
//! ```
//!
//! σ² is the two-sided spectral density of the acceleration. The variance that a flight gathers, σ² t, doesn't depend on the step; within
//! a step the kick comes at its end, an error of first order in h on position and attitude. Valid for what is faster than
//! the vehicle: anything slower is a model that is missing. Source: A. Gelb (ed.), Applied Optimal Estimation, 1974, section 3.

use nalgebra::Vector3;
use quad_math::{Real, constant};

/// A sudden change of motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kick<R: Real> {
    /// Change of the velocity along W, m/s.
    pub velocity: Vector3<R>,
    /// Change of the body rates along B, rad/s.
    pub body_rates: Vector3<R>,
}

/// Intensity of the process noise, the same on all axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProcessNoise<R: Real> {
    /// σ_a, m/s²/√Hz.
    pub acceleration: R,
    /// σ_α, rad/s²/√Hz.
    pub angular_acceleration: R,
}

impl<R: Real> ProcessNoise<R> {
    /// What has gathered over a step of `h` seconds, from independent standard normal numbers: three for the velocity, three
    /// for the body rates.
    #[inline]
    pub fn kick(&self, h: R, [velocity, body_rates]: [Vector3<R>; 2]) -> Kick<R> {
        let root = h.simd_sqrt();
        Kick {
            velocity: velocity * (self.acceleration * root),
            body_rates: body_rates * (self.angular_acceleration * root),
        }
    }
}

impl<R: Real> Kick<R> {
    /// None.
    pub fn none() -> Self {
        Self {
            velocity: Vector3::from_element(constant(0.0)),
            body_rates: Vector3::from_element(constant(0.0)),
        }
    }
}
