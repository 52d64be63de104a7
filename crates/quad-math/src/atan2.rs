//! The arc tangent of two arguments as arithmetic, for lanes and dual numbers alike.
//!
//! Lanes would call the library once per lane, and num-dual's `atan2` differentiates `atan(y/x)`, which
//! loses all digits near ±90°. Here the quotient is folded into `[0, 1]`, then into `±0.205`, and the
//! rational approximation of Moshier's *Cephes* library (`atan.c`, relative error 2e-16 there) does the
//! rest: two divisions, no branch, and automatic differentiation goes straight through. The derivatives are those of
//! the approximation: first ones are good to 1e-13, and each further one loses digits.

use crate::{Real, constant};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// Quotient above which the octant is folded once more.
const FOLD: f64 = 0.66;

/// Numerator of the approximation, highest power first.
const P: [f64; 5] = [
    -8.750_608_600_031_904e-1,
    -1.615_753_718_733_365e1,
    -7.500_855_792_314_705e1,
    -1.228_866_684_490_136_1e2,
    -6.485_021_904_942_025e1,
];

/// Denominator of the approximation below its leading one, highest power first.
const Q: [f64; 5] = [
    2.485_846_490_142_306_3e1,
    1.650_270_098_316_988_5e2,
    4.328_810_604_912_902_7e2,
    4.853_903_996_359_137e2,
    1.945_506_571_482_614e2,
];

/// The angle of the point `(x, y)` from the x axis, rad, in `[−π, π]`; 0 at the origin.
///
/// Within 1e-15 of the library's `atan2` for finite arguments on `f64`. Signed zeros are not distinguished.
///
/// ```
/// let angle = quad_math::atan2(-1.0_f64, -1.0);
/// assert!((angle + 0.75 * std::f64::consts::PI).abs() < 1e-15);
/// ```
#[inline(always)]
pub fn atan2<R: Real>(y: R, x: R) -> R {
    // One question about the sign for value and derivative alike: `abs` would answer for −0 in its own way.
    let (below, behind) = (y.simd_lt(R::zero()), x.simd_lt(R::zero()));
    let (rise, run) = ((-y).select(below, y), (-x).select(behind, x));
    let steep = rise.simd_gt(run);
    let small = run.select(steep, rise);
    let large = rise.select(steep, run);
    // tan(a − π/4) = (tan a − 1) / (tan a + 1).
    let fold = small.simd_gt(large * constant(FOLD));
    let top = (small - large).select(fold, small);
    let bottom = (small + large).select(fold, large);
    let origin = bottom.simd_eq(R::zero());
    let t = top / R::one().select(origin, bottom);
    let z = t * t;
    // Estrin's scheme: pairs side by side instead of one chain, since a controller waits for the result.
    let z2 = z * z;
    let tail =
        |c: &[f64; 5]| (z * constant(c[1]) + constant(c[2])) * z2 + (z * constant(c[3]) + constant(c[4]));
    let z4 = z2 * z2;
    let p = z4 * constant(P[0]) + tail(&P);
    let q = z4 * (z + constant(Q[0])) + tail(&Q);
    let correction = t * z * (p / q);
    let base: R = constant::<R>(FRAC_PI_4).select(fold, R::zero());
    let octant = base + (t + correction);
    let quadrant = (constant::<R>(FRAC_PI_2) - octant).select(steep, octant);
    let half = (constant::<R>(PI) - quadrant).select(behind, quadrant);
    (-half).select(below, half)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{F32x8, F64x4, jacobian};
    use nalgebra::SimdValue;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn exact_against_the_library(angle in -3.2..3.2_f64, size in prop::sample::select(vec![1e-8, 0.3, 1.0, 1e6])) {
            let (y, x) = (size * angle.sin(), size * angle.cos());
            // Two roundings of an angle up to π, 4.4e-16 each.
            prop_assert!((atan2(y, x) - y.atan2(x)).abs() < 1e-15);
            let lanes = atan2(F64x4::splat(y), F64x4::splat(x));
            // Lanes may fuse multiply and add.
            prop_assert!((lanes.extract(2) - y.atan2(x)).abs() < 1e-15);
            let single = atan2(F32x8::splat(y as f32), F32x8::splat(x as f32));
            // Four roundings of an angle up to π in single precision.
            prop_assert!((f64::from(single.extract(5)) - y.atan2(x)).abs() < 1.5e-6);
        }

        /// `∂/∂y = x/(x² + y²)`, `∂/∂x = −y/(x² + y²)`, on the axes too.
        #[test]
        fn exact_derivatives(angle in -3.1..3.1_f64, axis in 0..8_i32) {
            for angle in [angle, f64::from(axis - 3) * std::f64::consts::FRAC_PI_4] {
                let (y, x) = angle.sin_cos();
                let j = jacobian(|v| [atan2(v[0], v[1])], [y, x]);
                // The approximation's derivative is as good as the function to a few digits.
                prop_assert!((j[0] - x).abs() < 1e-13 && (j[1] + y).abs() < 1e-13, "{angle}: {j}");
            }
        }
    }

    #[test]
    fn exact_derivative_at_negative_zero() {
        let j = jacobian(|v| [atan2(-v[0], v[1])], [0.0, 1.0]);
        assert_eq!((j[0], j[1]), (-1.0, 0.0));
    }

    #[test]
    fn exact_on_the_axes() {
        let points = [
            (0.0, 1.0, 0.0),
            (1.0, 0.0, FRAC_PI_2),
            (-1.0, 0.0, -FRAC_PI_2),
            (0.0, -1.0, PI),
            (0.0, 0.0, 0.0),
        ];
        for (y, x, angle) in points {
            assert_eq!(atan2(y, x), angle);
        }
    }
}
