//! Drag of the airframe, through which a model feels the air.
//!
//! ```text
//! F_i = −k_i |v_i| v_i      v = Rᵀ (velocity − wind), along B
//! M_i = −d_i (ω_i − ω_air,i)   ω_air = Rᵀ (rotation of the air), along B
//! ```
//!
//! A bluff body's quadratic law axis by axis; the damping is that of rotors whose inflow a rate changes. Valid for a body
//! without lift at Reynolds numbers where its drag coefficient is constant (above some 0.5 m/s for rods of millimetres),
//! and for rates that change the inflow little (tip speed against hub speed). Kink: the second derivative of the force
//! jumps at `v_i = 0`. Source: thesis chapter 3.4.4 (that there is drag); S. F. Hoerner, Fluid-Dynamic Drag, 1965 (bluff bodies);
//! the form axis by axis is this project's choice.

use crate::Wrench;
use nalgebra::Vector3;
use quad_math::Real;

/// Drag of the airframe and damping of its rates: `F_i = −k_i |v_i| v_i`, `M_i = −d_i (ω_i − ω_air,i)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drag<R> {
    /// `k`, N s²/m², per body axis.
    pub quadratic: Vector3<R>,
    /// `d`, N m s/rad, per body axis.
    pub rate_damping: Vector3<R>,
}

impl<R: Real> Drag<R> {
    /// Force and moment at an air-relative velocity along B, m/s, and body rates relative to the air, rad/s.
    ///
    /// Air that rolls by p_g about a body at rest acts like a body that rolls by −p_g in air at rest.
    #[inline(always)]
    pub fn wrench(&self, air_velocity_b: &Vector3<R>, air_rates_b: &Vector3<R>) -> Wrench<R> {
        Wrench {
            force: self
                .quadratic
                .zip_map(air_velocity_b, |k, v| -k * v.simd_abs() * v),
            moment: -self.rate_damping.component_mul(air_rates_b),
        }
    }
}
