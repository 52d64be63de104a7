//! Image kinematics: how the target's image moves when the platform turns and the target flies.
//!
//! With `p = [x, y, z]` the target in C, `η = y/x`, `ζ = z/x`, `r_C = f [η, ζ]`, the gimbal's rates
//! `q̇ = [ψ̇_E, θ̇_E]`, the platform's angular velocity `ω = J(θ_E) q̇` and the target's velocity `v` along C:
//!
//! `ṗ = v − ω × p`, `ṙ_C = L(θ_E, r_C) q̇ + d`,
//!
//! `L = f [[−(c(1 + η²) + s ζ), η ζ], [η (s − c ζ), 1 + ζ²]]`, `d = (f/x) [v_y − η v_x, v_z − ζ v_x]`,
//!
//! with `s, c` sine and cosine of `θ_E`. `det L = −f² (1 + η² + ζ²)(c + s ζ)`: the interaction is singular where
//! the target stands over the pan axis' own plane, at the zenith if it is centred. Depth enters `d` only.
//!
//! A second derivative follows from `p̈ = a − ω × v − (J q̈ + J̇ q̇) × p − ω × ṗ`: `r̈_C = L q̈ + b`.
//!
//! Source: the interaction matrix of a point, Chaumette, Hutchinson, *Visual servo control I*, IEEE Robotics and Automation
//! Magazine 13(4), 2006, with the axes of C and the gimbal's kinematics inserted; checked against automatic differentiation.

use crate::camera::in_front;
use crate::gimbal::{GimbalState, platform_rate_matrix};
use nalgebra::{Matrix2, Vector2, Vector3};
use quad_math::{Real, constant};

/// A point's motion along some frame's axes: position, velocity and acceleration seen from rest.
///
/// Only the direction of the position matters for an image, so a unit vector and its derivatives will do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointMotion<R: Real> {
    /// Position, or direction.
    pub position: Vector3<R>,
    /// Its velocity in an inertial frame, 1/s times the unit of the position.
    pub velocity: Vector3<R>,
    /// Its acceleration in an inertial frame, 1/s² times the unit of the position.
    pub acceleration: Vector3<R>,
}

/// The image kinematics of a camera with focal length f on the gimbal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImageKinematics<R> {
    /// Focal length f, px.
    pub focal_length: R,
}

impl<R: Real> PointMotion<R> {
    /// A point at rest.
    pub fn at_rest(position: Vector3<R>) -> Self {
        Self {
            position,
            velocity: Vector3::zeros(),
            acceleration: Vector3::zeros(),
        }
    }

    /// The same motion with components along other axes.
    #[inline(always)]
    pub(crate) fn along(&self, r: &nalgebra::Matrix3<R>) -> Self {
        Self {
            position: r * self.position,
            velocity: r * self.velocity,
            acceleration: r * self.acceleration,
        }
    }
}

impl<R: Real> ImageKinematics<R> {
    /// `r_C = f [y/x, z/x]`, px, finite everywhere (see [`crate::MAX_SLOPE`]).
    #[inline(always)]
    pub fn image(&self, p_c: &Vector3<R>) -> Vector2<R> {
        let p = in_front(p_c);
        Vector2::new(p.y, p.z) * (self.focal_length / p.x)
    }

    /// The interaction `L(θ_E, r_C)`, px: image velocity per gimbal rate; columns pan, tilt.
    #[inline(always)]
    pub fn interaction(&self, tilt: R, image: &Vector2<R>) -> Matrix2<R> {
        let (s, c) = tilt.simd_sin_cos();
        let (eta, zeta) = (image.x / self.focal_length, image.y / self.focal_length);
        let l = R::one();
        Matrix2::new(
            -(c * (l + eta * eta) + s * zeta),
            eta * zeta,
            eta * (s - c * zeta),
            l + zeta * zeta,
        ) * self.focal_length
    }

    /// `d`, px/s: image velocity of a target moving with `velocity` along C as seen from a platform at rest.
    #[inline(always)]
    pub fn target_motion(&self, p_c: &Vector3<R>, velocity: &Vector3<R>) -> Vector2<R> {
        let p = in_front(p_c);
        let (eta, zeta) = (p.y / p.x, p.z / p.x);
        Vector2::new(velocity.y - eta * velocity.x, velocity.z - zeta * velocity.x)
            * (self.focal_length / p.x)
    }

    /// `ṙ_C = L q̇ + d`, px/s.
    #[inline(always)]
    pub fn image_velocity(&self, gimbal: &GimbalState<R>, target_c: &PointMotion<R>) -> Vector2<R> {
        let image = self.image(&target_c.position);
        self.interaction(gimbal.tilt, &image) * gimbal.rates()
            + self.target_motion(&target_c.position, &target_c.velocity)
    }

    /// `b` of `r̈_C = L q̈ + b`, px/s²: the image acceleration with the gimbal's rates held.
    #[inline(always)]
    pub fn image_acceleration_at_constant_rates(
        &self,
        gimbal: &GimbalState<R>,
        target_c: &PointMotion<R>,
    ) -> Vector2<R> {
        let (p, v) = (in_front(&target_c.position), target_c.velocity);
        let (s, c) = gimbal.tilt.simd_sin_cos();
        let w = platform_rate_matrix(gimbal.tilt) * gimbal.rates();
        // J̇ q̇.
        let turn = gimbal.pan_rate * gimbal.tilt_rate;
        let w_dot = Vector3::new(-c * turn, R::zero(), -s * turn);
        let p_dot = v - w.cross(&p);
        let p_ddot = target_c.acceleration - w.cross(&v) - w_dot.cross(&p) - w.cross(&p_dot);
        let component = |along: fn(&Vector3<R>) -> R| {
            let slope = along(&p) / p.x;
            let slope_dot = (along(&p_dot) - slope * p_dot.x) / p.x;
            (along(&p_ddot) - slope_dot * p_dot.x * constant(2.0) - slope * p_ddot.x) / p.x
        };
        Vector2::new(component(|v| v.y), component(|v| v.z)) * self.focal_length
    }
}
