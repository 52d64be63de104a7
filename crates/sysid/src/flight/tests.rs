//! Identification of a simulated vehicle whose numbers are known, by equations written anew here.

use super::*;
use crate::Warning;
use crate::laboratory::generator;
use crate::recorded::InertialLog;
use nalgebra::Vector3;
use quad_dynamics::Vehicle;
use rand_distr::{Distribution, StandardNormal};

const MASS: f64 = 0.027;
const CURVE: ThrustCurve = ThrustCurve {
    constant: 0.012,
    linear: 0.01,
    quadratic: 0.117,
};
const LAG: f64 = 0.07;
/// Inertia, kg m², about x, y, z; torque per thrust, m; zero of the yaw torque, rad/s.
const INERTIA: [f64; 3] = [1.2e-5, 1.3e-5, 2.2e-5];
const TORQUE: f64 = 0.005;
const ZERO: f64 = 9.0;
/// Samples, 1 kHz, that the inertial unit is behind.
const BEHIND: usize = 6;

/// What is known of the rotors of the simulated vehicle.
fn rotation_model(delay: SensorDelay) -> RotationModel {
    RotationModel {
        curve: CURVE,
        lag_on: LagOn::Thrust,
        lag_s: LAG,
        delay,
        bin_s: 0.02,
        slowest_s: 0.5,
    }
}

/// Commands of each motor: sines of its own, about hover, so that all axes are moved.
fn command(motor: usize, t: f64) -> f64 {
    let m = motor as f64;
    let tone = |amplitude: f64, hertz: f64, phase: f64| {
        amplitude * (std::f64::consts::TAU * hertz * t + phase).sin()
    };
    0.6 + tone(0.12, 0.3, 0.0)
        + tone(0.05, 2.3, 1.3 * m)
        + tone(0.04, 4.1, 2.9 * m * m)
        + tone(0.03, 6.7, 0.7 * m + 1.0)
        + tone(0.05, 0.9, 2.0 * m)
}

/// A flight of 25 s by forward integration of single rotors, noise of the rates (rad/s) and the specific force (m/s²) added.
fn flight(seed: u64, gyro_noise: f64, force_noise: f64) -> InertialLog {
    let mut random = generator(seed);
    let mut noise = move |sigma: f64| -> f64 {
        let sample: f64 = StandardNormal.sample(&mut random);
        sigma * sample
    };
    // Front right, rear right, rear left, front left: lifting right rolls left (−), lifting front pitches up (+); motors 1
    // and 3 turn counter-clockwise, so that they push the body clockwise (+).
    let (roll, pitch, yaw) = (
        [-1.0, -1.0, 1.0, 1.0],
        [1.0, -1.0, -1.0, 1.0],
        [1.0, -1.0, 1.0, -1.0],
    );
    let arm = 0.028;
    let dt = 1e-3;
    let mut thrust: [f64; 4] = std::array::from_fn(|i| CURVE.thrust(command(i, 0.0)));
    let mut rates = Vector3::zeros();
    let mut log = InertialLog {
        time: vec![],
        specific_force: vec![],
        body_rates: vec![],
        commands: vec![],
        remarks: vec![],
    };
    for k in 0..25_000 {
        let t = f64::from(k) * dt;
        let commands = std::array::from_fn(|i| command(i, t));
        log.time.push(t);
        log.commands.push(commands);
        let total: f64 = thrust.iter().sum();
        log.specific_force.push(Vector3::new(0.0, 0.0, -total / MASS));
        log.body_rates.push(rates);
        let old = thrust;
        for (thrust, c) in thrust.iter_mut().zip(commands) {
            let steady = CURVE.thrust(c);
            *thrust = steady + (*thrust - steady) * (-dt / LAG).exp();
        }
        let sum =
            |signs: [f64; 4], of: &dyn Fn(usize) -> f64| -> f64 { (0..4).map(|i| signs[i] * of(i)).sum() };
        let mean = |i: usize| 0.5 * (old[i] + thrust[i]);
        rates.x += dt * arm * sum(roll, &mean) / INERTIA[0];
        rates.y += dt * arm * sum(pitch, &mean) / INERTIA[1];
        let lead = sum(yaw, &|i| thrust[i] - old[i]) / ZERO;
        rates.z += TORQUE / INERTIA[2] * (dt * sum(yaw, &mean) + lead);
    }
    delayed(&mut log.specific_force);
    delayed(&mut log.body_rates);
    for (f, w) in log.specific_force.iter_mut().zip(&mut log.body_rates) {
        f.z += noise(force_noise);
        *w += Vector3::from_fn(|_, _| noise(gyro_noise));
    }
    log
}

fn delayed(series: &mut Vec<Vector3<f64>>) {
    let first = series[0];
    series.truncate(series.len() - BEHIND);
    series.splice(0..0, [first; BEHIND]);
}

