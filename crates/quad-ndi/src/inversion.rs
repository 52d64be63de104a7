//! The hand-derived inversions c1, c2 and c3 of levels 1, 2 and 3.
//!
//! Nested loops: the outer loop turns errors of the flat outputs `[x, y, z, ψ]` into demanded
//! accelerations and a demanded tilt; the inner loop turns errors of attitude into demanded angular
//! accelerations; the linearising feedback of the level turns demands into rotor commands. See [`C1`],
//! [`C2`], [`C3`] for each. Source: thesis chapters 6.2 and 6.3.

mod c1;
mod c2;
mod c3;

pub use c1::C1;
pub use c2::C2;
pub use c3::{C3, ObserverState};

use crate::settings::Gains;
use nalgebra::{Matrix3, Vector3};
use quad_dynamics::{Flight, RigidBody};
use quad_math::{Real, atan2, constant};

/// Least cosine of a tilt that is divided by (84°): beyond it a demand saturates instead of exploding.
const LEAST_COSINE: f64 = 0.1;

/// Least upward specific force that a tilt demand divides by, as a fraction of g.
const LEAST_SPECIFIC_FORCE: f64 = 0.1;

/// Acceleration that the outer loop demands along `x_W` and `y_W`, m/s².
#[inline(always)]
fn horizontal_demand<R: Real>(
    gains: &Gains<R>,
    flight: &Flight<R>,
    reference: &crate::Reference<R>,
) -> [R; 2] {
    let flat = &reference.flat;
    let axis = |i: usize| {
        gains.position.second_order(
            flat.position[i] - flight.position[i],
            flat.velocity[i] - flight.velocity[i],
            flat.acceleration[i],
        )
    };
    [axis(0), axis(1)]
}

/// Errors of roll and pitch, rad, against the tilt that makes the demanded horizontal acceleration while the
/// specific force along `−z_W` is `up`, m/s²: `θ_des = atan(−a'_x/up)`, `φ_des = atan(a'_y/√(a'_x² + up²))`.
///
/// Each error is the angle between two directions of a plane, `atan(d_1 × d_2 / d_1 · d_2)`: one arc tangent
/// instead of the difference of two, and within ±π by itself. `up` is held at a tenth of g or more, so a demand to
/// fall doesn't turn the vehicle over.
#[inline(always)]
fn tilt_errors<R: Real>(demand: [R; 2], up: R, flight: &Flight<R>, gravity: R) -> [R; 2] {
    let heading = Heading::of(flight);
    let up = up.simd_max(gravity * constant(LEAST_SPECIFIC_FORCE));
    let forward = demand[0] * heading.cos + demand[1] * heading.sin;
    let right = demand[1] * heading.cos - demand[0] * heading.sin;
    let m = &flight.rotation.matrix;
    // [cos φ, sin φ] cos θ = [R_33, R_32] and [cos θ, sin θ] = [√(R_32² + R_33²), −R_31].
    let level = quad_math::sqrt(forward * forward + up * up);
    let roll = atan2(right * m.m33 - level * m.m32, level * m.m33 + right * m.m32);
    let cos_pitch = cos_pitch(flight);
    let pitch = atan2(up * m.m31 - forward * cos_pitch, up * cos_pitch + forward * m.m31);
    [roll, pitch]
}

/// Sine and cosine of the heading, from the rotation matrix.
///
/// The cosine of the pitch divides and is held at a tenth or more: towards a vertical nose, where there is no
/// heading, both go to zero.
struct Heading<R> {
    sin: R,
    cos: R,
}

impl<R: Real> Heading<R> {
    #[inline(always)]
    fn of(flight: &Flight<R>) -> Self {
        let m = &flight.rotation.matrix;
        let scale = R::one() / cos_pitch(flight).simd_max(constant(LEAST_COSINE));
        Self {
            sin: m.m21 * scale,
            cos: m.m11 * scale,
        }
    }
}

/// Cosine of the pitch, `√(R_WB,32² + R_WB,33²)`: the one expression for it, so that it is computed once per step.
#[inline(always)]
fn cos_pitch<R: Real>(flight: &Flight<R>) -> R {
    let m = &flight.rotation.matrix;
    quad_math::sqrt(m.m32 * m.m32 + m.m33 * m.m33)
}

/// Cosine of the tilt, `R_WB,33 = cos φ cos θ`, held at a tenth or more.
#[inline(always)]
fn tilt_cosine<R: Real>(flight: &Flight<R>) -> R {
    flight.rotation.matrix.m33.simd_max(constant(LEAST_COSINE))
}

