//! The oracle of the replay: a flight flown by the model itself comes back from its own commands.

use super::*;
use crate::measurement::Remark;
use crate::recorded::{InertialLog, MotionCaptureFlight};
use nalgebra::Vector3;
use quad_dynamics::{AnyQuadrotor, Input, Level, PhenomenonSet, Vehicle};
use quad_math::FixedStep;

const DT: f64 = 0.01;

/// Commands that wander about hover, small enough for the vehicle to stay upright for three seconds.
fn wander(hover: &[f64; 4], zero: f64, t: f64) -> [f64; 4] {
    std::array::from_fn(|i| {
        hover[i] + zero + 0.002 * (5.0 * t + 1.7 * i as f64).sin() + 0.01 * (2.0 * t).sin()
    })
}

/// A flight that a level flew, recorded without noise at 100 Hz; its battery falls from 3.9 V.
fn flown(level: Level, vehicle: &Vehicle, phenomena: &PhenomenonSet) -> MotionCaptureFlight {
    let mut quadrotor = AnyQuadrotor::hovering(level, vehicle, phenomena, Vector3::zeros(), 0.3).unwrap();
    let hover = quadrotor.hover_input().commands;
    let nominal = vehicle.battery.as_ref().unwrap().nominal_voltage;
    let mut flight = MotionCaptureFlight {
        inertial: InertialLog {
            time: vec![],
            specific_force: vec![],
            body_rates: vec![],
            commands: vec![],
            remarks: Vec::<Remark>::new(),
        },
        voltage: vec![],
        position: vec![],
        velocity: vec![],
        attitude: vec![],
        captured_rates: vec![],
        set_point: vec![],
    };
    for k in 0..320 {
        let t = f64::from(k) * DT;
        let seen = quadrotor.flight();
        let snapshot = quadrotor.snapshot(&Input::still_air(hover));
        // The flight computer makes up for the falling voltage, so that level 5 sees what it would at nominal voltage.
        let voltage = if level == Level::Five {
            3.9 - 0.05 * t
        } else {
            nominal
        };
        let raw = wander(&hover, vehicle.pwm.zero_thrust, t);
        flight.inertial.time.push(t);
        flight.inertial.commands.push(raw.map(|u| u * nominal / voltage));
        flight.inertial.body_rates.push(seen.body_rates);
        flight.inertial.specific_force.push(Vector3::zeros());
        flight.voltage.push(voltage);
        flight.position.push(seen.position);
        flight.velocity.push(seen.velocity);
        flight.attitude.push(snapshot.body.attitude);
        flight.captured_rates.push(seen.body_rates);
        flight.set_point.push(Vector3::zeros());
        let input = Input::still_air(raw.map(|u| u - vehicle.pwm.zero_thrust));
        for _ in 0..10 {
            quadrotor.step(FixedStep::Rk4, &input, DT / 10.0);
        }
    }
    flight
}

#[test]
fn agree_a_flight_of_the_model_itself_is_predicted_to_the_end() {
    let replayed = ReplayVehicle {
        vehicle: Vehicle::crazyflie(),
        trim: [0.0; 4],
        delay_s: 0.0,
    };
    for level in [Level::Two, Level::Three, Level::Four, Level::Five] {
        let phenomena = level
            .phenomena()
            .without(quad_dynamics::Phenomenon::VoltageSag)
            .without(quad_dynamics::Phenomenon::InputLimits);
        let flight = flown(level, &replayed.vehicle, &phenomena);
        for prediction in [
            Prediction::OneStep,
            Prediction::ShortHorizon(0.5),
            Prediction::WholeFlight,
        ] {
            let replay = replay(&flight, &(1.0..3.1), level, &replayed, prediction).unwrap();
            assert_eq!(replay.tumbled_at, None);
            let agreement = replay.agreement().unwrap();
            // The same integrator at the same step; the rotors, run in for 0.5 s or 7 lags from hover instead of 1 s, still
            // remember a thousandth of the difference, which an unstable attitude makes grow in two seconds.
            for axis in 0..3 {
                for found in [
                    agreement.acceleration[axis],
                    agreement.angular_acceleration[axis],
                    agreement.body_rates[axis],
                ] {
                    let fit = found.fit_percent.unwrap();
                    assert!(fit > 98.0, "{level} {prediction} axis {axis}: {fit}");
                }
            }
        }
    }
}

#[test]
fn exact_another_mass_shows_as_another_vertical_acceleration() {
    let mut replayed = ReplayVehicle {
        vehicle: Vehicle::crazyflie(),
        trim: [0.0; 4],
        delay_s: 0.0,
    };
    let flight = flown(Level::Two, &replayed.vehicle, &PhenomenonSet::none());
    replayed.vehicle.airframe.mass *= 1.1;
    let replay = replay(&flight, &(1.0..3.1), Level::Two, &replayed, Prediction::OneStep).unwrap();
    // The thrust's share of the measured acceleration, y − g, acts on 1.1 times the mass. Within a sample of 10 ms the
    // attitude turns by a few mrad more or less, hence 0.1 % of g.
    let down = &replay.acceleration[2];
    for (y, predicted) in down.measured.iter().zip(&down.predicted) {
        let expected = 9.81 + (y - 9.81) / 1.1;
        assert!(
            (predicted - expected).abs() < 0.01,
            "{predicted} instead of {expected}"
        );
    }
    assert!(down.agreement().unwrap().shares.unwrap().bias > 0.8);
}

#[test]
fn exact_refusals() {
    let replayed = ReplayVehicle {
        vehicle: Vehicle::crazyflie(),
        trim: [0.0; 4],
        delay_s: 0.0,
    };
    let flight = flown(Level::Two, &replayed.vehicle, &PhenomenonSet::none());
    let run = |window, level, prediction| replay(&flight, &window, level, &replayed, prediction).unwrap_err();
    assert_eq!(
        run(1.0..2.0, Level::One, Prediction::OneStep),
        ReplayError::Level { level: Level::One }
    );
    assert_eq!(
        run(9.0..10.0, Level::Two, Prediction::OneStep),
        ReplayError::Window {
            from: 9.0,
            to: 10.0,
            samples: 0
        }
    );
    assert_eq!(
        run(1.0..2.0, Level::Two, Prediction::ShortHorizon(0.07)),
        ReplayError::Horizon { horizon_s: 0.07 }
    );
}
