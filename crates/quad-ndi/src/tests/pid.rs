//! The PID cascade: filter, tilt limit, integral action, anti-windup.

use super::bad_input::pid_settings;
use super::flights::{fly, plan};
use super::*;
use crate::metrics::StepMetrics;
use crate::{AnyController, Controller, FlightLog, Pid, PidGains, PidSettings, Reference};
use quad_dynamics::{CommandLimits, Flight, Level, Level2, Phenomenon, PhenomenonSet};

const NO_GAINS: PidGains = PidGains {
    proportional: 0.0,
    integral: 0.0,
    derivative: 0.0,
};

fn hovering(vehicle: &Vehicle) -> Flight<f64> {
    let model = Level2::<f64>::build(vehicle, &PhenomenonSet::none()).unwrap();
    model.flight(&model.hover(Vector3::zeros(), 0.0).state)
}

#[test]
fn exact_derivative_filter_on_a_ramp() {
    // y = a t through ẏ_f = N (y − y_f): ẏ_f = a (1 − e^(−N t)), at any sampling time.
    let vehicle = Vehicle::qball_x4();
    let (slope, bandwidth) = (0.7, 40.0);
    let settings = PidSettings {
        height: PidGains {
            derivative: 3.0,
            ..NO_GAINS
        },
        filter_bandwidth_rad_s: bandwidth,
        ..pid_settings()
    };
    let pid = Pid::new(&vehicle, &settings).unwrap();
    let rest = Reference::hold(Vector3::zeros(), 0.0);
    for h in [1e-3, 5e-3, 0.05] {
        let mut flight = hovering(&vehicle);
        let mut memory = pid.initial_memory();
        for k in 0..100 {
            let t = f64::from(k) * h;
            flight.position.z = slope * t;
            let answer = pid.control(&memory, &flight, &rest, h);
            memory = answer.memory;
            let thrust = answer.commands.iter().sum::<f64>() * vehicle.linear_rotor.thrust_gain;
            // T = m (g + k_d ẏ_f): sinking asks for more.
            let rate = (thrust / vehicle.airframe.mass - vehicle.environment.gravity) / 3.0;
            let truth = slope * (1.0 - (-bandwidth * t).exp());
            // A hundred steps' rounding of the filtered height, up to 3.5 m, over the shortest step.
            assert!((rate - truth).abs() < 1e-10, "{h} {t}: {rate} {truth}");
        }
    }
}

#[test]
fn exact_demanded_tilt_stops_at_its_limit() {
    // Far away in a random direction: the tilt loops, proportional only, show what they were asked for.
    let vehicle = Vehicle::qball_x4();
    let settings = PidSettings {
        attitude: PidGains {
            proportional: 10.0,
            ..NO_GAINS
        },
        tilt_limit_rad: 0.4,
        ..pid_settings()
    };
    let pid = Pid::<f64>::new(&vehicle, &settings).unwrap();
    let far = Reference::hold(Vector3::new(-300.0, 400.0, 0.0), 0.0);
    let answer = pid.control(&pid.initial_memory(), &hovering(&vehicle), &far, 1e-3);
    let thrusts = answer.commands.map(|u| u * vehicle.linear_rotor.thrust_gain);
    let tilt = pid.body.inertia_inverse * pid.allocation.demand(&thrusts).moment / 10.0;
    // Backwards is nose up, right is right side down; rounding of the allocation.
    approx::assert_relative_eq!(tilt, Vector3::new(0.4 * 0.8, 0.4 * 0.6, 0.0), epsilon = 1e-12);
}

fn height_step(settings: &PidSettings, level: Level, on: &PhenomenonSet, step: f64, end_s: f64) -> FlightLog {
    let vehicle = Vehicle::qball_x4();
    let pid = AnyController::Pid(Pid::new(&vehicle, settings).unwrap().into());
    let limits = on
        .contains(Phenomenon::InputLimits)
        .then(|| CommandLimits::of(&vehicle));
    let up = Reference::hold(Vector3::new(0.0, 0.0, -step), 0.0);
    fly(level, on, pid.with_limits(limits), 0.0, &plan(end_s, 10), up)
}

fn metrics(log: &FlightLog, target: f64) -> StepMetrics {
    let response: Vec<(f64, f64)> = log
        .records
        .iter()
        .map(|r| (r.time_s, r.flight.position.z))
        .collect();
    StepMetrics::of(&response, target).unwrap()
}

#[test]
fn prop_integral_action_removes_the_error_of_the_non_linear_rotor() {
    // On level 5 the linear rotor that PID believes in is wrong by some per cent of thrust, and the battery sags.
    let good = pid_settings();
    let without = PidSettings {
        height: PidGains {
            integral: 0.0,
            ..good.height
        },
        ..good
    };
    let on = Level::Five.phenomena();
    let [left, removed] = [without, good].map(|s| {
        let log = height_step(&s, Level::Five, &on, 1.0, 30.0);
        metrics(&log, -1.0).steady_state_error.abs()
    });
    // What remains with it is the lag behind the battery's slow sag.
    assert!(left > 0.02, "{left}");
    assert!(removed < 0.05 * left, "{removed}");
}

#[test]
fn prop_anti_windup_recovers_faster() {
    // 10 m up: the rotors are at their limits for a second, and the integral of the error has time to grow.
    let on = PhenomenonSet::none().with(Phenomenon::InputLimits);
    let fast = pid_settings();
    let slow = PidSettings {
        anti_windup_per_s: 1e-9,
        ..fast
    };
    let [with, without] =
        [fast, slow].map(|s| metrics(&height_step(&s, Level::Three, &on, 10.0, 40.0), -10.0));
    let [settled, late] = [with, without].map(|m| m.settling_time_s.unwrap());
    // Measured: 3.2 s without overshoot against 9.2 s with 19 %.
    assert!(settled < 0.5 * late, "{settled} {late}");
    assert!(
        with.overshoot < 0.02 && without.overshoot > 0.1,
        "{with:?} {without:?}"
    );
}
