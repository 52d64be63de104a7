//! What acts on the airframe besides gravity: rotors, drag, gyroscopic torque. One type per contribution.
//!
//! Rotor order and place on a '+' layout: 1 rear, 2 front, 3 left, 4 right. Source: thesis chapter 3.4.

use crate::Wrench;
use nalgebra::Vector3;
use quad_math::Real;
use quad_rotor::RotorOutput;

/// Where the four rotors act and which way they turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotorGeometry<R: Real> {
    /// Hub positions relative to the centre of mass, along `x_B` (forward), m.
    pub forward: [R; 4],
    /// Hub positions relative to the centre of mass, along `y_B` (right), m.
    pub right: [R; 4],
    /// Spin sense `s_i` about `z_B` (down): +1 clockwise, −1 counter-clockwise seen from above.
    pub spin: [R; 4],
}

impl<R: Real> RotorGeometry<R> {
    /// Force and moment of the rotors: `F = −Σ T_i e_z`, `M = Σ r_i × (−T_i e_z) − Σ s_i Q_i e_z`.
    ///
    /// On a '+' layout of arm L: `M_x = L (T_3 − T_4)`, `M_y = L (T_2 − T_1)`.
    #[inline(always)]
    pub fn wrench(&self, rotors: &[RotorOutput<R>; 4]) -> Wrench<R> {
        Wrench {
            force: Vector3::new(R::zero(), R::zero(), -sum_of_four(|i| rotors[i].thrust)),
            moment: Vector3::new(
                -sum_of_four(|i| self.right[i] * rotors[i].thrust),
                sum_of_four(|i| self.forward[i] * rotors[i].thrust),
                -sum_of_four(|i| self.spin[i] * rotors[i].torque),
            ),
        }
    }
}

/// `f(0) + f(1) + f(2) + f(3)`, pairwise.
#[inline(always)]
pub(crate) fn sum_of_four<R: Real>(f: impl Fn(usize) -> R) -> R {
    (f(0) + f(1)) + (f(2) + f(3))
}

/// Drag of the airframe and damping of its rates.
///
/// `F_i = −k_i |v_i| v_i` with the air-relative velocity along B, `M_i = −d_i ω_i`. A bluff body's
/// quadratic law axis by axis; the damping is that of rotors whose inflow a rate changes. Source: thesis
/// chapter 3.4.4 (that there is drag); the form is this project's choice. Kink: the second derivative of
/// the force jumps at `v_i = 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drag<R: Real> {
    /// `k`, N s²/m², per body axis.
    pub quadratic: Vector3<R>,
    /// `d`, N m s/rad, per body axis.
    pub rate_damping: Vector3<R>,
}

impl<R: Real> Drag<R> {
    /// Force and moment at an air-relative velocity along B, m/s, and body rates, rad/s.
    #[inline(always)]
    pub fn wrench(&self, air_velocity_b: &Vector3<R>, body_rates: &Vector3<R>) -> Wrench<R> {
        Wrench {
            force: self
                .quadratic
                .zip_map(air_velocity_b, |k, v| -k * v.simd_abs() * v),
            moment: -self.rate_damping.component_mul(body_rates),
        }
    }
}

/// Gyroscopic torque of the spinning rotors, `M = −ω × (Σ s_i I_R Ω_i e_z)`, N m along B.
///
/// The airframe must turn the rotors' angular momentum along with itself. Source: thesis chapter 3.4.3.
#[inline(always)]
pub fn gyroscopic_torque<R: Real>(body_rates: &Vector3<R>, spin_momentum: R) -> Vector3<R> {
    Vector3::new(
        -body_rates.y * spin_momentum,
        body_rates.x * spin_momentum,
        R::zero(),
    )
}
