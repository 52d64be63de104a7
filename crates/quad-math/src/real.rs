//! The scalar of all physics: one bound, many numbers.
//!
//! Model code is written once, generic in `R: Real`, and runs on `f64` and `f32`, on the dual numbers
//! of [`num_dual`] (Jacobians, Lie derivatives, gradients) and on SIMD lanes ([`F64x4`], [`F32x8`]:
//! one lane per vehicle). A branch on an `R` does not compile, because lanes may disagree about it;
//! use [`nalgebra::SimdPartialOrd`] and [`nalgebra::SimdValue::select`] instead.

use nalgebra::SimdRealField;

/// A real number of one of the kinds the physics runs on: `f64`, `f32`, dual numbers, SIMD lanes.
///
/// This is an alias: every `SimdRealField + Copy` is a `Real`.
pub trait Real: SimdRealField + Copy {}

impl<T: SimdRealField + Copy> Real for T {}

/// Four vehicles side by side in double precision.
pub type F64x4 = simba::simd::WideF64x4;

/// Eight vehicles side by side in single precision.
pub type F32x8 = simba::simd::WideF32x8;

/// A constant as a scalar of kind `R` (in every lane; with zero derivatives).
///
/// ```
/// use quad_math::constant;
/// let half: f32 = constant(0.5);
/// assert_eq!(half, 0.5);
/// ```
#[inline(always)]
pub fn constant<R: Real>(value: f64) -> R {
    nalgebra::convert(value)
}
