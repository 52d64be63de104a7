//! Stated intervals contain the truth as often as they say; the criterion chooses the true order.

use super::*;
use crate::rotor_static::tests::{Judged, assert_covered};

fn judged(name: &'static str, estimate: Estimate, truth: f64) -> Judged {
    Judged {
        name,
        estimate,
        truth,
    }
}

#[test]
fn prop_coverage_of_a_first_order_bandwidth() {
    let times = uniform_times(0.02, 4.0).unwrap();
    let truth = Truth {
        structure: Structure::FirstOrder,
        ..Truth::second_order(1.0, 14.5)
    };
    let samples = truth.outputs(&times, prbs(0.1));
    assert_covered(|seed| {
        let fit = identify(&noisy(&samples, 0.1, seed), truth.structure, Start::Equilibrium).unwrap();
        let Coefficients::FirstOrder { bandwidth } = fit.coefficients else {
            panic!()
        };
        vec![
            judged("ω_R", bandwidth, 14.5),
            judged("gain", fit.gain, 2.0),
            judged("offset", fit.offset, 0.3),
        ]
    });
}

#[test]
fn prop_coverage_of_the_thrust_coefficients_at_irregular_times() {
    let times = irregular_times(0.008, 3.0, &mut generator(1)).unwrap();
    let samples = Truth::second_order(114.465, 1446.53).outputs(&times, prbs(0.04));
    assert_covered(|seed| {
        let record = noisy(&samples, 0.05, seed);
        let fit = identify(&record, Structure::SecondOrder, Start::Equilibrium).unwrap();
        let (Coefficients::SecondOrder { c1, c2 }, Poles::Real { slow, .. }) = (fit.coefficients, fit.poles)
        else {
            panic!()
        };
        vec![
            judged("c_T1", c1, 114.465),
            judged("c_T2", c2, 1446.53),
            judged("slow pole", slow, 14.4653),
        ]
    });
}

#[test]
fn prop_coverage_of_the_torque_coefficients() {
    let times = uniform_times(0.005, 2.0).unwrap();
    let truth = Truth {
        structure: Structure::SecondOrderWithZero,
        kappa: 768.716,
        ..Truth::second_order(114.465, 1446.53)
    };
    let samples = truth.outputs(&times, prbs(0.04));
    assert_covered(|seed| {
        let record = noisy(&samples, 0.1, seed);
        let fit = identify(&record, truth.structure, Start::Equilibrium).unwrap();
        let Coefficients::SecondOrderWithZero { c1, c3, c4, .. } = fit.coefficients else {
            panic!()
        };
        vec![
            judged("c_Q1", c1, 384.358),
            judged("c_Q3", c3, 114.465),
            judged("c_Q4", c4, 1446.53),
        ]
    });
}

#[test]
fn prop_the_criterion_chooses_the_true_structure() {
    let times = uniform_times(0.008, 3.0).unwrap();
    let truths = [
        Truth {
            structure: Structure::FirstOrder,
            ..Truth::second_order(1.0, 14.5)
        },
        Truth::second_order(114.465, 1446.53),
        Truth {
            structure: Structure::SecondOrderWithZero,
            kappa: 768.716,
            ..Truth::second_order(114.465, 1446.53)
        },
    ];
    const TRIALS: u64 = 20;
    for truth in truths {
        let samples = truth.outputs(&times, prbs(0.04));
        let right = (0..TRIALS).filter(|&seed| {
            let record = noisy(&samples, 0.05, seed);
            let selection = select(&record, &[], Start::Equilibrium).unwrap();
            selection.candidates.len() == 3 && selection.chosen.structure == truth.structure
        });
        // Each of two larger structures is chosen by chance with P(χ²_1 > ln 376) = 1.5 %: more than two in twenty, 2 in 1000.
        assert!(right.count() as u64 >= TRIALS - 2, "{:?}", truth.structure);
    }
}

#[test]
fn prop_a_fit_predicts_data_it_has_not_seen() {
    let times = uniform_times(0.005, 3.0).unwrap();
    let truth = Truth::second_order(60.0, 1200.0);
    let fit = identify(
        &noisy(&truth.outputs(&times, prbs(0.04)), 0.02, 1),
        truth.structure,
        Start::Equilibrium,
    )
    .unwrap();
    let step = noisy(&truth.outputs(&times, |t| f64::from(t > 0.5)), 0.02, 2);
    // By hand: noise 0.02 against a step of 2 whose deviation is 2 √(p(1−p)) = 0.75 (p = 1/6): 2.7 % misfit.
    let percent = fit.validate(&step).unwrap();
    assert!(percent > 96.8 && percent < 97.8, "{percent}");
}
