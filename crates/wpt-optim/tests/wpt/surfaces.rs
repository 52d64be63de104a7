//! Surfaces: the same on any number of threads, and with the minima where they are.

use crate::nominal;
use quad_dynamics::Level;
use wpt_optim::{Choice, Grid, ProblemError, Surface};

/// Five nodes by three over the box.
const COARSE: Grid = Grid { columns: 5, rows: 3 };

fn on_threads(count: usize) -> Surface {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(count)
        .build()
        .unwrap();
    pool.install(|| nominal(Choice::Two, 2.0, Level::Five).surface(COARSE).unwrap())
}

#[test]
fn exact_the_same_on_any_number_of_threads() {
    let one = on_threads(1);
    assert_eq!(one.outcomes.len(), 15);
    assert_eq!((one.first[0], one.first[4], one.second[2]), (-8.0, 8.0, 8.0));
    for count in [2, 3, 7] {
        assert_eq!(on_threads(count), one);
    }
}

#[test]
fn agree_surface_with_single_flights() {
    let problem = nominal(Choice::Two, 2.0, Level::Three);
    let surface = problem.surface(COARSE).unwrap();
    for (row, &b) in surface.second.iter().enumerate() {
        for (column, &a) in surface.first.iter().enumerate() {
            let alone = problem.evaluate(&[a, b]).unwrap().cost;
            // Flights over the station amplify rounding.
            assert!(
                (surface.cost(column, row) - alone).abs() < 1e-6 * alone,
                "at {a}, {b}"
            );
        }
    }
}

#[test]
fn thesis_a_minimum_on_each_side_of_the_station() {
    let problem = nominal(Choice::Two, 10.0, Level::One);
    let surface = problem.surface(Grid { columns: 9, rows: 9 }).unwrap();
    let minima = surface.minima();
    assert!(minima.len() >= 2, "{minima:?}");
    let best: Vec<_> = minima[..2].iter().map(|m| m.at).collect();
    assert!(
        best.contains(&[4.0, 4.0]) && best.contains(&[-4.0, -4.0]),
        "{best:?}"
    );
    assert_eq!(surface.failures(), 0);
}

#[test]
fn exact_errors_of_a_surface() {
    let grid = Grid { columns: 1, rows: 5 };
    let two = nominal(Choice::Two, 2.0, Level::One);
    assert!(matches!(
        two.surface(grid),
        Err(ProblemError::EmptySurface { columns: 1, rows: 5 })
    ));
    let four = nominal(Choice::Four, 2.0, Level::One);
    assert!(matches!(
        four.surface(COARSE),
        Err(ProblemError::NotTwoVariables { variables: 4 })
    ));
}

/// A box of which every flight leaves the numbers.
#[test]
fn exact_a_surface_of_failures_is_an_error() {
    let problem = nominal(Choice::Two, 2.0, Level::Two);
    let mut far = problem.decisions().to_vec();
    for decision in &mut far {
        (decision.lower, decision.upper, decision.start) = (1e5, 2e5, 1e5);
    }
    let error = problem.deciding(far).unwrap().surface(COARSE).unwrap_err();
    assert!(matches!(error, ProblemError::AllFailed { evaluations: 15 }));
}
