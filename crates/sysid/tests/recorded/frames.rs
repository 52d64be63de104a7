//! Frames, signs and units of the data sets, shown by the recordings themselves.

use crate::files::{ARPL_ROLL_PITCH, ARPL_THRUST, ARPL_YAW, NANOBENCH, arpl, nanobench, open};
use nalgebra::Vector3;
use quad_dynamics::Vehicle;
use sysid::recorded::{InertialLog, MotionCaptureFlight, STANDARD_GRAVITY};

/// Correlation coefficient and slope of `y` over `x`.
struct Line {
    correlation: f64,
    slope: f64,
}

fn line(x: &[f64], y: &[f64]) -> Line {
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
    let (mx, my) = (mean(x), mean(y));
    let sum = |f: &dyn Fn(f64, f64) -> f64| -> f64 { x.iter().zip(y).map(|(a, b)| f(a - mx, b - my)).sum() };
    let (xx, yy, xy) = (sum(&|a, _| a * a), sum(&|_, b| b * b), sum(&|a, b| a * b));
    Line {
        correlation: xy / (xx * yy).sqrt(),
        slope: xy / xx,
    }
}

/// Means over `2 reach + 1` samples around each of the `samples`.
fn smoothed(values: impl Fn(usize) -> f64, samples: &[usize], reach: usize) -> Vec<f64> {
    let mean = |&k: &usize| (k - reach..=k + reach).map(&values).sum::<f64>() / (2 * reach + 1) as f64;
    samples.iter().map(mean).collect()
}

/// Samples of the flight itself: away from take-off and landing.
fn airborne(flight: &MotionCaptureFlight) -> Vec<usize> {
    flight.inertial.window(7.0, 20.0).collect()
}

#[test]
fn data_accelerometers_at_rest_read_one_g_up() {
    // On the ground before the motors start. 30 mg is the accelerometer's offset (data sheet BMI088: 20 mg) and a table that is level to half a degree.
    let at_rest = |log: &InertialLog, name: &str| {
        let still = log
            .commands
            .iter()
            .take_while(|c| c.iter().all(|u| *u == 0.0))
            .count()
            .min(300);
        assert!(still > 50, "{name}: {still} samples at rest");
        let mean = log.specific_force[..still].iter().sum::<Vector3<f64>>() / still as f64;
        let off = (mean - Vector3::new(0.0, 0.0, -STANDARD_GRAVITY)).amax();
        assert!(off < 0.03 * STANDARD_GRAVITY, "{name}: {mean:?}");
        let rates = log.body_rates[..still].iter().sum::<Vector3<f64>>() / still as f64;
        // Offset of a gyroscope after its calibration at start: below 1 deg/s.
        assert!(rates.amax() < 0.0175, "{name}: {rates:?}");
    };
    for name in [ARPL_THRUST, ARPL_ROLL_PITCH, ARPL_YAW] {
        let Some(log) = arpl(name) else { return };
        at_rest(&log, name);
    }
    for name in NANOBENCH {
        let Some(flight) = nanobench(name) else { return };
        at_rest(&flight.inertial, name);
    }
}

#[test]
fn data_nanobench_rates_are_the_body_components_of_the_attitudes_derivative() {
    for name in NANOBENCH {
        let Some(flight) = nanobench(name) else { return };
        let samples = airborne(&flight);
        let rates: Vec<Vector3<f64>> = (0..flight.attitude.len())
            .map(|k| attitude_rate(&flight, k))
            .collect();
        let world = |k: usize| flight.attitude[k].rotate(&rates[k]);
        let turned = |k: usize, axis: usize| rates[k][axis];
        for axis in 0..3 {
            let from_attitude = smoothed(|k| turned(k, axis), &samples, 5);
            let captured = smoothed(|k| flight.captured_rates[k][axis], &samples, 5);
            let captured = line(&from_attitude, &captured);
            // The same motion capture, smoothed by the set's authors: a few per cent are lost.
            assert!(
                captured.correlation > 0.97,
                "{name} {axis}: {}",
                captured.correlation
            );
            assert!(
                (captured.slope - 1.0).abs() < 0.1,
                "{name} {axis}: {}",
                captured.slope
            );
            let gyro = line(
                &from_attitude,
                &smoothed(|k| flight.inertial.body_rates[k][axis], &samples, 5),
            );
            // Another sensor on another clock, tens of milliseconds apart; the yaw rates are hardly above its noise.
            let (least, slope) = if axis == 2 { (0.4, 0.3) } else { (0.7, 0.6) };
            assert!(gyro.correlation > least, "{name} {axis}: {}", gyro.correlation);
            assert!(
                (slope..1.2).contains(&gyro.slope),
                "{name} {axis}: {}",
                gyro.slope
            );
        }
        // Body and world components differ in yaw, where tilting mixes roll and pitch rates into the world's.
        let yaw = smoothed(|k| flight.captured_rates[k].z, &samples, 5);
        let along_body = line(&smoothed(|k| rates[k].z, &samples, 5), &yaw).correlation;
        let along_world = line(&smoothed(|k| world(k).z, &samples, 5), &yaw).correlation;
        assert!(
            along_body > along_world,
            "{name}: body {along_body}, world {along_world}"
        );
    }
}

/// Body rates from the attitude by central differences: `q* ⊗ q̇ = ½ [0, ω]`.
fn attitude_rate(flight: &MotionCaptureFlight, k: usize) -> Vector3<f64> {
    let (a, b) = (k.saturating_sub(1), (k + 1).min(flight.attitude.len() - 1));
    let turn = flight.attitude[a].conjugate().product(&flight.attitude[b]);
    let time = flight.inertial.time[b] - flight.inertial.time[a];
    2.0 * turn.v * turn.w.signum() / time
}

