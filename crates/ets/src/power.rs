//! Power on the receiver and past it, by quadrature over the face.
//!
//! `P_in = ∫ I(ρ, z) (d + ρ w'/w)·(−n) dA` over the face, `P_missed = P exp(−βR) − P_in`, `P_el = η P_in`.
//!
//! Light flows along the streamlines `ρ ∝ w(z)` of the Gaussian beam, in the direction `d + ρ w'/w`: so its flux through any surface
//! across the whole beam is the same, and nothing is lost or won by an oblique one. On the axis this is `I cos α`.
//!
//! A point of the face at `x = c + x_1 e_1 + x_2 e_2` has `z = (x − o)·d`, `ρ² = |x − o|² − z²`. On the plane ρ² is the quadratic form
//! `Δᵀ Q Δ` of the distance Δ from the spot, `Q = I − δδᵀ`, `δ = [d·e_1, d·e_2]`: an elliptic footprint, longer by `1/cos α` along δ.
//!
//! Product Gauss-Legendre rule over that part of the face that lies within [`REACH`] beam radii of the axis, so that the accuracy does not
//! depend on how small the spot is: 1e-7 of the power up to 50° of incidence, 1e-6 up to 85° (tested on discs for spots from a hundredth to
//! five times the disc; rectangles to 57°); the light outside [`REACH`] radii is 4e-8. A rectangle takes 20 × 20 points along its sides. A disc
//! takes 32 × 20, rows at `x_2 = a sin t`, which makes the chord `2a cos t` smooth. Its axes are turned so that the spot lies on the first,
//! which keeps the rim square to the rows where a small spot meets it; past 60° so that the footprint's long axis δ does, which no row then
//! meets slantwise.
//!
//! Assumptions: a footprint over whose depth w changes by a few per cent at most (`w' tan α` up to 0.01, the reach is that of w on the axis);
//! the air takes from all rays what it takes over the range R; a flat face without shadows. No light from behind: then `P_in = 0`.

use crate::beam::{Light, Ray};
use crate::quadrature::{Interval, RULE_20, RULE_32, integrate};
use crate::receiver::{Aperture, Face, GRAZING, LinkGeometry};
use crate::scalar::{is_set, root, within};
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};
use quad_math::{Real, constant, sqrt};

/// Beam radii from the axis beyond which light is neglected: `erfc(√2 · 2.8)` = 2e-8 of the power per direction.
pub const REACH: f64 = 2.8;

/// Share of a disc's radius that its rule stops short of, where the arc sine's derivative is infinite.
const RIM: f64 = 1e-12;

/// Cosine of the incidence, 60°, below which a disc's rows lie across the footprint's long axis.
const STEEP: f64 = 0.5;

/// Where the beam's power goes, W.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerBudget<R> {
    /// Optical power at the emitter.
    pub emitted: R,
    /// Optical power that reaches the range of the receiver's centre.
    pub transmitted: R,
    /// Optical power on the receiver's face.
    pub received: R,
    /// Optical power that passes the face: the hazard of overfill. Not negative.
    pub missed: R,
    /// Electrical power that the receiver gives.
    pub electrical: R,
}

/// The part of `[middle − half, middle + half]` that lies within `[−bound, bound]`; of length zero if there is none.
#[inline(always)]
fn around<R: Real>(middle: R, half: R, bound: R) -> Interval<R> {
    Interval {
        low: within(middle - half, -bound, bound),
        high: within(middle + half, -bound, bound),
    }
}

/// The beam's footprint on the plane of a face.
struct Footprint<'a, R: Real> {
    light: &'a Light<R>,
    /// The beam's direction along `e_1`, `e_2`, `n`.
    along: Vector3<R>,
    /// From the emitter to the face's centre along `e_1`, `e_2`, `n`, m.
    centre: Vector3<R>,
    spot: Vector2<R>,
    q: Matrix2<R>,
    /// `REACH w`, m.
    reach: R,
    cos: R,
}

/// `Q = I − δδᵀ`. Its first element is no less than `cos² α`, for whose square at grazing incidence the difference leaves a rounding error of either sign.
#[inline(always)]
fn form<R: Real>(across: &Vector2<R>) -> Matrix2<R> {
    let mut q = Matrix2::identity() - across * across.transpose();
    q.m11 = q.m11.simd_max(constant(GRAZING * GRAZING));
    q
}

