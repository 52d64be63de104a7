//! What perfect sensors read, in closed form, and what imperfect ones do to it, in the mean of many readings.

use crate::support::generator;
use nalgebra::Vector3;
use quad_dynamics::{AnyQuadrotor, Input, Level, RigidBodyState, Vehicle};
use quad_estimation::sensor::{Instrument, Reading, Seen, Sensor, SensorSuite};
use quad_kinematics::EulerAngles;

fn hovering(level: Level) -> (AnyQuadrotor<f64>, Input<f64>) {
    let at = Vector3::new(1.0, -2.0, -3.0);
    let model = AnyQuadrotor::hovering(level, &Vehicle::qball_x4(), &level.phenomena(), at, 0.4)
        .expect("a valid level");
    let input = model.hover_input();
    (model, input)
}

/// The same flight with another body.
fn with_body(level: Level, change: impl Fn(&mut RigidBodyState<f64>)) -> (AnyQuadrotor<f64>, Input<f64>) {
    let (mut model, input) = hovering(level);
    let mut snapshot = model.snapshot(&input);
    change(&mut snapshot.body);
    model.adopt(&snapshot, &input);
    (model, input)
}

fn vector(instrument: Instrument, seen: &Seen<f64>) -> Vector3<f64> {
    match instrument.ideal(seen) {
        Reading::Vector(v) => v,
        Reading::Scalar(x) => panic!("{instrument} reads {x}"),
    }
}

fn scalar(instrument: Instrument, seen: &Seen<f64>) -> f64 {
    match instrument.ideal(seen) {
        Reading::Scalar(x) => x,
        Reading::Vector(v) => panic!("{instrument} reads {v}"),
    }
}

fn near(a: Vector3<f64>, b: [f64; 3], tolerance: f64) {
    assert!((a - Vector3::from(b)).amax() < tolerance, "{a} is not {b:?}");
}

#[test]
fn exact_in_hover_an_accelerometer_reads_gravity_upwards() {
    let g = Vehicle::qball_x4().environment.gravity;
    for level in Level::ALL {
        let (model, input) = hovering(level);
        let seen = Seen::of(&model, &input);
        // Level 5's trim is iterated to rounding; gravity is a number of order ten.
        near(vector(Instrument::Accelerometer, &seen), [0.0, 0.0, -g], 1e-9);
        near(vector(Instrument::Gyroscope, &seen), [0.0; 3], 1e-15);
        near(vector(Instrument::PositionFix, &seen), [1.0, -2.0, -3.0], 1e-15);
        assert!((scalar(Instrument::Barometer, &seen) - 3.0).abs() < 1e-15);
        assert!((scalar(Instrument::Sonar, &seen) - 3.0).abs() < 1e-14);
    }
}

#[test]
fn exact_in_free_fall_an_accelerometer_reads_nothing() {
    for level in [Level::One, Level::Two] {
        let (model, _) = with_body(level, |body| {
            // Level 1 tilts the weight, not the thrust: without thrust it falls freely only while it is level.
            let tilt = if level == Level::One { 0.0 } else { 0.3 };
            body.attitude = EulerAngles::new(tilt, -tilt, 0.7).quaternion();
            body.body_rates = Vector3::new(0.5, 1.0, -0.7);
            body.velocity = Vector3::new(2.0, 1.0, 3.0);
        });
        let seen = Seen::of(&model, &Input::still_air([0.0; 4]));
        near(vector(Instrument::Accelerometer, &seen), [0.0; 3], 1e-14);
    }
}

/// At level, 10 % more thrust on every rotor is 10 % more specific force; rotors without lag, and gravity drops out whatever the tilt.
#[test]
fn exact_thrust_is_felt_along_the_body_whatever_the_tilt() {
    let g = Vehicle::qball_x4().environment.gravity;
    let (model, mut input) = with_body(Level::Two, |body| {
        body.attitude = EulerAngles::new(0.5, -0.3, 2.0).quaternion();
    });
    input.commands = input.commands.map(|u| 1.1 * u);
    near(
        vector(Instrument::Accelerometer, &Seen::of(&model, &input)),
        [0.0, 0.0, -1.1 * g],
        1e-13,
    );
}

/// What an accelerometer feels is `v̇ + ω × v − Rᵀ g`: differentiated from a short flight of level 5, wind and drag included.
#[test]
fn exact_specific_force_is_acceleration_less_gravity() {
    let g = Vehicle::qball_x4().environment.gravity;
    let (mut model, mut input) = with_body(Level::Five, |body| {
        body.attitude = EulerAngles::new(0.2, -0.3, 2.0).quaternion();
        body.velocity = Vector3::new(3.0, -1.0, 0.5);
        body.body_rates = Vector3::new(0.3, -0.2, 0.5);
    });
    input.wind = Vector3::new(4.0, 1.0, 0.0);
    let seen = Seen::of(&model, &input);
    let h = 1e-5;
    let before = model.flight();
    model.step(quad_math::FixedStep::Rk4, &input, h);
    let after = model.flight();
    let expected = before.rotation.matrix.transpose()
        * ((after.velocity - before.velocity) / h - Vector3::new(0.0, 0.0, g));
    // A one-sided difference: h/2 times a jerk of some 10 m/s³ is 5e-5, rounding 1e-16 × 3/h.
    near(vector(Instrument::Accelerometer, &seen), expected.into(), 2e-4);
}

