//! The rigid body by the Euler-Lagrange formalism, in three forms.
//!
//! With `L = T − V`, `T = ½ m ṙᵀṙ + ½ ωᵀ I ω`, `V = −m g z` and `W(η) = J⁻¹(η)` (so `ω = W η̇`):
//!
//! 1. translation with inertial velocities, `q = r_W`: `d/dt (∂L/∂ṙ) = ∂L/∂r + F_W`;
//! 2. translation with body velocities, quasi-velocities `v_B = Rᵀ ṙ`:
//!    `d/dt (∂T/∂v) + ω × ∂T/∂v = F_B − Rᵀ ∂V/∂r`;
//! 3. rotation, `q = η`: `M(η) η̈ + C(η, η̇) η̇ = Wᵀ M_B`, with `M = Wᵀ I W` and `C` from the Christoffel
//!    symbols of `M`.
//!
//! The third form is singular at `θ = ±90°`, where `M` is. It exists beside the Newton-Euler form as a
//! second derivation: the two must give the same accelerations. Source: thesis chapter 3.3.2 and
//! appendix D.2; Goldstein, *Classical Mechanics*, chapters 1 and 4; Meirovitch, *Methods of Analytical
//! Dynamics*, chapter 4 (quasi-coordinates).

use crate::RigidBody;
use nalgebra::{Matrix3, Vector3};
use quad_kinematics::{EulerAngles, EulerRates};
use quad_math::{Real, constant};

impl<R: Real> RigidBody<R> {
    /// Form 1: acceleration `r̈_W`, m/s², from the force (without gravity) with components along W, N.
    ///
    /// `∂L/∂ṙ = m ṙ` and `∂L/∂r = m g e_z`, so `m r̈ = m g e_z + F_W`.
    pub fn lagrange_inertial_acceleration(&self, force_w: &Vector3<R>) -> Vector3<R> {
        let potential_force = Vector3::z() * (self.mass * self.gravity);
        (potential_force + force_w) / self.mass
    }

    /// Form 2: rate of the body velocities `v̇_B`, m/s², from the force (without gravity) along B, N.
    ///
    /// `∂T/∂v = m v`, and the potential's force `m g e_z` is brought to B by the attitude.
    pub fn lagrange_body_velocity_rate(
        &self,
        attitude: &EulerAngles<R>,
        velocity_b: &Vector3<R>,
        body_rates: &Vector3<R>,
        force_b: &Vector3<R>,
    ) -> Vector3<R> {
        let momentum = velocity_b * self.mass;
        let potential_force = Vector3::z() * (self.mass * self.gravity);
        let generalised_force = force_b + attitude.rotation().matrix.transpose() * potential_force;
        (generalised_force - body_rates.cross(&momentum)) / self.mass
    }

    /// `M(η) = Wᵀ I W`, kg m², the inertia matrix of form 3; singular at `θ = ±90°`.
    pub fn euler_mass_matrix(&self, attitude: &EulerAngles<R>) -> Matrix3<R> {
        let w = attitude.body_rate_matrix();
        w.transpose() * self.inertia * w
    }

    /// `C(η, η̇)` of form 3, kg m²/s: `C_ij = Σ_k ½ (∂M_ij/∂η_k + ∂M_ik/∂η_j − ∂M_jk/∂η_i) η̇_k`.
    pub fn euler_coriolis_matrix(&self, attitude: &EulerAngles<R>, rates: &EulerRates<R>) -> Matrix3<R> {
        let partials = self.euler_mass_matrix_partials(attitude);
        let rates = rates.vector();
        Matrix3::from_fn(|i, j| {
            let christoffel = |k: usize| partials[k][(i, j)] + partials[j][(i, k)] - partials[i][(j, k)];
            let sum = (0..3).fold(R::zero(), |sum, k| sum + christoffel(k) * rates[k]);
            sum * constant(0.5)
        })
    }

    /// Form 3: `η̈ = M⁻¹ (Wᵀ M_B − C η̇)`, rad/s², from the moment along B, N m.
    ///
    /// `M⁻¹ = J I⁻¹ Jᵀ`, so no solver is needed.
    pub fn lagrange_euler_acceleration(
        &self,
        attitude: &EulerAngles<R>,
        rates: &EulerRates<R>,
        moment_b: &Vector3<R>,
    ) -> Vector3<R> {
        let generalised_moment = attitude.body_rate_matrix().transpose() * moment_b;
        let coriolis = self.euler_coriolis_matrix(attitude, rates) * rates.vector();
        let j = attitude.rate_matrix();
        j * (self.inertia_inverse * (j.transpose() * (generalised_moment - coriolis)))
    }

    /// `∂M/∂φ`, `∂M/∂θ`, `∂M/∂ψ`; the last is zero, for no heading is special.
    fn euler_mass_matrix_partials(&self, attitude: &EulerAngles<R>) -> [Matrix3<R>; 3] {
        let (s_phi, c_phi) = attitude.roll.simd_sin_cos();
        let (s_theta, c_theta) = attitude.pitch.simd_sin_cos();
        let o = R::zero();
        let w = attitude.body_rate_matrix();
        let dw_dphi = Matrix3::new(o, o, o, o, -s_phi, c_phi * c_theta, o, -c_phi, -s_phi * c_theta);
        let dw_dtheta = Matrix3::new(o, o, -c_theta, o, o, -s_phi * s_theta, o, o, -c_phi * s_theta);
        let partial = |dw: Matrix3<R>| {
            let half = dw.transpose() * self.inertia * w;
            half + half.transpose()
        };
        [partial(dw_dphi), partial(dw_dtheta), Matrix3::zeros()]
    }
}
