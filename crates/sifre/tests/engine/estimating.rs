//! Estimators on board: beside the loop they change nothing, in it they fly; they are saved, resumed, and fail in words.

use crate::support::{c1, c3, ms, run_recorded, sorted_bits, sorted_snapshot, vehicle};
use proptest::prelude::*;
use quad_dynamics::Level;
use quad_estimation::sensor::{Quality, Sensor, SensorSuite};
use quad_estimation::{InitialUncertainty, ProcessNoise};
use quad_ndi::Reference;
use sifre::quadrotor::{EstimateUse, Estimation, FilterKind, QuadrotorError, Setup, Start, Wind};
use sifre::{
    AgentEvent, Engine, Member, ModelQuadrotor, Recording, ResumeError, RunStatus, SimulationSnapshot,
    SnapshotError,
};

/// Two metres up, asked for a step of half a metre, in a wind that the filter knows nothing of.
fn setup(level: Level, estimation: Option<Estimation>) -> Setup {
    let vehicle = vehicle();
    let goal = Reference::hold([0.5, -0.3, -2.0].into(), 0.3);
    let mut setup = Setup {
        start: Start {
            position_m: [0.0, 0.0, -2.0],
            yaw_rad: 0.0,
        },
        estimation,
        ..Setup::new("alpha", &vehicle, level, c3(&vehicle), goal)
    };
    if level >= Level::Four {
        setup.script.wind = Wind {
            constant_m_s: [1.0, 0.0, 0.0],
            ..Wind::default()
        };
    }
    setup
}

fn simulation(level: Level, step_ms: f64, estimation: Option<Estimation>) -> Engine {
    let quadrotor = ModelQuadrotor::new(setup(level, estimation)).expect("a valid setup");
    Engine::new(vec![Member::new(quadrotor, ms(step_ms))]).expect("one agent")
}

fn estimation() -> impl Strategy<Value = Estimation> {
    let filters = prop::sample::select(vec![FilterKind::Extended, FilterKind::Unscented]);
    let quality = prop::sample::select(Quality::ALL.to_vec());
    (3..=5_u8, quality, filters, any::<u64>()).prop_map(|(level, quality, filter, seed)| Estimation {
        filter,
        ..Estimation::new(Level::try_from(level).expect("1 to 5"), quality.suite(), seed)
    })
}

fn through_json(snapshot: &SimulationSnapshot) -> SimulationSnapshot {
    let mut file = Vec::new();
    snapshot.write_json(&mut file).expect("memory doesn't fail");
    SimulationSnapshot::read_json(&file[..]).expect("what was written")
}

proptest! {
    // A filter's step takes a tenth of a millisecond and more, an unscented one's several times that.
    #![proptest_config(ProptestConfig::with_cases(8))]

    #[test]
    fn prop_beside_the_loop_the_flight_is_the_same(estimation in estimation(), truth in 3..=5_u8) {
        let level = Level::try_from(truth).expect("1 to 5");
        let beside = Estimation { used: EstimateUse::Beside, ..estimation };
        let (_, alone) = run_recorded(&mut simulation(level, 2.0, None), 0.2);
        let (report, watched) = run_recorded(&mut simulation(level, 2.0, Some(beside)), 0.2);
        prop_assert!(report.status.is_completed());
        let is_estimate = |name: &str| name.starts_with("alpha.estimate.");
        prop_assert!(!alone.channels().iter().any(|channel| is_estimate(&channel.name)));
        let mut columns = sorted_bits(&watched);
        columns.retain(|(name, _)| !is_estimate(name));
        prop_assert_eq!(watched.channels().len() - columns.len(), 12);
        prop_assert_eq!(columns, sorted_bits(&alone));
    }

    /// Stopped at any nanosecond, fixes on their way, saved, read back, resumed: the same flight, the same beliefs.
    #[test]
    fn prop_resumed_equals_uninterrupted(estimation in estimation(), pause_ns in 0..300_000_000_u64) {
        let start = || simulation(Level::Four, 4.0, Some(estimation.clone()));
        let mut whole = start();
        let (_, uninterrupted) = run_recorded(&mut whole, 0.3);
        let mut first = start();
        let (_, before) = run_recorded(&mut first, pause_ns as f64 / 1e9);
        let snapshot = through_json(&first.save().expect("states are JSON"));
        let member = Member::new(
            ModelQuadrotor::new(setup(Level::Four, Some(estimation.clone()))).expect("as before"),
            ms(4.0),
        );
        let mut second = Engine::resume(vec![member], &snapshot).expect("the same agent");
        let (_, after) = run_recorded(&mut second, 0.3);
        prop_assert_eq!(sorted_snapshot(&second), sorted_snapshot(&whole));
        let bits = |recording: &Recording| -> Vec<Vec<u64>> {
            recording.rows().map(|row| row.values.iter().map(|x| x.to_bits()).collect()).collect()
        };
        prop_assert_eq!([bits(&before), bits(&after)].concat(), bits(&uninterrupted));
    }
}

