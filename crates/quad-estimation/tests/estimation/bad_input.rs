//! What makes no sense is refused with numbers, and leaves everything as it was.

use crate::support::{hovering, process};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use quad_dynamics::{Input, Level, Vehicle};
use quad_estimation::sensor::{Instrument, Measurement, Sensor, SensorError, SensorSuite};
use quad_estimation::{
    Belief, EstimationError, Estimator, ExtendedFilter, InitialUncertainty, LevelError, LevelProcess,
    ProcessNoise, Spread, UnscentedFilter,
};

#[test]
fn exact_a_covariance_must_be_one() {
    let mean = DVector::zeros(2);
    let of = |numbers: [f64; 4]| Belief::new(mean.clone(), DMatrix::from_row_slice(2, 2, &numbers));
    assert!(of([1.0, 0.5, 0.5, 1.0]).is_ok());
    for variance in [0.0, -0.3] {
        assert_eq!(
            of([1.0, 0.0, 0.0, variance]),
            Err(EstimationError::NonPositiveVariance { place: 1, variance })
        );
    }
    assert!(matches!(
        of([1.0, 0.5, 0.4, 1.0]),
        Err(EstimationError::NotSymmetric {
            row: 1,
            column: 0,
            ..
        })
    ));
    // Correlated by more than one.
    assert_eq!(
        of([1.0, 1.5, 1.5, 1.0]),
        Err(EstimationError::NotPositiveDefinite)
    );
    assert!(matches!(
        of([1.0, f64::NAN, f64::NAN, 1.0]),
        Err(EstimationError::NotFinite { .. })
    ));
    let wide = DMatrix::zeros(2, 3);
    assert!(matches!(
        Belief::new(mean, wide),
        Err(EstimationError::Length { .. })
    ));
}

#[test]
fn exact_a_belief_of_another_level_is_refused() {
    let belief = hovering(&process(Level::Two));
    let error = ExtendedFilter::new(process(Level::Five), belief.clone()).unwrap_err();
    assert!(matches!(
        error,
        EstimationError::Length {
            expected: 39,
            found: 22,
            ..
        }
    ));
    let spread = Spread {
        alpha: 0.0,
        ..Spread::default()
    };
    let error = UnscentedFilter::new(process(Level::Two), belief, spread).unwrap_err();
    assert!(matches!(error, EstimationError::BadSpread { n: 21, .. }));
}

#[test]
fn exact_noise_must_be_positive() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let noise = ProcessNoise {
            disturbance: bad,
            ..ProcessNoise::default()
        };
        let level = Level::Two;
        let error = LevelProcess::new(level, &Vehicle::qball_x4(), &level.phenomena(), noise).unwrap_err();
        assert!(matches!(
            error,
            LevelError::Noise(EstimationError::BadNoise { .. })
        ));
        assert!(
            error.to_string().contains("the disturbance's noise density"),
            "{error}"
        );
        let uncertainty = InitialUncertainty {
            attitude_rad: bad,
            ..InitialUncertainty::default()
        };
        assert!(uncertainty.validate().is_err());
    }
}

#[test]
fn exact_sensors_that_make_no_sense() {
    let good = Sensor::noisy(Instrument::Sonar, 0.1, 10.0);
    let refused = |sensor: Sensor| SensorSuite::new([good, sensor]).expect_err("it makes no sense");
    for rate_hz in [0.0, -5.0, f64::NAN, f64::INFINITY] {
        let error = refused(Sensor { rate_hz, ..good });
        assert!(matches!(error, SensorError::Rate { .. }));
        assert!(error.to_string().contains("sonar"), "{error}");
    }
    for bad in [-0.1, f64::NAN, f64::INFINITY] {
        for sensor in [
            Sensor { noise: bad, ..good },
            Sensor {
                turn_on_bias: bad,
                ..good
            },
            Sensor {
                bias_drift: bad,
                ..good
            },
            Sensor { quantum: bad, ..good },
            Sensor { delay_s: bad, ..good },
        ] {
            assert!(matches!(refused(sensor), SensorError::Imperfection { .. }));
        }
    }
    for dropout in [-0.1, 1.0, f64::NAN] {
        assert!(matches!(
            refused(Sensor { dropout, ..good }),
            SensorError::Dropout { .. }
        ));
    }
    for range in [[1.0, 1.0], [2.0, 1.0], [f64::NAN, 1.0]] {
        let range = Some(range);
        assert!(matches!(
            refused(Sensor { range, ..good }),
            SensorError::EmptyRange { .. }
        ));
    }
    let compass = |field_ut| Sensor::noisy(Instrument::Magnetometer { field_ut }, 1.0, 10.0);
    for field in [[0.0; 3], [f64::NAN, 0.0, 1.0]] {
        assert!(matches!(refused(compass(field)), SensorError::Field { .. }));
    }
    assert!(matches!(
        refused(Sensor { noise: 0.0, ..good }),
        SensorError::Perfect { .. }
    ));
}

