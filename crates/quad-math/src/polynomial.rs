//! Polynomials, and the one that joins two sets of boundary conditions in a given time.
//!
//! `p(s) = c₀ + c₁ s + … + c_(N-1) s^(N-1)`, evaluated with all its derivatives by repeated synthetic
//! division (Horner's scheme; Knuth, *The Art of Computer Programming* 2, §4.6.4).
//!
//! [`Segment`] is the Hermite interpolant that meets value, velocity, acceleration, … at both ends of a
//! duration `T`. It is held in normalised time `s = t/T`, where the coefficients follow from the
//! boundary values by whole numbers and are well conditioned whatever `T` is. With three conditions at
//! rest at each end it is the minimum-jerk curve `10 s³ - 15 s⁴ + 6 s⁵`, with four the minimum-snap
//! curve.

use crate::{Real, constant};
use nalgebra::SimdBool;

/// A polynomial with `N` coefficients, that is of degree up to `N - 1`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polynomial<R, const N: usize> {
    /// Coefficients in ascending powers: `coefficients[k]` belongs to `s^k`.
    pub coefficients: [R; N],
}

impl<R: Real, const N: usize> Polynomial<R, N> {
    /// The value `p(s)`, by Horner's scheme.
    #[inline]
    pub fn value(&self, s: R) -> R {
        self.coefficients
            .iter()
            .rev()
            .fold(R::zero(), |sum, &c| sum * s + c)
    }

    /// The `order`-th derivative at `s`; order 0 is the value.
    pub fn derivative(&self, order: usize, s: R) -> R {
        let mut sum = R::zero();
        for k in (order..N).rev() {
            sum = sum * s + self.coefficients[k] * constant(falling_factorial(k, order));
        }
        sum
    }

    /// Value and first `K - 1` derivatives at `s` in one pass: `[p, p′, p″, …]`.
    ///
    /// ```
    /// use quad_math::Polynomial;
    /// let cube = Polynomial { coefficients: [0.0, 0.0, 0.0, 1.0] };
    /// assert_eq!(cube.derivatives(2.0), [8.0, 12.0, 12.0, 6.0, 0.0]);
    /// ```
    #[inline]
    pub fn derivatives<const K: usize>(&self, s: R) -> [R; K] {
        // After the pass, taylor[k] = p⁽ᵏ⁾(s) / k!.
        let mut taylor = [R::zero(); K];
        for &c in self.coefficients.iter().rev() {
            for k in (1..K).rev() {
                taylor[k] = taylor[k] * s + taylor[k - 1];
            }
            if let Some(value) = taylor.first_mut() {
                *value = *value * s + c;
            }
        }
        let mut factorial = 1.0;
        for (k, t) in taylor.iter_mut().enumerate().skip(2) {
            factorial *= k as f64;
            *t *= constant(factorial);
        }
        taylor
    }

    /// The polynomial on `[0, 1]` with `p⁽ᵏ⁾(0) = start[k]` and `p⁽ᵏ⁾(1) = end[k]`, `k < M`.
    ///
    /// `N` must be `2 M` and `M` from 1 to 5 (value, velocity, acceleration, jerk, snap); anything else
    /// does not compile.
    ///
    /// Derivation. Write `p(s) = ℓ(s) + sᴹ g(s)` with `ℓ` the Taylor polynomial of the start. With
    /// `σ = s - 1`, the end asks for `sᴹ g = r(σ) + O(σᴹ)`, `r_k = (end[k] - ℓ⁽ᵏ⁾(1))/k!`, hence
    /// `g = (1 + σ)⁻ᴹ r(σ)` up to `σᴹ⁻¹`: a product of two short series. All factors are whole numbers.
    pub fn between<const M: usize>(start: [R; M], end: [R; M]) -> Self {
        const {
            assert!(
                N == 2 * M,
                "a polynomial between M conditions at each end has 2 M coefficients"
            )
        };
        const {
            assert!(
                1 <= M && M <= 5,
                "one to five conditions at each end: value to snap"
            )
        };

        let mut coefficients = [R::zero(); N];
        let mut factorials = [1.0; M];
        for k in 1..M {
            factorials[k] = factorials[k - 1] * k as f64;
        }
        for k in 0..M {
            coefficients[k] = start[k] * constant(1.0 / factorials[k]);
        }
        let from_start: [R; M] = Self { coefficients }.derivatives(R::one());
        let r: [R; M] = std::array::from_fn(|k| (end[k] - from_start[k]) * constant(1.0 / factorials[k]));

        for k in 0..M {
            // (1 + σ)⁻ᴹ = Σ (-1)^i C(M - 1 + i, i) σ^i.
            let g_k = (0..=k).fold(R::zero(), |sum, i| {
                sum + r[k - i] * constant(alternating(i) * binomial(M - 1 + i, i))
            });
            // σ^k = (s - 1)^k = Σ (-1)^(k - j) C(k, j) s^j.
            for j in 0..=k {
                coefficients[M + j] += g_k * constant(alternating(k - j) * binomial(k, j));
            }
        }
        Self { coefficients }
    }
}

