//! Uniformly random candidates, and what every optimiser owes its caller.

use optim::{Candidate, Limits, Optimiser, RandomSearch, SetupError, TellError, Variable, minimise};
use proptest::prelude::*;

fn variable(name: &str, lower: f64, upper: f64) -> Variable {
    Variable {
        name: name.into(),
        unit: "m".into(),
        lower,
        upper,
    }
}

/// More than any budget here.
const ALL: Limits = Limits::evaluations(1000);

fn search(seed: u64, budget: u64) -> RandomSearch {
    RandomSearch::new(
        vec![variable("x", -1.0, 3.0), variable("y", 2.0, 2.5)],
        seed,
        budget,
    )
    .unwrap()
}

fn cost(values: &[f64]) -> f64 {
    (values[0] - 1.0).powi(2) + (values[1] - 2.2).powi(2)
}

proptest! {
    /// Lost and renewed: proposed again, the first one first, and then the search continues where it was.
    #[test]
    fn prop_lost_candidates_are_renewed(seed in any::<u64>(), told in 0..5_usize) {
        let mut whole = search(seed, 8);
        let expected: Vec<Candidate> = std::iter::from_fn(|| whole.ask()).collect();
        let mut search = search(seed, 8);
        let asked: Vec<Candidate> = std::iter::from_fn(|| search.ask()).take(5).collect();
        search.tell(&asked[told], 1.0).unwrap();
        search.renew();
        let again: Vec<Candidate> = std::iter::from_fn(|| search.ask()).collect();
        let lost = expected.iter().filter(|c| **c != asked[told]);
        prop_assert_eq!(again.iter().collect::<Vec<_>>(), lost.collect::<Vec<_>>());
    }

    #[test]
    fn prop_candidates_lie_within_their_bounds(seed in any::<u64>()) {
        let mut search = search(seed, 50);
        while let Some(candidate) = search.ask() {
            prop_assert!((-1.0..=3.0).contains(&candidate.values[0]) && (2.0..=2.5).contains(&candidate.values[1]));
        }
    }

    /// All asked for first, answered in any order: the same best as one after the other.
    #[test]
    fn prop_the_order_of_telling_does_not_matter(
        seed in any::<u64>(), order in Just((0..20_usize).collect::<Vec<_>>()).prop_shuffle(),
    ) {
        let mut one_by_one = search(seed, 20);
        let best = minimise(&mut one_by_one, cost, ALL).unwrap().best;
        let mut at_once = search(seed, 20);
        let candidates: Vec<Candidate> = std::iter::from_fn(|| at_once.ask()).collect();
        prop_assert!(!at_once.is_done());
        for k in order {
            at_once.tell(&candidates[k], cost(&candidates[k].values)).unwrap();
        }
        prop_assert!(at_once.is_done() && at_once.evaluations() == 20);
        prop_assert_eq!(at_once.best(), Some(&best));
    }

    /// Saved as JSON in the middle and resumed: the same search.
    #[test]
    fn prop_a_saved_search_goes_on(seed in any::<u64>(), pause in 0..20_u64) {
        let mut whole = search(seed, 20);
        minimise(&mut whole, cost, ALL).unwrap();
        let mut first = search(seed, 20);
        for _ in 0..pause {
            let candidate = first.ask().unwrap();
            first.tell(&candidate, cost(&candidate.values)).unwrap();
        }
        let mut second: RandomSearch = serde_json::from_str(&serde_json::to_string(&first).unwrap()).unwrap();
        minimise(&mut second, cost, ALL).unwrap();
        prop_assert_eq!(second, whole);
    }
}

/// The mean of uniform samples tends to the middle: 5 standard errors of `(upper − lower)/√12` over √n.
#[test]
fn exact_samples_are_uniform() {
    let mut search = search(1, 4000);
    let (mut sum, mut below) = (0.0, 0.0);
    while let Some(candidate) = search.ask() {
        sum += candidate.values[0];
        below += f64::from(candidate.values[0] < 0.0);
    }
    let n = 4000.0_f64;
    assert!((sum / n - 1.0).abs() < 5.0 * 4.0 / 12.0_f64.sqrt() / n.sqrt());
    // A quarter lies below zero, binomially.
    assert!((below / n - 0.25).abs() < 5.0 * (0.25 * 0.75 / n).sqrt());
}

#[test]
fn exact_bad_input() {
    assert_eq!(RandomSearch::new(Vec::new(), 0, 1), Err(SetupError::NoVariables));
    for (lower, upper) in [(1.0, 0.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
        let error = RandomSearch::new(vec![variable("x", lower, upper)], 0, 1).unwrap_err();
        assert!(matches!(error, SetupError::BadBounds { .. }));
    }
    let mut search = search(0, 1);
    let candidate = search.ask().unwrap();
    assert_eq!(search.ask(), None);
    assert!(matches!(
        search.tell(&candidate, f64::NAN),
        Err(TellError::NotFinite { id: 0, .. })
    ));
    // Still awaited.
    search.tell(&candidate, 1.0).unwrap();
    assert_eq!(search.tell(&candidate, 1.0), Err(TellError::NotAwaited { id: 0 }));
}
