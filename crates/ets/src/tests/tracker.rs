//! The tracker's dynamics: exact where the design says exact, finite where the inversion is singular.

use super::{camera, free_gimbal, nominal, pedestal, run};
use crate::image::{ImageKinematics, PointMotion};
use crate::{ErrorDynamics, EtsInput, GimbalState, Plant};
use nalgebra::{Matrix2, Vector2, Vector3};
use proptest::prelude::*;
use quad_math::{System, rk4};
use std::f64::consts::FRAC_PI_2;

const SECOND: ErrorDynamics<f64> = ErrorDynamics::SecondOrder {
    natural_frequency: 5.0,
    damping: 1.0,
};
const FIRST: ErrorDynamics<f64> = ErrorDynamics::FirstOrder { time_constant: 0.3 };

fn kinematics() -> ImageKinematics<f64> {
    ImageKinematics {
        focal_length: camera().focal_length,
    }
}

/// Continuous feedback on a gimbal without limits: the state at `t_end`, from the target's image at `r_0`, platform at rest.
fn track(
    dynamics: ErrorDynamics<f64>,
    start: GimbalState<f64>,
    target: &dyn Fn(f64) -> PointMotion<f64>,
    t_end: f64,
) -> Vec<(f64, Vector2<f64>)> {
    let (gimbal, base, h) = (free_gimbal(), pedestal(), 1e-3);
    let rate = |t: f64, x: &GimbalState<f64>| {
        let plant = Plant {
            state: x,
            gimbal: &gimbal,
            pedestal: &base,
            kinematics: kinematics(),
        };
        gimbal.derivative(x, &dynamics.command(&plant, &target(t)))
    };
    let image = |t: f64, x: &GimbalState<f64>| {
        kinematics().image(&(base.rotation(x).matrix.tr_mul(&target(t).position)))
    };
    let mut x = start;
    let mut history = vec![(0.0, image(0.0, &x))];
    for k in 0..(t_end / h).round() as u32 {
        let t = f64::from(k) * h;
        x = rk4(&rate, t, &x, h);
        history.push((t + h, image(t + h, &x)));
    }
    history
}

/// A target whose image is `r_0` for the platform at these angles.
fn seen_at(start: &GimbalState<f64>, r_0: Vector2<f64>) -> Vector3<f64> {
    pedestal().rotation(start).matrix * camera().direction(&r_0) * 4.0
}

/// Figure 7.6's start, target at rest: `r_C(t) = r_C(0) (1 + ω_n t) e^(−ω_n t)`, exactly, lag and all.
#[test]
fn exact_second_order_error_dynamics() {
    let start = GimbalState::at_rest(-0.4, 0.3);
    let target = PointMotion::at_rest(seen_at(&start, Vector2::new(200.0, 100.0)));
    for (t, r) in track(SECOND, start, &|_| target, 2.0) {
        let closed = Vector2::new(200.0, 100.0) * (1.0 + 5.0 * t) * (-5.0 * t).exp();
        // RK4 at h = 1 ms with the fastest rate 1/τ = 20/s: (20 h)⁴ 200 px/120 = 3e-7 px.
        assert!((r - closed).amax() < 1e-6, "{t}: {r}");
    }
}

/// The same for a target on a known parabola at speed: with its motion fed forward it does not disturb the image at all.
#[test]
fn exact_known_motion_is_cancelled() {
    let start = GimbalState::at_rest(0.2, 0.1);
    let p = seen_at(&start, Vector2::new(-150.0, 80.0));
    let (v, a) = (Vector3::new(0.5, -1.5, -0.6), Vector3::new(-0.4, 0.8, 0.2));
    let target = |t: f64| PointMotion {
        position: p + v * t + a * (t * t / 2.0),
        velocity: v + a * t,
        acceleration: a,
    };
    let r_dot_0 = kinematics().image_velocity(
        &start,
        &target(0.0).along(&pedestal().rotation(&start).matrix.transpose()),
    );
    for (t, r) in track(SECOND, start, &target, 2.0) {
        let r_0 = Vector2::new(-150.0, 80.0);
        let closed = (r_0 + (r_dot_0 + r_0 * 5.0) * t) * (-5.0 * t).exp();
        assert!((r - closed).amax() < 1e-6, "{t}: {r} {closed}");
    }
}

