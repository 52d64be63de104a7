//! Atmospheric turbulence: Dryden's gusts at low altitude, as shaping filters of white noise.
//!
//! ```text
//! Φ_u(Ω) = σ_u² (2 L_u/π) / (1 + (L_u Ω)²)                    along the mean wind
//! Φ_v(Ω) = σ_v² (L_v/π) (1 + 3 (L_v Ω)²) / (1 + (L_v Ω)²)²    across; w, down, alike
//! L_w = h,  L_u = L_v = h / (0.177 + 0.000823 h)^1.2           h and L in feet
//! σ_w = 0.1 W_20,  σ_u = σ_v = σ_w / (0.177 + 0.000823 h)^0.4
//! ```
//!
//! with W_20 the wind 20 ft above the ground and Ω the spatial frequency, rad per length. Flown through at an airspeed V the
//! field is a noise of frequency ω = Ω V (Taylor's frozen turbulence), made by filters with the pole a = V/L:
//!
//! ```text
//! u = σ_u x,  dx = −a x dt + √(2a) dW
//! v = σ_v (√3 x_1 + (1 − √3) x_2) / √2,  dx_1 = −a x_1 dt + √(2a) dW,  dx_2 = a (x_1 − x_2) dt
//! ```
//!
//! The step is exact (transition and covariance in closed form), so the standard deviation is σ at any step size, and no
//! step is too long. Valid from 10 ft to 1000 ft above the ground; heights outside are held at these ends. How the air
//! turns in these gusts: [`DrydenRotation`]. Source: MIL-F-8785C, Flying Qualities of Piloted Airplanes, 1980, section 3.7.

mod rotation;
#[cfg(test)]
mod tests;

pub use rotation::{DrydenRotation, DrydenRotationNoise, DrydenRotationState, GustStep};

use nalgebra::Vector3;
use quad_math::{Real, constant};

/// Metres in a foot.
const FOOT_M: f64 = 0.3048;
/// Range of heights of the low-altitude model, ft.
const HEIGHT_RANGE_FT: [f64; 2] = [10.0, 1000.0];

/// Intensity and scale of the turbulence at a height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dryden<R: Real> {
    /// Standard deviations σ along the mean wind, across to the right, and down, m/s.
    pub intensity: Vector3<R>,
    /// Lengths L in the same order, m.
    pub length: Vector3<R>,
}

/// State of the shaping filters: all of unit size, whatever intensity and length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrydenState<R: Real> {
    /// Along the mean wind.
    pub along: R,
    /// Across: `x_1`, `x_2`.
    pub across: [R; 2],
    /// Down: `x_1`, `x_2`.
    pub down: [R; 2],
}

/// Independent standard normal numbers, fresh for each step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrydenNoise<R: Real> {
    /// For the gust along the mean wind.
    pub along: R,
    /// For the gust across.
    pub across: [R; 2],
    /// For the gust down.
    pub down: [R; 2],
}

impl<R: Real> Dryden<R> {
    /// The turbulence at a height above the ground, m, under a wind of `w20` m/s at 20 ft.
    ///
    /// Heights outside 10 ft to 1000 ft are held at these ends.
    #[inline]
    pub fn low_altitude(height: R, w20: R) -> Self {
        let [lowest, highest] = HEIGHT_RANGE_FT.map(constant::<R>);
        let foot = constant::<R>(FOOT_M);
        let h = (height / foot).simd_clamp(lowest, highest);
        let base = constant::<R>(0.177) + constant::<R>(0.000_823) * h;
        let down = constant::<R>(0.1) * w20;
        let across = down / base.simd_powf(constant(0.4));
        let length = h / base.simd_powf(constant(1.2)) * foot;
        Self {
            intensity: Vector3::new(across, across, down),
            length: Vector3::new(length, length, h * foot),
        }
    }

    /// The filters' states after flying for `h` seconds at an airspeed V ≥ 0, m/s.
    #[inline]
    pub fn step(&self, state: &DrydenState<R>, airspeed: R, h: R, noise: &DrydenNoise<R>) -> DrydenState<R> {
        let way = airspeed * h;
        DrydenState {
            along: first_order(state.along, way / self.length.x, noise.along),
            across: second_order(state.across, way / self.length.y, noise.across),
            down: second_order(state.down, way / self.length.z, noise.down),
        }
    }

    /// Velocity of the gust along the mean wind, across to the right, and down, m/s.
    #[inline]
    pub fn gust(&self, state: &DrydenState<R>) -> Vector3<R> {
        self.intensity.component_mul(&Vector3::new(
            state.along,
            lateral(state.across),
            lateral(state.down),
        ))
    }
}

impl<R: Real> DrydenState<R> {
    /// A state of turbulence that has continued for ever: `x` and `x_1` of variance 1, `x_2` of variance ½ and covariance ½.
    pub fn stationary(noise: &DrydenNoise<R>) -> Self {
        let half = constant::<R>(0.5);
        let pair = |[n_1, n_2]: [R; 2]| [n_1, (n_1 + n_2) * half];
        Self {
            along: noise.along,
            across: pair(noise.across),
            down: pair(noise.down),
        }
    }
}

/// `x e^−τ + √(1 − e^−2τ) n` after the time τ in units of 1/a.
#[inline(always)]
fn first_order<R: Real>(x: R, tau: R, noise: R) -> R {
    let decay = (-tau).simd_exp();
    decay * x + (R::one() - decay * decay).simd_max(R::zero()).simd_sqrt() * noise
}

/// A gust across or down of unit size, `(√3 x_1 + (1 − √3) x_2) / √2`.
#[inline(always)]
fn lateral<R: Real>([x_1, x_2]: [R; 2]) -> R {
    let root = constant::<R>(3.0_f64.sqrt());
    let scale = constant::<R>(std::f64::consts::FRAC_1_SQRT_2);
    (root * x_1 + (R::one() - root) * x_2) * scale
}

/// Two poles at a: `Φ = e^−τ [1 0; τ 1]`.
#[inline(always)]
fn second_order<R: Real>([x_1, x_2]: [R; 2], tau: R, [n_1, n_2]: [R; 2]) -> [R; 2] {
    let Shock { l_11, l_21, l_22 } = Shock::over(tau);
    let decay = (-tau).simd_exp();
    [
        decay * x_1 + l_11 * n_1,
        decay * (x_2 + tau * x_1) + l_21 * n_1 + l_22 * n_2,
    ]
}

/// Noise of two poles at a: the Cholesky factor of `Q = P − Φ P Φᵀ` with `P = [1 ½; ½ ½]`.
struct Shock<R: Real> {
    l_11: R,
    l_21: R,
    l_22: R,
}

impl<R: Real> Shock<R> {
    #[inline(always)]
    fn over(tau: R) -> Self {
        let half = constant::<R>(0.5);
        let decay = (-tau).simd_exp();
        let square = decay * decay;
        let q_11 = (R::one() - square).simd_max(constant(f64::MIN_POSITIVE));
        let q_12 = half - square * (tau + half);
        let q_22 = half - square * (tau * tau + tau + half);
        let l_11 = q_11.simd_sqrt();
        let l_21 = q_12 / l_11;
        let l_22 = (q_22 - l_21 * l_21).simd_max(R::zero()).simd_sqrt();
        Self { l_11, l_21, l_22 }
    }
}