impl<'a, R: Real> Footprint<'a, R> {
    #[inline(always)]
    fn new(light: &'a Light<R>, ray: &Ray<R>, face: &Face<R>, spot: &Vector2<R>, cos: R) -> Self {
        let along = face.axes.tr_mul(&ray.direction);
        let centre = face.axes.tr_mul(&(face.centre - ray.origin));
        let across = along.xy();
        Self {
            light,
            along,
            centre,
            spot: *spot,
            q: form(&across),
            reach: sqrt(light.radius_squared(centre.dot(&along))) * constant(REACH),
            cos,
        }
    }

    /// The part of the face's extent along `e_2` that the light reaches.
    #[inline(always)]
    fn rows(&self, bound: R) -> Interval<R> {
        // (Q⁻¹)_22 = Q_11 / det Q, det Q = cos² α.
        around(self.spot.y, self.reach * sqrt(self.q.m11) / self.cos, bound)
    }

    /// The integral along the chord of half-length `bound` at `x_2`, W/m.
    #[inline(always)]
    fn row(&self, x_2: R, bound: R) -> R {
        let middle = self.spot.x - self.q.m12 / self.q.m11 * (x_2 - self.spot.y);
        let lit = around(middle, self.reach / sqrt(self.q.m11), bound);
        integrate(&RULE_20, lit, |x_1| {
            let x = self.centre + Vector3::new(x_1, x_2, R::zero());
            let z = x.dot(&self.along);
            let rho = x - self.along * z;
            // −n of the streamline's direction per unit of the axis.
            let slant = self.cos - rho.z * self.light.spread(z);
            self.light.irradiance(rho.norm_squared(), z) * slant
        })
    }
}

impl<R: Real> Light<R> {
    /// Where the power goes: on a face of this aperture under the beam along `ray`, and past it.
    pub fn budget(
        &self,
        ray: &Ray<R>,
        face: &Face<R>,
        aperture: &Aperture<R>,
        efficiency: R,
    ) -> PowerBudget<R> {
        let link = face.under(ray);
        let transmitted = self.power_at(link.range);
        let lit = is_set(link.facing);
        // A face that is not lit is integrated as one that is, and the result dropped: lanes may disagree.
        let arriving = Self {
            power: transmitted,
            attenuation: R::zero(),
            ..*self
        };
        let received = R::zero().select(!lit, arriving.on_face(ray, face, aperture, &link));
        PowerBudget {
            emitted: self.power,
            transmitted,
            received,
            missed: (transmitted - received).simd_max(R::zero()),
            electrical: received * efficiency,
        }
    }

    /// `∫ I (d + ρ w'/w)·(−n) dA`, W.
    #[inline(always)]
    fn on_face(&self, ray: &Ray<R>, face: &Face<R>, aperture: &Aperture<R>, link: &LinkGeometry<R>) -> R {
        let cos = link.cos_incidence.simd_max(constant(GRAZING));
        match *aperture {
            Aperture::Rectangle {
                half_width,
                half_height,
            } => {
                let f = Footprint::new(self, ray, face, &link.spot, cos);
                integrate(&RULE_20, f.rows(half_height), |x_2| f.row(x_2, half_width))
            }
            Aperture::Disc { radius } => {
                let across = face.axes.tr_mul(&ray.direction).xy();
                let steep = cos.simd_lt(constant(STEEP));
                let way = link
                    .spot
                    .zip_map(&across, |spot, across| across.select(steep, spot));
                let (face, spot) = turned(face, &way, &link.spot);
                let f = Footprint::new(self, ray, &face, &spot, cos);
                let rows = f.rows(radius * constant(1.0 - RIM));
                let angles = Interval {
                    low: (rows.low / radius).simd_asin(),
                    high: (rows.high / radius).simd_asin(),
                };
                integrate(&RULE_32, angles, |t| {
                    let (s, c) = t.simd_sin_cos();
                    f.row(radius * s, radius * c) * radius * c
                })
            }
        }
    }
}

/// The face with its in-plane axes turned so that the first is along `way`, or as they are if that is nought; and the spot there.
#[inline(always)]
fn turned<R: Real>(face: &Face<R>, way: &Vector2<R>, spot: &Vector2<R>) -> (Face<R>, Vector2<R>) {
    let length = root(way.norm_squared());
    let nought = length.simd_eq(R::zero());
    let along = Vector2::new(R::one(), R::zero())
        .zip_map(&(way / R::one().select(nought, length)), |none, way| {
            none.select(nought, way)
        });
    let [e_1, e_2, n] = [0, 1, 2].map(|i| face.axes.column(i).into_owned());
    let axes = Matrix3::from_columns(&[e_1 * along.x + e_2 * along.y, e_2 * along.x - e_1 * along.y, n]);
    let spot = Vector2::new(along.dot(spot), along.x * spot.y - along.y * spot.x);
    (Face { axes, ..*face }, spot)
}
