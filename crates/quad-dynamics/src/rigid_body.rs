//! The rigid body by the Newton-Euler formalism, in body axes.
//!
//! ```text
//! ṙ_W = R_WB v_B                         position
//! m (v̇_B + ω × v_B) = F_B + m R_WBᵀ g_W   translation
//! q̇ = ½ q ⊗ [0, ω]                       attitude
//! I ω̇ + ω × I ω = M_B                     rotation
//! ```
//!
//! Full inertia matrix about the centre of mass, flat non-rotating Earth, constant mass. Source: thesis
//! chapter 3.3.1 and appendix D.1; Stevens, Lewis, Johnson, *Aircraft Control and Simulation*, chapter 1.

use nalgebra::{Matrix3, Vector3};
use quad_kinematics::{Quaternion, QuaternionRate};
use quad_math::{Flat, Rate, Real, State};

/// Mass properties in uniform gravity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidBody<R: Real> {
    /// Mass m, kg.
    pub mass: R,
    /// Inertia matrix I about the centre of mass, along B, kg m².
    pub inertia: Matrix3<R>,
    /// Its inverse, 1/(kg m²).
    pub inertia_inverse: Matrix3<R>,
    /// Gravity g, m/s², along `+z_W`.
    pub gravity: R,
}

/// Position, velocity, attitude and rates of a rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidBodyState<R: Real> {
    /// Position of the centre of mass in W, m.
    pub position: Vector3<R>,
    /// Inertial velocity with components along B, m/s: `[u, v, w]`.
    pub velocity: Vector3<R>,
    /// Attitude of B against W.
    pub attitude: Quaternion<R>,
    /// Body rates `ω = [p, q, r]`, rad/s.
    pub body_rates: Vector3<R>,
}

/// Rate of [`RigidBodyState`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidBodyRate<R: Real> {
    /// ṙ in W, m/s.
    pub position: Vector3<R>,
    /// Rate of the body components of the velocity, m/s²; not the acceleration, which adds `ω × v`.
    pub velocity: Vector3<R>,
    /// q̇, 1/s.
    pub attitude: QuaternionRate<R>,
    /// ω̇, rad/s².
    pub body_rates: Vector3<R>,
}

/// A force and a moment about the centre of mass, both with components along B.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench<R: Real> {
    /// Force, N.
    pub force: Vector3<R>,
    /// Moment about the centre of mass, N m.
    pub moment: Vector3<R>,
}

impl<R: Real> RigidBody<R> {
    /// The rate of the state under all forces and moments but gravity, which is added here.
    #[inline(always)]
    pub fn derivative(&self, state: &RigidBodyState<R>, wrench: &Wrench<R>) -> RigidBodyRate<R> {
        let r_wb = state.attitude.rotation().matrix;
        let (v, w) = (&state.velocity, &state.body_rates);
        // The third row of R_WB is the world's z axis (down) seen in B.
        let down_b = Vector3::new(r_wb.m31, r_wb.m32, r_wb.m33);
        RigidBodyRate {
            position: r_wb * v,
            velocity: wrench.force * (R::one() / self.mass) + down_b * self.gravity - w.cross(v),
            attitude: state.attitude.derivative(w),
            body_rates: self.angular_acceleration(w, &wrench.moment),
        }
    }

    /// `ω̇ = I⁻¹ (M − ω × I ω)`, rad/s².
    #[inline(always)]
    pub fn angular_acceleration(&self, body_rates: &Vector3<R>, moment: &Vector3<R>) -> Vector3<R> {
        let momentum = self.inertia * body_rates;
        self.inertia_inverse * (moment - body_rates.cross(&momentum))
    }

    /// Kinetic plus potential energy, J, zero at rest at `z = 0`: `½ m v² + ½ ωᵀ I ω − m g z`.
    pub fn energy(&self, state: &RigidBodyState<R>) -> R {
        let half = quad_math::constant::<R>(0.5);
        let translation = self.mass * state.velocity.norm_squared() * half;
        let rotation = state.body_rates.dot(&(self.inertia * state.body_rates)) * half;
        translation + rotation - self.mass * self.gravity * state.position.z
    }
}

impl<R: Real> RigidBodyState<R> {
    /// At rest at a position in W, m, level, heading ψ, rad.
    pub fn at_rest(position: Vector3<R>, yaw: R) -> Self {
        Self {
            position,
            velocity: Vector3::zeros(),
            attitude: Quaternion::from_axis_angle(&Vector3::z(), yaw),
            body_rates: Vector3::zeros(),
        }
    }
}

impl<R: Real> State<R> for RigidBodyState<R> {
    type Rate = RigidBodyRate<R>;

    #[inline(always)]
    fn advanced(&self, h: R, rate: &RigidBodyRate<R>) -> Self {
        Self {
            position: self.position + rate.position * h,
            velocity: self.velocity + rate.velocity * h,
            attitude: self.attitude.advanced(h, &rate.attitude),
            body_rates: self.body_rates + rate.body_rates * h,
        }
    }

    #[inline(always)]
    fn normalised(self) -> Self {
        Self {
            attitude: self.attitude.normalised(),
            ..self
        }
    }
}

impl<R: Real> Rate<R> for RigidBodyRate<R> {
    #[inline(always)]
    fn zero() -> Self {
        Self {
            position: Vector3::zeros(),
            velocity: Vector3::zeros(),
            attitude: QuaternionRate::zero(),
            body_rates: Vector3::zeros(),
        }
    }

    #[inline(always)]
    fn add_scaled(&self, h: R, other: &Self) -> Self {
        Self {
            position: self.position + other.position * h,
            velocity: self.velocity + other.velocity * h,
            attitude: self.attitude.add_scaled(h, &other.attitude),
            body_rates: self.body_rates + other.body_rates * h,
        }
    }
}

impl<R: Real> Flat<R> for RigidBodyState<R> {
    const LEN: usize = 13;

    #[inline(always)]
    fn write(&self, out: &mut [R]) {
        self.position.write(out);
        self.velocity.write(&mut out[3..]);
        self.attitude.write(&mut out[6..]);
        self.body_rates.write(&mut out[10..]);
    }

    #[inline(always)]
    fn read(values: &[R]) -> Self {
        Self {
            position: Vector3::read(values),
            velocity: Vector3::read(&values[3..]),
            attitude: Quaternion::read(&values[6..]),
            body_rates: Vector3::read(&values[10..]),
        }
    }
}

impl<R: Real> Flat<R> for RigidBodyRate<R> {
    const LEN: usize = 13;

    #[inline(always)]
    fn write(&self, out: &mut [R]) {
        self.position.write(out);
        self.velocity.write(&mut out[3..]);
        self.attitude.write(&mut out[6..]);
        self.body_rates.write(&mut out[10..]);
    }

    #[inline(always)]
    fn read(values: &[R]) -> Self {
        Self {
            position: Vector3::read(values),
            velocity: Vector3::read(&values[3..]),
            attitude: QuaternionRate::read(&values[6..]),
            body_rates: Vector3::read(&values[10..]),
        }
    }
}
