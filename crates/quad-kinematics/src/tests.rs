//! Oracles: closed forms, automatic differentiation, agreement of the three representations.

use crate::*;
use approx::assert_relative_eq;
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use num_dual::Dual64;
use proptest::prelude::*;
use quad_math::{Flat, Real, constant, rk4};

/// Attitudes that keep 3 degrees away from the singularity of the Euler angles.
fn attitude() -> impl Strategy<Value = EulerAngles<f64>> {
    (-3.1..3.1, -1.52..1.52, -3.1..3.1).prop_map(|(r, p, y)| EulerAngles::new(r, p, y))
}

fn vector(size: f64) -> impl Strategy<Value = Vector3<f64>> {
    [-size..size, -size..size, -size..size].prop_map(|[x, y, z]| Vector3::new(x, y, z))
}

/// Rounding of a few tens of operations on numbers of order one.
const ROUNDING: f64 = 1e-13;

/// A smooth attitude history with bounded pitch: `η(t) = a + b sin(c t + d)`, axis by axis.
fn history<R: Real>(t: R, a: &Vector3<f64>, b: &Vector3<f64>, c: &Vector3<f64>) -> EulerAngles<R> {
    let axis = |i: usize| {
        let k: R = constant(c[i]);
        let size: R = constant(b[i]);
        (t * k).simd_sin() * size + constant(a[i])
    };
    EulerAngles::new(axis(0), axis(1), axis(2))
}

#[test]
fn exact_axes_of_single_rotations() {
    let quarter = std::f64::consts::FRAC_PI_2;
    // Yaw by +90 degrees: forward points east (+y_W).
    let r = EulerAngles::new(0.0, 0.0, quarter).rotation().matrix;
    assert_relative_eq!(r * Vector3::x(), Vector3::y(), epsilon = 1e-15);
    // Roll by +90 degrees: the right side points down (+z_W).
    let r = EulerAngles::new(quarter, 0.0, 0.0).rotation().matrix;
    assert_relative_eq!(r * Vector3::y(), Vector3::z(), epsilon = 1e-15);
    // Pitch by +90 degrees: the nose points up (-z_W).
    let r = EulerAngles::new(0.0, quarter, 0.0).rotation().matrix;
    assert_relative_eq!(r * Vector3::x(), -Vector3::z(), epsilon = 1e-15);
}

