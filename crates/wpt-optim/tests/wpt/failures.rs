//! Whatever happens in a flight, its cost is finite, and grows with what went wrong.

use crate::nominal;
use proptest::prelude::*;
use quad_dynamics::Level;
use wpt_optim::{Choice, FAILURE, Objective};

/// Asks for a start at so many m/s away from everything.
fn away(speed: f64) -> [f64; 4] {
    [5.0, speed, 5.0, 0.0]
}

#[test]
fn exact_a_failed_flight_is_a_finite_penalty_that_says_when() {
    // Drag brakes levels 4 and 5 before they are lost.
    for level in [Level::One, Level::Two, Level::Three] {
        let problem = nominal(Choice::Four, 4.0, level);
        let slow = problem.evaluate(&away(1e4)).unwrap();
        let fast = problem.evaluate(&away(1e6)).unwrap();
        for outcome in [slow, fast] {
            assert!(
                outcome.cost.is_finite() && outcome.cost > 0.5 * FAILURE,
                "{level}"
            );
        }
        // 1 km at 10 km/s takes 0.1 s, at 1000 km/s a millisecond; the controller brakes a little.
        let time_s = |outcome: wpt_optim::Outcome| outcome.failure.unwrap().time_s;
        assert!((0.09..0.2).contains(&time_s(slow)), "{level}: {}", time_s(slow));
        assert!(time_s(fast) < 0.01 && fast.cost > slow.cost, "{level}");
    }
}

#[test]
fn exact_a_failed_lane_spoils_no_other() {
    for level in Level::ALL {
        let problem = nominal(Choice::Four, 4.0, level);
        let good: [f64; 4] = [4.0, 0.0, 4.0, 0.0];
        let beside_good = problem.evaluate_lanes([&good; 4]).unwrap()[0];
        let beside_bad = problem
            .evaluate_lanes([&good, &away(1e300), &away(1e200), &away(-1e150)])
            .unwrap();
        assert_eq!(beside_bad[0], beside_good);
        for (bad, speed) in beside_bad[1..].iter().zip([1e300, 1e200, -1e150]) {
            let alone = problem.evaluate(&away(speed)).unwrap();
            assert!(
                bad.failure.is_some() && bad.cost.is_finite(),
                "{level} at {speed}: {bad:?}"
            );
            // One instant before the failure, the same but for rounding.
            assert!(
                (bad.cost - alone.cost).abs() < 1e-12 * alone.cost,
                "{level} at {speed}"
            );
        }
    }
}

#[test]
fn exact_an_objective_counts_what_failed() {
    let problem = nominal(Choice::Four, 4.0, Level::Two);
    let objective = Objective::new(&problem);
    let good = objective.cost(&[4.0, 0.0, 4.0, 0.0]);
    assert!(good < 10.0);
    for bad in [&away(1e6)[..], &[f64::NAN; 4], &[1.0]] {
        let cost = objective.cost(bad);
        assert!(cost.is_finite() && cost > 0.5 * FAILURE);
    }
    assert_eq!((objective.evaluations(), objective.failures()), (4, 3));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]

    /// Over the whole box, the station's zenith included.
    #[test]
    fn prop_finite_over_the_box(x in prop::array::uniform2(-8.0..8.0_f64)) {
        for level in Level::ALL {
            let outcome = nominal(Choice::Two, 6.0, level).evaluate(&x).unwrap();
            prop_assert!(outcome.cost.is_finite() && outcome.cost > 0.0);
            prop_assert!(outcome.means.array().iter().all(|mean| mean.is_finite() && *mean >= 0.0));
        }
    }
}

/// Lower and lower, faster and faster, nearer and nearer to the zenith: each penalty grows with its violation.
#[test]
fn prop_penalties_grow_with_the_violation() {
    let six = nominal(Choice::Six, 6.0, Level::Three);
    let low = |z: f64| six.evaluate(&[4.0, 0.0, 4.0, 0.0, z, z]).unwrap().means;
    let ground: Vec<f64> = [-1.0, -0.3, 0.0, 1.0, 5.0].map(|z| low(z).ground).into();
    assert_eq!(ground[0], 0.0);
    assert!(ground.windows(2).all(|pair| pair[0] < pair[1]), "{ground:?}");

    let four = nominal(Choice::Four, 6.0, Level::Three);
    let fast = |v: f64| four.evaluate(&[4.0, v, 4.0, 0.0]).unwrap().means;
    let saturation: Vec<f64> = [0.0, 40.0, 60.0, 80.0].map(|v| fast(v).saturation).into();
    assert_eq!(saturation[0], 0.0);
    assert!(
        saturation[1..].windows(2).all(|pair| pair[0] < pair[1]),
        "{saturation:?}"
    );

    let two = nominal(Choice::Two, 6.0, Level::Three);
    let near = |x: f64| two.evaluate(&[x, x]).unwrap().means;
    for term in [
        |m: wpt_optim::Terms<f64>| m.lost_target,
        |m: wpt_optim::Terms<f64>| m.overfill,
    ] {
        let values: Vec<f64> = [6.0, 0.2, 0.0].map(|x| term(near(x))).into();
        assert!(values[0] <= values[1] && values[1] < values[2], "{values:?}");
    }
}
