//! The formulas of Dormand and Prince's method of order 5(4), generic in the scalar.
//!
//! Seven stages `k_i = f(t + c_i h, x + h Σ_j a_ij k_j)`; `x + h Σ b_i k_i` is of order 5, its seventh
//! stage is the first one of the next step, `h Σ e_i k_i` is the difference from the embedded solution of
//! order 4, and the continuous extension is of order 4.
//!
//! Source: Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., table II.5.2 and
//! section II.6; coefficients of the extension from the code DOPRI5 by Hairer and Wanner.

use crate::{Rate, Real, State, constant};

/// Nodes `c₂ … c₆` (`c₁ = 0`, `c₇ = 1`).
const C: [f64; 5] = [1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0];
/// Row 2 of `a_ij`, and so on.
const A2: [f64; 1] = [1.0 / 5.0];
const A3: [f64; 2] = [3.0 / 40.0, 9.0 / 40.0];
const A4: [f64; 3] = [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0];
const A5: [f64; 4] = [
    19372.0 / 6561.0,
    -25360.0 / 2187.0,
    64448.0 / 6561.0,
    -212.0 / 729.0,
];
const A6: [f64; 5] = [
    9017.0 / 3168.0,
    -355.0 / 33.0,
    46732.0 / 5247.0,
    49.0 / 176.0,
    -5103.0 / 18656.0,
];
/// Weights `b_i` of order 5, which are the seventh row of `a_ij` as well.
const B: [f64; 6] = [
    35.0 / 384.0,
    0.0,
    500.0 / 1113.0,
    125.0 / 192.0,
    -2187.0 / 6784.0,
    11.0 / 84.0,
];
/// `e_i = b_i - b̂_i`: order 5 less order 4.
const E: [f64; 7] = [
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];
/// Weights `d_i` of the quartic term of the continuous extension.
const D: [f64; 7] = [
    -12715105075.0 / 11282082432.0,
    0.0,
    87487479700.0 / 32700410799.0,
    -10690763975.0 / 1880347072.0,
    701980252875.0 / 199316789632.0,
    -1453857185.0 / 822651844.0,
    69997945.0 / 29380423.0,
];

/// One step with its continuous extension: the solution at every instant between its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DenseStep<R: Real, X: State<R>> {
    /// Time `t` at its start, s.
    pub start_s: R,
    /// Length `h`, s.
    pub step_s: R,
    /// State at its start.
    pub start: X,
    /// State at its end, of order 5.
    pub end: X,
    /// Rate at its start `k₁ = f(t, x)`.
    pub start_rate: X::Rate,
    /// Rate at its end `k₇ = f(t + h, x₁)`.
    pub end_rate: X::Rate,
    /// Mean rate over the step `Σ b_i k_i`.
    pub mean_rate: X::Rate,
    /// `Σ d_i k_i`, which makes the extension quartic.
    pub quartic_rate: X::Rate,
}

/// A step and its error estimate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DormandPrinceStep<R: Real, X: State<R>> {
    /// The step.
    pub dense: DenseStep<R, X>,
    /// `Σ e_i k_i`: times `h`, the estimated error of the state at the end.
    pub error_rate: X::Rate,
}

/// `Σ w_i k_i`.
#[inline(always)]
fn weighted<R: Real, K: Rate<R>>(weights: &[f64], k: &[K]) -> K {
    weights
        .iter()
        .zip(k)
        .fold(K::zero(), |sum, (&w, k)| sum.add_scaled(constant(w), k))
}

/// One step of size `h` of `ẋ = f(t, x)` from `x` at `t`, where `start_rate = f(t, x)` is known from the step
/// before ([`DenseStep::end_rate`]).
///
/// The state is brought back to its constraints ([`State::normalised`]) once, at the end.
#[inline]
pub fn dormand_prince_step<R: Real, X: State<R>>(
    f: &impl Fn(R, &X) -> X::Rate,
    t: R,
    x: &X,
    start_rate: X::Rate,
    h: R,
) -> DormandPrinceStep<R, X> {
    let mut k = [start_rate; 7];
    let rows: [&[f64]; 5] = [&A2, &A3, &A4, &A5, &A6];
    for (i, row) in rows.iter().enumerate() {
        k[i + 1] = f(t + h * constant(C[i]), &x.advanced(h, &weighted(row, &k)));
    }
    let mean_rate = weighted(&B, &k);
    let end = x.advanced(h, &mean_rate).normalised();
    k[6] = f(t + h, &end);
    DormandPrinceStep {
        dense: DenseStep {
            start_s: t,
            step_s: h,
            start: *x,
            end,
            start_rate,
            end_rate: k[6],
            mean_rate,
            quartic_rate: weighted(&D, &k),
        },
        error_rate: weighted(&E, &k),
    }
}

impl<R: Real, X: State<R>> DenseStep<R, X> {
    /// The state at the fraction `θ` of the step, 0 to 1, of order 4 (uniformly in `θ`):
    ///
    /// `x(θ) = x + h [θ m + θ(1-θ)(k₁ - m) + θ²(1-θ)(2m - k₁ - k₇) + θ²(1-θ)² d]`,
    ///
    /// with the mean rate `m` and the quartic rate `d`. Value and slope are those of the step at both ends.
    pub fn at_fraction(&self, theta: R) -> X {
        let rest = R::one() - theta;
        let linear = theta * rest;
        let cubic = theta * linear;
        let quartic = linear * linear;
        let rate = X::Rate::zero()
            .add_scaled(theta - linear + cubic + cubic, &self.mean_rate)
            .add_scaled(linear - cubic, &self.start_rate)
            .add_scaled(-cubic, &self.end_rate)
            .add_scaled(quartic, &self.quartic_rate);
        self.start.advanced(self.step_s, &rate).normalised()
    }

    /// The state at time `t`, s, within the step.
    pub fn at(&self, t: R) -> X {
        self.at_fraction((t - self.start_s) / self.step_s)
    }
}