proptest! {
    /// First order: with the commanded rates reached at once, `ṙ_C = −r_C/T`.
    #[test]
    fn exact_first_order_law(
        pan in -3.0..3.0_f64, tilt in -1.2..1.2_f64,
        r in prop::array::uniform2(-300.0..300.0_f64), v in prop::array::uniform3(-2.0..2.0_f64),
    ) {
        let x = GimbalState::at_rest(pan, tilt);
        // Where the inversion is exact.
        let zeta = r[1] / camera().focal_length;
        prop_assume!((tilt.cos() + tilt.sin() * zeta).abs() > crate::SINGULAR);
        let target = PointMotion { velocity: v.into(), ..PointMotion::at_rest(seen_at(&x, r.into())) };
        let plant = Plant { state: &x, gimbal: &free_gimbal(), pedestal: &pedestal(), kinematics: kinematics() };
        let u = FIRST.command(&plant, &target);
        let turning = GimbalState { pan_rate: u.pan_rate, tilt_rate: u.tilt_rate, ..x };
        let r_dot = kinematics().image_velocity(&turning, &target.along(&pedestal().rotation(&x).matrix.transpose()));
        // Image velocities up to 1e4 px/s; the inverse of L loses a digit to 1/SINGULAR.
        prop_assert!((r_dot + Vector2::from(r) / 0.3).amax() < 1e-8, "{r_dot}");
    }

    /// Pivoting from the tilt axis is the inverse of L where L is regular.
    #[test]
    fn agree_with_the_matrix_inverse(tilt in -1.0..1.0_f64, r in prop::array::uniform2(-200.0..200.0_f64)) {
        let x = GimbalState::at_rest(0.3, tilt);
        let plant = Plant { state: &x, gimbal: &free_gimbal(), pedestal: &pedestal(), kinematics: kinematics() };
        let u = FIRST.command(&plant, &PointMotion::at_rest(seen_at(&x, r.into())));
        let l: Matrix2<f64> = kinematics().interaction(tilt, &r.into());
        let q = l.try_inverse().unwrap() * (-Vector2::from(r) / 0.3);
        // Rates of order 1, condition number below 10.
        prop_assert!((q - Vector2::new(u.pan_rate, u.tilt_rate)).amax() < 1e-12);
    }

    /// At and around the zenith and the nadir, target and platform anywhere: finite commands, finite states.
    #[test]
    fn prop_finite_at_the_singularity(
        off in prop::array::uniform3(-1e-3..1e-3_f64), up in prop::bool::ANY,
        pick in 0..3_usize, rates in prop::array::uniform2(-2.0..2.0_f64), second in prop::bool::ANY,
    ) {
        let sign = if up { 1.0 } else { -1.0 };
        let offset = if pick == 0 { Vector3::zeros() } else { Vector3::from(off) };
        let tilt = sign * FRAC_PI_2 + if pick == 1 { off[0] } else { 0.0 };
        let x = GimbalState { pan: off[1], tilt, pan_rate: rates[0], tilt_rate: rates[1] };
        let target = PointMotion { velocity: Vector3::new(1.0, -0.5, 0.1), ..PointMotion::at_rest(Vector3::new(0.0, 0.0, -sign * 4.0) + offset) };
        let plant = Plant { state: &x, gimbal: &crate::Station::nominal().gimbal, pedestal: &pedestal(), kinematics: kinematics() };
        let u = if second { SECOND } else { FIRST }.command(&plant, &target);
        prop_assert!(u.pan_rate.is_finite() && u.tilt_rate.is_finite(), "{u:?}");
    }
}

/// Where pan has no authority tilt keeps all of its own: platform at the zenith, target 50 px below the centre.
#[test]
fn exact_tilt_keeps_its_authority_at_the_zenith() {
    let x = GimbalState::at_rest(0.0, FRAC_PI_2);
    let r_0 = Vector2::new(0.0, 50.0);
    let plant = Plant {
        state: &x,
        gimbal: &free_gimbal(),
        pedestal: &pedestal(),
        kinematics: kinematics(),
    };
    let u = FIRST.command(&plant, &PointMotion::at_rest(seen_at(&x, r_0)));
    let f = camera().focal_length;
    // ζ̇ = θ̇ (1 + ζ²) = −ζ/T.
    let zeta = 50.0 / f;
    assert!(
        (u.tilt_rate + zeta / 0.3 / (1.0 + zeta * zeta)).abs() < 1e-12 && u.pan_rate.abs() < 1e-9,
        "{u:?}"
    );
}

