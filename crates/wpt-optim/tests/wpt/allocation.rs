//! No heap in a rollout's loop, counted for the measuring thread alone.

use allocation_counter::measure;
use quad_dynamics::Level;
use wpt_optim::{Choice, Problem};

#[test]
fn exact_no_allocation_in_a_rollout() {
    for level in Level::ALL {
        let problem = Problem::nominal(Choice::Two, 2.0, level).unwrap();
        let scalar = measure(|| {
            problem.evaluate(&[4.0, 4.0]).unwrap();
        });
        let lanes = measure(|| {
            problem
                .evaluate_lanes([&[4.0, 4.0], &[0.0, 0.0], &[1e9, 0.0], &[-4.0, 2.0]])
                .unwrap();
        });
        assert_eq!((scalar.count_total, lanes.count_total), (0, 0), "{level}");
    }
}

/// The counter counts: without this the test above could not fail.
#[test]
fn exact_the_counter_counts() {
    assert_eq!(
        measure(|| drop(std::hint::black_box(vec![1.0_f64; 8]))).count_total,
        1
    );
}
