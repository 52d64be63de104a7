//! Closed forms, agreement with the vehicle file's own derivation, refusals.

use super::*;
use quad_dynamics::vehicle::derive::{FitGrid, SteadyRotor, rad_per_s};

/// The grid that the vehicle file's polynomial was fitted on: 51 duties, 10 voltages.
fn file_grid() -> StaticSweep {
    sweep(evenly(0.05, 0.10, 51), &evenly(9.9, 12.6, 10), 1)
}

#[test]
fn exact_coefficients_of_a_noiseless_stand() {
    let samples = perfect()
        .sweep(&sweep(evenly(0.06, 0.09, 20), &[11.1], 1), &mut generator(0))
        .unwrap();
    let propeller: Vec<PropellerSample> = samples.iter().map(Into::into).collect();
    let truth = qball().propeller.unwrap();
    for (quantity, truth) in [
        (Quantity::Thrust, truth.thrust_coefficient),
        (Quantity::Torque, truth.torque_coefficient),
    ] {
        let fit = coefficient(&propeller, &scale(), quantity).unwrap();
        // Rounding of sums of 20 squares.
        assert_relative_eq!(fit.values()[0], truth, max_relative = 1e-13);
    }
}

#[test]
fn exact_cubic_and_line_through_points_of_one() {
    let cubic_of = |x: f64| 0.7 * x + 55.0 * x * x - 28.0 * x.powi(3);
    let samples: Vec<StaticSample> = evenly(0.06, 0.09, 12)
        .into_iter()
        .map(|duty| StaticSample {
            duty,
            battery_voltage_v: 11.1,
            thrust_n: cubic_of((duty - 0.05) * 11.1),
            torque_n_m: 0.02 * cubic_of((duty - 0.05) * 11.1),
            speed_rad_s: 400.0,
        })
        .collect();
    let fit = polynomial(&samples, 0.05, Quantity::Thrust).unwrap();
    // Rounding times the condition number of a cubic on a third of its range, some 500.
    for (value, truth) in fit.values().into_iter().zip([0.7, 55.0, -28.0]) {
        assert_relative_eq!(value, truth, max_relative = 1e-11);
    }
    let straight = samples.map_thrust(|duty| 250.0 * (duty - 0.0599));
    let gains = linear_gains(&straight).unwrap();
    // Rounding of duties near 0.06 in differences of 0.01.
    assert_relative_eq!(gains.thrust_gain.value, 250.0, max_relative = 1e-11);
    assert_relative_eq!(gains.torque_gain.value, 5.0, max_relative = 1e-11);
    assert_relative_eq!(gains.zero_thrust.value, 0.0599, max_relative = 1e-11);
}

/// Test data with another thrust, and a fiftieth of it as torque.
trait MapThrust {
    fn map_thrust(&self, thrust: impl Fn(f64) -> f64) -> Vec<StaticSample>;
}

impl MapThrust for Vec<StaticSample> {
    fn map_thrust(&self, thrust: impl Fn(f64) -> f64) -> Vec<StaticSample> {
        self.iter()
            .map(|s| StaticSample {
                thrust_n: thrust(s.duty),
                torque_n_m: thrust(s.duty) / 50.0,
                ..*s
            })
            .collect()
    }
}

#[test]
fn exact_intercept_ratio_by_hand() {
    // T = 1, 3, 2, 5, 4 at ū = 0..4: a = 1.4, K = 0.8, s² = 1.2, cov = s²/50 · [[30, −10], [−10, 5]] (as the test of `linear`).
    // u_0 = −1.75; g = [−1.25, 2.1875]; gᵀ C g = 1.2/50 (30·1.5625 + 20·1.25·2.1875 + 5·4.78515625) = 3.01171875.
    let samples: Vec<StaticSample> = [1.0, 3.0, 2.0, 5.0, 4.0]
        .iter()
        .enumerate()
        .map(|(i, &thrust_n)| StaticSample {
            duty: i as f64,
            battery_voltage_v: 11.1,
            thrust_n,
            torque_n_m: 0.016 * thrust_n,
            speed_rad_s: 1.0,
        })
        .collect();
    // Five points leave the slope's interval (0.8 ± 1.1) at zero: refused. Ten copies of each don't.
    assert!(matches!(linear_gains(&samples), Err(StaticError::NoSlope { .. })));
    let many: Vec<StaticSample> = samples.iter().copied().cycle().take(50).collect();
    let gains = linear_gains(&many).unwrap();
    // Ten copies: XᵀX ten times as large, s² = 36/48.
    let variance: f64 = 3.011_718_75 / 10.0 / 1.2 * 36.0 / 48.0;
    assert_relative_eq!(gains.zero_thrust.value, -1.75, max_relative = 1e-12);
    assert_relative_eq!(
        gains.zero_thrust.standard_error,
        variance.sqrt(),
        max_relative = 1e-12
    );
}

