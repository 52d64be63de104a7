//! The exact solution of a first- or second-order system over an interval with held input.
//!
//! ```text
//! ẋ = A x + B u,  A = [[−a_1, 1], [−a_2, 0]],  y = x_1
//! x(t+h) = x_∞ + e^{A h} (x(t) − x_∞),  x_∞ = −A⁻¹ B u
//! e^{A h} = C I + S (A − σ I),  σ = −a_1/2,  δ = σ² − a_2
//! C = e^{σh} cosh(√δ h),  S = e^{σh} sinh(√δ h)/√δ   (cos and sin for δ < 0; both are entire functions of δ)
//! ```
//!
//! Source: Cayley-Hamilton; Åström and Wittenmark, *Computer-Controlled Systems*, 3rd ed., chapter 2.

use quad_math::{Real, constant};

/// `e^{A h}` for `A = [[−a_1, 1], [−a_2, 0]]`, `a_1, a_2 > 0`, rows first.
pub(super) fn second_order<R: Real>(a1: R, a2: R, h: f64) -> [[R; 2]; 2] {
    let h: R = constant(h);
    let sigma = -a1 * constant(0.5);
    let delta = sigma * sigma - a2;
    let Kernel { c, s } = kernel(sigma, delta, a2, h);
    [[c + s * sigma, s], [-a2 * s, c - s * sigma]]
}

/// C and S of the module's head.
struct Kernel<R> {
    c: R,
    s: R,
}

/// `|δ h²|` below which the power series is used, where `√δ` has no derivative.
const NEARLY_EQUAL_POLES: f64 = 0.25;

fn kernel<R: Real>(sigma: R, delta: R, a2: R, h: R) -> Kernel<R> {
    let z = delta * h * h;
    let near = z.simd_abs().simd_lt(constant(NEARLY_EQUAL_POLES));
    let is_real = delta.simd_gt(R::zero());
    let (near_double, real, complex) = (
        near_double(sigma, z, h),
        real_poles(sigma, delta.select(is_real, R::one()), a2, h),
        complex_poles(sigma, R::one().select(is_real, -delta), h),
    );
    Kernel {
        c: near_double.c.select(near, real.c.select(is_real, complex.c)),
        s: near_double.s.select(near, real.s.select(is_real, complex.s)),
    }
}

/// Poles `−fast` and `−slow`; the slow one by the product of the two, which does not cancel.
fn real_poles<R: Real>(sigma: R, delta: R, a2: R, h: R) -> Kernel<R> {
    let root = delta.simd_sqrt();
    let fast = root - sigma;
    let (slow_decay, fast_decay) = ((-a2 / fast * h).simd_exp(), (-fast * h).simd_exp());
    let half: R = constant(0.5);
    Kernel {
        c: (slow_decay + fast_decay) * half,
        s: (slow_decay - fast_decay) * half / root,
    }
}

fn complex_poles<R: Real>(sigma: R, minus_delta: R, h: R) -> Kernel<R> {
    let frequency = minus_delta.simd_sqrt();
    let decay = (sigma * h).simd_exp();
    let phase = frequency * h;
    Kernel {
        c: decay * phase.simd_cos(),
        s: decay * phase.simd_sin() / frequency,
    }
}

/// Terms of the series: the first left out is `0.25⁷/14! = 7e-16`.
const TERMS: usize = 7;

/// `C = e^{σh} Σ zᵏ/(2k)!`, `S = h e^{σh} Σ zᵏ/(2k+1)!`.
fn near_double<R: Real>(sigma: R, z: R, h: R) -> Kernel<R> {
    let (mut even, mut odd) = (R::one(), R::one());
    // Horner: 1 + z/(1·2) (1 + z/(3·4) (…)) and 1 + z/(2·3) (1 + z/(4·5) (…)).
    for k in (1..TERMS).rev() {
        let n = 2.0 * k as f64;
        even = even * z * constant(1.0 / ((n - 1.0) * n)) + R::one();
        odd = odd * z * constant(1.0 / (n * (n + 1.0))) + R::one();
    }
    let decay = (sigma * h).simd_exp();
    Kernel {
        c: decay * even,
        s: decay * odd * h,
    }
}
