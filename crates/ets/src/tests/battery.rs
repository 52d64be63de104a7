//! The battery of every model: dual Jacobian = central differences, lane k = scalar, finite over the valid box.

use super::nominal;
use crate::{Aperture, Ets, EtsInput, EtsState, FrameClock, Link, Station};
use nalgebra::{SimdValue, Vector2, Vector3};
use proptest::prelude::*;
use quad_kinematics::EulerAngles;
use quad_math::{F32x8, F64x4, Flat, Real, constant, jacobian};

/// Numbers of a state, and of a flight of the receiver: position and attitude.
const STATE: usize = 17;

/// The map of one step of 10 ms, a frame captured and delivered in it; the target is part of the argument.
fn step<R: Real>(ets: &Ets<R>, x: &[R]) -> [R; STATE] {
    let clock = FrameClock::new(0.01, 50.0, 0.0).unwrap();
    let input = EtsInput {
        target: Vector3::read(&x[STATE..]),
        noise: Vector2::zeros(),
    };
    let mut out = [R::zero(); STATE];
    ets.step(&clock, 2, &EtsState::read(x), &input).write(&mut out);
    out
}

/// The link's outputs as functions of pan, tilt, and the vehicle's position and Euler angles.
fn link<R: Real>(ets: &Ets<R>, x: &[R; 8]) -> [R; 6] {
    let gimbal = crate::GimbalState::at_rest(x[0], x[1]);
    let r_wb = EulerAngles::new(x[5], x[6], x[7]).rotation().matrix;
    let Link { geometry, power } = ets.link(&gimbal, &ets.receiver.on(&Vector3::read(&x[2..]), &r_wb));
    [
        geometry.range,
        geometry.incidence,
        geometry.spot.x,
        geometry.spot.y,
        power.received,
        power.missed,
    ]
}

/// A state in the valid box, away from kinks: target near the axis, gimbal inside its travel, filter running.
fn smooth_state() -> impl Strategy<Value = [f64; STATE + 3]> {
    let gimbal = (-1.5..1.5_f64, 0.0..0.9_f64, prop::array::uniform2(-0.5..0.5_f64));
    let sight = (
        prop::array::uniform3(-0.02..0.02_f64),
        prop::array::uniform2(-0.2..0.2_f64),
        0.1..0.4_f64,
    );
    (gimbal, sight, prop::array::uniform2(-0.2..0.2_f64), 2.0..8.0_f64).prop_map(
        |((pan, tilt, rates), (off, turn, since), aside, range)| {
            let ets = Ets::<f64>::new(&Station::nominal());
            let axis = ets.axis(&crate::GimbalState::at_rest(pan, tilt));
            let s = (axis + Vector3::from(off)).normalize();
            let across = s.cross(&Vector3::z());
            let rate = across * turn[0] + s.cross(&across) * turn[1];
            let r = ets
                .pedestal
                .rotation(&crate::GimbalState::at_rest(pan, tilt))
                .matrix;
            let target = r * Vector3::new(1.0, aside[0], aside[1]) * range;
            let mut x = [0.0; STATE + 3];
            x[..4].copy_from_slice(&[pan, tilt, rates[0], rates[1]]);
            s.write(&mut x[4..]);
            rate.write(&mut x[7..]);
            (x[10], x[11]) = (since, 1.0);
            s.write(&mut x[12..]);
            (x[15], x[16]) = (1.0, 0.01);
            target.write(&mut x[STATE..]);
            x
        },
    )
}

