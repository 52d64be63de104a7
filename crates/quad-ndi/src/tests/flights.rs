//! Whole flights: the short way round in yaw, and what is kept of a flight that diverges.

use super::*;
use crate::metrics::StepMetrics;
use crate::{AnyController, C2, C3, FlightLog, FlightPlan, FlightStatus, Flyer, Reference};
use quad_dynamics::{AnyQuadrotor, Level, Phenomenon, PhenomenonSet};
use quad_math::TimeGrid;
use std::num::NonZeroU64;

/// A plan at 1 kHz.
pub(super) fn plan(end_s: f64, record_every: u64) -> FlightPlan {
    FlightPlan {
        grid: TimeGrid::from_seconds(1e-3, end_s).unwrap(),
        record_every: NonZeroU64::new(record_every).unwrap(),
    }
}

pub(super) fn fly(
    level: Level,
    on: &PhenomenonSet,
    controller: AnyController<f64>,
    yaw: f64,
    plan: &FlightPlan,
    reference: Reference<f64>,
) -> FlightLog {
    let vehicle = Vehicle::qball_x4();
    let model = AnyQuadrotor::hovering(level, &vehicle, on, Vector3::zeros(), yaw).unwrap();
    Flyer::new(&vehicle, model, controller)
        .unwrap()
        .fly(plan, |_| reference)
}

#[test]
fn exact_yaw_takes_the_short_way_round() {
    let vehicle = Vehicle::qball_x4();
    let s = settings();
    let (from, to) = (170_f64.to_radians(), (-170_f64).to_radians());
    let pid = crate::Pid::new(&vehicle, &super::bad_input::pid_settings()).unwrap();
    let controllers: [(Level, AnyController<f64>); 4] = [
        (
            Level::One,
            AnyController::C1(crate::C1::new(&vehicle, &s).unwrap().into()),
        ),
        (
            Level::Two,
            AnyController::C2(C2::new(&vehicle, &s).unwrap().into()),
        ),
        (
            Level::Three,
            AnyController::C3(C3::new(&vehicle, &s).unwrap().into()),
        ),
        (Level::Three, AnyController::Pid(pid.into())),
    ];
    for (level, controller) in controllers {
        let reference = Reference::hold(Vector3::zeros(), to);
        let log = fly(
            level,
            &PhenomenonSet::none(),
            controller,
            from,
            &plan(6.0, 10),
            reference,
        );
        // Angle turned since the start, each step of it taken the short way.
        let mut turned = 0.0;
        let (mut least, mut most) = (0.0_f64, 0.0_f64);
        for pair in log.records.windows(2) {
            let change = pair[1].flight.attitude.yaw - pair[0].flight.attitude.yaw;
            turned += change - (change / std::f64::consts::TAU).round() * std::f64::consts::TAU;
            (least, most) = (least.min(turned), most.max(turned));
        }
        // 20° to the right, never to the left; the inversions don't overshoot, PID does by its integral, less than 15 %,
        // of which 5 % are left at the end.
        let way = 20_f64.to_radians();
        assert!((turned - way).abs() < 0.05 * way, "{level}: {turned}");
        assert!(least > -1e-9 && most < 1.15 * way, "{level}: {least} {most}");
    }
}

#[test]
fn exact_a_diverging_flight_stops_and_keeps_its_records() {
    let vehicle = Vehicle::qball_x4();
    // An attitude loop ten times faster than the rotors that it doesn't know, on rotors without limits.
    let wild = Settings {
        attitude: AttitudeSettings {
            frequency_ratio: 100.0,
            ..settings().attitude
        },
        ..settings()
    };
    let on = Level::Five.phenomena().without(Phenomenon::InputLimits);
    let controller = AnyController::C2(C2::new(&vehicle, &wild).unwrap().into());
    let ahead = Reference::hold(Vector3::new(1.0, 0.0, 0.0), 0.0);
    let log = fly(Level::Five, &on, controller, 0.0, &plan(20.0, 1), ahead);
    let FlightStatus::Diverged { time_s, last } = &log.status else {
        panic!("{:?}", log.records.last())
    };
    let end = log.records.last().unwrap();
    assert!(*time_s > 0.0 && *time_s < 20.0);
    // The last record is that of the instant before, or of the same if its commands were the first to go.
    assert!((time_s - end.time_s) < 1.5e-3, "{time_s} {}", end.time_s);
    assert!(
        last.position
            .iter()
            .chain(last.body_rates.iter())
            .all(|x| x.is_finite())
    );
    for record in &log.records {
        let flight = &record.flight;
        let numbers = flight
            .position
            .iter()
            .chain(flight.velocity.iter())
            .chain(flight.body_rates.iter());
        assert!(
            numbers
                .chain(&record.commands)
                .chain(&record.pseudo_inputs)
                .all(|x| x.is_finite()),
            "{record:?}"
        );
    }
    assert!(log.records.len() > 2);
}

#[test]
fn agree_metrics_of_a_designed_step_with_its_settings() {
    // Default settings: 2 s to 2 % without overshoot. The third pole, 20 times faster, and sampling at 1 kHz delay by
    // 0.02 s and 0.001 s.
    let vehicle = Vehicle::qball_x4();
    let controller = AnyController::C3(C3::new(&vehicle, &Settings::default()).unwrap().into());
    let up = Reference::hold(Vector3::new(0.0, 0.0, -1.0), 0.0);
    let log = fly(
        Level::Three,
        &PhenomenonSet::none(),
        controller,
        0.0,
        &plan(5.0, 1),
        up,
    );
    let response: Vec<(f64, f64)> = log
        .records
        .iter()
        .map(|r| (r.time_s, r.flight.position.z))
        .collect();
    let metrics = StepMetrics::of(&response, -1.0).unwrap();
    let settled = metrics.settling_time_s.unwrap();
    assert!((settled - 2.0).abs() < 0.03, "{settled}");
    assert!(
        metrics.overshoot < 1e-9 && metrics.steady_state_error.abs() < 1e-4,
        "{metrics:?}"
    );
}
