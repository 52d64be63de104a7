//! The gimbal: pan about z, then tilt about the platform's y, with first-order rate actuators and limits.
//!
//! Per axis, angle `ψ`, rate `ω`, commanded rate `u`:
//!
//! `ψ̇ = ω`, `ω̇ = (sat(u) − ω)/τ`, with `sat` into
//! `[max(−ω_max, −(ψ − ψ_min)/4τ), min(ω_max, (ψ_max − ψ)/4τ)]`.
//!
//! The first bound of each pair is the drive's rate limit. The second is an electronic end stop: near a limit
//! of travel the drive takes no command that it could not brake. With the bound `(ψ_max − ψ)/4τ` the distance to the limit has
//! the double pole `−1/2τ`, so an axis that starts inside its travel with `ω ≤ (ψ_max − ψ)/2τ` never leaves it:
//! `s = ė + e/2τ` with `e = ψ_max − ψ` obeys `ṡ ≥ −s/2τ`, hence `s ≥ 0` and `e ≥ 0` for good.
//!
//! Assumptions: the axes do not couple, the platform is balanced, the pedestal is level and at rest. Kinks: where a
//! bound becomes active. Source of the actuator: the thesis' open-loop first-order rate response (7.3); the end stop
//! is a *choice*.

use crate::scalar::within;
use nalgebra::{Matrix3x2, Vector2, Vector3};
use quad_kinematics::{EulerAngles, Platform, Rotation, World};
use quad_math::{Flat, Rate, Real, State, System, constant};

/// The distance to an end stop over `STOP τ` bounds the commanded rate: 4 is the least factor without overshoot.
const STOP: f64 = 4.0;

/// One axis of the gimbal: its actuator and its limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GimbalAxis<R> {
    /// Time constant τ of the rate's response, s.
    pub time_constant: R,
    /// Largest rate ω_max, rad/s.
    pub rate_limit: R,
    /// Least angle, rad.
    pub minimum: R,
    /// Largest angle, rad.
    pub maximum: R,
}

/// The pan-tilt gimbal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gimbal<R> {
    /// Pan ψ_E about z, positive clockwise seen from above, zero at the pedestal's heading.
    pub pan: GimbalAxis<R>,
    /// Tilt θ_E about the platform's y, positive upwards, zero on the horizon.
    pub tilt: GimbalAxis<R>,
}

/// Where the platform points and how fast it turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GimbalState<R> {
    /// Pan ψ_E, rad, positive clockwise seen from above.
    pub pan: R,
    /// Tilt θ_E, rad, positive upwards.
    pub tilt: R,
    /// Pan rate, rad/s.
    pub pan_rate: R,
    /// Tilt rate, rad/s.
    pub tilt_rate: R,
}

/// Rate of a [`GimbalState`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GimbalStateRate<R> {
    /// Pan rate, rad/s.
    pub pan: R,
    /// Tilt rate, rad/s.
    pub tilt: R,
    /// Pan acceleration, rad/s².
    pub pan_rate: R,
    /// Tilt acceleration, rad/s².
    pub tilt_rate: R,
}

/// Commanded rates `u`, before any limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GimbalCommand<R> {
    /// Commanded pan rate, rad/s.
    pub pan_rate: R,
    /// Commanded tilt rate, rad/s.
    pub tilt_rate: R,
}

/// Where the station stands: the point where the gimbal's axes cross, and the heading of zero pan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pedestal<R> {
    /// Crossing of the gimbal's axes in W, m; origin of E and C.
    pub position: [R; 3],
    /// Heading of the platform at zero pan, rad, clockwise from north seen from above.
    pub heading: R,
}

impl<R: Real> GimbalAxis<R> {
    /// The commanded rate that the drive accepts at this angle, rad/s (see the module's head).
    #[inline(always)]
    pub fn admissible(&self, command: R, angle: R) -> R {
        let room = self.time_constant * constant(STOP);
        let w = self.rate_limit;
        let low = within(-(angle - self.minimum) / room, -w, w);
        let high = within((self.maximum - angle) / room, -w, w);
        within(command, low, high)
    }

    /// `ω̇ = (sat(u) − ω)/τ`, rad/s².
    #[inline(always)]
    pub fn acceleration(&self, command: R, angle: R, rate: R) -> R {
        (self.admissible(command, angle) - rate) / self.time_constant
    }
}

