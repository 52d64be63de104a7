//! Heading towards a point: how a vehicle keeps its nose, and what it carries there, on something.
//!
//! ```text
//! ψ = atan2(Δy, Δx),  ψ̇ = (Δx Δv_y − Δy Δv_x) / (Δx² + Δy²)
//! ```
//!
//! with Δ from the vehicle to the point. Higher derivatives of the heading are left at zero. Two kinks: right above or below the
//! point there is no bearing, and the path's own heading holds; near there the bearing turns faster than any vehicle,
//! and ψ̇ is held at [`MAX_YAW_RATE`]. Source: thesis appendix A (the quadrotor yaws to face the ground station).

use crate::FlatOutput;
use nalgebra::Vector3;
use quad_math::{Real, atan2, constant};

/// Horizontal distance below which a point has no bearing, m.
pub const LEAST_DISTANCE: f64 = 1e-3;

/// Largest rate of the bearing that is fed forward, rad/s: a turn per second.
///
/// *Choice.* The tilt's feed-forward grows with its cube; the heading itself is not touched.
pub const MAX_YAW_RATE: f64 = std::f64::consts::TAU;

impl<R: Real> FlatOutput<R> {
    /// The same path with the heading towards a point at `line` from the vehicle (m, in W) that changes by `line_rate`, m/s.
    #[inline(always)]
    #[must_use]
    pub fn facing(self, line: &Vector3<R>, line_rate: &Vector3<R>) -> Self {
        let square = line.x * line.x + line.y * line.y;
        let none = square.simd_lt(constant(LEAST_DISTANCE * LEAST_DISTANCE));
        let turn = (line.x * line_rate.y - line.y * line_rate.x) / R::one().select(none, square);
        let turn = turn.simd_clamp(constant(-MAX_YAW_RATE), constant(MAX_YAW_RATE));
        let o = R::zero();
        Self {
            yaw: self.yaw.select(none, atan2(line.y, line.x)),
            yaw_rate: self.yaw_rate.select(none, turn),
            yaw_acceleration: self.yaw_acceleration.select(none, o),
            yaw_jerk: self.yaw_jerk.select(none, o),
            ..self
        }
    }
}
