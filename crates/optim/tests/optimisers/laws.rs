//! Laws of all methods: within bounds, saved and resumed, alone or side by side.

use crate::support::{annealing, evolution, go_on, lines, simplex, solve, space};
use proptest::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;

use optim::test_functions::{himmelblau, rastrigin};
use optim::{
    Answer, CostAndGradient, Limits, Optimiser, QuasiNewton, QuasiNewtonSettings, RandomSearch, StopReason,
    TellError, run, run_parallel,
};
use std::fmt::Debug;

/// Most evaluations of a case.
const MOST: u64 = 300;

fn gradient(x: &[f64]) -> CostAndGradient {
    let (a, b) = (x[0] * x[0] + x[1] - 11.0, x[0] + x[1] * x[1] - 7.0);
    CostAndGradient {
        cost: a * a + b * b,
        gradient: vec![4.0 * a * x[0] + 2.0 * b, 2.0 * a + 4.0 * b * x[1]],
    }
}

fn quasi_newton(start: &[f64]) -> QuasiNewton {
    QuasiNewton::new(space(2, -5.0, 5.0), start, QuasiNewtonSettings::default()).unwrap()
}

/// Some costs fail, as simulations do.
fn holed(x: &[f64]) -> f64 {
    let hole = x[0] + x[1] > 4.0;
    if hole { f64::NAN } else { rastrigin(x) }
}

/// Stopped after `pause` evaluations, saved as JSON, read and run on: the same state, best and history.
fn resumes<A: Answer, S>(
    make: impl Fn() -> S,
    cost: impl Fn(&[f64]) -> A,
    pause: u64,
) -> Result<(), TestCaseError>
where
    S: Optimiser<A> + Serialize + DeserializeOwned + PartialEq + Debug,
{
    let mut whole = make();
    let at_once = run(&mut whole, &cost, Limits::evaluations(MOST), &mut go_on).unwrap();
    if pause >= at_once.evaluations {
        return Ok(());
    }
    let mut first = make();
    let begun = run(&mut first, &cost, Limits::evaluations(pause), &mut go_on).unwrap();
    let mut second: S = serde_json::from_str(&serde_json::to_string(&first).unwrap()).unwrap();
    prop_assert_eq!(&second, &first);
    let ended = run(&mut second, &cost, Limits::evaluations(MOST - pause), &mut go_on).unwrap();
    prop_assert_eq!(&second, &whole);
    prop_assert_eq!(&ended.best, &at_once.best);
    prop_assert_eq!([begun.history, ended.history].concat(), at_once.history);
    Ok(())
}

/// On rayon's threads as alone: the same state and history, whatever the number of threads.
fn agrees_in_parallel<S: Optimiser + PartialEq + Debug + Send>(
    make: impl Fn() -> S + Sync,
) -> Result<(), TestCaseError> {
    let mut alone = make();
    let expected = run(&mut alone, holed, Limits::evaluations(MOST), &mut go_on).unwrap();
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        let mut search = make();
        let report = pool
            .install(|| run_parallel(&mut search, holed, Limits::evaluations(MOST), &mut go_on))
            .unwrap();
        prop_assert_eq!(&search, &alone);
        prop_assert_eq!(&report.history, &expected.history);
        prop_assert_eq!(report.failed, expected.failed);
        prop_assert_eq!(report.stop, expected.stop);
    }
    Ok(())
}