/// Good sensors and all that the filter is uncertain of, made this many times smaller: its gains stay the same.
fn nearly_perfect(scale: f64) -> Estimation {
    let sensors = Quality::Good.sensors().map(|s| Sensor {
        noise: s.noise * scale,
        turn_on_bias: s.turn_on_bias * scale,
        bias_drift: s.bias_drift * scale,
        ..s
    });
    let estimation = Estimation::new(Level::Three, SensorSuite::new(sensors).expect("sensors"), 3);
    let (n, u) = (estimation.noise, estimation.uncertainty);
    Estimation {
        noise: ProcessNoise {
            position: n.position * scale,
            velocity: n.velocity * scale,
            attitude: n.attitude * scale,
            rates: n.rates * scale,
            own: n.own * scale,
            disturbance: n.disturbance * scale,
            ..n
        },
        uncertainty: InitialUncertainty {
            position_m: u.position_m * scale,
            velocity_m_s: u.velocity_m_s * scale,
            attitude_rad: u.attitude_rad * scale,
            rates_rad_s: u.rates_rad_s * scale,
            own: u.own * scale,
            disturbance_m_s2: u.disturbance_m_s2 * scale,
            ..u
        },
        ..estimation
    }
}

/// Largest distance between a flight by estimates and the flight by the truth, m.
fn largest_distance(scale: f64) -> f64 {
    let (_, truth) = run_recorded(&mut simulation(Level::Three, 2.0, None), 3.0);
    let (report, flown) = run_recorded(
        &mut simulation(Level::Three, 2.0, Some(nearly_perfect(scale))),
        3.0,
    );
    assert!(report.status.is_completed());
    let columns = |recording: &Recording| {
        ["x", "y", "z"].map(|axis| -> Vec<f64> {
            let column = recording.column(&format!("alpha.position.{axis}"));
            column.expect("every quadrotor has it").collect()
        })
    };
    let (a, b) = (columns(&flown), columns(&truth));
    let distance = |k: usize| (0..3).map(|i| (a[i][k] - b[i][k]).powi(2)).sum::<f64>().sqrt();
    (0..a[0].len()).map(distance).fold(0.0, f64::max)
}

/// With the truth's own model and sensors that are perfect in the limit, flying by the estimate is flying by the truth: the
/// difference goes to zero with the sensors' noise, and in proportion to it.
#[test]
fn exact_with_perfect_sensors_the_loop_is_that_of_the_truth() {
    let [coarse, fine] = [1e-2, 1e-3].map(largest_distance);
    println!("a hundredth of the noise: {coarse:e} m, a thousandth: {fine:e} m");
    // In proportion but for what is of second order, relatively a hundredth at most.
    assert!((coarse / fine - 10.0).abs() < 0.5, "{coarse} m and {fine} m");
    // A hundredth of good sensors, whose fixes are good to 1 cm.
    assert!(fine < 1e-4, "{fine} m");
}

/// The filter is informed of a start in motion; otherwise it would look for its flight two metres away.
#[test]
fn exact_a_start_in_motion_is_known() {
    let estimation = Estimation::new(Level::Three, Quality::Good.suite(), 1);
    let mut quadrotor = ModelQuadrotor::new(setup(Level::Three, Some(estimation))).expect("a valid setup");
    let mut flight = quadrotor.model().snapshot(quadrotor.input());
    flight.body.position += nalgebra::Vector3::new(2.0, 0.0, 0.0);
    flight.body.velocity.x = 1.0;
    quadrotor.put_in_flight(&flight);
    let mut simulation = Engine::new(vec![Member::new(quadrotor, ms(2.0))]).expect("one agent");
    let (_, flown) = run_recorded(&mut simulation, 0.01);
    let first = |name: &str| flown.column(name).expect("a channel").next().expect("a row");
    // One fix of 1 cm pulls by at most its own error; velocities are not measured.
    assert!((first("alpha.estimate.position.x") - 2.0).abs() < 0.05);
    assert!((first("alpha.estimate.velocity.x") - 1.0).abs() < 0.05);
}

