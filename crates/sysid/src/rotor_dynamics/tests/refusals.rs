//! Bad data: refused, or announced.

use super::*;

fn step_response(n: usize) -> Vec<ResponseSample> {
    let times: Vec<f64> = (0..n).map(|k| 0.02 * k as f64).collect();
    Truth {
        structure: Structure::FirstOrder,
        ..Truth::second_order(1.0, 14.0)
    }
    .outputs(&times, |t| f64::from(t > 0.3))
}

#[test]
fn exact_bad_records_are_refused() {
    let good = step_response(60);
    let with = |change: fn(&mut Vec<ResponseSample>)| {
        let mut samples = good.clone();
        change(&mut samples);
        Record::new(&samples)
    };
    assert_eq!(
        with(|s| s.truncate(5)),
        Err(RecordError::TooFewSamples {
            samples: 5,
            needed: 8
        })
    );
    assert_eq!(
        with(|s| s[9].output = f64::NAN),
        Err(RecordError::NotFinite { index: 9 })
    );
    assert!(matches!(
        with(|s| s[9].time_s = 0.1),
        Err(RecordError::TimeNotRising { index: 9, .. })
    ));
    assert!(matches!(
        with(|s| s[9].time_s = s[8].time_s),
        Err(RecordError::TimeNotRising { index: 9, .. })
    ));
    assert_eq!(
        with(|s| s.iter_mut().for_each(|s| s.input = 2.0)),
        Err(RecordError::ConstantInput { value: 2.0 })
    );
    // An input that changes at the very last sample has had no time to act.
    assert!(matches!(
        with(|s| {
            s.iter_mut().for_each(|s| s.input = 2.0);
            s[59].input = 3.0;
        }),
        Err(RecordError::ConstantInput { .. })
    ));
    assert_eq!(
        with(|s| s.iter_mut().for_each(|s| s.output = 1.5)),
        Err(RecordError::ConstantOutput { value: 1.5 })
    );
}

#[test]
fn exact_gaps_and_saturation_are_announced() {
    let mut samples = step_response(120);
    samples.drain(30..50);
    let record = Record::new(&samples).unwrap();
    let [Warning::Gaps { gaps: 1, longest_s }] = record.warnings[..] else {
        panic!("{:?}", record.warnings)
    };
    // 21 intervals of 0.02 s, up to rounding.
    assert!((longest_s - 0.42).abs() < 1e-12);
    // The exact solution bridges the gap: the input is known there.
    let fit = identify(&record, Structure::FirstOrder, Start::Equilibrium).unwrap();
    let Coefficients::FirstOrder { bandwidth } = fit.coefficients else {
        panic!()
    };
    // As without a gap: the noiseless minimum.
    assert!((bandwidth.value - 14.0).abs() < 1e-6);
    assert!(fit.warnings.contains(&Warning::Gaps { gaps: 1, longest_s }));

    let times = uniform_times(0.005, 2.0).unwrap();
    let mut samples = Truth::second_order(40.0, 300.0).outputs(&times, prbs(0.1));
    let free = Record::new(&samples).unwrap();
    assert_eq!(free.warnings, []);
    for sample in &mut samples {
        sample.output = sample.output.min(1.0);
    }
    let clipped = Record::new(&samples).unwrap();
    assert!(
        matches!(clipped.warnings[..], [Warning::Saturated { limit, .. }] if limit == 1.0),
        "{:?}",
        clipped.warnings
    );
}

/// A fast pole sampled far too slowly, at rest again before the next sample, is not excited as the data show it.
#[test]
fn exact_a_pole_that_the_sampling_cannot_see_is_announced() {
    let times = uniform_times(0.1, 30.0).unwrap();
    let samples = Truth::second_order(5010.0, 50_000.0).outputs(&times, prbs(0.3));
    let fit = identify(
        &noisy(&samples, 0.05, 3),
        Structure::SecondOrder,
        Start::Equilibrium,
    );
    let announced = match &fit {
        Ok(fit) => fit.warnings.iter().any(|w| {
            matches!(
                w,
                Warning::Undetermined { .. } | Warning::NotConverged { .. } | Warning::IllConditioned { .. }
            )
        }),
        Err(_) => true,
    };
    assert!(announced, "{:?}", fit.map(|f| (f.coefficients, f.warnings)));
}

#[test]
fn exact_a_model_too_small_leaves_correlated_residuals() {
    let times = uniform_times(0.005, 3.0).unwrap();
    let samples = Truth::second_order(60.0, 1200.0).outputs(&times, prbs(0.04));
    let fit = identify(
        &noisy(&samples, 0.01, 2),
        Structure::FirstOrder,
        Start::Equilibrium,
    )
    .unwrap();
    assert!(
        fit.warnings
            .iter()
            .any(|w| matches!(w, Warning::CorrelatedResiduals { .. }))
    );
}