impl GimbalAxis<f64> {
    fn over<R: Real>(&self) -> GimbalAxis<R> {
        GimbalAxis {
            time_constant: constant(self.time_constant),
            rate_limit: constant(self.rate_limit),
            minimum: constant(self.minimum),
            maximum: constant(self.maximum),
        }
    }
}

impl Gimbal<f64> {
    /// The same gimbal over another scalar.
    pub fn over<R: Real>(&self) -> Gimbal<R> {
        Gimbal {
            pan: self.pan.over(),
            tilt: self.tilt.over(),
        }
    }
}

impl Pedestal<f64> {
    /// The same pedestal over another scalar.
    pub fn over<R: Real>(&self) -> Pedestal<R> {
        Pedestal {
            position: self.position.map(constant),
            heading: constant(self.heading),
        }
    }
}

impl<R: Real> Pedestal<R> {
    /// Crossing of the gimbal's axes in W, m.
    #[inline(always)]
    pub fn origin(&self) -> Vector3<R> {
        self.position.into()
    }

    /// `R_WE = R_z(ψ_0 + ψ_E) R_y(θ_E)`, components along the moving platform to components in W.
    #[inline(always)]
    pub fn rotation(&self, state: &GimbalState<R>) -> Rotation<R, Platform, World> {
        let attitude = EulerAngles::new(R::zero(), state.tilt, self.heading + state.pan);
        Rotation::from_matrix(attitude.rotation().matrix)
    }
}

/// `J(θ_E)` of `ω_E = J [ψ̇_E, θ̇_E]`: gimbal rates to the platform's angular velocity along E.
#[inline(always)]
pub fn platform_rate_matrix<R: Real>(tilt: R) -> Matrix3x2<R> {
    let (s, c) = tilt.simd_sin_cos();
    let (o, l) = (R::zero(), R::one());
    Matrix3x2::new(-s, o, o, l, c, o)
}

impl<R: Real> GimbalState<R> {
    /// At rest at these angles, rad.
    pub fn at_rest(pan: R, tilt: R) -> Self {
        Self {
            pan,
            tilt,
            pan_rate: R::zero(),
            tilt_rate: R::zero(),
        }
    }

    /// `[ψ̇_E, θ̇_E]`, rad/s.
    #[inline(always)]
    pub fn rates(&self) -> Vector2<R> {
        Vector2::new(self.pan_rate, self.tilt_rate)
    }
}

impl<R: Real> System<R> for Gimbal<R> {
    type State = GimbalState<R>;
    type Input = GimbalCommand<R>;

    #[inline(always)]
    fn derivative(&self, x: &GimbalState<R>, u: &GimbalCommand<R>) -> GimbalStateRate<R> {
        GimbalStateRate {
            pan: x.pan_rate,
            tilt: x.tilt_rate,
            pan_rate: self.pan.acceleration(u.pan_rate, x.pan, x.pan_rate),
            tilt_rate: self.tilt.acceleration(u.tilt_rate, x.tilt, x.tilt_rate),
        }
    }
}

impl<R: Real> State<R> for GimbalState<R> {
    type Rate = GimbalStateRate<R>;

    #[inline(always)]
    fn advanced(&self, h: R, rate: &GimbalStateRate<R>) -> Self {
        Self {
            pan: self.pan + rate.pan * h,
            tilt: self.tilt + rate.tilt * h,
            pan_rate: self.pan_rate + rate.pan_rate * h,
            tilt_rate: self.tilt_rate + rate.tilt_rate * h,
        }
    }
}

impl<R: Real> Rate<R> for GimbalStateRate<R> {
    #[inline(always)]
    fn zero() -> Self {
        let o = R::zero();
        Self {
            pan: o,
            tilt: o,
            pan_rate: o,
            tilt_rate: o,
        }
    }

    #[inline(always)]
    fn add_scaled(&self, h: R, other: &Self) -> Self {
        Self {
            pan: self.pan + other.pan * h,
            tilt: self.tilt + other.tilt * h,
            pan_rate: self.pan_rate + other.pan_rate * h,
            tilt_rate: self.tilt_rate + other.tilt_rate * h,
        }
    }
}

impl<R: Real> Flat<R> for GimbalState<R> {
    const LEN: usize = 4;

    fn write(&self, out: &mut [R]) {
        out[..4].copy_from_slice(&[self.pan, self.tilt, self.pan_rate, self.tilt_rate]);
    }

    fn read(values: &[R]) -> Self {
        Self {
            pan: values[0],
            tilt: values[1],
            pan_rate: values[2],
            tilt_rate: values[3],
        }
    }
}
