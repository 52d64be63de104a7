//! The receiver on the vehicle and the geometry of the link (figure 7.2).
//!
//! The receiver's sensitive face is flat, at an offset in the body frame B, with a unit normal `n` towards the light it takes. In its
//! plane, `e_2` points as nearly up the body (`−z_B`) as the normal allows and `e_1 = e_2 × n` to the right of one who looks at the
//! face; of a receiver that faces straight up or down, `e_2` is along `x_B`.
//!
//! With the emitter at `o`, the beam's unit direction `d` and the receiver's centre at `c`, all in W:
//!
//! range `R = |c − o|`; incidence `α`, `cos α = −d · n`; the axis meets the sensor's plane at `o + t d`, `t = (o − c)·n / cos α`, and the
//! spot offset is `s = [e_1, e_2]ᵀ (o + t d − c)`.
//!
//! Light from behind meets no plane: `cos α` is held at [`GRAZING`] from below and t at 0, so `s` stays finite, grows with
//! the violation, and a flag reports it. Kinks: there, and of `α` at 0.

use crate::beam::Ray;
use crate::scalar::{flag, length};
use nalgebra::{Matrix3, Vector2, Vector3};
use quad_math::{Real, atan2, constant};

/// Least `cos α` for which the spot is computed: 89.9°.
pub const GRAZING: f64 = 1e-3;

/// Shape of the sensitive face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Aperture<R> {
    /// A disc.
    Disc {
        /// Radius a, m.
        radius: R,
    },
    /// A rectangle with sides along `e_1` and `e_2`.
    Rectangle {
        /// Half of the side along `e_1`, m.
        half_width: R,
        /// Half of the side along `e_2`, m.
        half_height: R,
    },
}

/// A receiver fixed on the vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Receiver<R> {
    /// Shape of its face.
    pub aperture: Aperture<R>,
    /// Its centre in B from the centre of mass, m.
    pub offset: [R; 3],
    /// Its normal in B, a unit vector out of the face, against the light.
    pub normal: [R; 3],
    /// Photovoltaic efficiency, electrical over optical power, 0 to 1.
    pub efficiency: R,
}

/// A receiver placed in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face<R: Real> {
    /// Its centre in W, m.
    pub centre: Vector3<R>,
    /// Columns `e_1`, `e_2`, `n` in W.
    pub axes: Matrix3<R>,
}

/// Range, incidence and spot offset: what the link's quality depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkGeometry<R: Real> {
    /// Range R from the emitter to the receiver's centre, m.
    pub range: R,
    /// Angle of incidence α between the beam and the receiver's normal, rad, 0 to π.
    pub incidence: R,
    /// Cosine of the angle of incidence.
    pub cos_incidence: R,
    /// Spot offset `s` along `e_1`, `e_2` on the sensor's plane, m.
    pub spot: Vector2<R>,
    /// 1 if the light meets the face from the front, else 0.
    pub facing: R,
}

impl Receiver<f64> {
    /// The same receiver over another scalar.
    pub fn over<R: Real>(&self) -> Receiver<R> {
        Receiver {
            aperture: self.aperture.over(),
            offset: self.offset.map(constant),
            normal: self.normal.map(constant),
            efficiency: constant(self.efficiency),
        }
    }
}

impl Aperture<f64> {
    /// The same shape over another scalar.
    pub fn over<R: Real>(&self) -> Aperture<R> {
        match *self {
            Self::Disc { radius } => Aperture::Disc {
                radius: constant(radius),
            },
            Self::Rectangle {
                half_width,
                half_height,
            } => Aperture::Rectangle {
                half_width: constant(half_width),
                half_height: constant(half_height),
            },
        }
    }

    /// Area of the face, m².
    pub fn area(&self) -> f64 {
        match *self {
            Self::Disc { radius } => std::f64::consts::PI * radius * radius,
            Self::Rectangle {
                half_width,
                half_height,
            } => 4.0 * half_width * half_height,
        }
    }
}

impl<R: Real> Receiver<R> {
    /// Columns `e_1`, `e_2`, `n` in B.
    #[inline(always)]
    pub fn axes(&self) -> Matrix3<R> {
        let n = Vector3::from(self.normal);
        // The in-plane part of "up"; of a face that looks along z_B, that of "forward".
        let vertical = (n.x * n.x + n.y * n.y).simd_lt(constant(1e-12));
        let up = Vector3::new(R::one(), R::zero(), R::zero())
            .zip_map(&-Vector3::z(), |x, z: R| x.select(vertical, z));
        let e_2 = crate::scalar::unit(&(up - n * n.dot(&up)));
        Matrix3::from_columns(&[e_2.cross(&n), e_2, n])
    }

    /// The receiver on a vehicle at `position` (W, m) with the attitude `r_wb`.
    #[inline(always)]
    pub fn on(&self, position: &Vector3<R>, r_wb: &Matrix3<R>) -> Face<R> {
        Face {
            centre: position + r_wb * Vector3::from(self.offset),
            axes: r_wb * self.axes(),
        }
    }
}

impl<R: Real> Face<R> {
    /// Range, incidence and spot offset under a beam.
    #[inline(always)]
    pub fn under(&self, ray: &Ray<R>) -> LinkGeometry<R> {
        let (d, n) = (ray.direction, self.axes.column(2).into_owned());
        let cos_incidence = -d.dot(&n);
        let from_face = ray.origin - self.centre;
        let height = from_face.dot(&n);
        let t = height.simd_max(R::zero()) / cos_incidence.simd_max(constant(GRAZING));
        let spot = self.axes.tr_mul(&(from_face + d * t));
        LinkGeometry {
            range: length(&from_face),
            incidence: atan2(length(&d.cross(&n)), cos_incidence),
            cos_incidence,
            spot: spot.xy(),
            facing: flag::<R>(cos_incidence.simd_gt(R::zero())) * flag::<R>(height.simd_gt(R::zero())),
        }
    }
}
