//! Rounding to whole numbers, and angles within a turn, for dual numbers too.
//!
//! num-dual refuses to round: the function has no derivative at its jumps. Everywhere else it is zero, which is what
//! [`round`] gives, and with it [`wrapped`] passes derivatives unchanged.

use crate::{F32x8, F64x4, Real, constant};
use std::any::TypeId;

/// Largest power of two of turns that a scalar without a rounding of its own is brought back by.
const HIGHEST_POWER: i32 = 15;

/// `x` rounded to the nearest whole number, halves away from zero; its derivative is zero.
///
/// Scalars and lanes round with their own instruction. Others, dual numbers above all, do up to magnitudes of 2¹⁶, beyond
/// which they come back as ±(2¹⁶ − 1).
///
/// ```
/// assert_eq!(quad_math::round(-2.5_f64), -3.0);
/// let x = num_dual::Dual64::new(2.6, 1.0);
/// assert_eq!((quad_math::round(x).re, quad_math::round(x).eps), (3.0, 0.0));
/// ```
#[inline(always)]
pub fn round<R: Real>(x: R) -> R {
    let own = TypeId::of::<R>();
    let plain = [
        TypeId::of::<f64>(),
        TypeId::of::<f32>(),
        TypeId::of::<F64x4>(),
        TypeId::of::<F32x8>(),
    ];
    if plain.contains(&own) {
        return x.simd_round();
    }
    by_powers(x)
}

/// The whole number by its binary digits: comparisons and constants only, so no derivative gets through.
fn by_powers<R: Real>(x: R) -> R {
    let negative = x.simd_lt(R::zero());
    let magnitude = (-x).select(negative, x);
    let half: R = constant(0.5);
    let mut whole = R::zero();
    for power in (0..=HIGHEST_POWER).rev() {
        let step: R = constant(2.0_f64.powi(power));
        let next = whole + step;
        whole = next.select(magnitude.simd_ge(next - half), whole);
    }
    (-whole).select(negative, whole)
}

/// An angle brought into ±π by whole turns.
///
/// ```
/// assert_eq!(quad_math::wrapped(1.0_f64), 1.0);
/// assert!((quad_math::wrapped(7.0_f64) - (7.0 - std::f64::consts::TAU)).abs() < 1e-15);
/// ```
#[inline(always)]
pub fn wrapped<R: Real>(angle: R) -> R {
    let turn: R = constant(std::f64::consts::TAU);
    angle - round(angle / turn) * turn
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_dual::Dual64;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn agree_digits_with_the_library(x in -65000.0..65000.0_f64) {
            prop_assert_eq!(by_powers(x), x.round());
            let near = x.round() + 0.5;
            prop_assert_eq!(by_powers(near), near.round());
        }

        #[test]
        fn exact_wrapping_passes_derivatives(x in -100.0..100.0_f64) {
            let angle = wrapped(Dual64::new(x, 2.0));
            prop_assert_eq!((angle.re, angle.eps), (wrapped(x), 2.0));
            prop_assert!(angle.re.abs() <= std::f64::consts::PI + 1e-14);
        }
    }

    #[test]
    fn exact_no_number_stays_none() {
        assert!(wrapped(f64::NAN).is_nan());
        assert!(wrapped(Dual64::new(f64::NAN, 0.0)).re.is_nan());
        assert!(wrapped(Dual64::new(1e9, 1.0)).re.is_finite());
    }
}
