//! The gusts' rotation: how fast the air about the vehicle turns, after Dryden at low altitude.
//!
//! ```text
//! Φ_p(Ω) = (σ_w²/L_w) 0.8 (π L_w / 4b)^⅓ / (1 + (4bΩ/π)²)    about the mean wind
//! Φ_q(Ω) = Ω² / (1 + (4bΩ/π)²) Φ_w(Ω)                        about the axis across
//! Φ_r(Ω) = Ω² / (1 + (3bΩ/π)²) Φ_v(Ω)                        about the axis down
//! ```
//!
//! with the vehicle's span b, over which the field is averaged. p is a noise of its own; q and r are slopes of the very gusts
//! w and v that are felt: the field is passed against the mean wind, as in hover, so that what has been felt lies down
//! the wind, and the air turns like a rigid body, `q = −∂w/∂x`, `r = ∂v/∂x` with x down the wind:
//!
//! ```text
//! p = σ_p x,  dx = −x ds/ℓ + √(2/ℓ) dW,  ℓ = 4b/π,  σ_p² = ∫ Φ_p dΩ = 0.8 (π L_w / 4b)^⅓ π² σ_w² / (8 b L_w)
//! q =  (w − w̄)/ℓ_q,  dw̄ = (w − w̄) ds/ℓ_q,  ℓ_q = 4b/π      a way ds = V dt flown through the field
//! r = −(v − v̄)/ℓ_r,  dv̄ = (v − v̄) ds/ℓ_r,  ℓ_r = 3b/π
//! σ_q = σ_w √(a (3 + 2a)/2) / ((1 + a) ℓ_q),  a = ℓ_q/L_w;  r alike
//! ```
//!
//! A downdraught that grows (w > w̄) comes from upwind: the air goes down more behind than ahead, which is a turn
//! about the axis to the right. The step is exact given the gusts' own (transition and covariance in closed form).
//! Valid for a span that is small against L_w; one above π L_w/8 (1.2 m at 10 ft) is held there. Source: MIL-F-8785C, 1980,
//! section 3.7 (spectra; it leaves the signs of q and r open); that they are slopes of a frozen field: Etkin and Reid,
//! Dynamics of Flight, 3rd ed., 1996, chapter 13.

#[cfg(test)]
mod tests;

use super::{Dryden, DrydenNoise, DrydenState, Shock, first_order, lateral};
use nalgebra::Vector3;
use quad_math::{Real, constant};
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// Largest span over L_w.
const LARGEST_SPAN: f64 = PI / 8.0;
/// Variances below this are rounding; dividing by them tells nothing.
const ROUNDING: f64 = 1e-15;

/// The rotation's intensity and lengths at a height, for a vehicle of some span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrydenRotation<R: Real> {
    /// Standard deviation σ_p, rad/s.
    pub roll_intensity: R,
    /// Lengths ℓ about the mean wind, across and down, m.
    pub length: Vector3<R>,
    linear: Dryden<R>,
}

/// State of the rotation's filters, beside that of the gusts: all of unit size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrydenRotationState<R: Real> {
    /// x of p.
    pub roll: R,
    /// w̄/σ_w of q.
    pub lagged_down: R,
    /// v̄/σ_v of r.
    pub lagged_across: R,
}

/// Independent standard normal numbers, fresh for each step and others than the gusts' own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrydenRotationNoise<R: Real> {
    /// For p.
    pub roll: R,
    /// For q.
    pub pitch: R,
    /// For r.
    pub yaw: R,
}

/// A step of the gusts that the rotation goes along with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GustStep<'a, R: Real> {
    /// The gusts' state before it.
    pub before: &'a DrydenState<R>,
    /// The noise that drives it.
    pub noise: &'a DrydenNoise<R>,
    /// The way flown through the field over it, `V h`, m.
    pub way: R,
}

impl<R: Real> Dryden<R> {
    /// The rotation that goes with this turbulence for a vehicle of a span b > 0, m.
    #[inline]
    pub fn rotation(&self, span: R) -> DrydenRotation<R> {
        let scale = self.length.z;
        let b = span.simd_min(scale * constant(LARGEST_SPAN));
        let slenderness = (scale * constant::<R>(PI / 4.0) / b).simd_powf(constant(1.0 / 3.0));
        let variance = constant::<R>(0.8 * PI * PI / 8.0) * slenderness / (b * scale);
        let [four, three] = [4.0, 3.0].map(|n| b * constant::<R>(n / PI));
        DrydenRotation {
            roll_intensity: self.intensity.z * variance.simd_sqrt(),
            length: Vector3::new(four, four, three),
            linear: *self,
        }
    }
}

impl<R: Real> DrydenRotation<R> {
    /// The filters' states after the step that the gusts take.
    #[inline]
    pub fn step(
        &self,
        state: &DrydenRotationState<R>,
        gusts: &GustStep<'_, R>,
        noise: &DrydenRotationNoise<R>,
    ) -> DrydenRotationState<R> {
        let scales = self.linear.length;
        let pitch = Lag::new(gusts.way, scales.z, self.length.y);
        let yaw = Lag::new(gusts.way, scales.y, self.length.z);
        DrydenRotationState {
            roll: first_order(state.roll, gusts.way / self.length.x, noise.roll),
            lagged_down: pitch.step(
                state.lagged_down,
                gusts.before.down,
                [gusts.noise.down[0], gusts.noise.down[1], noise.pitch],
            ),
            lagged_across: yaw.step(
                state.lagged_across,
                gusts.before.across,
                [gusts.noise.across[0], gusts.noise.across[1], noise.yaw],
            ),
        }
    }

