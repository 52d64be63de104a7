//! From forward-left-up and z-up to forward-right-down and z-down.
//!
//! Both changes are the half turn `D = diag(1, −1, −1)` about x, its own inverse: north is the data's x, east its −y,
//! down its −z. `R_WB = D R D`.

use nalgebra::Vector3;
use quad_kinematics::Quaternion;

/// A vector with components forward-left-up (or along a world's x, y, z up) in forward-right-down (north-east-down).
pub fn half_turn(v: Vector3<f64>) -> Vector3<f64> {
    Vector3::new(v.x, -v.y, -v.z)
}

/// The attitude of a forward-left-up body against a z-up world, as that of forward-right-down against z-down.
pub fn half_turned_attitude(w: f64, v: Vector3<f64>) -> Quaternion<f64> {
    Quaternion { w, v: half_turn(v) }.normalised()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use nalgebra::Matrix3;

    #[test]
    fn exact_attitude_equals_the_matrix_product() {
        // Any unit quaternion; the rotation matrices are the oracle.
        let q = Quaternion {
            w: 0.8,
            v: Vector3::new(0.1, -0.5, 0.3),
        }
        .normalised();
        let d = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0));
        let turned = half_turned_attitude(q.w, q.v).rotation().matrix;
        assert_relative_eq!(turned, d * q.rotation().matrix * d, epsilon = 1e-15);
    }

    #[test]
    fn exact_signs_by_thought() {
        // Nose up is a negative rotation about 'left' and a positive one about 'right': the pitch angle is +0.2 rad.
        let nose_up = half_turned_attitude((0.1_f64).cos(), Vector3::new(0.0, -(0.1_f64).sin(), 0.0));
        assert_relative_eq!(nose_up.euler_angles().pitch, 0.2, epsilon = 1e-15);
        // Right side down is a positive rotation about 'forward' in both.
        let right_down = half_turned_attitude((0.1_f64).cos(), Vector3::new((0.1_f64).sin(), 0.0, 0.0));
        assert_relative_eq!(right_down.euler_angles().roll, 0.2, epsilon = 1e-15);
        // Turning left is negative about 'down'.
        let left = half_turned_attitude((0.1_f64).cos(), Vector3::new(0.0, 0.0, (0.1_f64).sin()));
        assert_relative_eq!(left.euler_angles().yaw, -0.2, epsilon = 1e-15);
    }
}