#[test]
fn data_nanobench_velocity_is_the_derivative_of_position_and_height_is_up() {
    for name in NANOBENCH {
        let Some(flight) = nanobench(name) else { return };
        let samples = airborne(&flight);
        let time = &flight.inertial.time;
        for axis in 0..3 {
            let moved = |k: usize| {
                (flight.position[k + 1][axis] - flight.position[k - 1][axis]) / (time[k + 1] - time[k - 1])
            };
            let both = line(
                &smoothed(moved, &samples, 2),
                &smoothed(|k| flight.velocity[k][axis], &samples, 2),
            );
            // Smoothing by the set's authors.
            assert!(
                both.correlation > 0.99 && (both.slope - 1.0).abs() < 0.03,
                "{name} {axis}: {}",
                both.slope
            );
        }
        // Flown about 1 m above the floor by its own set point; motion capture's z is the marker's.
        let height = samples.iter().map(|&k| -flight.position[k].z).sum::<f64>() / samples.len() as f64;
        assert!((height - 1.0).abs() < 0.15, "{name}: {height} m");
        let commanded = samples.iter().map(|&k| -flight.set_point[k].z).sum::<f64>() / samples.len() as f64;
        assert!((commanded - 1.0).abs() < 0.02, "{name}: {commanded} m");
    }
}

#[test]
fn data_nanobench_specific_force_turned_into_the_world_is_the_captured_acceleration() {
    for name in NANOBENCH {
        let Some(flight) = nanobench(name) else { return };
        let samples = airborne(&flight);
        let time = &flight.inertial.time;
        let gravity = Vector3::new(0.0, 0.0, STANDARD_GRAVITY);
        for axis in 0..3 {
            let inertial =
                |k: usize| (flight.attitude[k].rotate(&flight.inertial.specific_force[k]) + gravity)[axis];
            let captured = |k: usize| {
                (flight.velocity[k + 1][axis] - flight.velocity[k - 1][axis]) / (time[k + 1] - time[k - 1])
            };
            let both = line(
                &smoothed(captured, &samples, 10),
                &smoothed(inertial, &samples, 10),
            );
            // 0.21 s means; what remains is offset in time and, in z on the slow flights, hardly any acceleration to see.
            let least = if axis == 2 { 0.3 } else { 0.9 };
            assert!(both.correlation > least, "{name} {axis}: {}", both.correlation);
        }
    }
}

/// Moments about x_B and y_B that the vehicle file's rotors give when each pushes with its squared command.
fn moments(vehicle: &Vehicle, commands: &[f64; 4]) -> [f64; 3] {
    let mut moment = [0.0; 3];
    for ((rotor, hub), c) in vehicle.rotors.iter().zip(vehicle.hubs()).zip(commands) {
        moment[0] -= hub.y * c * c;
        moment[1] += hub.x * c * c;
        moment[2] -= rotor.spin.sign() * c * c;
    }
    moment
}

#[test]
fn data_motor_order_and_signs_give_the_recorded_angular_acceleration() {
    // One wrong motor would turn the sign of an axis or halve the correlation. The lag of the motors is taken as 70 ms; the means are over 50 ms.
    let vehicle = Vehicle::crazyflie();
    let windows = [
        (ARPL_ROLL_PITCH, 55.0, 90.0, 0, 0.8),
        (ARPL_ROLL_PITCH, 55.0, 90.0, 1, 0.8),
        (ARPL_YAW, 32.0, 38.0, 2, 0.6),
    ];
    for (name, from, to, axis, least) in windows {
        let Some(log) = arpl(name) else { return };
        let mut lagged = [0.0; 4];
        let mut torque = vec![0.0];
        for k in 1..log.time.len() {
            let step = ((log.time[k - 1] - log.time[k]) / 0.07).exp();
            for (state, c) in lagged.iter_mut().zip(&log.commands[k - 1]) {
                *state = *state * step + c * (1.0 - step);
            }
            torque.push(moments(&vehicle, &lagged)[axis]);
        }
        let samples: Vec<usize> = log.window(from, to).step_by(25).collect();
        let rate = |k: usize| {
            (log.body_rates[k + 25][axis] - log.body_rates[k - 25][axis])
                / (log.time[k + 25] - log.time[k - 25])
        };
        let measured: Vec<f64> = samples.iter().map(|&k| rate(k)).collect();
        let both = line(&smoothed(|k| torque[k], &samples, 25), &measured);
        assert!(
            both.correlation > least,
            "{name} axis {axis}: {}",
            both.correlation
        );
    }
}

#[test]
fn data_motor_measurements_are_read() {
    let Some(file) = open("ntnu_motor/sample_time_const_data.csv") else {
        return;
    };
    let steps = sysid::recorded::read_motor_steps(file).expect("published file");
    assert_eq!(steps.time.len(), 200);
    assert!((steps.time[1] - 0.02).abs() < 1e-12);
    let Some(file) = open("ntnu_motor/sample_vertiq_motor_data_force_torque.csv") else {
        return;
    };
    let table = sysid::recorded::read_motor_table(file).expect("published file");
    // Force rises with the square of the speed: the ratio of the last to the second row says so within 10 %.
    let last = table.speed.len() - 1;
    let ratio = (table.force[last] / table.force[1]) / (table.speed[last] / table.speed[1]).powi(2);
    assert!((ratio - 1.0).abs() < 0.1, "{ratio}");
}