impl<const N: usize> Polynomial<f64, N> {
    /// The same polynomial over another scalar (dual numbers, lanes).
    pub fn over<R: Real>(&self) -> Polynomial<R, N> {
        Polynomial {
            coefficients: self.coefficients.map(constant),
        }
    }
}

/// `(-1)^i`.
fn alternating(i: usize) -> f64 {
    if i.is_multiple_of(2) { 1.0 } else { -1.0 }
}

/// `k (k - 1) … (k - order + 1)`, the factor of the `order`-th derivative of `s^k`.
fn falling_factorial(k: usize, order: usize) -> f64 {
    (k - order + 1..=k).map(|i| i as f64).product()
}

/// The binomial coefficient `C(n, k)`, exact for the small numbers used here.
fn binomial(n: usize, k: usize) -> f64 {
    (1..=k).fold(1.0, |product, i| product * (n + 1 - i) as f64 / i as f64)
}

/// Which end of a [`Segment`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// `t = 0`.
    Start,
    /// `t = T`.
    Finish,
}

/// Why a [`Segment`] cannot be.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SegmentError {
    /// A duration that is not a positive, finite number.
    #[error("the duration of a polynomial segment must be positive and finite, got {duration_s} s")]
    BadDuration {
        /// The duration given, s.
        duration_s: f64,
    },
    /// A boundary value that is NaN or infinite (in any lane).
    #[error("derivative {order} at the {end:?} of a polynomial segment must be finite")]
    NotFinite {
        /// At which end.
        end: End,
        /// Of which derivative; 0 is the value.
        order: usize,
    },
}

/// A polynomial of time over `[0, T]` that meets boundary conditions at both ends; `N` coefficients for
/// `N/2` conditions at each end.
///
/// ```
/// use quad_math::Segment;
/// // From rest at 1 m to rest at 3 m in 4 s with minimum jerk.
/// let height = Segment::<f64, 6>::new([1.0, 0.0, 0.0], [3.0, 0.0, 0.0], 4.0)?;
/// let [position, velocity] = height.derivatives(2.0);
/// assert_eq!(position, 2.0);
/// assert_eq!(velocity, 15.0 / 8.0 * 2.0 / 4.0);
/// # Ok::<(), quad_math::SegmentError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment<R, const N: usize> {
    normalised: Polynomial<R, N>,
    duration_s: f64,
}

impl<R: Real, const N: usize> Segment<R, N> {
    /// The polynomial of degree `2 M - 1` whose derivative `k < M` is `start[k]` at `t = 0` and `end[k]`
    /// at `t = duration_s`, in units of value per s^k.
    ///
    /// Both ends take the same number `M = N/2` of conditions, from 1 (value) to 5 (up to snap).
    ///
    /// # Errors
    /// A duration that is NaN, infinite or not positive; a boundary value that is not finite.
    pub fn new<const M: usize>(start: [R; M], end: [R; M], duration_s: f64) -> Result<Self, SegmentError> {
        if !(duration_s.is_finite() && duration_s > 0.0) {
            return Err(SegmentError::BadDuration { duration_s });
        }
        for (end, values) in [(End::Start, &start), (End::Finish, &end)] {
            if let Some(order) = values.iter().position(|&value| !is_finite(value)) {
                return Err(SegmentError::NotFinite { end, order });
            }
        }
        // d^k/ds^k = T^k d^k/dt^k.
        let scaled = |values: [R; M]| {
            let mut power = 1.0;
            values.map(|value| {
                let scaled = value * constant(power);
                power *= duration_s;
                scaled
            })
        };
        Ok(Self {
            normalised: Polynomial::between(scaled(start), scaled(end)),
            duration_s,
        })
    }

    /// Duration `T`, s.
    pub fn duration_s(&self) -> f64 {
        self.duration_s
    }

    /// The polynomial in normalised time `s = t/T`.
    pub fn normalised(&self) -> &Polynomial<R, N> {
        &self.normalised
    }

    /// The value at time `t`, s. Outside `[0, T]` the polynomial continues; it is not held.
    #[inline]
    pub fn value(&self, t: R) -> R {
        self.normalised.value(t * constant(1.0 / self.duration_s))
    }

    /// Value and first `K - 1` time derivatives at `t`, s: `[p, ṗ, p̈, …]`.
    ///
    /// Outside `[0, T]` the polynomial continues; it is not held.
    #[inline]
    pub fn derivatives<const K: usize>(&self, t: R) -> [R; K] {
        let per_s: R = constant(1.0 / self.duration_s);
        let mut power = R::one();
        self.normalised.derivatives(t * per_s).map(|derivative| {
            let scaled = derivative * power;
            power *= per_s;
            scaled
        })
    }
}

/// Whether the value (its real part, in every lane) is neither NaN nor infinite.
fn is_finite<R: Real>(value: R) -> bool {
    // ∞ · 0 and NaN · 0 are NaN, which equals nothing.
    (value * R::zero()).simd_eq(R::zero()).all()
}

#[cfg(test)]
mod tests;
