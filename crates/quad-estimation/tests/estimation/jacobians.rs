//! The battery of derivatives: automatic against central differences, for every level, instrument and the reset.

use crate::support::{drawn, generator, hovering, process};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use quad_dynamics::Level;
use quad_estimation::Process;
use quad_estimation::sensor::{EARTH_FIELD_UT, Instrument};

const INSTRUMENTS: [Instrument; 6] = [
    Instrument::Accelerometer,
    Instrument::Gyroscope,
    Instrument::Magnetometer {
        field_ut: EARTH_FIELD_UT,
    },
    Instrument::Sonar,
    Instrument::Barometer,
    Instrument::PositionFix,
];

/// Step of the differences: the truncation is h² times a third derivative of order one to a hundred, the rounding 1e-16 × 100 / h.
const H: f64 = 1e-5;

fn differences(n: usize, f: impl Fn(&DVector<f64>) -> DVector<f64>) -> DMatrix<f64> {
    let column = |j: usize| {
        let mut error = DVector::zeros(n);
        error[j] = H;
        (f(&error) - f(&-&error)) / (2.0 * H)
    };
    DMatrix::from_columns(&(0..n).map(column).collect::<Vec<_>>())
}

fn assert_near(what: &str, automatic: &DMatrix<f64>, differences: &DMatrix<f64>) {
    let scale = differences.amax().max(1.0);
    let worst = (automatic - differences).amax();
    // Rounding 1e-16 × 100/H = 1e-9, truncation H² × 100 = 1e-8, both relative to the largest entry.
    assert!(worst < 2e-8 * scale, "{what}: {worst} of {scale}");
}

#[test]
fn exact_derivatives_of_every_level() {
    for level in Level::ALL {
        let mut p = process(level);
        let x = drawn(&p, &hovering(&p), &mut generator(u64::from(level.number())));
        let n = p.error_len();
        let mut input = p.hover_input();
        input.commands[1] *= 1.05;
        input.wind = [0.5, -0.3, 0.1].into();
        let step_s = 0.013;
        let after = p.transition(&x, &input, step_s);
        let automatic = p.transition_jacobian(&x, &input, step_s);
        let by_hand = differences(n, |error| {
            let mut p = p.clone();
            let moved = p.transition(&p.retract(&x, error), &input, step_s);
            p.local(&after, &moved)
        });
        assert_near(&format!("{level}, transition"), &automatic, &by_hand);
        for instrument in INSTRUMENTS {
            let automatic = p.observe_jacobian(&x, &input, instrument);
            let by_hand = differences(n, |error| {
                let mut p = p.clone();
                p.observe(&p.retract(&x, error), &input, instrument)
            });
            assert_near(&format!("{level}, {instrument}"), &automatic, &by_hand);
        }
    }
}

/// Errors about the new mean, differentiated by those about the old one, at the new mean.
#[test]
fn exact_derivative_of_the_reset() {
    for level in [Level::One, Level::Two, Level::Four] {
        let p = process(level);
        let x = hovering(&p).mean;
        let n = p.error_len();
        let mut error = DVector::from_fn(n, |i, _| 0.1 * (i as f64 + 1.0).sin());
        error[6] = 0.4;
        let renewed = p.retract(&x, &error);
        let by_hand = differences(n, |more| p.local(&renewed, &p.retract(&x, &(&error + more))));
        assert_near(&format!("{level}"), &p.reset_jacobian(&error), &by_hand);
    }
}

/// For a small turn the error is the rotation vector: `φ = 2 tan(φ/2)` to third order.
#[test]
fn exact_the_attitude_error_is_the_rotation_vector() {
    let p = process(Level::Two);
    let x = hovering(&p).mean;
    let mut error = DVector::zeros(p.error_len());
    error[8] = 2.0 * (0.2_f64 / 2.0).tan();
    let turned = p.retract(&x, &error);
    // Heading 0.3 at first, 0.2 more about the body's z.
    assert!((turned[6] - 0.25_f64.cos()).abs() < 1e-15 && (turned[9] - 0.25_f64.sin()).abs() < 1e-15);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn prop_an_error_added_is_read_off_again(level in 1..=5_u8, seed in any::<u64>()) {
        let p = process(Level::try_from(level).unwrap());
        let belief = hovering(&p);
        let mut random = generator(seed);
        let x = drawn(&p, &belief, &mut random);
        let error = crate::support::normals(p.error_len(), &mut random);
        let back = p.local(&x, &p.retract(&x, &error));
        // A product and a division of quaternions; the Gibbs vector is below 10 with its reciprocal cosine.
        prop_assert!((&back - &error).amax() < 1e-12 * (1.0 + error.norm_squared()));
    }
}