/// A filter that refuses ends the run in words; the flight is whole, and so is what was recorded.
#[test]
fn exact_a_failing_filter_ends_the_run() {
    let mut estimation = Estimation::new(Level::Three, Quality::Good.suite(), 1);
    // A variance beyond the numbers.
    estimation.noise.disturbance = 1e200;
    let mut simulation = simulation(Level::Five, 2.0, Some(estimation));
    let (report, recording) = run_recorded(&mut simulation, 1.0);
    let RunStatus::EstimatorFailed { agent, reason } = &report.status else {
        panic!("{}", report.status);
    };
    assert_eq!(agent, "alpha");
    assert!(reason.contains("became NaN or infinite"), "{reason}");
    assert!(report.status.to_string().contains("estimator of \"alpha\""));
    assert_eq!(report.time_s, 0.002, "at the first prediction");
    let event = simulation.events().last().expect("it is noted");
    assert!(matches!(event.what, AgentEvent::EstimatorFailed { .. }));
    assert_eq!(recording.rows().count(), 2);
    assert!(
        recording
            .rows()
            .all(|row| row.values.iter().all(|x| x.is_finite()))
    );
}

#[test]
fn exact_wrong_estimators_are_refused() {
    let refuse = |estimation| {
        let error = ModelQuadrotor::new(setup(Level::Five, Some(estimation))).expect_err("a bad estimator");
        assert!(matches!(error, QuadrotorError::Estimation { .. }), "{error}");
        error.to_string()
    };
    let good = || Estimation::new(Level::Three, Quality::Good.suite(), 1);
    // c3 flies by thrusts, which a filter on level 2 has not; beside the loop it needs none.
    let low = Estimation {
        level: Level::Two.into(),
        ..good()
    };
    let beside = Estimation {
        used: EstimateUse::Beside,
        ..low.clone()
    };
    let error = refuse(low);
    assert!(error.contains("in the loop"), "{error}");
    assert!(ModelQuadrotor::new(setup(Level::Five, Some(beside))).is_ok());
    let mut nan = good();
    nan.noise.rates = f64::NAN;
    assert!(refuse(nan).contains("NaN"));
    let mut sure = good();
    sure.uncertainty.position_m = 0.0;
    assert!(refuse(sure).contains("position"));
}

/// At level 1 states are Euler angles and velocities along W; its pilot flies by its filter all the same.
#[test]
fn prop_c1_flies_by_a_filter_on_level_1() {
    let vehicle = vehicle();
    let setup = Setup {
        pilot: Box::new(c1(&vehicle)),
        ..setup(
            Level::One,
            Some(Estimation::new(Level::One, Quality::Good.suite(), 2)),
        )
    };
    let quadrotor = ModelQuadrotor::new(setup).expect("c1 needs no more than level 1");
    let mut simulation = Engine::new(vec![Member::new(quadrotor, ms(4.0))]).expect("one agent");
    let report = simulation.run(6.0, &mut ()).expect("a later end");
    assert!(report.status.is_completed(), "{}", report.status);
    let flown = simulation.published("alpha").expect("it is there").position;
    // Fixes are good to 1 cm, and the filter smooths them; ten times that is lost control.
    assert!(
        (flown - nalgebra::Vector3::new(0.5, -0.3, -2.0)).norm() < 0.1,
        "{flown}"
    );
}

#[test]
fn exact_a_snapshot_of_another_estimator_is_refused() {
    let good = || Some(Estimation::new(Level::Three, Quality::Good.suite(), 1));
    let fewer = || {
        let mut sensors = Quality::Good.sensors().to_vec();
        sensors.pop();
        let suite = SensorSuite::new(sensors).expect("sensors");
        Some(Estimation::new(Level::Three, suite, 1))
    };
    let higher = || Some(Estimation::new(Level::Five, Quality::Good.suite(), 1));
    let mut saved = simulation(Level::Five, 4.0, good());
    saved.run(0.02, &mut ()).expect("a later end");
    let snapshot = saved.save().expect("states are JSON");
    for (other, says) in [
        (None, "estimator"),
        (fewer(), "sensors"),
        (higher(), "covariance"),
    ] {
        let quadrotor = ModelQuadrotor::new(setup(Level::Five, other)).expect("a valid setup");
        let error =
            Engine::resume(vec![Member::new(quadrotor, ms(4.0))], &snapshot).expect_err("another estimator");
        assert!(
            matches!(error, ResumeError::Snapshot(SnapshotError::Memory { .. })),
            "{error}"
        );
        assert!(error.to_string().contains(says), "{error}");
    }
}
