//! What the four rotors do to the airframe: force and moment from their thrusts and torques.
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
