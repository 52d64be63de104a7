//! Consistency over many seeds: with a matched model the errors are as large as the filter says, no larger and no smaller.
//!
//! The sum of the normalised squares over independent flights is χ²; each test asks for the central 99.9 %, so that the eighteen of them
//! fail once in some fifty choices of seeds, and seeds are fixed.

use crate::matched::{Told, fly};
use quad_dynamics::Level;
use quad_estimation::{ExtendedFilter, Spread, UnscentedFilter};
use statrs::distribution::{ChiSquared, ContinuousCDF};

const SEEDS: u64 = 16;
const STEPS: usize = 150;

fn assert_chi_squared(what: &str, sum: f64, freedom: usize) {
    let chi = ChiSquared::new(freedom as f64).expect("positive");
    let (low, high) = (chi.inverse_cdf(0.0005), chi.inverse_cdf(0.9995));
    assert!(
        (low..high).contains(&sum),
        "{what}: {sum:.1} of {freedom} is not within {low:.1} to {high:.1}"
    );
}

fn assert_consistent(what: &str, flights: &[Told]) {
    let errors = flights[0].belief.covariance.nrows();
    let n = flights.len();
    assert_chi_squared(
        &format!("{what}, NEES of all errors"),
        flights.iter().map(|t| t.nees).sum(),
        errors * n,
    );
    assert_chi_squared(
        &format!("{what}, NEES of the rigid body"),
        flights.iter().map(|t| t.rigid_nees).sum(),
        12 * n,
    );
    assert_chi_squared(
        &format!("{what}, NIS"),
        flights.iter().map(|t| t.nis).sum(),
        flights.iter().map(|t| t.readings).sum(),
    );
}

#[test]
fn prop_extended_filters_on_their_own_level_are_consistent() {
    for level in Level::ALL {
        let flights: Vec<Told> = (0..SEEDS)
            .map(|seed| {
                fly(level, seed, STEPS, |p, first| {
                    ExtendedFilter::new(p, first).expect("same size")
                })
            })
            .collect();
        assert_consistent(&format!("extended, {level}"), &flights);
    }
}

#[test]
fn prop_unscented_filters_are_consistent() {
    let flights: Vec<Told> = (0..SEEDS)
        .map(|seed| {
            fly(Level::Three, seed, STEPS / 2, |p, first| {
                UnscentedFilter::new(p, first, Spread::default()).expect("same size")
            })
        })
        .collect();
    assert_consistent("unscented, level 3", &flights);
}
