//! The mechanistic rotor about hover: identified poles against the closed form of its linearisation.

use super::*;
use crate::laboratory::thrust_stand::{BenchSupply, Step, ThrustStand};
use crate::rotor_static::tests::{Judged, assert_covered};
use quad_dynamics::Vehicle;
use quad_dynamics::vehicle::derive::SteadyRotor;

/// A recording about hover, and the rotor linearised at its mean.
struct AboutHover {
    steady: SteadyRotor,
    /// Steady speed at the mean of the commands, rad/s: a piece of a sequence is not quite balanced, and the slope of the thrust
    /// grows by 4 % per ten percent of thrust.
    speed: f64,
    samples: Vec<DynamicSample>,
}

fn about_hover(amplitude: f64, seed: u64) -> AboutHover {
    let vehicle = Vehicle::qball_x4();
    let steady = SteadyRotor::of(&vehicle).unwrap();
    let hover = steady.speed_at_thrust(vehicle.hover_thrust_per_rotor());
    let signal = Prbs {
        centre: 0.05 + steady.duty(hover, 11.1),
        amplitude,
        hold_s: 0.03,
        skipped_bits: 0,
    };
    let samples = ThrustStand::of(&vehicle)
        .unwrap()
        .record(
            &uniform_times(0.005, 4.0).unwrap(),
            signal.signal(),
            BenchSupply::Regulated { voltage_v: 11.1 },
            &mut generator(seed),
        )
        .unwrap();
    let mean = samples.iter().map(|s| s.duty).sum::<f64>() / samples.len() as f64;
    AboutHover {
        steady,
        speed: steady.speed(steady.effective_voltage(mean - 0.05, 11.1)),
        samples,
    }
}

/// The amplitude keeps the rotor nearly linear: thrust within a tenth of hover, where its pole moves by 0.25 of 14.5 rad/s,
/// evenly to both sides, so that to first order the mean stays.
const SMALL: f64 = 0.0015;

/// Intervals identified from small signals contain the closed form of the linearised rotor as often as they say.
#[test]
fn agree_small_signals_about_hover_with_the_linearised_rotor() {
    assert_covered(|seed| {
        let AboutHover {
            steady,
            speed,
            samples,
        } = about_hover(SMALL, seed);
        let linear = steady.rotor_dynamics(speed);
        let fit = |output: fn(&DynamicSample) -> f64, structure| {
            let record = Record::of(&samples, |s| s.duty, output).unwrap();
            identify(&record, structure, Start::Equilibrium).unwrap()
        };
        let thrust = fit(|s| s.thrust_n, Structure::SecondOrder);
        let torque = fit(|s| s.torque_n_m, Structure::SecondOrderWithZero);
        let (Poles::Real { slow, fast }, Coefficients::SecondOrderWithZero { c1, c3, c4, .. }) =
            (thrust.poles, torque.coefficients)
        else {
            panic!()
        };
        let judged = |name, estimate, truth| Judged {
            name,
            estimate,
            truth,
        };
        vec![
            judged("motor pole", slow, steady.motor_pole(speed)),
            judged("controller pole", fast, 100.0),
            judged("slope at hover", thrust.gain, steady.thrust_slope(speed, 11.1)),
            judged("c_Q1", c1, linear.torque_c1),
            judged("c_Q3", c3, linear.torque_c3),
            judged("c_Q4", c4, linear.torque_c4),
        ]
    });
}

#[test]
fn prop_small_signals_leave_white_residuals_and_the_right_structures() {
    let samples = about_hover(SMALL, 1).samples;
    for (output, structure) in [
        (
            (|s| s.thrust_n) as fn(&DynamicSample) -> f64,
            Structure::SecondOrder,
        ),
        (|s| s.torque_n_m, Structure::SecondOrderWithZero),
    ] {
        let record = Record::of(&samples, |s| s.duty, output).unwrap();
        let chosen = select(&record, &[], Start::Equilibrium).unwrap().chosen;
        assert_eq!(chosen.structure, structure);
        assert!(chosen.warnings.is_empty(), "{:?}", chosen.warnings);
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
    let samples = about_hover(0.012, 1).samples;
    let record = Record::of(&samples, |s| s.duty, |s| s.thrust_n).unwrap();
    let fit = identify(&record, Structure::SecondOrder, Start::Equilibrium).unwrap();
    assert!(!fit.whiteness.is_white());
}
