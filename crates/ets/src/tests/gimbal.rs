use super::{free_gimbal, pedestal};
use crate::{Gimbal, GimbalCommand, GimbalState, Station, platform_rate_matrix};
use nalgebra::{Matrix3, Vector2, Vector3};
use proptest::prelude::*;
use quad_kinematics::cross_matrix;
use quad_math::{Flat, jacobian, rk4_step};

fn command(pan_rate: f64, tilt_rate: f64) -> GimbalCommand<f64> {
    GimbalCommand { pan_rate, tilt_rate }
}

/// `ω(t) = u (1 − e^(−t/τ))`, `ψ(t) = u (t − τ (1 − e^(−t/τ)))`.
#[test]
fn exact_first_order_response_to_a_step() {
    let (gimbal, h, u) = (free_gimbal(), 1e-3, [0.4, -0.3]);
    let mut x = GimbalState::at_rest(0.1, -0.2);
    for _ in 0..200 {
        x = rk4_step(&gimbal, &x, &command(u[0], u[1]), h);
    }
    let (t, tau) = (0.2, 0.05_f64);
    let grown = 1.0 - (-t / tau).exp();
    // RK4: t/τ (h/τ)⁴/120 = 5e-9 of u.
    assert!((x.pan_rate - u[0] * grown).abs() < 2e-9 && (x.tilt_rate - u[1] * grown).abs() < 2e-9);
    assert!((x.pan - 0.1 - u[0] * (t - tau * grown)).abs() < 1e-9);
    assert!((x.tilt + 0.2 - u[1] * (t - tau * grown)).abs() < 1e-9);
}

#[test]
fn exact_signs_of_pan_and_tilt() {
    let north = crate::Pedestal {
        position: [0.0; 3],
        heading: 0.0,
    };
    let axis = |pan, tilt| -> Vector3<f64> {
        let r = north.rotation(&GimbalState::at_rest(pan, tilt)).matrix;
        r.column(0).into_owned()
    };
    let quarter = std::f64::consts::FRAC_PI_2;
    // Sine and cosine of π/2 in double precision: 6e-17.
    assert!(
        (axis(quarter, 0.0) - Vector3::y()).norm() < 1e-15,
        "pan clockwise from above: north to east"
    );
    assert!(
        (axis(0.0, quarter) + Vector3::z()).norm() < 1e-15,
        "tilt upwards: to the zenith, −z"
    );
    assert!((axis(quarter, 0.3).z + 0.3_f64.sin()).abs() < 1e-15);
}

proptest! {
    /// `Ṙ_WE = R_WE [ω_E]×` with `ω_E = J(θ) q̇`, Ṙ by automatic differentiation.
    #[test]
    fn agree_platform_rates_with_the_rotation(pan in -3.0..3.0_f64, tilt in -1.5..1.5_f64, q in prop::array::uniform2(-2.0..2.0_f64)) {
        let base = pedestal();
        let columns = jacobian(
            |x: &[quad_math::Dual<2>; 2]| {
                let m = base.over().rotation(&GimbalState::at_rest(x[0], x[1])).matrix;
                let flat: [_; 9] = std::array::from_fn(|i| m[i]);
                flat
            },
            [pan, tilt],
        );
        let r_dot = Matrix3::from_column_slice((columns * Vector2::from(q)).as_slice());
        let r = base.rotation(&GimbalState::at_rest(pan, tilt)).matrix;
        let w = platform_rate_matrix(tilt) * Vector2::from(q);
        // Products of a handful of numbers up to 2.
        prop_assert!((r_dot - r * cross_matrix(&w)).norm() < 1e-14);
    }

    /// The proof in the module's head: an axis that can still brake never leaves its travel, and no rate exceeds its limit,
    /// whatever is commanded.
    #[test]
    fn prop_limits_are_kept(
        start in prop::array::uniform2(0.0..1.0_f64),
        commands in prop::collection::vec(prop::array::uniform2(-50.0..50.0_f64), 40),
    ) {
        let gimbal = Station::nominal().gimbal;
        let at = |axis: &crate::GimbalAxis<f64>, share: f64| axis.minimum + share * (axis.maximum - axis.minimum);
        let mut x = GimbalState::at_rest(at(&gimbal.pan, start[0]), at(&gimbal.tilt, start[1]));
        for [pan, tilt] in commands {
            for _ in 0..50 {
                x = rk4_step(&gimbal, &x, &command(pan, tilt), 1e-3);
                // RK4 over the kink where the stop becomes active: h² ω_max/τ = 4e-5 at most; at the end of travel the
                // motion is smooth, so rounding is what remains.
                for (angle, rate, axis) in [(x.pan, x.pan_rate, &gimbal.pan), (x.tilt, x.tilt_rate, &gimbal.tilt)] {
                    prop_assert!(angle >= axis.minimum - 1e-9 && angle <= axis.maximum + 1e-9, "{angle}");
                    prop_assert!(rate.abs() <= axis.rate_limit * (1.0 + 1e-12), "{rate}");
                }
            }
        }
    }

    #[test]
    fn prop_flat_round_trip(v in prop::array::uniform4(-1e3..1e3_f64)) {
        let mut out = [0.0; 4];
        <GimbalState<f64> as Flat<f64>>::read(&v).write(&mut out);
        prop_assert_eq!(out, v);
    }
}

/// Critically damped at the stop: reached without overshoot, closed form `e(t) = (e_0 + (ė_0 + λe_0) t) e^(−λt)`, λ = 1/2τ.
#[test]
fn exact_braking_at_the_end_stop() {
    let mut gimbal: Gimbal<f64> = free_gimbal();
    (gimbal.pan.maximum, gimbal.pan.rate_limit) = (1.0, 2.0);
    let (tau, lambda) = (gimbal.pan.time_constant, 0.5 / gimbal.pan.time_constant);
    // On the edge of the stop's reach at full speed.
    let e_0 = 4.0 * tau * gimbal.pan.rate_limit;
    let mut x = GimbalState {
        pan: 1.0 - e_0,
        tilt: 0.0,
        pan_rate: 2.0,
        tilt_rate: 0.0,
    };
    for k in 1..=1000 {
        x = rk4_step(&gimbal, &x, &command(100.0, 0.0), 1e-3);
        let t = f64::from(k) * 1e-3;
        let e = (e_0 + (lambda * e_0 - 2.0) * t) * (-lambda * t).exp();
        // RK4: (λh)⁴ λt/120 e_0 is below 1e-9.
        assert!((1.0 - x.pan - e).abs() < 1e-9, "{t}");
    }
}