proptest! {
    #[test]
    fn agree_with_nalgebra(a in attitude()) {
        let theirs = Rotation3::from_euler_angles(a.roll, a.pitch, a.yaw);
        assert_relative_eq!(a.rotation().matrix, *theirs.matrix(), epsilon = ROUNDING);
        let q = UnitQuaternion::from_rotation_matrix(&theirs);
        let ours = a.quaternion();
        let same = (ours.w * q.w + ours.v.dot(&q.imag())).abs();
        prop_assert!((same - 1.0).abs() < ROUNDING);
    }

    #[test]
    fn agree_conversions_go_round(a in attitude()) {
        let q = a.quaternion();
        let r = a.rotation();
        assert_relative_eq!(q.rotation().matrix, r.matrix, epsilon = ROUNDING);
        assert_relative_eq!(r.quaternion().rotation().matrix, r.matrix, epsilon = ROUNDING);
        // asin loses digits as 1/cos(pitch), here at most 20.
        assert_relative_eq!(r.euler_angles().vector(), a.vector(), epsilon = 1e-11);
        assert_relative_eq!(q.euler_angles().vector(), a.vector(), epsilon = 1e-11);
    }

    #[test]
    fn agree_quaternion_of_half_turns(axis in vector(1.0)) {
        prop_assume!(axis.norm() > 1e-3);
        // The trace is -1, where the textbook formula divides by zero.
        let q = Quaternion::from_axis_angle(&axis.normalize(), std::f64::consts::PI);
        let back = q.rotation().quaternion();
        assert_relative_eq!(back.rotation().matrix, q.rotation().matrix, epsilon = ROUNDING);
    }

    #[test]
    fn agree_quaternion_rotates_as_its_matrix(a in attitude(), v in vector(10.0)) {
        let q = a.quaternion();
        assert_relative_eq!(q.rotate(&v), q.rotation().matrix * v, epsilon = 1e-12);
        assert_relative_eq!(q.conjugate().rotate(&q.rotate(&v)), v, epsilon = 1e-12);
    }

    #[test]
    fn prop_rate_matrices_are_inverse(a in attitude()) {
        // J grows as 1/cos(pitch).
        assert_relative_eq!(a.rate_matrix() * a.body_rate_matrix(), Matrix3::identity(), epsilon = 1e-12);
    }

    /// D.3: `d/dt R(η(t)) = R [ω]×` with `ω = J⁻¹ η̇`, the left side by automatic differentiation.
    #[test]
    fn thesis_d3_derivative_of_the_rotation_matrix(
        a in vector(1.0), b in vector(0.5), c in vector(5.0), t in 0.0..10.0,
    ) {
        let eta = history(Dual64::from(t).derivative(), &a, &b, &c);
        let left = eta.rotation().matrix.map(|x| x.eps);
        let now = EulerAngles::from_vector(&eta.vector().map(|x| x.re));
        let omega = now.body_rates(&EulerRates::from_vector(&eta.vector().map(|x| x.eps)));
        assert_relative_eq!(left, now.rotation().derivative(&omega), epsilon = ROUNDING * 10.0);
        // The same for the quaternion: the derivative of q(η(t)) is ½ q ⊗ [0, ω].
        let q = eta.quaternion();
        let rate = now.quaternion().derivative(&omega);
        prop_assert!((q.w.eps - rate.w).abs() < ROUNDING * 10.0);
        assert_relative_eq!(q.v.map(|x| x.eps), rate.v, epsilon = ROUNDING * 10.0);
    }

    /// Law 9: the three representations, each integrated by its own rate kinematics, agree.
    #[test]
    fn agree_integration_of_the_three_representations(
        a in vector(0.5), b in vector(0.4), c in vector(2.0),
    ) {
        let omega = |t: f64| {
            let eta = history(Dual64::from(t).derivative(), &a, &b, &c);
            let now = EulerAngles::from_vector(&eta.vector().map(|x| x.re));
            now.body_rates(&EulerRates::from_vector(&eta.vector().map(|x| x.eps)))
        };
        let start = history(0.0, &a, &b, &c);
        let (h, steps) = (1e-3, 1000);
        let (mut euler, mut q) = (start, start.quaternion());
        let mut r: nalgebra::SVector<f64, 9> = nalgebra::SVector::read(start.rotation().matrix.as_slice());
        for k in 0..steps {
            let t = k as f64 * h;
            euler = rk4(&|t, x: &EulerAngles<f64>| x.rates(&omega(t)), t, &euler, h);
            q = rk4(&|t, x: &Quaternion<f64>| x.derivative(&omega(t)), t, &q, h);
            let f = |t, x: &nalgebra::SVector<f64, 9>| {
                let m = Rotation::<f64, Body, World>::from_matrix(Matrix3::from_column_slice(x.as_slice()));
                nalgebra::SVector::read(m.derivative(&omega(t)).as_slice())
            };
            r = rk4(&f, t, &r, h);
        }
        let end = history(1.0, &a, &b, &c);
        // RK4 with h = 1 ms on rates below 10 rad/s: local error below (h ω)⁵/120 ≈ 1e-12 a step.
        let tolerance = 1e-9;
        assert_relative_eq!(euler.vector(), end.vector(), epsilon = tolerance);
        assert_relative_eq!(q.rotation().matrix, end.rotation().matrix, epsilon = tolerance);
        assert_relative_eq!(Matrix3::from_column_slice(r.as_slice()), end.rotation().matrix, epsilon = tolerance);
    }

    #[test]
    fn prop_flat_round_trip(a in attitude()) {
        let mut out = [0.0; 7];
        a.write(&mut out);
        a.quaternion().write(&mut out[3..]);
        prop_assert_eq!(EulerAngles::read(&out), a);
        prop_assert_eq!(Quaternion::read(&out[3..]), a.quaternion());
    }

    #[test]
    fn prop_normalised_is_a_unit(a in attitude(), s in 0.5..2.0_f64) {
        let q = a.quaternion();
        let scaled = Quaternion { w: q.w * s, v: q.v * s };
        let size: f64 = scaled.normalised().norm_squared();
        prop_assert!((size - 1.0).abs() < ROUNDING);
        let stretched = Rotation::<f64, Body, World>::from_matrix(a.rotation().matrix * s);
        assert_relative_eq!(stretched.orthonormalised().matrix, a.rotation().matrix, epsilon = ROUNDING);
    }

    #[test]
    fn prop_frames_compose(a in attitude(), v in vector(3.0)) {
        let r_wb = a.rotation();
        let v_b = FrameVector::<f64, Body>::from_components(v);
        let back: FrameVector<f64, Body> = r_wb.then(&r_wb.inverse()).rotate(v_b);
        assert_relative_eq!(back.v, v, epsilon = 1e-12);
        assert_relative_eq!(cross_matrix(&v) * a.vector(), v.cross(&a.vector()), epsilon = 1e-12);
    }
}

#[test]
fn exact_pitch_of_ninety_degrees_is_finite() {
    let straight_up = EulerAngles::new(0.0, std::f64::consts::FRAC_PI_2, 0.4);
    let back = straight_up.rotation().euler_angles();
    assert!(back.vector().iter().all(|x| x.is_finite()));
    // Near the pole asin turns rounding into its square root.
    assert!((back.pitch - straight_up.pitch).abs() < 1e-7);
}