fn tests_of(log: &InertialLog) -> FlightTests<'_> {
    let part = Part {
        log,
        fit: 2.0..20.0,
        rest: 20.0..24.0,
    };
    FlightTests {
        mass: MASS,
        thrust: part.clone(),
        roll_pitch: part.clone(),
        yaw: part,
    }
}

#[test]
fn exact_a_simulated_vehicle_is_recovered() {
    let log = flight(1, 0.0, 0.0);
    let found = identify_crazyflie(&tests_of(&log), &Vehicle::crazyflie()).unwrap();
    // Without noise what is left is the interpolation of the integrals at 1 kHz and the linear hold of the delayed command.
    let close = |value: f64, truth: f64, part: f64, what: &str| {
        assert!(
            (value / truth - 1.0).abs() < part,
            "{what}: {value} instead of {truth}"
        );
    };
    close(found.thrust.lag().value, LAG, 0.01, "lag");
    for c in [0.4, 0.6, 0.8] {
        close(found.thrust.curve().thrust(c), CURVE.thrust(c), 0.003, "thrust");
    }
    close(found.roll.inertia.value, INERTIA[0], 0.01, "I_xx");
    close(found.pitch.inertia.value, INERTIA[1], 0.01, "I_yy");
    // Half a sample.
    assert!(
        (found.delay_s() - BEHIND as f64 * 1e-3).abs() < 5e-4,
        "{}",
        found.delay_s()
    );
    // Thrust at the samples instead of between them is half a sample late: 0.5 ms of the lead time of 111 ms, and what the
    // errors of lag and delay above make of it.
    close(found.yaw.ratio().value, TORQUE / INERTIA[2], 0.02, "ratio");
    close(found.yaw.zero().value, ZERO, 0.03, "zero");
    close(found.yaw.inertia_for(TORQUE).value, INERTIA[2], 0.02, "I_zz");
}

/// The closed form of the line is a regression's through many points of the same curve, and its errors are those of a
/// central difference through the covariance.
#[test]
fn exact_the_line_through_the_curve_is_the_regressions() {
    use crate::regression::{Row, linear};
    let log = flight(1, 0.0, 0.1);
    let settings = ThrustSettings {
        mass: MASS,
        lag_on: LagOn::Thrust,
        delay_s: BEHIND as f64 * 1e-3,
    };
    let fit = identify_thrust(&log, &(2.0..20.0), settings).unwrap();
    let (a, b) = (0.45, 0.8);
    let line_of = |[k0, k1, k2, _]: [f64; 4]| {
        let rows: Vec<Row<2>> = (0..10_000)
            .map(|k| a + (b - a) * (f64::from(k) + 0.5) / 1e4)
            .map(|c| Row {
                regressors: [1.0, c],
                y: k0 + (k1 + k2 * c) * c,
            })
            .collect();
        let [intercept, gain] = linear(&rows).unwrap().values();
        [gain, -intercept / gain]
    };
    let line = fit.line(&(a..=b));
    let [gain, zero] = line_of(fit.fit.values());
    // The midpoint rule over 10⁴ points is off by their number's square.
    assert!((line.gain.value / gain - 1.0).abs() < 1e-7, "{line:?} {gain}");
    assert!((line.zero.value / zero - 1.0).abs() < 1e-7, "{line:?} {zero}");
    let step = 1e-5;
    let slopes: [[f64; 2]; 4] = std::array::from_fn(|i| {
        let (mut up, mut down) = (fit.fit.values(), fit.fit.values());
        up[i] += step;
        down[i] -= step;
        let (up, down) = (line_of(up), line_of(down));
        [0, 1].map(|k| (up[k] - down[k]) / (2.0 * step))
    });
    for (k, error) in [line.gain.standard_error, line.zero.standard_error]
        .into_iter()
        .enumerate()
    {
        let expected = fit.fit.propagated(0.0, &slopes.map(|s| s[k])).standard_error;
        // The difference's own error: its step over the gain of 0.15 N, squared.
        assert!(
            (error / expected - 1.0).abs() < 1e-4,
            "{k}: {error} instead of {expected}"
        );
    }
}

#[test]
fn prop_the_intervals_of_inertia_contain_the_truth() {
    // White noise of the gyroscope ten times the real one's (0.1 deg/s), 60 flights: of a true 95 % interval 57 ± 1.7 contain
    // the truth; three standard deviations below are 52.
    let vehicle = Vehicle::crazyflie();
    let model = rotation_model(SensorDelay::Identified);
    let hits = (0..60).filter(|&seed| {
        let log = flight(seed, 0.0175, 0.0);
        let fit = identify_inertia(Axis::Roll, &model, &vehicle, &log, &(2.0..20.0)).unwrap();
        fit.inertia.interval().contains(INERTIA[0])
    });
    let hits = hits.count();
    assert!(hits >= 52, "{hits} of 60");
}

