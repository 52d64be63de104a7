use super::{camera, pedestal};
use crate::image::{ImageKinematics, PointMotion};
use crate::{GimbalState, SINGULAR};
use nalgebra::{Vector2, Vector3};
use num_dual::Dual3_64;
use proptest::prelude::*;
use quad_math::{Dual, Real, Taylor3, constant, jacobian};

/// The image of a point `p_W` from the crossing of the axes, at pan and tilt.
fn image<R: Real>(pan: R, tilt: R, p_w: &Vector3<R>) -> Vector2<R> {
    let r_wc = pedestal()
        .over()
        .rotation(&GimbalState::at_rest(pan, tilt))
        .matrix;
    camera().over().project(&r_wc.tr_mul(p_w)).point
}

fn kinematics() -> ImageKinematics<f64> {
    ImageKinematics {
        focal_length: camera().focal_length,
    }
}

/// A target in front of the camera, up to 45° off its axis on each side, and the gimbal's angles.
fn scene() -> impl Strategy<Value = (f64, f64, Vector3<f64>)> {
    let slopes = prop::array::uniform2(-1.0..1.0_f64);
    (-3.0..3.0_f64, -1.5..1.5_f64, slopes, 0.5..20.0_f64).prop_map(|(pan, tilt, slopes, depth)| {
        let r = pedestal().rotation(&GimbalState::at_rest(pan, tilt)).matrix;
        (
            pan,
            tilt,
            r * Vector3::new(depth, depth * slopes[0], depth * slopes[1]),
        )
    })
}

proptest! {
    /// The hand-derived interaction against automatic differentiation of rotation and projection.
    #[test]
    fn agree_interaction_with_automatic_differentiation((pan, tilt, p_w) in scene()) {
        let by_duals = jacobian(
            |x: &[Dual<2>; 2]| {
                let r = image(x[0], x[1], &p_w.map(constant));
                [r.x, r.y]
            },
            [pan, tilt],
        );
        let by_hand = kinematics().interaction(tilt, &image(pan, tilt, &p_w));
        // Numbers up to f (1 + 2) = 2000 with a few roundings each.
        prop_assert!((by_duals - by_hand).amax() < 1e-10, "{by_duals} {by_hand}");
    }

    /// The part of the image's velocity that is the target's.
    #[test]
    fn agree_target_motion_with_automatic_differentiation((pan, tilt, p_w) in scene(), v in prop::array::uniform3(-3.0..3.0_f64)) {
        let by_duals = jacobian(
            |x: &[Dual<3>; 3]| {
                let r = image(constant(pan), constant(tilt), &Vector3::from(*x));
                [r.x, r.y]
            },
            p_w.into(),
        ) * Vector3::from(v);
        let r_cw = pedestal().rotation(&GimbalState::at_rest(pan, tilt)).matrix.transpose();
        let by_hand = kinematics().target_motion(&(r_cw * p_w), &(r_cw * Vector3::from(v)));
        // Numbers up to f/x v = 2e4 with a few roundings each.
        prop_assert!((by_duals - by_hand).amax() < 1e-9);
    }

    /// `r̈_C = L q̈ + b` against the second time derivative of the image of a target on a parabola, gimbal on another.
    #[test]
    fn agree_image_acceleration_with_taylor_series(
        (pan, tilt, p_w) in scene(),
        q in prop::array::uniform4(-1.5..1.5_f64),
        v in prop::array::uniform3(-3.0..3.0_f64),
        a in prop::array::uniform3(-3.0..3.0_f64),
    ) {
        let series = |x: f64, x1: f64, x2: f64| -> Taylor3 { Dual3_64::new(x, x1, x2, 0.0) };
        let moving = Vector3::from_fn(|i, _| series(p_w[i], v[i], a[i]));
        let r = image(series(pan, q[0], q[2]), series(tilt, q[1], q[3]), &moving);

        let state = GimbalState { pan, tilt, pan_rate: q[0], tilt_rate: q[1] };
        let r_cw = pedestal().rotation(&state).matrix.transpose();
        let target_c = PointMotion { position: p_w, velocity: v.into(), acceleration: a.into() }.along(&r_cw);
        let k = kinematics();
        let velocity = k.image_velocity(&state, &target_c);
        let image = k.image(&target_c.position);
        let acceleration = k.interaction(tilt, &image) * Vector2::new(q[2], q[3])
            + k.image_acceleration_at_constant_rates(&state, &target_c);
        // Cancellation among terms up to f (v/x)² = 3e4 f for the nearest targets; relative to the largest of them.
        let scale = 1.0 + acceleration.amax().max(velocity.amax());
        prop_assert!((velocity - Vector2::new(r.x.v1, r.y.v1)).amax() < 1e-11 * scale);
        prop_assert!((acceleration - Vector2::new(r.x.v2, r.y.v2)).amax() < 1e-10 * scale);
    }

    /// `det L = −f² (1 + η² + ζ²)(c + s ζ)`.
    #[test]
    fn exact_determinant((pan, tilt, p_w) in scene()) {
        let (k, r) = (kinematics(), image(pan, tilt, &p_w));
        let f = k.focal_length;
        let (eta, zeta) = (r.x / f, r.y / f);
        let closed = -f * f * (1.0 + eta * eta + zeta * zeta) * (tilt.cos() + tilt.sin() * zeta);
        // f² times a few roundings.
        prop_assert!((k.interaction(tilt, &r).determinant() - closed).abs() < 1e-14 * f * f * 10.0);
    }
}

/// At the image centre: pan moves the image left by `f cos θ`, tilt moves it down by f; nothing at the zenith.
#[test]
fn exact_interaction_at_the_centre() {
    let k = kinematics();
    let l = k.interaction(0.4, &Vector2::zeros());
    let expected = nalgebra::Matrix2::new(-0.4_f64.cos(), 0.0, 0.0, 1.0) * k.focal_length;
    assert!((l - expected).amax() < 1e-12);
    let at_zenith = k.interaction(std::f64::consts::FRAC_PI_2, &Vector2::zeros());
    assert!(at_zenith.m11.abs() < 1e-12 && SINGULAR > 0.0);
}
