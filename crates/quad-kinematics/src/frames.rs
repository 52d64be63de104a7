//! Frames of reference as types, so that a rotation can't be applied the wrong way round.
//!
//! The tags are phantom types: they cost nothing and they end where arithmetic begins. They guard what
//! a rotation maps from and to. They do **not** guard units, which point a vector starts at, or what
//! you do with the bare `.v` and `.matrix`; physics inside the crates uses bare vectors with monogram
//! names (`v_W`, `R_WB`).
//!
//! ```compile_fail
//! use quad_kinematics::{Body, EulerAngles, FrameVector, World};
//! let R_WB = EulerAngles::level(0.3).rotation();
//! let g_W = FrameVector::<f64, World>::new(0.0, 0.0, 9.81);
//! let nonsense = R_WB.rotate(g_W); // R_WB takes body components, g_W has world components
//! ```

use nalgebra::{Matrix3, Vector3};
use quad_math::Real;
use std::marker::PhantomData;

/// The world frame W: north-east-down, fixed on flat ground, taken as inertial. Height is `h = −z`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum World {}

/// The body frame B: forward-right-down, origin at the vehicle's centre of mass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Body {}

/// The frame E fixed on the moving platform of the energy transmission system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Platform {}

/// The camera frame C: x along the optical axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Camera {}

/// A vector given by its components in frame `F`.
#[derive(Debug, PartialEq)]
pub struct FrameVector<R: Real, F> {
    /// The components along the axes of `F`.
    pub v: Vector3<R>,
    frame: PhantomData<F>,
}

impl<R: Real, F> Clone for FrameVector<R, F> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<R: Real, F> Copy for FrameVector<R, F> {}

impl<R: Real, F> FrameVector<R, F> {
    /// The vector with these components along the axes of `F`.
    pub fn new(x: R, y: R, z: R) -> Self {
        Self::from_components(Vector3::new(x, y, z))
    }

    /// The vector with these components along the axes of `F`.
    pub fn from_components(v: Vector3<R>) -> Self {
        Self {
            v,
            frame: PhantomData,
        }
    }
}

/// The rotation matrix that takes components in `From` to components in `To`.
///
/// `Rotation<R, Body, World>` is the matrix `R_WB` of the equations: `v_W = R_WB v_B`. It is one of the
/// three attitude representations; nothing here keeps it orthonormal except
/// [`Rotation::orthonormalised`].
#[derive(Debug, PartialEq)]
pub struct Rotation<R: Real, From, To> {
    /// The matrix; its columns are the axes of `From` seen in `To`.
    pub matrix: Matrix3<R>,
    frames: PhantomData<(From, To)>,
}

impl<R: Real, From, To> Clone for Rotation<R, From, To> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<R: Real, From, To> Copy for Rotation<R, From, To> {}

impl<R: Real, From, To> Rotation<R, From, To> {
    /// The rotation with this orthonormal matrix.
    #[inline(always)]
    pub fn from_matrix(matrix: Matrix3<R>) -> Self {
        Self {
            matrix,
            frames: PhantomData,
        }
    }

    /// The rotation between two aligned frames.
    pub fn identity() -> Self {
        Self::from_matrix(Matrix3::identity())
    }

    /// The components in `To` of a vector given in `From`.
    #[inline(always)]
    pub fn rotate(&self, vector: FrameVector<R, From>) -> FrameVector<R, To> {
        FrameVector::from_components(self.matrix * vector.v)
    }

    /// The rotation back.
    #[inline(always)]
    pub fn inverse(&self) -> Rotation<R, To, From> {
        Rotation::from_matrix(self.matrix.transpose())
    }

    /// This rotation followed by `next`.
    #[inline(always)]
    pub fn then<Next>(&self, next: &Rotation<R, To, Next>) -> Rotation<R, From, Next> {
        Rotation::from_matrix(next.matrix * self.matrix)
    }

    /// The matrix with orthonormal columns next to this one (Gram-Schmidt from the first column).
    ///
    /// For removing the drift of an integrated matrix: the input must already be near a rotation.
    pub fn orthonormalised(&self) -> Self {
        let x = unit(self.matrix.column(0).into_owned());
        let y_raw = self.matrix.column(1).into_owned();
        let y = unit(y_raw - x * x.dot(&y_raw));
        Self::from_matrix(Matrix3::from_columns(&[x, y, x.cross(&y)]))
    }
}

fn unit<R: Real>(v: Vector3<R>) -> Vector3<R> {
    v / v.norm_squared().simd_sqrt()
}

/// The cross product matrix: `[ω]× v = ω × v`.
#[inline(always)]
pub fn cross_matrix<R: Real>(w: &Vector3<R>) -> Matrix3<R> {
    let o = R::zero();
    Matrix3::new(o, -w.z, w.y, w.z, o, -w.x, -w.y, w.x, o)
}