#[test]
fn exact_a_vehicle_file_of_the_identified_numbers_flies_at_every_level() {
    let log = flight(1, 0.0, 0.0);
    let found = identify_crazyflie(&tests_of(&log), &Vehicle::crazyflie()).unwrap();
    let base = vehicle::base();
    let file = vehicle_file(&found, &base, "simulated flight").unwrap();
    let vehicle = Vehicle::from_file(&file, "identified").unwrap();
    assert_eq!(
        file.airframe.inertia.m11.standard_error,
        Some(found.roll.inertia.standard_error)
    );
    for level in quad_dynamics::Level::ALL {
        quad_dynamics::AnyQuadrotor::<f64>::hovering(
            level,
            &vehicle,
            &level.phenomena(),
            Vector3::zeros(),
            0.0,
        )
        .unwrap();
    }
    // The cubic of level 5 meets the curve over the range of flight within 2 mN, the line at hover within 3 mN.
    let nominal = base.battery.as_ref().unwrap().nominal_voltage.value;
    let thrust = vehicle.polynomial_rotor.unwrap().thrust;
    let hover = CURVE.command(MASS * 9.81 / 4.0);
    for c in [0.4, hover, 0.9] {
        let cubic = thrust.value(c * nominal);
        assert!((cubic - CURVE.thrust(c)).abs() < 2e-3, "{c}: {cubic}");
    }
    let line = file.linear_rotor.thrust_gain.value * (hover - file.pwm.zero_thrust.value);
    assert!((line - CURVE.thrust(hover)).abs() < 3e-3, "{line}");
}

#[test]
fn exact_refusals() {
    let mut log = flight(1, 0.0, 0.0);
    let vehicle = Vehicle::crazyflie();
    let settings = ThrustSettings {
        mass: MASS,
        lag_on: LagOn::Thrust,
        delay_s: 0.0,
    };
    let refused = |log: &InertialLog, window, settings| identify_thrust(log, &window, settings).unwrap_err();
    assert!(matches!(
        refused(&log, 90.0..99.0, settings),
        FlightError::TooFewSamples { samples: 0, .. }
    ));
    assert!(matches!(
        refused(&log, 3.0..3.5, settings),
        FlightError::TooFewSamples { samples: 500, .. }
    ));
    assert!(matches!(
        refused(
            &log,
            3.0..9.0,
            ThrustSettings {
                mass: -1.0,
                ..settings
            }
        ),
        FlightError::NotPositive { .. }
    ));
    // Motors 1 and 4 exchanged with 2 and 3: the vehicle would pitch the wrong way.
    let mut exchanged = log.clone();
    for c in &mut exchanged.commands {
        *c = [c[1], c[0], c[3], c[2]];
    }
    let model = rotation_model(SensorDelay::Known(0.0));
    assert!(matches!(
        identify_inertia(Axis::Pitch, &model, &vehicle, &exchanged, &(2.0..20.0)),
        Err(FlightError::NotPhysical { .. })
    ));
    for c in &mut log.commands {
        c[2] = 0.5;
    }
    assert_eq!(
        refused(&log, 3.0..9.0, settings),
        FlightError::ConstantInput {
            motor: 3,
            value: 0.5,
            from: 3.0,
            to: 9.0
        }
    );
}

#[test]
fn exact_gaps_saturation_and_a_stuck_sensor_are_told() {
    let vehicle = Vehicle::crazyflie();
    let model = rotation_model(SensorDelay::Known(0.0));
    let roll = |log: &InertialLog| identify_inertia(Axis::Roll, &model, &vehicle, log, &(2.0..20.0));
    let log = flight(1, 0.001, 0.0);
    let told = |log: &InertialLog| roll(log).unwrap().warnings;
    let clean = told(&log);
    assert!(
        !clean
            .iter()
            .any(|w| matches!(w, Warning::Gaps { .. } | Warning::Saturated { .. })),
        "{clean:?}"
    );
    // Ten samples lost at 5 s.
    let mut gap = log.clone();
    gap.time.drain(5000..5010);
    gap.specific_force.drain(5000..5010);
    gap.body_rates.drain(5000..5010);
    gap.commands.drain(5000..5010);
    let found = told(&gap);
    assert!(
        found
            .iter()
            .any(|w| matches!(w, Warning::Gaps { gaps: 1, longest_s } if (longest_s - 0.011).abs() < 1e-9)),
        "{found:?}"
    );
    // A gyroscope whose range ends at half of what it ought to show.
    let mut saturated = log.clone();
    let largest = saturated.body_rates.iter().fold(0.0_f64, |m, w| m.max(w.x));
    for w in &mut saturated.body_rates {
        w.x = w.x.min(0.5 * largest);
    }
    let found = told(&saturated);
    assert!(
        found
            .iter()
            .any(|w| matches!(w, Warning::Saturated { limit, .. } if *limit == 0.5 * largest)),
        "{found:?}"
    );
    let mut stuck = log;
    for w in &mut stuck.body_rates {
        w.x = 0.25;
    }
    assert_eq!(
        roll(&stuck).unwrap_err(),
        FlightError::ConstantSensor {
            sensor: "gyroscope, rad/s,",
            value: 0.25
        }
    );
}
