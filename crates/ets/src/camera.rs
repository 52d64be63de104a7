//! The pinhole camera on the platform.
//!
//! `r_C = f [y/x, z/x]` px for a point `p_C = [x, y, z]` of the camera frame C: x along the optical axis, y to the right
//! and z down in the image, origin at the camera's centre, which is where the gimbal's axes cross (*choice*: no
//! lever arm). `r_C` is measured from the principal point (*choice*), so that a centred target is at `[0, 0]`;
//! [`Camera::pixel`] gives column and row from the upper left corner.
//!
//! Assumptions: no lens distortion, no exposure time, a point-like target. The image is undefined for `x ≤ 0`. So that it
//! stays finite, slopes are held at [`MAX_SLOPE`] beyond 63° off the axis, far outside the field of view of any camera
//! accepted here; that is a kink, and such a target is reported as not visible.
//!
//! Source: Hartley, Zisserman, *Multiple View Geometry*, 2nd ed., §6.1, with the axes of the thesis' figure 7.5.

use crate::scalar::{absolute, flag, unit, whole};
use nalgebra::{Vector2, Vector3};
use quad_math::{Real, constant};

/// Largest slope `y/x`, `z/x` of an image point: 63.4° off the axis.
pub const MAX_SLOPE: f64 = 2.0;

/// Depth under which a point counts as the camera's centre itself, m.
const NO_DEPTH: f64 = 1e-12;

/// A pinhole camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera<R> {
    /// Focal length f, px: focal length over pixel pitch.
    pub focal_length: R,
    /// Number of pixels: columns, rows.
    pub pixels: [R; 2],
    /// Principal point: column and row from the upper left corner, px.
    pub principal_point: [R; 2],
    /// Step to which image coordinates are rounded, px; 0 for none.
    pub quantum: R,
}

/// An image point and whether the camera sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Image<R> {
    /// `r_C`, px from the principal point, right and down. Always finite.
    pub point: Vector2<R>,
    /// 1 if the target is in front of the camera and inside the field of view, else 0; in each lane.
    pub visible: R,
}

/// What the camera makes of a target, where lanes need not be served.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum View {
    /// In the field of view, at this image point, px from the principal point.
    Visible(Vector2<f64>),
    /// In front of the camera but outside the pixels, at this (saturated) image point, px.
    OutsideField(Vector2<f64>),
    /// Beside or behind the camera.
    Behind,
}

impl Camera<f64> {
    /// The same camera over another scalar.
    pub fn over<R: Real>(&self) -> Camera<R> {
        Camera {
            focal_length: constant(self.focal_length),
            pixels: self.pixels.map(constant),
            principal_point: self.principal_point.map(constant),
            quantum: constant(self.quantum),
        }
    }

    /// What the camera makes of a target at `p_C`, m.
    pub fn look(&self, p_c: &Vector3<f64>) -> View {
        let image = self.project(p_c);
        if image.visible == 1.0 {
            View::Visible(image.point)
        } else if p_c.x > 0.0 {
            View::OutsideField(image.point)
        } else {
            View::Behind
        }
    }

    /// Field of view, horizontal and vertical, rad.
    pub fn field_of_view(&self) -> [f64; 2] {
        [0, 1].map(|i| {
            let near = self.principal_point[i] / self.focal_length;
            let far = (self.pixels[i] - self.principal_point[i]) / self.focal_length;
            near.atan() + far.atan()
        })
    }
}

impl<R: Real> Camera<R> {
    /// The image of a point `p_C`, m, with its visibility.
    #[inline(always)]
    pub fn project(&self, p_c: &Vector3<R>) -> Image<R> {
        let p = in_front(p_c);
        let point = Vector2::new(p.y, p.z) * (self.focal_length / p.x);
        let ahead = flag::<R>(p_c.x.simd_gt(R::zero()));
        Image {
            point,
            visible: ahead * self.contains(&point),
        }
    }

    /// The direction in C, a unit vector, in which an image point `r_C` (px) is seen: the inverse of the projection.
    #[inline(always)]
    pub fn direction(&self, point: &Vector2<R>) -> Vector3<R> {
        unit(&Vector3::new(self.focal_length, point.x, point.y))
    }

    /// Column and row of an image point from the upper left corner, px.
    #[inline(always)]
    pub fn pixel(&self, point: &Vector2<R>) -> Vector2<R> {
        point + Vector2::from(self.principal_point)
    }

    /// The image as it is read out: noise (px, a sample that the caller drew; zero for none) is added, then the
    /// coordinates are rounded to the quantum. Rounding passes derivatives unchanged.
    #[inline(always)]
    pub fn read_out(&self, image: &Image<R>, noise: &Vector2<R>) -> Image<R> {
        let q = self.quantum;
        let off = q.simd_le(R::zero());
        let step = R::one().select(off, q);
        Image {
            point: (image.point + noise).map(|v| v.select(off, whole(v / step) * step)),
            ..*image
        }
    }

    /// 1 if the image point lies on the pixels, else 0.
    #[inline(always)]
    fn contains(&self, point: &Vector2<R>) -> R {
        let pixel = self.pixel(point);
        let inside =
            |i: usize| flag::<R>(pixel[i].simd_ge(R::zero())) * flag::<R>(pixel[i].simd_le(self.pixels[i]));
        inside(0) * inside(1)
    }
}

/// The point moved forward along x, if need be, until its slopes do not exceed [`MAX_SLOPE`].
#[inline(always)]
pub(crate) fn in_front<R: Real>(p_c: &Vector3<R>) -> Vector3<R> {
    let (across, down) = (absolute(p_c.y), absolute(p_c.z));
    let widest = across.select(across.simd_gt(down), down);
    let least = widest * constant(1.0 / MAX_SLOPE) + constant(NO_DEPTH);
    let far = p_c.x.simd_gt(least);
    Vector3::new(p_c.x.select(far, least), p_c.y, p_c.z)
}
