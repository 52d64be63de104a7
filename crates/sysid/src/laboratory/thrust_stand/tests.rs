use super::*;
use crate::laboratory::{Sensor, generator};
use approx::assert_relative_eq;
use quad_dynamics::vehicle::derive::SteadyRotor;

fn perfect() -> ThrustStand {
    ThrustStand {
        instruments: Instruments::PERFECT,
        ..ThrustStand::of(&Vehicle::qball_x4()).unwrap()
    }
}

const NOMINAL: BenchSupply = BenchSupply::Regulated { voltage_v: 11.1 };

#[test]
fn agree_steady_readings_with_the_closed_form() {
    let stand = perfect();
    let steady = SteadyRotor::of(&Vehicle::qball_x4()).unwrap();
    let sweep = StaticSweep {
        duties: vec![0.05, 0.051, 0.06, 0.0735, 0.1],
        supplies: vec![NOMINAL, BenchSupply::Regulated { voltage_v: 12.6 }],
        readings: 1,
    };
    let samples = stand.sweep(&sweep, &mut generator(0)).unwrap();
    assert_eq!(samples.len(), 10);
    for sample in samples {
        let thrust = steady.thrust(sample.duty - 0.05, sample.battery_voltage_v);
        // Two closed forms of one root: rounding.
        assert_relative_eq!(sample.thrust_n, thrust, max_relative = 1e-10);
        let torque = thrust * steady.torque_constant() / steady.thrust_constant();
        assert_relative_eq!(sample.torque_n_m, torque, max_relative = 1e-9, epsilon = 1e-15);
    }
}

/// The reaction torque less the aerodynamic one is what spins the rotor up: `∫ (Q_m − k_Q Ω²) dt = I_R ΔΩ`.
#[test]
fn prop_angular_momentum_of_a_step() {
    let stand = perfect();
    let step = Step {
        before: 0.062,
        after: 0.08,
        at_s: 0.05,
    };
    let times = uniform_times(1e-4, 0.3).unwrap();
    let samples = stand
        .record(&times, |t| step.at(t), NOMINAL, &mut generator(0))
        .unwrap();
    let net = |s: &DynamicSample| s.torque_n_m - stand.rotor.propeller.torque(s.speed_rad_s);
    let impulse: f64 = samples
        .windows(2)
        .map(|p| 0.5 * (net(&p[0]) + net(&p[1])) * (p[1].time_s - p[0].time_s))
        .sum();
    let gained =
        stand.rotor.motor.rotor_inertia * (samples[samples.len() - 1].speed_rad_s - samples[0].speed_rad_s);
    assert!(gained > 0.0);
    // Trapezoidal rule: h²/12 times the jump of the integrand's slope, (1e-4 s)² · (100/s)/0.1 s, below 1e-5 of the whole.
    assert_relative_eq!(impulse, gained, max_relative = 1e-5);
    // One rotor: spinning up adds to the reaction against the spin.
    let peak = samples.iter().map(|s| s.torque_n_m).fold(0.0, f64::max);
    assert!(peak > samples[samples.len() - 1].torque_n_m);
}

#[test]
fn exact_a_constant_command_stays_at_rest() {
    let stand = perfect();
    let times = irregular_times(0.01, 0.5, &mut generator(1)).unwrap();
    let samples = stand
        .record(&times, |_| 0.0735, NOMINAL, &mut generator(0))
        .unwrap();
    for s in &samples {
        // Rounding of the equilibrium, damped at every step.
        assert_relative_eq!(s.thrust_n, samples[0].thrust_n, max_relative = 1e-12);
    }
}