/// Every candidate within its bounds, whatever the costs, and no run for ever.
fn stays_inside<A: Answer>(
    mut search: impl Optimiser<A>,
    cost: impl Fn(&[f64]) -> A,
    bounds: [f64; 2],
) -> Result<(), TestCaseError> {
    let mut outside = 0;
    let watched = |x: &[f64]| {
        outside += x.iter().filter(|x| !(bounds[0]..=bounds[1]).contains(*x)).count();
        cost(x)
    };
    run(&mut search, watched, Limits::evaluations(MOST), &mut go_on).unwrap();
    prop_assert_eq!(outside, 0);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn prop_a_saved_search_goes_on(seed in any::<u64>(), pause in 1..MOST, x in -5.0..5.0, y in -5.0..5.0) {
        resumes(|| simplex(space(2, -5.0, 5.0), &[x, y]), himmelblau, pause)?;
        resumes(|| lines(space(2, -5.0, 5.0), &[x, y]), himmelblau, pause)?;
        resumes(|| annealing(space(2, -5.0, 5.0), &[x, y], seed), himmelblau, pause)?;
        resumes(|| evolution(space(2, -5.0, 5.0), seed), himmelblau, pause)?;
        resumes(|| quasi_newton(&[x, y]), gradient, pause)?;
    }

    #[test]
    fn prop_threads_change_nothing(seed in any::<u64>(), x in -5.0..1.0, y in -5.0..1.0) {
        agrees_in_parallel(|| simplex(space(2, -5.0, 5.0), &[x, y]))?;
        agrees_in_parallel(|| lines(space(2, -5.0, 5.0), &[x, y]))?;
        agrees_in_parallel(|| annealing(space(2, -5.0, 5.0), &[x, y], seed))?;
        agrees_in_parallel(|| evolution(space(2, -5.0, 5.0), seed))?;
    }

    #[test]
    fn prop_candidates_lie_within_their_bounds(
        seed in any::<u64>(), lower in -9.0..0.0_f64, width in 0.01..9.0_f64, a in 0.0..=1.0, b in 0.0..=1.0,
    ) {
        let bounds = [lower, lower + width];
        let box_ = || space(2, bounds[0], bounds[1]);
        let start: Vec<f64> = [a, b].map(|s: f64| (lower + s * width).min(bounds[1])).to_vec();
        // Costs that fail in places, but for the start.
        let at_start = start.clone();
        let cost = move |x: &[f64]| if x == at_start { 0.0 } else { holed(x) };
        stays_inside(simplex(box_(), &start), &cost, bounds)?;
        stays_inside(lines(box_(), &start), &cost, bounds)?;
        stays_inside(annealing(box_(), &start, seed), &cost, bounds)?;
        stays_inside(evolution(box_(), seed), |x: &[f64]| x[0] * x[1], bounds)?;
        let search = QuasiNewton::new(box_(), &start, QuasiNewtonSettings::default()).unwrap();
        stays_inside(search, gradient, bounds)?;
    }

    /// A population that is answered in any order continues in the same way.
    #[test]
    fn prop_the_order_of_telling_does_not_matter(
        seed in any::<u64>(), order in Just((0..30_usize).collect::<Vec<_>>()).prop_shuffle(),
    ) {
        let (mut forwards, mut shuffled) = (evolution(space(2, -5.0, 5.0), seed), evolution(space(2, -5.0, 5.0), seed));
        for _ in 0..3 {
            let asked: Vec<_> = std::iter::from_fn(|| forwards.ask()).collect();
            prop_assert_eq!(asked.len(), 30);
            prop_assert_eq!(&asked, &std::iter::from_fn(|| shuffled.ask()).collect::<Vec<_>>());
            for k in 0..30 {
                forwards.tell(&asked[k], himmelblau(&asked[k].values)).unwrap();
                let other = &asked[order[k]];
                shuffled.tell(other, himmelblau(&other.values)).unwrap();
            }
        }
        prop_assert_eq!(forwards, shuffled);
    }
}

/// What was proposed and lost is proposed again; an answer is used once.
#[test]
fn exact_lost_candidates_are_renewed() {
    let mut search = evolution(space(2, -5.0, 5.0), 7);
    let first: Vec<_> = std::iter::from_fn(|| search.ask()).collect();
    search.tell(&first[3], 1.0).unwrap();
    assert_eq!(search.tell(&first[3], 1.0), Err(TellError::NotAwaited { id: 3 }));
    assert!(search.ask().is_none());
    search.renew();
    let again: Vec<_> = std::iter::from_fn(|| search.ask()).collect();
    assert_eq!(again.len(), first.len() - 1);
    assert!(again.iter().all(|c| first.contains(c) && c.id != 3));
}

/// Random search runs under the same driver.
#[test]
fn exact_random_search_ends_with_its_schedule() {
    let mut search = RandomSearch::new(space(2, -5.0, 5.0), 3, 50).unwrap();
    let report = solve(&mut search, himmelblau);
    assert_eq!((report.evaluations, report.stop), (50, StopReason::ScheduleDone));
}