    /// A state of turbulence that has continued for ever, beside [`DrydenState::stationary`] of the same `gusts`' noise.
    pub fn stationary(
        &self,
        gusts: &DrydenNoise<R>,
        noise: &DrydenRotationNoise<R>,
    ) -> DrydenRotationState<R> {
        let zero = R::zero();
        let calm = DrydenState {
            along: zero,
            across: [zero; 2],
            down: [zero; 2],
        };
        let nothing = DrydenRotationState {
            roll: zero,
            lagged_down: zero,
            lagged_across: zero,
        };
        // So long a way that what was before it is forgotten: e^−1000 is nought.
        let gusts = GustStep {
            before: &calm,
            noise: gusts,
            way: self.linear.length.max() * constant(1000.0),
        };
        self.step(&nothing, &gusts, noise)
    }

    /// Rotation of the air about the mean wind, about the axis across to the right, and about the axis down, rad/s.
    #[inline]
    pub fn rates(&self, state: &DrydenRotationState<R>, gusts: &DrydenState<R>) -> Vector3<R> {
        let sigma = &self.linear.intensity;
        Vector3::new(
            self.roll_intensity * state.roll,
            sigma.z * (lateral(gusts.down) - state.lagged_down) / self.length.y,
            -sigma.y * (lateral(gusts.across) - state.lagged_across) / self.length.z,
        )
    }
}

/// The lag `dz = c (w − z) dτ` behind the unit gust w of [`lateral`], over τ in units of its length: transition and noise.
struct Lag<R: Real> {
    /// `[φ_1, φ_2, φ_z]`, the last row of the transition of `[x_1, x_2, z]`.
    transition: [R; 3],
    /// The last row of the noise's Cholesky factor.
    noise: [R; 3],
}

impl<R: Real> Lag<R> {
    /// Over a way, behind a gust of length L, with a lag of length ℓ ≤ L/2 (c ≥ 2).
    ///
    /// `φ_1 = c (α E + β F)`, `φ_2 = c β E` of `w = α x_1 + β x_2`; with `d = c − 1`: `E = ∫ e^−c(τ−s) e^−s ds = (e^−τ − e^−cτ)/d`, `F = ∫ e^−c(τ−s) s e^−s ds = (τ e^−τ − E)/d`.
    #[inline(always)]
    fn new(way: R, scale: R, length: R) -> Self {
        let root = 3.0_f64.sqrt();
        let [alpha, beta] = [root, 1.0 - root].map(|x| constant::<R>(x * FRAC_1_SQRT_2));
        let (one, half) = (R::one(), constant::<R>(0.5));
        let (tau, c) = (way / scale, scale / length);
        let (decay, fade, d) = ((-tau).simd_exp(), (-c * tau).simd_exp(), c - one);
        let e = (decay - fade) / d;
        let f = (tau * decay - e) / d;
        let [phi_1, phi_2, phi_z] = [c * (alpha * e + beta * f), c * beta * e, fade];
        // Stationary covariances of z with x_1, x_2 and itself.
        let p_1 = c * (alpha + beta * half) / (one + c);
        let p_2 = (p_1 + c * (alpha + beta) * half) / (one + c);
        let p_z = alpha * p_1 + beta * p_2;
        // Q = P − Φ P Φᵀ, its last row.
        let s_1 = phi_1 + half * phi_2 + p_1 * phi_z;
        let s_2 = half * (phi_1 + phi_2) + p_2 * phi_z;
        let s_z = p_1 * phi_1 + p_2 * phi_2 + p_z * phi_z;
        let q_1 = p_1 - decay * s_1;
        let q_2 = p_2 - decay * (tau * s_1 + s_2);
        let q_z = p_z - (phi_1 * s_1 + phi_2 * s_2 + phi_z * s_z);
        let shock = Shock::over(tau);
        // Over short ways the variances are rounding; what is left out here the last number makes up for.
        let quotient = |x: R, l: R| x * l / (l * l + constant(ROUNDING));
        let l_1 = quotient(q_1, shock.l_11);
        let l_2 = quotient(q_2 - shock.l_21 * l_1, shock.l_22);
        let l_z = (q_z - l_1 * l_1 - l_2 * l_2).simd_max(R::zero()).simd_sqrt();
        Self {
            transition: [phi_1, phi_2, phi_z],
            noise: [l_1, l_2, l_z],
        }
    }

    #[inline(always)]
    fn step(&self, z: R, [x_1, x_2]: [R; 2], [n_1, n_2, n_z]: [R; 3]) -> R {
        let ([phi_1, phi_2, phi_z], [l_1, l_2, l_z]) = (self.transition, self.noise);
        (phi_1 * x_1 + phi_2 * x_2 + phi_z * z) + (l_1 * n_1 + l_2 * n_2 + l_z * n_z)
    }
}
