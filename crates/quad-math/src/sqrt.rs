//! The square root as an instruction.

use crate::Real;
use std::any::Any;

/// `√x`, with the same bits as [`simd_sqrt`](nalgebra::SimdComplexField::simd_sqrt), and as fast as the
/// processor has it.
///
/// With `libm_force`, simba takes the root of an `f64` or `f32` from the library `libm`, whose inline assembly the
/// compiler cannot vectorise: one such root in a step would keep a whole [`crate::Batch`] scalar. The
/// root of the standard library is an operation that the compiler knows. Both round correctly (IEEE 754), so
/// they agree in every bit. Which of the two it is, is decided when the program is built.
///
/// ```
/// assert_eq!(quad_math::sqrt(2.0_f64), std::f64::consts::SQRT_2);
/// ```
#[inline(always)]
pub fn sqrt<R: Real>(x: R) -> R {
    as_type(x, f64::sqrt)
        .or_else(
            #[inline(always)]
            || as_type(x, f32::sqrt),
        )
        .unwrap_or_else(
            #[inline(always)]
            || x.simd_sqrt(),
        )
}

/// `f(x)` if `R` is the type `T`.
#[inline(always)]
fn as_type<R: Real, T: Copy + 'static>(x: R, f: impl Fn(T) -> T) -> Option<R> {
    let y = f(*(&x as &dyn Any).downcast_ref::<T>()?);
    (&y as &dyn Any).downcast_ref::<R>().copied()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Dual, F32x8, F64x4, constant};
    use nalgebra::{SimdComplexField, SimdValue};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn agree_the_root_is_that_of_the_scalar(x in prop::num::f64::POSITIVE) {
            prop_assert_eq!(sqrt(x).to_bits(), x.simd_sqrt().to_bits());
            let single = x as f32;
            prop_assert_eq!(sqrt(single).to_bits(), single.simd_sqrt().to_bits());
            prop_assert_eq!(sqrt(F64x4::splat(x)).extract(3), sqrt(x));
            prop_assert_eq!(sqrt(F32x8::splat(single)).extract(7), sqrt(single));
        }
    }

    #[test]
    fn exact_the_root_of_a_dual_number_has_its_derivative() {
        let mut x: Dual<1> = constant(4.0);
        x.eps = num_dual::Derivative::some(nalgebra::vector![1.0]);
        let y = sqrt(x);
        assert_eq!(
            (y.re, y.eps.unwrap_generic(nalgebra::U1, nalgebra::U1).x),
            (2.0, 0.25)
        );
    }

    #[test]
    fn exact_a_negative_number_has_no_root() {
        assert!(sqrt(-1.0_f64).is_nan());
    }
}