#[test]
fn agree_with_the_vehicle_files_derivation() {
    let vehicle = qball();
    let steady = SteadyRotor::of(&vehicle).unwrap();
    let samples = perfect().sweep(&file_grid(), &mut generator(0)).unwrap();
    let grid = FitGrid {
        duties: 0.0..=0.05,
        duty_count: 51,
        voltages: 9.9..=12.6,
        voltage_count: 10,
    };
    let derived = steady.polynomial_fit(&grid).unwrap();
    for (quantity, terms) in [
        (Quantity::Thrust, derived.thrust),
        (Quantity::Torque, derived.torque),
    ] {
        let fit = polynomial(&samples, 0.05, quantity).unwrap();
        for (value, term) in fit.values().into_iter().zip(terms.coefficients()) {
            // Singular values here, normal equations there: 1e-16 times the squared condition number, 1e5.
            assert_relative_eq!(value, term, max_relative = 1e-9);
        }
        // The mechanistic rotor is no cubic: without noise, that shows.
        assert!(
            fit.warnings
                .iter()
                .any(|w| matches!(w, Warning::CorrelatedResiduals { .. }))
        );
    }
    let speeds = rad_per_s(2377.0)..=rad_per_s(6528.0);
    let duties = [*speeds.start(), *speeds.end()].map(|speed| 0.05 + steady.duty(speed, 11.1));
    let samples = perfect()
        .sweep(
            &sweep(evenly(duties[0], duties[1], 1001), &[11.1], 1),
            &mut generator(0),
        )
        .unwrap();
    let (gains, line) = (
        linear_gains(&samples).unwrap(),
        steady.linear_fit(speeds, 11.1).unwrap(),
    );
    // Rounding of sums over a thousand points.
    assert_relative_eq!(gains.thrust_gain.value, line.thrust_gain, max_relative = 1e-10);
    assert_relative_eq!(gains.torque_gain.value, line.torque_gain, max_relative = 1e-10);
    assert_relative_eq!(
        gains.zero_thrust.value - 0.05,
        line.zero_thrust,
        max_relative = 1e-10
    );
}

#[test]
fn exact_a_bias_moves_the_zero_by_itself_over_the_gain() {
    let duties = sweep(evenly(0.062, 0.085, 15), &[11.1], 1);
    let truth = perfect().sweep(&duties, &mut generator(0)).unwrap();
    let before = linear_gains(&truth).unwrap();
    let bias = 0.2;
    let biased: Vec<StaticSample> = truth
        .iter()
        .map(|s| StaticSample {
            thrust_n: s.thrust_n + bias,
            ..*s
        })
        .collect();
    let after = linear_gains(&biased).unwrap();
    // Least squares is linear: rounding only.
    assert_relative_eq!(
        after.zero_thrust.value,
        before.zero_thrust.value - bias / before.thrust_gain.value,
        epsilon = 1e-13
    );
    assert_relative_eq!(
        after.thrust_gain.value,
        before.thrust_gain.value,
        max_relative = 1e-12
    );
}

#[test]
fn exact_refusals_and_warnings() {
    let good = perfect()
        .sweep(
            &sweep(evenly(0.06, 0.09, 20), &[11.1, 12.0], 1),
            &mut generator(0),
        )
        .unwrap();
    assert!(matches!(
        linear_gains(&good),
        Err(StaticError::VoltageVaries { .. })
    ));
    assert!(matches!(
        polynomial(&good, 0.07, Quantity::Thrust),
        Err(StaticError::BelowRange { index: 0, .. })
    ));
    assert!(matches!(
        polynomial(&good[..3], 0.05, Quantity::Thrust),
        Err(StaticError::Fit(FitError::TooFewPoints {
            points: 3,
            unknowns: 3
        }))
    ));
    let same = vec![good[0]; 9];
    assert!(matches!(
        polynomial(&same, 0.05, Quantity::Torque),
        Err(StaticError::Fit(FitError::RankDeficient { .. }))
    ));
    assert!(matches!(
        linear_gains(&same),
        Err(StaticError::Fit(FitError::RankDeficient { .. }))
    ));
    let mut holed = good.clone();
    holed[7].thrust_n = f64::NAN;
    assert!(matches!(
        polynomial(&holed, 0.05, Quantity::Thrust),
        Err(StaticError::Fit(FitError::NotFinite { index: 7 }))
    ));
    let mut clipped = good.clone();
    for sample in &mut clipped {
        sample.thrust_n = sample.thrust_n.min(5.0);
    }
    let fit = polynomial(&clipped, 0.05, Quantity::Thrust).unwrap();
    assert!(
        fit.warnings
            .iter()
            .any(|w| matches!(w, Warning::Saturated { limit, .. } if *limit == 5.0))
    );
    let propeller: Vec<PropellerSample> = good.iter().map(Into::into).collect();
    let flat = PropellerScale {
        diameter_m: 0.0,
        ..scale()
    };
    assert!(matches!(
        coefficient(&propeller, &flat, Quantity::Thrust),
        Err(StaticError::NotPositive { .. })
    ));
    let stopped = [PropellerSample {
        speed_rad_s: 0.0,
        thrust_n: 0.0,
        torque_n_m: 0.0,
    }; 4];
    assert!(coefficient(&stopped, &scale(), Quantity::Torque).is_err());
    assert!(speed_dependence(&stopped, &scale(), Quantity::Torque, SpeedLaw::Linear, 400.0).is_err());
}

#[test]
fn exact_samples_are_rows_of_a_csv() {
    let text = "duty,battery_voltage_v,thrust_n,torque_n_m,speed_rad_s\n0.07,11.1,2.5,0.04,390\n";
    let rows: Vec<StaticSample> = csv::Reader::from_reader(text.as_bytes())
        .deserialize()
        .map(Result::unwrap)
        .collect();
    assert_eq!(
        rows,
        [StaticSample {
            duty: 0.07,
            battery_voltage_v: 11.1,
            thrust_n: 2.5,
            torque_n_m: 0.04,
            speed_rad_s: 390.0
        }]
    );
}