/// Figure 7.6 with the nominal station, sampled and delayed camera, lag and limits: the target ends at the image centre.
#[test]
fn thesis_target_ends_at_the_image_centre() {
    let (station, ets, clock) = nominal();
    let target = ets.camera.direction(&Vector2::new(200.0, 100.0)) * 5.0;
    let mut worst_late = 0.0_f64;
    let end = run(
        &ets,
        &clock,
        ets.at_rest(0.0, 0.0),
        4000,
        |_| target,
        |t, state| {
            let image = ets.view(&state.gimbal, &target);
            assert_eq!(image.visible, 1.0, "{t}: lost");
            if t > 2.0 {
                worst_late = worst_late.max(image.point.norm());
            }
        },
    );
    // (1 + t/T) e^(−t/T) of 224 px at t = 2 s = 10 T is 0.11 px; the designed response started a latency late.
    assert!(worst_late < 0.15, "{worst_late}");
    // At 4 s = 20 T: 1e-5 px.
    assert!(ets.view(&end.gimbal, &target).point.norm() < 1e-4);
    assert_eq!(end.sight.mode(&station.tracker), crate::Mode::Tracking);
}

/// A target that crosses the station's field at 1 m/s, 4 m away, is followed: the filter's lag is all that is left.
#[test]
fn prop_a_crossing_target_is_followed() {
    let (_, ets, clock) = nominal();
    let target = |t: f64| Vector3::new(4.0, -3.0 + t, -1.5);
    let start = ets.at_rest((-3.0_f64).atan2(4.0), (1.5_f64 / 5.0).atan());
    let mut worst = 0.0_f64;
    run(&ets, &clock, start, 6000, target, |t, state| {
        let image = ets.view(&state.gimbal, &target(t));
        assert_eq!(image.visible, 1.0, "{t}: lost");
        // After the filter has found the rate and ten time constants have passed.
        if t > 2.0 {
            worst = worst.max(image.point.norm());
        }
    });
    // By hand. The line of sight accelerates by up to a = 0.65 (1 m/s / 4 m)² = 0.04 rad/s², which is not fed forward: a f/ω_n² = 1.07 px.
    // The filter's rate lags by (2g − h)/2h a T = 1.36 a T with g = 0.91, h = 0.49, T = 33 ms: 1.8 mrad/s, 2 ė f/ω_n = 0.48 px. Its
    // direction lags by that rate over up to 63 ms, by a (63 ms)²/2 and by 0.18 a T²: 0.13 px. Together 1.7 px, and the steps of the frames on top.
    assert!(worst < 2.0, "{worst}");
}

/// Second-order inversion does better than neglecting the lag: the same target, the same time constant.
#[test]
fn agree_both_orders_converge() {
    let (station, _, clock) = nominal();
    for dynamics in [FIRST, SECOND] {
        let mut other = station.clone();
        other.tracker.dynamics = dynamics;
        let ets = crate::Ets::new(&other);
        let target = ets.camera.direction(&Vector2::new(-250.0, 150.0)) * 3.0;
        let end = run(&ets, &clock, ets.at_rest(0.0, 0.0), 6000, |_| target, |_, _| ());
        // 6 s are 20 and 30 time constants.
        assert!(ets.view(&end.gimbal, &target).point.norm() < 1e-3, "{dynamics:?}");
    }
}

/// Noise of 1 px shakes the line of sight by no more than it is itself.
#[test]
fn prop_noise_is_not_amplified() {
    let (_, ets, clock) = nominal();
    let target = Vector3::new(5.0, 0.0, 0.0);
    let mut state = ets.at_rest(0.0, 0.0);
    let (mut sum, mut count) = (0.0, 0.0);
    // A fixed sequence without correlation from frame to frame: the fractional parts of multiples of the golden ratio, ±1.
    let noise = |n: u64| 2.0 * (n as f64 * 0.618_033_988_75).fract() - 1.0;
    for n in 0..20_000 {
        let input = EtsInput {
            target,
            noise: Vector2::new(noise(n), noise(7 * n + 3)),
        };
        state = ets.step(&clock, n, &state, &input);
        if n > 2000 {
            sum += ets.view(&state.gimbal, &target).point.norm_squared();
            count += 1.0;
        }
    }
    let (rms, of_noise) = ((sum / count).sqrt(), (2.0_f64 / 3.0).sqrt());
    assert!(
        rms > 0.0 && rms < of_noise,
        "{rms} px against {of_noise} px of noise"
    );
}
