//! Lanes agree with scalars.

use crate::nominal;
use proptest::prelude::*;
use quad_dynamics::Level;
use wpt_optim::{Choice, LANES};

fn decision() -> impl Strategy<Value = Vec<f64>> {
    // One side of the station: over it a flight amplifies rounding by orders of magnitude.
    (2.0..8.0_f64, -1.0..1.0_f64, 2.0..8.0_f64, -1.0..1.0_f64).prop_map(|(a, b, c, d)| vec![a, b, c, d])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4))]

    #[test]
    fn agree_lanes_with_scalars(decisions in prop::array::uniform4(decision())) {
        for level in Level::ALL {
            let problem = nominal(Choice::Four, 4.0, level);
            let lanes = problem.evaluate_lanes(decisions.each_ref().map(Vec::as_slice)).unwrap();
            for lane in 0..LANES {
                let alone = problem.evaluate(&decisions[lane]).unwrap();
                // The lanes' sines differ in the last bit; a stable loop forgets it.
                let difference = (lanes[lane].cost - alone.cost).abs();
                prop_assert!(difference < 1e-9 * alone.cost, "{} {}: {:e}", level, lane, difference);
                prop_assert_eq!(lanes[lane].failure, None);
            }
        }
    }

    /// Every lane is a flight of its own: what flies beside it does not matter, not in the last bit.
    #[test]
    fn exact_lanes_do_not_see_each_other(x in decision(), others in prop::array::uniform3(decision())) {
        let problem = nominal(Choice::Four, 4.0, Level::Three);
        let [a, b, c] = &others;
        let together = problem.evaluate_lanes([a, &x, b, c].map(Vec::as_slice)).unwrap()[1];
        let alone = problem.evaluate_lanes([&x; LANES].map(|x| x.as_slice())).unwrap()[3];
        prop_assert_eq!(together, alone);
    }
}
