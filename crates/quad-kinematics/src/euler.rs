//! Euler angles in the aerospace order Z-Y-X and their rate kinematics.
//!
//! `R_WB = R_z(ψ) R_y(θ) R_x(φ)`, `η̇ = J(η) ω` with `η = [φ, θ, ψ]` and the body rates
//! `ω = [p, q, r]`. `J` is singular at `θ = ±90°`. Source: Stevens, Lewis, Johnson, *Aircraft Control
//! and Simulation*, 3rd ed., chapter 1.

use crate::{Body, Quaternion, Rotation, World};
use nalgebra::{Matrix3, Vector3};
use quad_math::{Flat, Rate, Real, State, constant};

/// Attitude `η = [φ, θ, ψ]` of the body frame against the world frame, rad.
///
/// Least numbers and readable, but singular at `θ = ±90°`: for small-angle models, for outputs, for
/// controllers that demand roll and pitch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EulerAngles<R: Real> {
    /// Roll φ about x_B, rad, positive right side down.
    pub roll: R,
    /// Pitch θ, rad, positive nose up.
    pub pitch: R,
    /// Yaw (heading) ψ about z_W, rad, positive clockwise seen from above.
    pub yaw: R,
}

/// Rate `η̇ = [φ̇, θ̇, ψ̇]` of the Euler angles, rad/s. Not the body rates `ω`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EulerRates<R: Real> {
    /// φ̇, rad/s.
    pub roll: R,
    /// θ̇, rad/s.
    pub pitch: R,
    /// ψ̇, rad/s.
    pub yaw: R,
}

impl<R: Real> EulerAngles<R> {
    /// The attitude from its angles in rad.
    #[inline(always)]
    pub fn new(roll: R, pitch: R, yaw: R) -> Self {
        Self { roll, pitch, yaw }
    }

    /// Level flight at the given heading ψ, rad.
    pub fn level(yaw: R) -> Self {
        Self::new(R::zero(), R::zero(), yaw)
    }

    /// `[φ, θ, ψ]`, rad.
    #[inline(always)]
    pub fn vector(&self) -> Vector3<R> {
        Vector3::new(self.roll, self.pitch, self.yaw)
    }

    /// From `[φ, θ, ψ]`, rad.
    #[inline(always)]
    pub fn from_vector(v: &Vector3<R>) -> Self {
        Self::new(v.x, v.y, v.z)
    }

    /// The rotation matrix `R_WB = R_z(ψ) R_y(θ) R_x(φ)`.
    #[inline(always)]
    pub fn rotation(&self) -> Rotation<R, Body, World> {
        let (s_phi, c_phi) = self.roll.simd_sin_cos();
        let (s_theta, c_theta) = self.pitch.simd_sin_cos();
        let (s_psi, c_psi) = self.yaw.simd_sin_cos();
        Rotation::from_matrix(Matrix3::new(
            c_theta * c_psi,
            s_phi * s_theta * c_psi - c_phi * s_psi,
            c_phi * s_theta * c_psi + s_phi * s_psi,
            c_theta * s_psi,
            s_phi * s_theta * s_psi + c_phi * c_psi,
            c_phi * s_theta * s_psi - s_phi * c_psi,
            -s_theta,
            s_phi * c_theta,
            c_phi * c_theta,
        ))
    }

    /// The unit quaternion of the same attitude, with the sign that half angles give.
    #[inline(always)]
    pub fn quaternion(&self) -> Quaternion<R> {
        let half: R = constant(0.5);
        let (s_phi, c_phi) = (self.roll * half).simd_sin_cos();
        let (s_theta, c_theta) = (self.pitch * half).simd_sin_cos();
        let (s_psi, c_psi) = (self.yaw * half).simd_sin_cos();
        Quaternion {
            w: c_phi * c_theta * c_psi + s_phi * s_theta * s_psi,
            v: Vector3::new(
                s_phi * c_theta * c_psi - c_phi * s_theta * s_psi,
                c_phi * s_theta * c_psi + s_phi * c_theta * s_psi,
                c_phi * c_theta * s_psi - s_phi * s_theta * c_psi,
            ),
        }
    }