#[test]
fn exact_a_pack_sags_by_its_resistance() {
    let vehicle = Vehicle::qball_x4();
    let b = vehicle.battery.unwrap();
    let sag = Sag {
        full_voltage: b.full_voltage,
        internal_resistance: b.internal_resistance,
        exponential_amplitude: b.exponential_amplitude,
        exponential_rate: b.exponential_rate,
    };
    let charge_drawn_ah = 0.6;
    let stand = perfect();
    let sweep = StaticSweep {
        duties: vec![0.06, 0.08, 0.1],
        supplies: vec![BenchSupply::Pack { sag, charge_drawn_ah }],
        readings: 1,
    };
    for sample in stand.sweep(&sweep, &mut generator(0)).unwrap() {
        // By hand: motor current K_v Q + I_0, of which the pack gives the fraction d: V = V_oc − R_i d (K_v Q + I_0).
        let motor = &stand.rotor.motor;
        let fraction = (sample.duty - 0.05) / 0.05;
        let current = fraction * (motor.velocity_constant * sample.torque_n_m + motor.no_load_current);
        let expected = sag.open_circuit_voltage(charge_drawn_ah) - b.internal_resistance * current;
        // Sixty halvings reach rounding.
        assert_relative_eq!(sample.battery_voltage_v, expected, max_relative = 1e-12);
        // The controller neither makes nor loses power: V_b I_b = V_eff I.
        let effective = stand.rotor.steady_voltage(sample.speed_rad_s);
        assert_relative_eq!(
            effective,
            fraction * sample.battery_voltage_v,
            max_relative = 1e-10
        );
    }
}

#[test]
fn exact_properties_of_a_maximal_sequence() {
    let bits = excitation::maximal_sequence();
    let signs: Vec<i32> = bits.iter().map(|b| if *b { 1 } else { -1 }).collect();
    // Golomb: one more of the one kind, and autocorrelation −1 at every shift within the period.
    assert_eq!(signs.iter().sum::<i32>(), 1);
    for shift in 1..excitation::PERIOD {
        let sum: i32 = (0..excitation::PERIOD)
            .map(|i| signs[i] * signs[(i + shift) % excitation::PERIOD])
            .sum();
        assert_eq!(sum, -1, "shift {shift}");
    }
    let signal = Prbs {
        centre: 0.07,
        amplitude: 0.002,
        hold_s: 0.03,
        skipped_bits: 5,
    }
    .signal();
    for (k, bit) in bits.iter().skip(5).enumerate().take(200) {
        let expected = if *bit { 0.07 + 0.002 } else { 0.07 - 0.002 };
        // At the change of a bit and just before the next.
        assert_eq!(signal(0.03 * k as f64), expected);
        assert_eq!(signal(0.03 * (k as f64 + 0.99)), expected);
    }
}

#[test]
fn regress_seeds_repeat_and_rotors_differ() {
    let vehicle = Vehicle::qball_x4();
    let four = |seed| ThrustStand::four(&vehicle, &RotorSpread::default(), &mut generator(seed)).unwrap();
    assert_eq!(four(3), four(3));
    assert_ne!(four(3), four(4));
    let thrusts = four(3).map(|stand| stand.steady(0.0735, 11.1).thrust);
    for (i, a) in thrusts.iter().enumerate() {
        // Deviations cut at three: 1.5 % of thrust, 2 · 1 % and some of 3 % of the motor's, each at most three times.
        assert!((a / 3.43 - 1.0).abs() < 0.2, "{a}");
        assert!(thrusts[..i].iter().all(|b| (a - b).abs() > 1e-3));
    }
    let noisy = ThrustStand::of(&vehicle).unwrap();
    let record = |seed| {
        let times = uniform_times(0.01, 0.2).unwrap();
        noisy
            .record(&times, |_| 0.07, NOMINAL, &mut generator(seed))
            .unwrap()
    };
    assert_eq!(record(1), record(1));
    assert_ne!(record(1), record(2));
}

#[test]
fn exact_refusals() {
    let stand = perfect();
    let random = &mut generator(0);
    assert!(matches!(
        stand.record(&[0.0, 0.1, 0.1], |_| 0.07, NOMINAL, random),
        Err(StandError::Times { index: 2, .. })
    ));
    assert!(matches!(
        stand.record(&[0.0, 0.1], |_| 0.04, NOMINAL, random),
        Err(StandError::Duty { .. })
    ));
    assert!(matches!(
        stand.record(
            &[0.0, 0.1],
            |_| 0.07,
            BenchSupply::Regulated { voltage_v: 0.0 },
            random
        ),
        Err(StandError::NotPositive { .. })
    ));
    let mut broken = stand;
    broken.instruments.torque = Sensor::noisy(-1.0);
    assert!(matches!(
        broken.record(&[0.0, 0.1], |_| 0.07, NOMINAL, random),
        Err(StandError::Sensor {
            instrument: "torque",
            ..
        })
    ));
    assert!(uniform_times(0.0, 1.0).is_err());
    assert!(irregular_times(0.1, f64::NAN, random).is_err());
    assert!(ThrustStand::of(&Vehicle::qball_x4_vendor()).is_err());
}
