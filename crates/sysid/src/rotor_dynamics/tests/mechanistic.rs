//! The mechanistic rotor about hover: identified poles against the closed form of its linearisation.

use super::*;
use crate::laboratory::thrust_stand::{BenchSupply, Step, ThrustStand};
use quad_dynamics::Vehicle;
use quad_dynamics::vehicle::derive::SteadyRotor;

/// Duty, speed and linearised dynamics at hover, and a recording about it.
fn about_hover(amplitude: f64, seed: u64) -> (SteadyRotor, f64, Vec<DynamicSample>) {
    let vehicle = Vehicle::qball_x4();
    let steady = SteadyRotor::of(&vehicle).unwrap();
    let speed = steady.speed_at_thrust(vehicle.hover_thrust_per_rotor());
    let signal = Prbs {
        centre: 0.05 + steady.duty(speed, 11.1),
        amplitude,
        hold_s: 0.03,
        skipped_bits: 0,
    };
    let samples = ThrustStand::of(&vehicle)
        .unwrap()
        .record(
            &uniform_times(0.005, 10.0).unwrap(),
            signal.signal(),
            BenchSupply::Regulated { voltage_v: 11.1 },
            &mut generator(seed),
        )
        .unwrap();
    (steady, speed, samples)
}

/// The amplitude keeps the rotor nearly linear: thrust within a tenth of hover, where its pole moves by 0.25 of 14.5 rad/s,
/// evenly to both sides, so that to first order the mean stays.
const SMALL: f64 = 0.0015;

#[test]
fn agree_small_signals_about_hover_with_the_linearised_rotor() {
    let (steady, speed, samples) = about_hover(SMALL, 1);
    let linear = steady.rotor_dynamics(speed);
    let thrust = Record::of(&samples, |s| s.duty, |s| s.thrust_n).unwrap();
    let fit = identify(&thrust, Structure::SecondOrder, Start::Equilibrium).unwrap();
    assert!(fit.warnings.is_empty(), "{:?}", fit.warnings);
    let (Coefficients::SecondOrder { c1, c2 }, Poles::Real { slow, fast }) = (fit.coefficients, fit.poles)
    else {
        panic!()
    };
    let slope = steady.thrust_slope(speed, 11.1);
    for (name, estimate, truth) in [
        ("motor pole", slow, steady.motor_pole(speed)),
        ("controller pole", fast, 100.0),
        ("c_T1", c1, linear.thrust_c1),
        ("c_T2", c2, linear.thrust_c2),
        ("slope at hover", fit.gain, slope),
    ] {
        assert!(
            estimate.interval().contains(truth),
            "{name}: {estimate:?}, linearised {truth}"
        );
    }

    let torque = Record::of(&samples, |s| s.duty, |s| s.torque_n_m).unwrap();
    let selection = select(&torque, &[], Start::Equilibrium).unwrap();
    let fit = selection.chosen;
    assert_eq!(fit.structure, Structure::SecondOrderWithZero);
    assert!(fit.warnings.is_empty(), "{:?}", fit.warnings);
    let Coefficients::SecondOrderWithZero { c1, c3, c4, .. } = fit.coefficients else {
        panic!()
    };
    for (name, estimate, truth) in [
        ("c_Q1", c1, linear.torque_c1),
        ("c_Q3", c3, linear.torque_c3),
        ("c_Q4", c4, linear.torque_c4),
    ] {
        assert!(
            estimate.interval().contains(truth),
            "{name}: {estimate:?}, linearised {truth}"
        );
    }
}

/// Rate a of the exponential nearest to the step response of two poles, by `∂/∂a ∫ (e^{−at} − g(t))² dt = 0` with
/// `g = (p_2 e^{−p_1 t} − p_1 e^{−p_2 t})/(p_2 − p_1)`:
/// `−1/(2a²) + 2/(p_2 − p_1) [p_2/(a + p_1)² − p_1/(a + p_2)²] = 0`.
fn nearest_exponential(p1: f64, p2: f64) -> f64 {
    let slope = |a: f64| {
        let both = p2 / (a + p1).powi(2) - p1 / (a + p2).powi(2);
        2.0 * both / (p2 - p1) - 0.5 / (a * a)
    };
    let (mut low, mut high) = (0.5 * p1, p1);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if slope(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Level 3 has one pole: the bandwidth fitted to a step is that of the exponential nearest to the two poles' response, and the
/// residuals say that a pole is missing.
#[test]
fn exact_first_order_bandwidth_of_a_step() {
    let vehicle = Vehicle::qball_x4();
    let steady = SteadyRotor::of(&vehicle).unwrap();
    let speed = steady.speed_at_thrust(vehicle.hover_thrust_per_rotor());
    let duty = 0.05 + steady.duty(speed, 11.1);
    let step = Step {
        before: duty - SMALL,
        after: duty + SMALL,
        at_s: 0.1,
    };
    // A sensor ten times as good: the second pole must show in a single step.
    let mut stand = ThrustStand::of(&vehicle).unwrap();
    stand.instruments.thrust.noise = 0.003;
    stand.instruments.thrust.quantum = 0.0;
    let samples = stand
        .record(
            &uniform_times(0.002, 1.5).unwrap(),
            |t| step.at(t),
            BenchSupply::Regulated { voltage_v: 11.1 },
            &mut generator(1),
        )
        .unwrap();
    let record = Record::of(&samples, |s| s.duty, |s| s.thrust_n).unwrap();
    let fit = identify(&record, Structure::FirstOrder, Start::Equilibrium).unwrap();
    let Coefficients::FirstOrder { bandwidth } = fit.coefficients else {
        panic!()
    };
    let truth = nearest_exponential(steady.motor_pole(speed), 100.0);
    println!(
        "ω_R = {:.2} ± {:.2} rad/s, nearest exponential {truth:.2}",
        bandwidth.value,
        bandwidth.half_width()
    );
    // The rotor's pole moves by 0.25 rad/s between the ends of the step: that far the linearisation is off at most.
    assert!((bandwidth.value - truth).abs() < bandwidth.half_width() + 0.25);
    assert!(!fit.whiteness.is_white());
    let selection = select(&record, &[], Start::Equilibrium).unwrap();
    assert_eq!(selection.chosen.structure.order(), 2);
}

/// A large step leaves what is linear: the same fit to it must not claim white residuals.
#[test]
fn prop_large_signals_are_announced_as_not_linear() {
    let (_, _, samples) = about_hover(0.012, 1);
    let record = Record::of(&samples, |s| s.duty, |s| s.thrust_n).unwrap();
    let fit = identify(&record, Structure::SecondOrder, Start::Equilibrium).unwrap();
    assert!(!fit.whiteness.is_white());
}