/// Euler angle kinematics `ω = W η̇` and its derivatives, from sines and cosines that the rotation matrix
/// already holds.
///
/// `W = [1, 0, −sθ; 0, cφ, sφ cθ; 0, −sφ, cφ cθ]`; then `ω̇ = W η̈ + Ẇ η̇` and
/// `ω̈ = W η⃛ + 2 Ẇ η̈ + Ẅ η̇`. The cosine of the pitch is held at a tenth or more where it divides.
struct EulerKinematics<R: Real> {
    sin_roll: R,
    cos_roll: R,
    sin_pitch: R,
    cos_pitch: R,
    inverse_cos_pitch: R,
    rates: Vector3<R>,
}

impl<R: Real> EulerKinematics<R> {
    #[inline(always)]
    fn of(flight: &Flight<R>) -> Self {
        let m = &flight.rotation.matrix;
        let cos_pitch = cos_pitch(flight).simd_max(constant(LEAST_COSINE));
        let inverse = R::one() / cos_pitch;
        let (sin_roll, cos_roll, sin_pitch) = (m.m32 * inverse, m.m33 * inverse, -m.m31);
        let w = &flight.body_rates;
        // η̇ = J ω, written out.
        let turn = (sin_roll * w.y + cos_roll * w.z) * inverse;
        let rates = Vector3::new(w.x + sin_pitch * turn, cos_roll * w.y - sin_roll * w.z, turn);
        Self {
            sin_roll,
            cos_roll,
            sin_pitch,
            cos_pitch,
            inverse_cos_pitch: inverse,
            rates,
        }
    }

    /// `W v`.
    #[inline(always)]
    fn body_rates(&self, v: &Vector3<R>) -> Vector3<R> {
        let Self {
            sin_roll: sp,
            cos_roll: cp,
            sin_pitch: st,
            cos_pitch: ct,
            ..
        } = *self;
        Vector3::new(v.x - st * v.z, cp * v.y + sp * ct * v.z, cp * ct * v.z - sp * v.y)
    }

    /// `J v = W⁻¹ v`.
    #[inline(always)]
    fn euler_rates(&self, v: &Vector3<R>) -> Vector3<R> {
        let turn = (self.sin_roll * v.y + self.cos_roll * v.z) * self.inverse_cos_pitch;
        Vector3::new(
            v.x + self.sin_pitch * turn,
            self.cos_roll * v.y - self.sin_roll * v.z,
            turn,
        )
    }

    /// `Ẇ` of the motion itself.
    #[inline(always)]
    fn first_derivative(&self) -> Matrix3<R> {
        let Self {
            sin_roll: sp,
            cos_roll: cp,
            sin_pitch: st,
            cos_pitch: ct,
            rates,
            ..
        } = *self;
        let (dp, dt, o) = (rates.x, rates.y, R::zero());
        Matrix3::new(
            o,
            o,
            -ct * dt,
            o,
            -sp * dp,
            cp * ct * dp - sp * st * dt,
            o,
            -cp * dp,
            -sp * ct * dp - cp * st * dt,
        )
    }

    /// `Ẅ` of the motion itself, given the Euler accelerations `η̈`, rad/s².
    #[inline(always)]
    fn second_derivative(&self, accelerations: &Vector3<R>) -> Matrix3<R> {
        let Self {
            sin_roll: sp,
            cos_roll: cp,
            sin_pitch: st,
            cos_pitch: ct,
            rates,
            ..
        } = *self;
        let (dp, dt, ap, at) = (rates.x, rates.y, accelerations.x, accelerations.y);
        let (o, two) = (R::zero(), constant::<R>(2.0));
        let squares = dp * dp + dt * dt;
        let cross = two * dp * dt;
        Matrix3::new(
            o,
            o,
            st * dt * dt - ct * at,
            o,
            -cp * dp * dp - sp * ap,
            -sp * ct * squares + cp * ct * ap - cp * st * cross - sp * st * at,
            o,
            sp * dp * dp - cp * ap,
            -cp * ct * squares - sp * ct * ap + sp * st * cross - cp * st * at,
        )
    }
}

/// The moment, N m, that gives the angular acceleration, rad/s²: `M = I ω̇ + ω × I ω`.
#[inline(always)]
fn moment_for<R: Real>(
    body: &RigidBody<R>,
    body_rates: &Vector3<R>,
    acceleration: &Vector3<R>,
) -> Vector3<R> {
    body.inertia * acceleration + body_rates.cross(&(body.inertia * body_rates))
}

#[cfg(test)]
mod tests;
