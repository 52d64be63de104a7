//! Gyroscopic torque of the spinning rotors.
//!
//! ```text
//! M = −ω × (Σ s_i I_R Ω_i e_z)
//! ```
//!
//! The airframe must turn the rotors' angular momentum along with itself. Exact for rotors that are symmetric about their axes,
//! which two blades are on the average of a turn. With all rotors at the same speed the sum is nought. Source: thesis
//! chapter 3.4.3; H. Goldstein, Classical Mechanics, chapter 5.

use nalgebra::Vector3;
use quad_math::Real;

/// Gyroscopic torque of the spinning rotors, `M = −ω × (Σ s_i I_R Ω_i e_z)`, N m along B.
#[inline(always)]
pub fn gyroscopic_torque<R: Real>(body_rates: &Vector3<R>, spin_momentum: R) -> Vector3<R> {
    Vector3::new(
        -body_rates.y * spin_momentum,
        body_rates.x * spin_momentum,
        R::zero(),
    )
}
