//! Small functions over any scalar that must stay finite, in value and in derivative, where the plain ones do not.

use nalgebra::Vector3;
use quad_math::{Real, constant, sqrt};

/// Square below which a length counts as zero: (10⁻¹² m)², far below any length here and above `f32`'s smallest number.
const NEGLIGIBLE_SQUARE: f64 = 1e-24;

/// `√x`, with value and derivative 0 where `x` is negligible. The true root has an infinite derivative there.
#[inline(always)]
pub(crate) fn root<R: Real>(x: R) -> R {
    let negligible = x.simd_lt(constant(NEGLIGIBLE_SQUARE));
    R::zero().select(negligible, sqrt(R::one().select(negligible, x)))
}

/// `|v|`, with derivative 0 at the zero vector (a kink).
#[inline(always)]
pub(crate) fn length<R: Real>(v: &Vector3<R>) -> R {
    root(v.norm_squared())
}

/// `v / |v|`; the zero vector stays what it is.
#[inline(always)]
pub(crate) fn unit<R: Real>(v: &Vector3<R>) -> Vector3<R> {
    let n = length(v);
    let none = n.simd_eq(R::zero());
    v / R::one().select(none, n)
}

/// 1 where the mask is set, else 0.
#[inline(always)]
pub(crate) fn flag<R: Real>(mask: R::SimdBool) -> R {
    R::one().select(mask, R::zero())
}

/// `|x|`, with derivative 1 at zero (a kink), whatever the sign of the zero.
#[inline(always)]
pub(crate) fn absolute<R: Real>(x: R) -> R {
    (-x).select(x.simd_lt(R::zero()), x)
}

/// `v` where `on` is 1, `other` where it is 0.
#[inline(always)]
pub(crate) fn choose<R: Real>(on: R, v: &Vector3<R>, other: &Vector3<R>) -> Vector3<R> {
    let mask = is_set(on);
    v.zip_map(other, |a, b| a.select(mask, b))
}

/// The mask of a [`flag`].
#[inline(always)]
pub(crate) fn is_set<R: Real>(on: R) -> R::SimdBool {
    on.simd_gt(constant(0.5))
}

/// `x` within `[low, high]`; the limits must be in order. Kinks at both.
#[inline(always)]
pub(crate) fn within<R: Real>(x: R, low: R, high: R) -> R {
    let above = x.simd_gt(high);
    let below = x.simd_lt(low);
    high.select(above, low.select(below, x))
}

/// `x` rounded to a whole number, for `|x|` below 2²² (ties to even); its derivative passes unchanged.
///
/// Adding and taking away `1.5 · 2^m`, with m the bits of the scalar's mantissa, leaves no room for a fraction. The
/// rounding of the standard library panics on dual numbers.
#[inline(always)]
pub(crate) fn whole<R: Real>(x: R) -> R {
    let l = R::one();
    // 2⁻³⁰ is lost beside 1 in single precision only.
    let single = (l + constant(2.0_f64.powi(-30))).simd_eq(l);
    let room = constant::<R>(1.5 * 2.0_f64.powi(23)).select(single, constant(1.5 * 2.0_f64.powi(52)));
    (x + room) - room
}