#[test]
fn exact_a_sensor_is_read_from_a_file() {
    let text = r#"{"instrument": {"magnetometer": {"field_ut": [21, 0, 45]}}, "noise": 0.5, "rate_hz": 20}"#;
    let sensor: Sensor = serde_json::from_str(text).expect("what is left out is perfect");
    let field_ut = [21.0, 0.0, 45.0];
    assert_eq!(
        sensor,
        Sensor::noisy(Instrument::Magnetometer { field_ut }, 0.5, 20.0)
    );
    let misspelt = r#"{"instrument": "sonar", "noise": 0.5, "rate_hz": 20, "dealy_s": 1}"#;
    assert!(serde_json::from_str::<Sensor>(misspelt).is_err());
}

type Extended = Estimator<ExtendedFilter<LevelProcess>>;

/// An estimator 50 ms into its flight that remembers 20 ms.
fn flying() -> (Extended, Input<f64>) {
    let process = process(Level::Two);
    let belief = hovering(&process);
    let input = process.hover_input();
    let filter = ExtendedFilter::new(process, belief).expect("same size");
    let mut estimator = Estimator::new(filter, input, 20_000_000);
    for k in 1..=5 {
        estimator.predict(&input, k * 10_000_000).expect("forward");
    }
    (estimator, input)
}

fn fix(taken_ns: u64, values: Vec<f64>, deviation: f64) -> Measurement {
    Measurement {
        instrument: Instrument::PositionFix,
        taken_ns,
        arrives_ns: taken_ns,
        values,
        deviation,
    }
}

#[test]
fn exact_measurements_out_of_order_or_without_sense() {
    let (mut estimator, input) = flying();
    let here = vec![0.0, 0.0, -1.0];
    let before = estimator.filter_mut().clone();
    assert_eq!(
        estimator.update(&fix(50_000_001, here.clone(), 0.1)),
        Err(EstimationError::FromTheFuture {
            taken_ns: 50_000_001,
            now_ns: 50_000_000
        })
    );
    assert_eq!(
        estimator.update(&fix(29_999_999, here.clone(), 0.1)),
        Err(EstimationError::TooOld {
            taken_ns: 29_999_999,
            oldest_ns: 30_000_000
        })
    );
    for taken_ns in [50_000_000, 41_000_000] {
        let nan = vec![0.0, f64::NAN, -1.0];
        assert!(matches!(
            estimator.update(&fix(taken_ns, nan, 0.1)),
            Err(EstimationError::NotFinite { .. })
        ));
        let short = vec![0.0, 0.0];
        assert!(matches!(
            estimator.update(&fix(taken_ns, short, 0.1)),
            Err(EstimationError::Length {
                expected: 3,
                found: 2,
                ..
            })
        ));
        for deviation in [0.0, -0.1, f64::NAN] {
            assert!(matches!(
                estimator.update(&fix(taken_ns, here.clone(), deviation)),
                Err(EstimationError::BadNoise { .. })
            ));
        }
    }
    assert!(matches!(
        estimator.predict(&input, 50_000_000),
        Err(EstimationError::BadStep { .. })
    ));
    let lost = Input::still_air([f64::NAN; 4]);
    assert!(matches!(
        estimator.predict(&lost, 60_000_000),
        Err(EstimationError::NotFinite { .. })
    ));
    use quad_estimation::Filter;
    assert_eq!(estimator.filter().belief(), before.belief());
    assert_eq!(estimator.now_ns(), 50_000_000);
    assert!(flying().0.with_gate(f64::NAN).is_err());
    // The oldest one it remembers is still taken.
    assert!(estimator.update(&fix(30_000_000, here, 0.1)).is_ok());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    /// Whatever is measured, believed or refused, the covariance stays one.
    #[test]
    fn prop_the_covariance_stays_symmetric_and_positive_definite(
        level in 1..=5_u8,
        readings in prop::collection::vec((0..6_usize, -20.0..20.0_f64, -4.0..1.0_f64, 0..30_u64), 1..30),
    ) {
        use quad_estimation::Filter;
        use quad_estimation::sensor::EARTH_FIELD_UT;
        let process = process(Level::try_from(level).unwrap());
        let belief = hovering(&process);
        let input = process.hover_input();
        let filter = ExtendedFilter::new(process, belief).unwrap();
        let mut estimator = Estimator::new(filter, input, 30_000_000);
        let mut now_ns = 0;
        for (kind, value, log_deviation, late_ms) in readings {
            now_ns += 7_000_000;
            // Wild readings may throw an estimate out of the numbers: then it is refused and the belief before it stays.
            let _ = estimator.predict(&input, now_ns);
            let instrument = [
                Instrument::Accelerometer,
                Instrument::Gyroscope,
                Instrument::Magnetometer { field_ut: EARTH_FIELD_UT },
                Instrument::Sonar,
                Instrument::Barometer,
                Instrument::PositionFix,
            ][kind];
            let _ = estimator.update(&Measurement {
                instrument,
                taken_ns: estimator.now_ns().saturating_sub(late_ms * 1_000_000),
                arrives_ns: now_ns,
                values: vec![value; instrument.readings()],
                deviation: 10_f64.powf(log_deviation),
            });
            let Belief { mean, covariance } = estimator.filter().belief().clone();
            prop_assert!(covariance == covariance.transpose());
            prop_assert!(Belief::new(mean, covariance).is_ok());
        }
    }
}
