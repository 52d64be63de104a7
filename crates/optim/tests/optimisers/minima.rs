//! Known minima.

use crate::support::{annealing, evolution, lines, simplex, solve, space};
use num_dual::DualNum;
use optim::test_functions::{HIMMELBLAU_MINIMA, himmelblau, rastrigin, rosenbrock, sphere};
use optim::{
    CostAndGradient, LineSearch, LineSearchSettings, NelderMead, QuasiNewton, QuasiNewtonSettings,
    SimplexSettings, StopReason, gradient_by_dual_numbers,
};
use quad_math::Dual;

/// The known minima are zeros: `f` is a sum of squares of terms of up to 22, so rounding of the last bit of x leaves below
/// (20 · 22 ε)² ~ 1e-26.
#[test]
fn exact_himmelblaus_minima_are_zeros() {
    for minimum in HIMMELBLAU_MINIMA {
        assert!(himmelblau(&minimum) < 1e-26, "{minimum:?}");
    }
}

/// From each quadrant to the minimum in it. Vertices are within 1e-5 of each other at the end.
#[test]
fn exact_nelder_mead_finds_himmelblaus_minima() {
    for minimum in HIMMELBLAU_MINIMA {
        let start = minimum.map(|m| 0.8 * m);
        let report = solve(&mut simplex(space(2, -5.0, 5.0), &start), himmelblau);
        assert!(matches!(report.stop, StopReason::Converged { .. }));
        let found = &report.best.candidate.values;
        assert!((found[0] - minimum[0]).abs() < 2e-5 && (found[1] - minimum[1]).abs() < 2e-5);
        assert!(report.history.windows(2).all(|w| w[1] <= w[0]));
        assert_eq!(report.history.len() as u64, report.evaluations);
    }
}

/// A simplex that is flat against a bound can't leave it; the restart can. The cost falls towards (0, 0), and both vertices
/// beside the start are clipped onto the bound `x_1 = -1` by the first moves.
#[test]
fn exact_a_restart_frees_a_flat_simplex() {
    let flat = vec![vec![-1.0, -1.0], vec![-0.5, -1.0], vec![0.0, -1.0]];
    let cost = |x: &[f64]| sphere(x);
    let without = SimplexSettings::default();
    let with = SimplexSettings {
        restarts: 3,
        ..without
    };
    let stuck = solve(
        &mut NelderMead::from_simplex(space(2, -1.0, 1.0), flat.clone(), without).unwrap(),
        cost,
    );
    assert!((stuck.best.cost - 1.0).abs() < 1e-10);
    let freed = solve(
        &mut NelderMead::from_simplex(space(2, -1.0, 1.0), flat, with).unwrap(),
        cost,
    );
    assert!(freed.best.cost < 1e-8);
}

/// Separable: one sweep finds the minimum to the golden section's 1e-6 of the box (9 wide) in every variable, a second one
/// gains nothing; an asymmetric box, so that no scan hits the minimum.
#[test]
fn exact_line_search_solves_separable_costs() {
    let mut search = lines(space(3, -5.0, 4.0), &[3.0, -2.0, 1.0]);
    let report = solve(&mut search, sphere);
    assert!(report.best.cost < 3.0 * (0.5 * 9e-6_f64).powi(2));
    // A scan must be finer than the valleys are wide.
    let settings = LineSearchSettings {
        scan: 41,
        ..LineSearchSettings::default()
    };
    let mut search = LineSearch::new(space(2, -5.12, 4.0), &[3.3, -4.4], settings).unwrap();
    let report = solve(&mut search, rastrigin);
    // Curvature 400 at the minimum: 200 times the square of half the last interval, in both variables.
    assert!(
        report.best.cost < 400.0 * (0.5 * 9.12e-6_f64).powi(2) + 1e-14,
        "{:?}",
        report.best
    );
}

/// The four minima of Himmelblau's function are equally good; Rastrigin's 81 in the box are not. Of 20 seeds all find the
/// origin by evolution and all by annealing: each is a bet that these fixed seeds win.
#[test]
fn exact_global_methods_find_the_global_minimum() {
    let (mut evolved, mut annealed) = (0, 0);
    for seed in 0..20 {
        let variables = space(2, -5.12, 4.0);
        evolved += u32::from(
            solve(&mut evolution(variables.clone(), seed), rastrigin)
                .best
                .cost
                < 1e-4,
        );
        annealed += u32::from(
            solve(&mut annealing(variables, &[3.9, -4.9], seed), rastrigin)
                .best
                .cost
                < 1e-4,
        );
    }
    assert!(
        evolved == 20 && annealed == 20,
        "{evolved} by evolution, {annealed} by annealing"
    );
}

fn dual_rosenbrock(x: &[f64]) -> CostAndGradient {
    let cost =
        |x: &[Dual<2>; 2]| (x[1] - x[0] * x[0]).powi(2) * 100.0 + (Dual::<2>::from_re(1.0) - x[0]).powi(2);
    gradient_by_dual_numbers(cost, [x[0], x[1]])
}

/// Against the gradient by hand, to rounding.
#[test]
fn exact_gradients_by_dual_numbers() {
    for x in [[-1.2, 1.0], [0.3, 0.7], [1.0, 1.0]] {
        let dual = dual_rosenbrock(&x);
        let slope = x[1] - x[0] * x[0];
        let by_hand = [-400.0 * x[0] * slope - 2.0 * (1.0 - x[0]), 200.0 * slope];
        assert!((dual.cost - rosenbrock(&x)).abs() < 1e-12);
        for (a, b) in dual.gradient.iter().zip(by_hand) {
            assert!((a - b).abs() < 1e-11, "{a} {b}");
        }
    }
}

/// With exact gradients to the minimum in a few dozen evaluations where the simplex takes 181.
#[test]
fn exact_quasi_newton_descends_rosenbrocks_valley() {
    let mut search =
        QuasiNewton::new(space(2, -2.0, 2.0), &[-1.2, 1.0], QuasiNewtonSettings::default()).unwrap();
    let report = solve(&mut search, dual_rosenbrock);
    assert!(
        matches!(report.stop, StopReason::Converged { .. }),
        "{}",
        report.stop
    );
    // A gradient below 1e-6 / 4 over the least curvature, 0.4.
    let x = &report.best.candidate.values;
    assert!((x[0] - 1.0).abs() < 1e-6 && (x[1] - 1.0).abs() < 2e-6);
    assert!(report.evaluations < 60, "{}", report.evaluations);
}

/// `Σ (x_i − 2)²` in a box up to 1: every variable ends at its bound, and the projected gradient is zero there.
#[test]
fn exact_quasi_newton_ends_at_bounds() {
    let cost = |x: &[f64]| CostAndGradient {
        cost: x.iter().map(|x| (x - 2.0).powi(2)).sum(),
        gradient: x.iter().map(|x| 2.0 * (x - 2.0)).collect(),
    };
    let mut search = QuasiNewton::new(
        space(3, -1.0, 1.0),
        &[0.0, -0.5, 1.0],
        QuasiNewtonSettings::default(),
    )
    .unwrap();
    let report = solve(&mut search, cost);
    assert_eq!(report.best.candidate.values, [1.0, 1.0, 1.0]);
    assert!(matches!(report.stop, StopReason::Converged { cost_spread, .. } if cost_spread == 0.0));
}