#[test]
fn exact_compass_gyroscope_and_sonar() {
    let field_ut = [20.0, 0.0, 45.0];
    // Facing east, north is to the left.
    let (model, input) = with_body(Level::Two, |body| {
        body.attitude = EulerAngles::new(0.0, 0.0, std::f64::consts::FRAC_PI_2).quaternion();
        body.body_rates = Vector3::new(0.1, 0.2, 0.3);
    });
    let seen = Seen::of(&model, &input);
    near(
        vector(Instrument::Magnetometer { field_ut }, &seen),
        [0.0, -20.0, 45.0],
        1e-13,
    );
    near(vector(Instrument::Gyroscope, &seen), [0.1, 0.2, 0.3], 1e-15);
    // Right side down by 60°: the beam is twice as long as the height, and the field's vertical part comes in from the right.
    let (model, input) = with_body(Level::Two, |body| {
        body.attitude = EulerAngles::new(std::f64::consts::FRAC_PI_3, 0.0, 0.0).quaternion();
    });
    let seen = Seen::of(&model, &input);
    assert!((scalar(Instrument::Sonar, &seen) - 6.0).abs() < 1e-13);
    let (s, c) = std::f64::consts::FRAC_PI_3.sin_cos();
    near(
        vector(Instrument::Magnetometer { field_ut }, &seen),
        [20.0, 45.0 * s, 45.0 * c],
        1e-13,
    );
}

/// Samples one sensor every millisecond for so many.
fn sampled(sensor: Sensor, milliseconds: u64, seed: u64) -> Vec<quad_estimation::sensor::Measurement> {
    let suite = SensorSuite::new([sensor]).expect("a valid sensor");
    let (model, input) = hovering(Level::Two);
    let seen = Seen::of(&model, &input);
    let mut random = generator(seed);
    let mut state = suite.turned_on(&mut random);
    (0..milliseconds)
        .flat_map(|k| {
            let arrived = suite.sample(&mut state, k * 1_000_000, &seen, &mut random);
            assert!(arrived.iter().all(|m| m.arrives_ns <= k * 1_000_000));
            arrived
        })
        .collect()
}

#[test]
fn exact_noise_and_bias_have_their_deviations() {
    let sensor = Sensor {
        turn_on_bias: 2.0,
        ..Sensor::noisy(Instrument::Barometer, 0.5, 1000.0)
    };
    let (n, seeds) = (2000, 400);
    let mut biases = Vec::new();
    for seed in 0..seeds {
        let read = sampled(sensor, n, seed);
        let mean = read.iter().map(|m| m.values[0] - 3.0).sum::<f64>() / n as f64;
        let variance = read
            .iter()
            .map(|m| (m.values[0] - 3.0 - mean).powi(2))
            .sum::<f64>()
            / (n - 1) as f64;
        // Five standard errors of a deviation: σ/√(2n).
        assert!((variance.sqrt() - 0.5).abs() < 5.0 * 0.5 / (2.0 * n as f64).sqrt());
        assert!((read[0].deviation - 0.5).abs() < 1e-15);
        biases.push(mean);
    }
    let deviation = (biases.iter().map(|b| b * b).sum::<f64>() / seeds as f64).sqrt();
    // Four standard errors.
    assert!(
        (deviation - 2.0).abs() < 4.0 * 2.0 / (2.0 * seeds as f64).sqrt(),
        "{deviation}"
    );
}

/// A bias that walks at d for a time T has the deviation `d √T`.
#[test]
fn exact_drift_grows_with_the_root_of_time() {
    let sensor = Sensor {
        bias_drift: 0.3,
        ..Sensor::noisy(Instrument::Barometer, 1e-9, 50.0)
    };
    let (seeds, milliseconds) = (400_u32, 4001);
    let squares: f64 = (0..seeds)
        .map(|seed| {
            let read = sampled(sensor, milliseconds, u64::from(seed));
            let last = read.last().expect("two hundred and one");
            assert_eq!(read.len(), 201);
            (last.values[0] - 3.0).powi(2)
        })
        .sum();
    let deviation = (squares / f64::from(seeds)).sqrt();
    // 0.3 √4 s, within four standard errors.
    assert!(
        (deviation - 0.6).abs() < 4.0 * 0.6 / (2.0 * f64::from(seeds)).sqrt(),
        "{deviation}"
    );
}

#[test]
fn exact_rate_delay_and_losses() {
    let sensor = Sensor {
        delay_s: 0.015,
        dropout: 0.2,
        ..Sensor::noisy(Instrument::PositionFix, 0.1, 200.0)
    };
    let read = sampled(sensor, 20_000, 3);
    assert!(read.iter().all(|m| m.taken_ns % 5_000_000 == 0));
    assert!(read.iter().all(|m| m.arrives_ns == m.taken_ns + 15_000_000));
    assert!(read.windows(2).all(|pair| pair[0].taken_ns < pair[1].taken_ns));
    // 3997 of them arrive in time; four deviations of a binomial.
    let (expected, deviation) = (0.8 * 3997.0, (3997.0 * 0.2 * 0.8_f64).sqrt());
    assert!(
        (read.len() as f64 - expected).abs() < 4.0 * deviation,
        "{}",
        read.len()
    );
}

#[test]
fn exact_rounding_and_range() {
    let coarse = Sensor {
        quantum: 0.4,
        ..Sensor::noisy(Instrument::Barometer, 0.0, 10.0)
    };
    // 3 m is 7.5 quanta: rounded away from zero.
    assert!(
        sampled(coarse, 300, 0)
            .iter()
            .all(|m| (m.values[0] - 3.2).abs() < 1e-12)
    );
    // A uniform error of ±q/2.
    assert!((coarse.deviation() - 0.4 / 12.0_f64.sqrt()).abs() < 1e-15);
    let short = Sensor {
        range: Some([0.2, 2.9]),
        ..Sensor::noisy(Instrument::Sonar, 0.01, 10.0)
    };
    assert!(sampled(short, 300, 0).is_empty());
}
