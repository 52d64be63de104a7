//! Unit quaternions and their rate kinematics.
//!
//! `q = [w, v]` takes body components to world components, `v_W = q ⊗ v_B ⊗ q*`, and moves with
//! `q̇ = ½ q ⊗ [0, ω]`, `ω` in body axes. Source: Diebel, *Representing Attitude* (2006).
//! The arithmetic is written out because nalgebra's
//! `UnitQuaternion` products ask more of a scalar than lanes can give.

use crate::{Body, EulerAngles, Rotation, World};
use nalgebra::{Matrix3, Vector3};
use quad_math::{Flat, Rate, Real, State, constant};

/// Attitude of the body frame against the world frame as a unit quaternion; `q` and `−q` are the same.
///
/// No singularity and no trigonometry: for integrating the non-linear models.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quaternion<R: Real> {
    /// Scalar part, `cos(angle/2)`.
    pub w: R,
    /// Vector part, `axis · sin(angle/2)`.
    pub v: Vector3<R>,
}

/// Rate of a quaternion, 1/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuaternionRate<R: Real> {
    /// Rate of the scalar part, 1/s.
    pub w: R,
    /// Rate of the vector part, 1/s.
    pub v: Vector3<R>,
}

impl<R: Real> Quaternion<R> {
    /// Body axes along world axes.
    pub fn identity() -> Self {
        Self {
            w: R::one(),
            v: Vector3::zeros(),
        }
    }

    /// Rotation by `angle` (rad) about the unit vector `axis`.
    pub fn from_axis_angle(axis: &Vector3<R>, angle: R) -> Self {
        let (s, c) = (angle * constant(0.5)).simd_sin_cos();
        Self { w: c, v: axis * s }
    }

    /// `q̇ = ½ q ⊗ [0, ω]` with the body rates `ω`, rad/s.
    #[inline(always)]
    pub fn derivative(&self, body_rates: &Vector3<R>) -> QuaternionRate<R> {
        let w2 = body_rates * constant::<R>(0.5);
        QuaternionRate {
            w: -self.v.dot(&w2),
            v: w2 * self.w + self.v.cross(&w2),
        }
    }

    /// The rotation matrix `R_WB`; orthonormal if the quaternion is a unit one.
    #[inline(always)]
    pub fn rotation(&self) -> Rotation<R, Body, World> {
        let (w, x, y, z) = (self.w, self.v.x, self.v.y, self.v.z);
        let (l, two) = (R::one(), constant::<R>(2.0));
        let (x2, y2, z2) = (x * two, y * two, z * two);
        let (xx, yy, zz) = (x * x2, y * y2, z * z2);
        let (xy, xz, yz) = (x * y2, x * z2, y * z2);
        let (wx, wy, wz) = (w * x2, w * y2, w * z2);
        Rotation::from_matrix(Matrix3::new(
            l - yy - zz,
            xy - wz,
            xz + wy,
            xy + wz,
            l - xx - zz,
            yz - wx,
            xz - wy,
            yz + wx,
            l - xx - yy,
        ))
    }

    /// The components in W of a vector given in B: `v + 2w (q_v × v) + 2 q_v × (q_v × v)`.
    #[inline(always)]
    pub fn rotate(&self, vector: &Vector3<R>) -> Vector3<R> {
        let two = constant::<R>(2.0);
        let t = self.v.cross(vector) * two;
        vector + t * self.w + self.v.cross(&t)
    }

    /// The Euler angles of the same attitude; roll and yaw lose their meaning near `θ = ±90°`.
    #[inline(always)]
    pub fn euler_angles(&self) -> EulerAngles<R> {
        self.rotation().euler_angles()
    }

    /// `|q|²`, 1 for an attitude.
    #[inline(always)]
    pub fn norm_squared(&self) -> R {
        self.w * self.w + self.v.norm_squared()
    }

    /// `q / |q|`.
    #[inline(always)]
    pub fn normalised(&self) -> Self {
        let scale = R::one() / quad_math::sqrt(self.norm_squared());
        Self {
            w: self.w * scale,
            v: self.v * scale,
        }
    }

    /// The product `self ⊗ other`: first `other`, then `self`.
    #[inline(always)]
    pub fn product(&self, other: &Self) -> Self {
        Self {
            w: self.w * other.w - self.v.dot(&other.v),
            v: other.v * self.w + self.v * other.w + self.v.cross(&other.v),
        }
    }

    /// The inverse rotation.
    #[inline(always)]
    pub fn conjugate(&self) -> Self {
        Self {
            w: self.w,
            v: -self.v,
        }
    }
}

impl<R: Real> State<R> for Quaternion<R> {
    type Rate = QuaternionRate<R>;

    #[inline(always)]
    fn advanced(&self, h: R, rate: &QuaternionRate<R>) -> Self {
        Self {
            w: self.w + rate.w * h,
            v: self.v + rate.v * h,
        }
    }

    /// `q (3 − |q|²) / 2`: one Newton step towards `q / |q|`, without root or division.
    ///
    /// Of a norm off by `δ` it leaves `1.5 δ²`, which is rounding after any sensible integration step.
    #[inline(always)]
    fn normalised(self) -> Self {
        let scale = (constant::<R>(3.0) - self.norm_squared()) * constant(0.5);
        Self {
            w: self.w * scale,
            v: self.v * scale,
        }
    }
}

impl<R: Real> Rate<R> for QuaternionRate<R> {
    #[inline(always)]
    fn zero() -> Self {
        Self {
            w: R::zero(),
            v: Vector3::zeros(),
        }
    }

    #[inline(always)]
    fn add_scaled(&self, h: R, other: &Self) -> Self {
        Self {
            w: self.w + other.w * h,
            v: self.v + other.v * h,
        }
    }
}

impl<R: Real> Flat<R> for Quaternion<R> {
    const LEN: usize = 4;

    #[inline(always)]
    fn write(&self, out: &mut [R]) {
        out[0] = self.w;
        self.v.write(&mut out[1..]);
    }

    #[inline(always)]
    fn read(values: &[R]) -> Self {
        Self {
            w: values[0],
            v: Vector3::read(&values[1..]),
        }
    }
}

impl<R: Real> Flat<R> for QuaternionRate<R> {
    const LEN: usize = 4;

    #[inline(always)]
    fn write(&self, out: &mut [R]) {
        out[0] = self.w;
        self.v.write(&mut out[1..]);
    }

    #[inline(always)]
    fn read(values: &[R]) -> Self {
        Self {
            w: values[0],
            v: Vector3::read(&values[1..]),
        }
    }
}
