//! The rotation matrix as an attitude: its rate kinematics and its conversions.
//!
//! `Ṙ_WB = R_WB [ω]×`, the proof obligation of appendix D.3, tested by automatic differentiation along
//! random smooth attitude histories.

use crate::{Body, EulerAngles, Quaternion, Rotation, World, cross_matrix};
use nalgebra::{Matrix3, Vector3};
use quad_math::{Real, atan2, constant, sqrt};

impl<R: Real> Rotation<R, Body, World> {
    /// `Ṙ = R [ω]×` with the body rates `ω`, rad/s.
    #[inline(always)]
    pub fn derivative(&self, body_rates: &Vector3<R>) -> Matrix3<R> {
        self.matrix * cross_matrix(body_rates)
    }

    /// The Euler angles; roll and yaw lose their meaning near `θ = ±90°`.
    ///
    /// The pitch is `atan2(−R_31, √(R_32² + R_33²))`: full accuracy everywhere and no NaN at the singularity,
    /// where its derivative is not defined.
    #[inline(always)]
    pub fn euler_angles(&self) -> EulerAngles<R> {
        let m = &self.matrix;
        EulerAngles {
            roll: atan2(m.m32, m.m33),
            pitch: atan2(-m.m31, sqrt(m.m32 * m.m32 + m.m33 * m.m33)),
            yaw: atan2(m.m21, m.m11),
        }
    }

    /// The unit quaternion with `w ≥ 0`.
    ///
    /// Of the four equivalent formulas the one with the largest divisor is selected per lane (Shepperd,
    /// *J. Guidance and Control* 1(3), 1978), so it is accurate for every attitude.
    pub fn quaternion(&self) -> Quaternion<R> {
        let m = &self.matrix;
        let (l, half): (R, R) = (R::one(), constant(0.5));
        let trace = m[(0, 0)] + m[(1, 1)] + m[(2, 2)];
        let a = m[(2, 1)] - m[(1, 2)];
        let b = m[(0, 2)] - m[(2, 0)];
        let c = m[(1, 0)] - m[(0, 1)];
        let xy = m[(0, 1)] + m[(1, 0)];
        let xz = m[(0, 2)] + m[(2, 0)];
        let yz = m[(1, 2)] + m[(2, 1)];
        // Each candidate is 4 × (its largest component) × q.
        let candidates = [
            (l + trace, [l + trace, a, b, c]),
            (
                l + m[(0, 0)] * constant(2.0) - trace,
                [a, l + m[(0, 0)] * constant(2.0) - trace, xy, xz],
            ),
            (
                l + m[(1, 1)] * constant(2.0) - trace,
                [b, xy, l + m[(1, 1)] * constant(2.0) - trace, yz],
            ),
            (
                l + m[(2, 2)] * constant(2.0) - trace,
                [c, xz, yz, l + m[(2, 2)] * constant(2.0) - trace],
            ),
        ];
        let (mut largest, mut q) = candidates[0];
        for (size, candidate) in &candidates[1..] {
            let take = size.simd_gt(largest);
            largest = size.select(take, largest);
            q = std::array::from_fn(|i| candidate[i].select(take, q[i]));
        }
        let scale = half / largest.simd_sqrt();
        let sign = l.select(q[0].simd_ge(R::zero()), -l);
        let q = q.map(|x| x * scale * sign);
        Quaternion {
            w: q[0],
            v: Vector3::new(q[1], q[2], q[3]),
        }
    }
}
