//! How gusts turn the air.

use crate::air::{setup, turbulent};
use crate::support::{ms, run_recorded, vehicle};
use quad_dynamics::{Level, Vehicle};
use sifre::quadrotor::{Gusts, Setup};
use sifre::{Engine, Member, ModelQuadrotor, Recording};
use std::sync::Arc;

/// The vehicle, or one whose rates the air does not damp.
fn damped(share: f64) -> Arc<Vehicle> {
    let mut vehicle = Vehicle::clone(&vehicle());
    vehicle.drag.as_mut().unwrap().rate_damping *= share;
    Arc::new(vehicle)
}

/// A flight in turbulence with these gusts at level 4, which keeps its height.
fn turned(gusts: Gusts, seed: u64, vehicle: &Arc<Vehicle>, duration_s: f64) -> Recording {
    let mut script = turbulent(seed);
    script.wind.turbulence.as_mut().unwrap().gusts = gusts;
    let setup = Setup {
        vehicle: Arc::clone(vehicle),
        ..setup(Level::Four.into(), script)
    };
    let member = Member::new(ModelQuadrotor::new(setup).unwrap(), ms(2.0));
    run_recorded(&mut Engine::new(vec![member]).unwrap(), duration_s).1
}

fn column(recording: &Recording, name: &str) -> Vec<f64> {
    recording.column(&format!("a.{name}")).unwrap().collect()
}

/// Rotation of the air of three flights about the wind's axes: standard deviations of the formula, by hand.
#[test]
fn exact_gusts_turn_about_the_wind_s_axes() {
    let (mut squares, mut n) = ([0.0; 3], 0.0);
    for seed in [1, 2, 3] {
        let recording = turned(Gusts::All, seed, &damped(1.0), 200.0);
        let rate = |axis: &str| column(&recording, &format!("air_rate.{axis}"));
        for ((x, y), z) in rate("x").into_iter().zip(rate("y")).zip(rate("z")) {
            let about = [0.6 * x - 0.8 * y, 0.8 * x + 0.6 * y, z];
            for axis in 0..3 {
                squares[axis] += about[axis] * about[axis];
            }
            n += 1.0;
        }
    }
    // 5 m up, b = 0.654 m: σ_p = 0.8 √(0.8 (5π/4b)^⅓ π²/(40 b)); ℓ_q = 0.8327 m of L_w = 5 m, ℓ_r = 0.6245 m of L_v = 36.55 m.
    let expected = [0.5925, 0.4339, 0.3936];
    for axis in 0..3 {
        let deviation = f64::sqrt(squares[axis] / n);
        // Correlated over 2ℓ_q/V = 0.33 s at most: a standard error of √(0.33/1200) = 1.7 %. Three of them.
        assert!(
            (deviation / expected[axis] - 1.0).abs() < 0.05,
            "axis {axis}: {deviation}"
        );
    }
}

/// Rotation draws from numbers of its own and is felt through the damping alone: without it the flight is the same bit for bit, with
/// it another. Without rotation nothing of it is recorded.
#[test]
fn exact_rotation_leaves_the_other_gusts_alone() {
    let flown = |gusts, damping| turned(gusts, 5, &damped(damping), 20.0);
    let (all, linear) = (flown(Gusts::All, 0.0), flown(Gusts::Linear, 0.0));
    for name in ["wind.x", "wind.y", "wind.z", "position.x", "body_rate.p"] {
        assert_eq!(column(&all, name), column(&linear, name), "{name}");
    }
    let (all, linear) = (flown(Gusts::All, 1.0), flown(Gusts::Linear, 1.0));
    let (gusts, alone) = (column(&all, "wind.x"), column(&linear, "wind.x"));
    // The same numbers from the start on; after a step of 2 ms the airspeed is another in its last bits.
    assert!(gusts[0] == alone[0] && (gusts[1] - alone[1]).abs() < 1e-12);
    let apart = column(&all, "body_rate.p")
        .into_iter()
        .zip(column(&linear, "body_rate.p"));
    let most = apart.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    // d_x p_g/I_xx = 0.016 · 0.6/0.03 = 0.3 rad/s² over some tenths of a second.
    assert!((0.01..0.5).contains(&most), "{most} rad/s");
    assert!(all.column("a.air_rate.x").is_some() && linear.column("a.air_rate.x").is_none());
}
