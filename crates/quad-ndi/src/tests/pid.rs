//! The PID cascade: filter, tilt limit, integral action, anti-windup.

use super::bad_input::pid_settings;
use super::flights::{fly, plan};
use super::*;
use crate::metrics::StepMetrics;
use crate::{AnyController, Controller, FlightLog, Flyer, Pid, PidGains, PidSettings, Reference};
use quad_dynamics::{AnyQuadrotor, CommandLimits, Flight, Level, Level2, Phenomenon, PhenomenonSet};

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

/// Height `−z` over time on level 1 with the heights that a path of `(h, ḣ)` asks for.
fn heights(settings: &PidSettings, path: impl Fn(f64) -> (f64, f64)) -> Vec<(f64, f64)> {
    let vehicle = Vehicle::qball_x4();
    let pid = AnyController::Pid(Pid::new(&vehicle, settings).unwrap().into());
    let model = AnyQuadrotor::hovering(
        Level::One,
        &vehicle,
        &PhenomenonSet::none(),
        Vector3::zeros(),
        0.0,
    );
    let log = Flyer::new(&vehicle, model.unwrap(), pid)
        .unwrap()
        .fly(&plan(8.0, 10), |t| {
            let (height, climb_rate) = path(t);
            let mut reference = Reference::hold(Vector3::new(0.0, 0.0, -height), 0.0);
            reference.flat.velocity.z = -climb_rate;
            reference
        });
    log.records
        .iter()
        .map(|r| (r.time_s, -r.flight.position.z))
        .collect()
}

/// Placed gains in height, their set-point weight, and a derivative filter that is out of the way.
fn placed(omega: f64, integral_pole: f64) -> PidSettings {
    let height = PidGains::placed(omega, integral_pole);
    PidSettings {
        height,
        set_point_weight: omega * omega / height.proportional,
        filter_bandwidth_rad_s: 1e4,
        ..pid_settings()
    }
}

#[test]
fn exact_placed_gains_make_the_step_second_order() {
    let omega = 2.9;
    for integral_pole in [0.5, 1.45, 6.0] {
        let settings = placed(omega, integral_pole);
        for (t, h) in heights(&settings, |_| (1.0, 0.0)) {
            let x = omega * t;
            // Held commands and the rate as a mean over the last step make a millisecond of delay, at a speed of up to
            // ω/e = 1.07 m/s, and the delayed derivative takes damping away: k_d · 1 ms, below 1.2 %.
            let design = 1.0 - (1.0 + x) * (-x).exp();
            assert!((h - design).abs() < 5e-3, "{integral_pole} {t}: {h} {design}");
        }
        // The same gains with the whole step on the proportional action: ∫e dt = 0 makes them overshoot.
        let whole = PidSettings {
            set_point_weight: 1.0,
            ..settings
        };
        let top = heights(&whole, |_| (1.0, 0.0))
            .iter()
            .fold(0.0_f64, |m, (_, h)| m.max(*h));
        assert!(top > 1.1, "{integral_pole}: {top}");
    }
}

#[test]
fn prop_a_smooth_reference_sees_no_set_point_weight() {
    // Up and down from rest, with its rate: (1 − b) k_p is an integral of a rate instead of an error, which is the same.
    let path = |t: f64| (1.0 - (1.5 * t).cos(), 1.5 * (1.5 * t).sin());
    let weighted = placed(2.9, 1.45);
    let whole = PidSettings {
        set_point_weight: 1.0,
        ..weighted
    };
    let (a, b) = (heights(&weighted, path), heights(&whole, path));
    for (a, b) in a.iter().zip(&b) {
        // The rectangle rule of the integral is half a step late: 0.5 ms at up to 1.5 m/s, half of k_p of it.
        assert!((a.1 - b.1).abs() < 1e-3, "{a:?} {b:?}");
    }
    // And it lags, if at all, by the acceleration that it isn't given: (s³ + 0)/(…) of the path.
    let worst = a.iter().map(|(t, h)| (h - path(*t).0).abs()).fold(0.0, f64::max);
    assert!(worst < 0.35, "{worst}");
}
