//! Power on the receiver and past it, by quadrature over the face.
//!
//! `P_in = ∫ I(ρ, z) cos α dA` over the face, `P_missed = P exp(−βR) − P_in`, `P_el = η P_in`.
//!
//! A point of the face at `x = c + x_1 e_1 + x_2 e_2` has `z = (x − o)·d`, `ρ² = |x − o|² − z²`. On the plane ρ² is the quadratic form
//! `Δᵀ Q Δ` of the distance Δ from the spot, `Q = I − δδᵀ`, `δ = [d·e_1, d·e_2]`: an elliptic footprint, longer by `1/cos α` along δ.
//!
//! Product Gauss-Legendre rule of 20 × 20 points over that part of the face that lies within [`REACH`] beam radii of
//! the axis: first along `e_2` (over a disc with `x_2 = a sin t`, which makes the chord smooth), then along `e_1`. So the accuracy does
//! not depend on how small the spot is: 5e-8 of the power, half of it the light outside [`REACH`] radii (tested).
//!
//! Assumptions: parallel light (θ ≪ 1), so `cos α` is that of the axis all over the face and w does not change over the
//! footprint's depth by more than a few per cent; a convex face without shadows. No light from behind: then `P_in = 0`.

use crate::beam::{Light, Ray};
use crate::receiver::{Aperture, Face, GRAZING, LinkGeometry};
use crate::scalar::{is_set, within};
use nalgebra::{Matrix2, Vector2, Vector3};
use quad_math::{Real, constant, sqrt};

/// Beam radii from the axis beyond which light is neglected: `erfc(√2 · 2.8)` = 2e-8 of the power per direction.
pub const REACH: f64 = 2.8;

/// Share of a disc's radius that its rule stops short of, where the arc sine's derivative is infinite.
const RIM: f64 = 1e-12;

/// Abscissae and weights of the Gauss-Legendre rule of 20 points on [−1, 1]; each stands for ±. Computed to 40 digits by
/// Newton's method on the Legendre polynomial; equal to Abramowitz, Stegun, table 25.4.
const RULE: [(f64, f64); 10] = [
    (0.993_128_599_185_094_9, 0.017_614_007_139_152_118),
    (0.963_971_927_277_913_8, 0.040_601_429_800_386_94),
    (0.912_234_428_251_326, 0.062_672_048_334_109_07),
    (0.839_116_971_822_218_8, 0.083_276_741_576_704_75),
    (0.746_331_906_460_150_8, 0.101_930_119_817_240_44),
    (0.636_053_680_726_515, 0.118_194_531_961_518_41),
    (0.510_867_001_950_827_1, 0.131_688_638_449_176_64),
    (0.373_706_088_715_419_55, 0.142_096_109_318_382_04),
    (0.227_785_851_141_645_07, 0.149_172_986_472_603_74),
    (0.076_526_521_133_497_34, 0.152_753_387_130_725_86),
];

/// Where the beam's power goes, W.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerBudget<R> {
    /// Optical power at the emitter.
    pub emitted: R,
    /// Optical power that reaches the receiver's range.
    pub transmitted: R,
    /// Optical power on the receiver's face.
    pub received: R,
    /// Optical power that passes the face: the hazard of overfill. Not negative.
    pub missed: R,
    /// Electrical power that the receiver gives.
    pub electrical: R,
}

/// An interval.
#[derive(Clone, Copy)]
struct Interval<R> {
    low: R,
    high: R,
}

impl<R: Real> Interval<R> {
    /// The part of `[middle − half, middle + half]` that lies within `[−bound, bound]`; of length zero if there is none.
    #[inline(always)]
    fn around(middle: R, half: R, bound: R) -> Self {
        Self {
            low: within(middle - half, -bound, bound),
            high: within(middle + half, -bound, bound),
        }
    }
}

/// `∫ f` over an interval by the rule of 20 points.
#[inline(always)]
fn integrate<R: Real>(over: Interval<R>, f: impl Fn(R) -> R) -> R {
    let half = (over.high - over.low) * constant(0.5);
    let middle = (over.high + over.low) * constant(0.5);
    let sum = RULE.iter().fold(R::zero(), |sum, &(node, weight)| {
        let step = half * constant(node);
        sum + (f(middle - step) + f(middle + step)) * constant(weight)
    });
    sum * half
}

/// The beam's footprint on the plane of the face.
struct Footprint<R: Real> {
    spot: Vector2<R>,
    q: Matrix2<R>,
    /// `REACH w`.
    reach: R,
    cos: R,
}

impl<R: Real> Footprint<R> {
    /// The part of the face's extent along `e_2` that the light reaches.
    #[inline(always)]
    fn rows(&self, bound: R) -> Interval<R> {
        // Q⁻¹_22 = Q_11 / det Q, det Q = cos² α.
        Interval::around(self.spot.y, self.reach * sqrt(self.q.m11) / self.cos, bound)
    }

    /// The part of the chord of half-length `bound` at `x_2` that the light reaches.
    #[inline(always)]
    fn chord(&self, x_2: R, bound: R) -> Interval<R> {
        let middle = self.spot.x - self.q.m12 / self.q.m11 * (x_2 - self.spot.y);
        Interval::around(middle, self.reach / sqrt(self.q.m11), bound)
    }
}

impl<R: Real> Light<R> {
    /// Where the power goes: on a face of this aperture under the beam along `ray`, and past it.
    pub fn budget(&self, ray: &Ray<R>, face: &Face<R>, aperture: &Aperture<R>, efficiency: R) -> PowerBudget<R> {
        let link = face.under(ray);
        let transmitted = self.power_at(link.range);
        let lit = is_set(link.facing);
        // A face that is not lit is integrated as one that is, and the result dropped: lanes may disagree.
        let received = R::zero().select(!lit, self.on_face(ray, face, aperture, &link));
        PowerBudget {
            emitted: self.power,
            transmitted,
            received,
            missed: (transmitted - received).simd_max(R::zero()),
            electrical: received * efficiency,
        }
    }

    /// `∫ I cos α dA`, W.
    #[inline(always)]
    fn on_face(&self, ray: &Ray<R>, face: &Face<R>, aperture: &Aperture<R>, link: &LinkGeometry<R>) -> R {
        let cos = link.cos_incidence.simd_max(constant(GRAZING));
        let along = face.axes.tr_mul(&ray.direction);
        let across = along.xy();
        let from_axis = face.axes.tr_mul(&(face.centre - ray.origin));
        let footprint = Footprint {
            spot: link.spot,
            q: Matrix2::identity() - across * across.transpose(),
            reach: sqrt(self.radius_squared(link.range)) * constant(REACH),
            cos,
        };
        let at = |x_1: R, x_2: R| {
            let q = from_axis + Vector3::new(x_1, x_2, R::zero());
            let z = q.dot(&along);
            self.irradiance((q - along * z).norm_squared(), z) * cos
        };
        let row = |x_2: R, half: R| integrate(footprint.chord(x_2, half), |x_1| at(x_1, x_2));
        match *aperture {
            Aperture::Rectangle {
                half_width,
                half_height,
            } => integrate(footprint.rows(half_height), |x_2| row(x_2, half_width)),
            Aperture::Disc { radius } => {
                let rows = footprint.rows(radius * constant(1.0 - RIM));
                let angles = Interval {
                    low: (rows.low / radius).simd_asin(),
                    high: (rows.high / radius).simd_asin(),
                };
                integrate(angles, |t| {
                    let (s, c) = t.simd_sin_cos();
                    row(radius * s, radius * c) * radius * c
                })
            }
        }
    }
}