    /// `J(η)` of `η̇ = J(η) ω`, body rates to angle rates; singular at `θ = ±90°`.
    #[inline(always)]
    pub fn rate_matrix(&self) -> Matrix3<R> {
        let (s_phi, c_phi) = self.roll.simd_sin_cos();
        let (s_theta, c_theta) = self.pitch.simd_sin_cos();
        let t_theta = s_theta / c_theta;
        let (o, l) = (R::zero(), R::one());
        Matrix3::new(
            l,
            s_phi * t_theta,
            c_phi * t_theta,
            o,
            c_phi,
            -s_phi,
            o,
            s_phi / c_theta,
            c_phi / c_theta,
        )
    }

    /// `J⁻¹(η)` of `ω = J⁻¹(η) η̇`, angle rates to body rates; regular everywhere, rank 2 at `θ = ±90°`.
    #[inline(always)]
    pub fn body_rate_matrix(&self) -> Matrix3<R> {
        let (s_phi, c_phi) = self.roll.simd_sin_cos();
        let (s_theta, c_theta) = self.pitch.simd_sin_cos();
        let (o, l) = (R::zero(), R::one());
        Matrix3::new(
            l,
            o,
            -s_theta,
            o,
            c_phi,
            s_phi * c_theta,
            o,
            -s_phi,
            c_phi * c_theta,
        )
    }

    /// Angle rates `η̇ = J(η) ω` from the body rates `ω`, rad/s.
    #[inline(always)]
    pub fn rates(&self, body_rates: &Vector3<R>) -> EulerRates<R> {
        EulerRates::from_vector(&(self.rate_matrix() * body_rates))
    }

    /// Body rates `ω = J⁻¹(η) η̇` from the angle rates, rad/s.
    #[inline(always)]
    pub fn body_rates(&self, rates: &EulerRates<R>) -> Vector3<R> {
        self.body_rate_matrix() * rates.vector()
    }
}

impl<R: Real> EulerRates<R> {
    /// `[φ̇, θ̇, ψ̇]`, rad/s.
    #[inline(always)]
    pub fn vector(&self) -> Vector3<R> {
        Vector3::new(self.roll, self.pitch, self.yaw)
    }

    /// From `[φ̇, θ̇, ψ̇]`, rad/s.
    #[inline(always)]
    pub fn from_vector(v: &Vector3<R>) -> Self {
        Self {
            roll: v.x,
            pitch: v.y,
            yaw: v.z,
        }
    }
}

impl<R: Real> State<R> for EulerAngles<R> {
    type Rate = EulerRates<R>;

    #[inline(always)]
    fn advanced(&self, h: R, rate: &EulerRates<R>) -> Self {
        Self::from_vector(&(self.vector() + rate.vector() * h))
    }
}

impl<R: Real> Rate<R> for EulerRates<R> {
    #[inline(always)]
    fn zero() -> Self {
        Self::from_vector(&Vector3::zeros())
    }

    #[inline(always)]
    fn add_scaled(&self, h: R, other: &Self) -> Self {
        Self::from_vector(&(self.vector() + other.vector() * h))
    }
}

impl<R: Real> Flat<R> for EulerAngles<R> {
    const LEN: usize = 3;

    #[inline(always)]
    fn write(&self, out: &mut [R]) {
        self.vector().write(out);
    }

    #[inline(always)]
    fn read(values: &[R]) -> Self {
        Self::from_vector(&Vector3::read(values))
    }
}

impl<R: Real> Flat<R> for EulerRates<R> {
    const LEN: usize = 3;

    #[inline(always)]
    fn write(&self, out: &mut [R]) {
        self.vector().write(out);
    }

    #[inline(always)]
    fn read(values: &[R]) -> Self {
        Self::from_vector(&Vector3::read(values))
    }
}