/// Central differences with steps of 1e-5: truncation 1e-10 of the third derivative, rounding 1e-11 of the value.
fn differences<const N: usize, const M: usize>(
    f: impl Fn(&[f64; N]) -> [f64; M],
    x: [f64; N],
) -> nalgebra::SMatrix<f64, M, N> {
    let h = 1e-5;
    nalgebra::SMatrix::from_fn(|i, j| {
        let at = |sign: f64| {
            let mut moved = x;
            moved[j] += sign * h;
            f(&moved)[i]
        };
        (at(1.0) - at(-1.0)) / (2.0 * h)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn agree_dual_jacobian_of_a_step_with_differences(x in smooth_state()) {
        let station = Station::nominal();
        let by_duals = jacobian(|x: &[quad_math::Dual<20>; 20]| step(&Ets::new(&station), x), x);
        let by_differences = differences(|x| step(&Ets::new(&station), x), x);
        // Third derivatives: of the filter e (1 − δ)² 6/t⁴ = 3e3 at t = 0.1 s, of the command some hundreds; times h²/6 = 2e-11.
        let error = (by_duals - by_differences).amax();
        prop_assert!(error < 1e-6, "{error}");
    }

    #[test]
    fn agree_dual_jacobian_of_the_link_with_differences(
        aim in prop::array::uniform2(-0.02..0.02_f64), place in prop::array::uniform3(-1.0..1.0_f64), euler in prop::array::uniform3(0.05..0.5_f64),
        disc in prop::bool::ANY,
    ) {
        let mut station = Station::nominal();
        if disc {
            station.receiver.aperture = Aperture::Disc { radius: 0.15 };
        }
        // A wide spot, so that the edge's third derivatives stay small against the differences' step.
        station.beam.waist_radius = 0.1;
        let position = Vector3::from(place) + Vector3::new(5.0, 0.0, -1.5);
        let euler = [euler[0], -euler[1], euler[2] + std::f64::consts::PI];
        let centre = station.receiver.on(&position, &EulerAngles::new(euler[0], euler[1], euler[2]).rotation().matrix).centre;
        let pan = centre.y.atan2(centre.x) + aim[0];
        let tilt = (-centre.z / centre.xy().norm()).atan() + aim[1];
        let x = [pan, tilt, position.x, position.y, position.z, euler[0], euler[1], euler[2]];
        let by_duals = jacobian(|x| link(&Ets::new(&station), x), x);
        let by_differences = differences(|x| link(&Ets::new(&station), x), x);
        // Received watts: third derivatives up to 5 W (R/w)³ 6 = 4e6 times h²/6 = 2e-11: 7e-5 at the very worst.
        let error = (by_duals - by_differences).amax();
        prop_assert!(error < 1e-4, "{error}");
    }

    /// Four stations at once, each in its own mode, equal four stations one by one.
    #[test]
    fn agree_lanes_with_scalars(xs in prop::array::uniform4(smooth_state()), lost in prop::array::uniform4(0.0..3.0_f64), behind in prop::bool::ANY) {
        let mut xs = xs;
        for (x, lost) in xs.iter_mut().zip(lost) {
            // Tracking, coasting and searching mixed.
            x[10] = lost;
        }
        if behind {
            xs[2][STATE] *= -1.0;
        }
        let station = Station::nominal();
        let lanes: [F64x4; STATE + 3] = std::array::from_fn(|i| F64x4::from([xs[0][i], xs[1][i], xs[2][i], xs[3][i]]));
        let together = step(&Ets::new(&station), &lanes);
        for (k, x) in xs.iter().enumerate() {
            let alone = step(&Ets::<f64>::new(&station), x);
            for i in 0..STATE {
                // Lanes may fuse multiply and add, and have their own sine: 1e-16 each, through gains up to 1/T² h/τ and 1/x.
                prop_assert!((together[i].extract(k) - alone[i]).abs() < 1e-11, "lane {k}, number {i}");
            }
        }
        let args: [F64x4; 8] = std::array::from_fn(|i| {
            F64x4::from(std::array::from_fn(|k| [xs[k][0], xs[k][1], 5.0, 0.1 * lost[k], -1.0, 0.1, 0.2, 3.0 * lost[k]][i]))
        });
        let together = link(&Ets::new(&station), &args);
        for k in 0..4 {
            let alone = link(&Ets::<f64>::new(&station), &args.map(|a| a.extract(k)));
            for i in 0..6 {
                let scale = alone[i].abs().max(1.0);
                prop_assert!((together[i].extract(k) - alone[i]).abs() < 1e-11 * scale, "lane {k}, output {i}");
            }
        }
    }

    /// Anything that may happen, from zenith to behind, from just seen to lost for an hour: finite after a hundred steps.
    #[test]
    fn prop_finite_over_the_valid_box(
        angles in (-2.96..2.96_f64, -0.52..1.57_f64), rates in prop::array::uniform2(-2.0..2.0_f64),
        s in prop::array::uniform3(-1.0..1.0_f64), rate in prop::array::uniform3(-3.0..3.0_f64), since in 0.0..3600.0_f64,
        target in prop::array::uniform3(-20.0..20.0_f64), noise in prop::array::uniform2(-50.0..50.0_f64), on_axis in prop::bool::ANY,
    ) {
        let (_, ets, clock) = nominal();
        let mut state = ets.at_rest(angles.0, if on_axis { std::f64::consts::FRAC_PI_2 } else { angles.1 });
        (state.gimbal.pan_rate, state.gimbal.tilt_rate) = (rates[0], rates[1]);
        state.sight.direction = if on_axis { -Vector3::z() } else { Vector3::from(s) };
        (state.sight.rate, state.sight.since) = (rate.into(), since);
        let target = if on_axis { Vector3::zeros() } else { target.into() };
        let input = EtsInput { target, noise: noise.into() };
        for n in 0..100 {
            state = ets.step(&clock, n, &state, &input);
            let mut flat = [0.0; STATE];
            state.write(&mut flat);
            prop_assert!(flat.iter().all(|v| v.is_finite()), "{n}: {state:?}");
        }
        let link = link(&ets, &[state.gimbal.pan, state.gimbal.tilt, target.x, target.y, target.z, s[0], s[1], rate[0]]);
        prop_assert!(link.iter().all(|v| v.is_finite()), "{link:?}");
    }
}

/// Eight stations in single precision: the same to its digits.
#[test]
fn agree_single_precision_lanes_with_double() {
    let station = Station::nominal();
    let ets = Ets::<f64>::new(&station);
    let target = Vector3::new(5.0, 1.0, -1.2);
    let mut x = [0.0; STATE + 3];
    ets.at_rest(0.1, 0.15).write(&mut x);
    target.write(&mut x[STATE..]);
    let flight = [0.1, 0.15, 5.2, 0.6, -0.9, 0.05, -0.1, 3.3];
    let single = |v: f64| F32x8::splat(v as f32);
    let steps = (step(&ets, &x), step(&Ets::new(&station), &x.map(single)));
    let links = (
        link(&ets, &flight),
        link(&Ets::new(&station), &flight.map(single)),
    );
    let pairs = steps.0.iter().zip(&steps.1).chain(links.0.iter().zip(&links.1));
    for (double, single) in pairs {
        for k in 0..8 {
            let found = f64::from(single.extract(k));
            // 6e-8 per operation; the power's exponent 2ρ²/w², up to 16, and sums over 400 points lose two digits and some.
            assert!(
                (found - double).abs() < 1e-4 * double.abs().max(1.0),
                "{found} {double}"
            );
        }
    }
}

/// Derivatives stay finite where lengths vanish: receiver at the emitter, light square to the face, target at the camera, target at the
/// zenith.
#[test]
fn prop_derivatives_are_finite_at_the_kinks() {
    let station = Station::nominal();
    let offset = station.receiver.offset[0];
    for x in [
        [0.0, 0.0, 5.0 + offset, 0.0, 0.0, 0.0, 0.0, std::f64::consts::PI],
        [0.0, 0.0, -offset, 0.0, 0.0, 0.0, 0.0, 0.0],
        [0.0, std::f64::consts::FRAC_PI_2, 0.0, 0.0, -5.0, 0.0, 0.0, 0.0],
    ] {
        for aperture in [station.receiver.aperture, Aperture::Disc { radius: 0.1 }] {
            let mut other = station.clone();
            other.receiver.aperture = aperture;
            let j = jacobian(|x| link(&Ets::new(&other), x), x);
            assert!(j.iter().all(|v| v.is_finite()), "{x:?} {j}");
        }
    }
    for (since, direction, target) in [
        (0.1, -Vector3::z(), Vector3::new(0.0, 0.0, -3.0)),
        (2.0, -Vector3::z(), Vector3::zeros()),
        (0.1, -Vector3::x(), Vector3::new(-1.0, 0.0, 0.0)),
    ] {
        let ets = Ets::<f64>::new(&station);
        let mut state = ets.at_rest(0.0, 0.0);
        (state.sight.since, state.sight.direction) = (since, direction);
        let mut x = [0.0; STATE + 3];
        state.write(&mut x);
        target.write(&mut x[STATE..]);
        let j = jacobian(|x: &[quad_math::Dual<20>; 20]| step(&Ets::new(&station), x), x);
        assert!(j.iter().all(|v| v.is_finite()), "{j}");
    }
    // A constant is a constant on any scalar.
    assert_eq!(constant::<F64x4>(2.0).extract(3), 2.0);
}
