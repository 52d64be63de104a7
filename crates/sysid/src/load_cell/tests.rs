use super::*;
use crate::laboratory::generator;
use crate::laboratory::load_cells::{Channel, LoadCell};
use crate::test_coverage::assert_covers;
use approx::assert_relative_eq;
use quad_dynamics::Vehicle;

const CHANNELS: [Channel; 3] = [
    Channel::Thrust,
    Channel::TorqueClockwise,
    Channel::TorqueCounterClockwise,
];

fn cell(channel: Channel) -> LoadCell {
    LoadCell {
        non_linearity: 0.0,
        ..LoadCell::of(&Vehicle::qball_x4(), channel)
    }
}

fn samples(cell: &LoadCell, seed: u64) -> Vec<Sample> {
    cell.calibrate(5, 2, &mut generator(seed)).unwrap()
}

fn calibrated(cell: &LoadCell, seed: u64) -> Calibration {
    calibrate(&samples(cell, seed), cell.capacity.abs()).unwrap()
}

#[test]
fn exact_a_perfect_cell_is_found() {
    for channel in CHANNELS {
        let mut cell = cell(channel);
        cell.reading_v = crate::laboratory::Sensor::PERFECT;
        let found = calibrated(&cell, 0);
        assert_relative_eq!(found.zero().value, cell.zero_v, epsilon = 1e-13);
        assert_relative_eq!(
            found.sensitivity().value,
            cell.sensitivity_v,
            max_relative = 1e-13
        );
        let load = 0.37 * cell.capacity;
        let back = found.load(&[cell.response(load)]).unwrap();
        assert_relative_eq!(back.load.value, load, max_relative = 1e-12);
    }
}

/// Five points by hand: line 0.1 + 2 x, residuals (1, −1, 0, −1, 1)/10: no slope, no mean, a bow.
const BY_HAND: [(f64, f64); 5] = [(0.0, 0.2), (1.0, 2.0), (2.0, 4.1), (3.0, 6.0), (4.0, 8.2)];

fn by_hand() -> Vec<Sample> {
    let sample = |(load, reading_v)| Sample { load, reading_v };
    BY_HAND.map(sample).to_vec()
}

#[test]
fn exact_inverse_prediction_and_fiellers_interval_by_hand() {
    let found = calibrate(&by_hand(), 5.0).unwrap();
    assert_relative_eq!(found.zero().value, 0.1, epsilon = 1e-13);
    assert_relative_eq!(found.sensitivity().value, 2.0, epsilon = 1e-13);
    let sigma = (0.04_f64 / 3.0).sqrt();
    assert_relative_eq!(found.line.goodness.standard_deviation, sigma, epsilon = 1e-13);
    let back = found.load(&[7.0, 7.2]).unwrap();
    assert_relative_eq!(back.load.value, 3.5, epsilon = 1e-13);
    // σ/s √(1/2 + 1/5 + 1.5²/10).
    assert_relative_eq!(
        back.load.standard_error,
        0.5 * sigma * (0.7_f64 + 0.225).sqrt(),
        epsilon = 1e-13
    );
    // The ends of Fieller's interval are where (ȳ_0 − a − s x)² = t² σ² (1/m + 1/n + (x − x̄)²/S_xx).
    let t = 3.182_446_305_f64;
    for x in [back.interval.lower, back.interval.upper] {
        let left = (7.1 - 0.1 - 2.0 * x).powi(2);
        let right = (t * sigma).powi(2) * (0.7 + (x - 2.0).powi(2) / 10.0);
        // Digits of the table of t.
        assert_relative_eq!(left, right, max_relative = 1e-8);
    }
    assert!(back.warnings.is_empty());
    assert!(matches!(
        found.load(&[9.0]).unwrap().warnings[..],
        [Warning::Extrapolated { .. }]
    ));
}

#[test]
fn exact_quadratic_term_by_hand() {
    let found = calibrate(&by_hand(), 5.0).unwrap().linearity;
    // Residuals (1, −1, 0, −1, 1)/10 against u² − 2 = (2, −1, −2, −1, 2): q = Σ r w / Σ w² = 0.6/14.
    assert_relative_eq!(found.quadratic.value, 0.6 / 14.0, epsilon = 1e-13);
    // Left over: Σ r² − q² Σ w² = 0.04 − 0.36/14, two degrees of freedom.
    let variance: f64 = (0.04 - 0.36 / 14.0) / 2.0 / 14.0;
    assert_relative_eq!(found.quadratic.standard_error, variance.sqrt(), epsilon = 1e-13);
    // Student's t with 2 degrees of freedom is closed: P(|T| > t) = 1 − t/√(2 + t²).
    let t = 0.6 / 14.0 / variance.sqrt();
    assert_relative_eq!(found.p_value, 1.0 - t / (2.0 + t * t).sqrt(), epsilon = 1e-9);
    // Largest departure q · 2 at the ends and the middle, of a span of 8.
    assert_relative_eq!(found.departure, 1.2 / 14.0 / 8.0, epsilon = 1e-13);
    assert_eq!(found.lack_of_fit, None);
}

#[test]
fn prop_95_percent_intervals_cover_zero_sensitivity_and_load() {
    for channel in CHANNELS {
        let cell = cell(channel);
        assert_covers(|seed| calibrated(&cell, seed).zero().interval().contains(cell.zero_v));
        assert_covers(|seed| {
            calibrated(&cell, seed)
                .sensitivity()
                .interval()
                .contains(cell.sensitivity_v)
        });
        let load = 0.8 * cell.capacity;
        assert_covers(|seed| {
            let calibration = calibrated(&cell, seed);
            let mut random = generator(1000 + seed);
            let readings: Vec<f64> = (0..3)
                .map(|_| cell.reading_v.read(cell.response(load), &mut random))
                .collect();
            let found = calibration.load(&readings).unwrap();
            found.interval.contains(load)
        });
    }
}

#[test]
fn prop_linearity_is_rejected_once_in_a_thousand_and_a_bow_is_seen() {
    let straight = cell(Channel::Thrust);
    // Two tests at 1e-3: 0.4 of 200 expected; 4 or more have a probability of 1e-3.
    let rejected = (0..200)
        .filter(|&seed| !calibrated(&straight, seed).linearity.is_straight())
        .count();
    assert!(rejected < 4, "{rejected}");
    let bowed = LoadCell {
        non_linearity: 2e-3,
        ..straight
    };
    // A bow of 10 mV in noise of 2 mV: seen in every calibration of 24 readings.
    for seed in 0..200 {
        let found = calibrated(&bowed, seed);
        assert!(!found.linearity.is_straight());
        assert!(
            found
                .line
                .warnings
                .iter()
                .any(|w| matches!(w, Warning::NotStraight { .. }))
        );
    }
    // −4 ε s² on s = 0, 0.2, .., 1 departs from its best line most at the ends: by 4 ε (0.25 − 0.7/6) = 0.533 ε. Noise of
    // 2 mV in 24 readings moves that by about 1.5 · 2/√24 = 0.6 mV of the 10 mV that ε is; three of those.
    let departure = calibrated(&bowed, 1).linearity.departure;
    assert!((departure / 2e-3 - 0.533).abs() < 0.18, "{departure}");
}

#[test]
fn exact_refusals() {
    let cell = cell(Channel::Thrust);
    let good = samples(&cell, 0);
    let changed = |change: fn(&mut Vec<Sample>)| {
        let mut bad = good.clone();
        change(&mut bad);
        calibrate(&bad, cell.capacity)
    };
    assert!(matches!(
        changed(|s| s[3].reading_v = f64::NAN),
        Err(LoadCellError::Fit(FitError::NotFinite { index: 3 }))
    ));
    assert!(matches!(
        changed(|s| s[3].load = 500.0),
        Err(LoadCellError::Overload { index: 3, .. })
    ));
    assert!(matches!(
        changed(|s| s.retain(|s| s.load < 4.0)),
        Err(LoadCellError::TooFewLoads { loads: 2 })
    ));
    assert!(matches!(
        changed(Vec::clear),
        Err(LoadCellError::TooFewLoads { loads: 0 })
    ));
    // A loose wire: noise alone.
    let dead = LoadCell {
        sensitivity_v: 1e-9,
        ..cell
    };
    assert!(matches!(
        calibrate(&samples(&dead, 0), dead.capacity),
        Err(LoadCellError::NoResponse { .. })
    ));
    assert!(matches!(
        changed(|s| s.iter_mut().for_each(|s| s.reading_v = 1.0)),
        Err(LoadCellError::Fit(FitError::ConstantData { value: 1.0, .. }))
    ));
    let found = calibrated(&cell, 0);
    assert_eq!(found.load(&[]), Err(LoadCellError::NoReading));
    assert_eq!(found.load(&[f64::NAN]), Err(LoadCellError::NoReading));
    assert!(matches!(
        calibrate(&good, 0.0),
        Err(LoadCellError::Capacity { .. })
    ));
}

#[test]
fn exact_a_saturated_amplifier_is_noticed() {
    let mut cell = cell(Channel::Thrust);
    cell.reading_v.maximum = 3.5;
    let warnings = calibrated(&cell, 0).line.warnings;
    assert!(
        warnings
            .iter()
            .any(|w| matches!(w, Warning::Saturated { samples: 8, limit } if *limit == 3.5)),
        "{warnings:?}"
    );
}

#[test]
fn data_columns_of_csv_files_are_read() {
    let thrust: Result<Vec<ThrustSample>, _> =
        csv::Reader::from_reader("load_n,reading_v\n1.5,0.4\n".as_bytes())
            .deserialize()
            .collect();
    let torque: Result<Vec<TorqueSample>, _> =
        csv::Reader::from_reader("load_n_m,reading_v\n-0.1,0.4\n".as_bytes())
            .deserialize()
            .collect();
    assert_eq!(Sample::from(thrust.unwrap()[0]).load, 1.5);
    assert_eq!(Sample::from(torque.unwrap()[0]).load, -0.1);
}
