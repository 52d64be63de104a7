//! Gradients by dual numbers through the whole flight.

use crate::nominal;
use optim::{CostAndGradient, Limits, NelderMead, QuasiNewton, minimise};
use quad_dynamics::Level;
use wpt_optim::Choice;

#[test]
fn agree_gradient_with_central_differences() {
    for level in Level::ALL {
        let problem = nominal(Choice::Six, 4.0, level);
        let x = [4.0, -0.3, 5.0, 0.2, -3.0, -2.5];
        let by_duals = problem.gradient(&x).unwrap();
        let cost = |x: &[f64]| problem.evaluate(x).unwrap().cost;
        // Dual arithmetic rounds its real parts a little differently.
        assert!((by_duals.cost - cost(&x)).abs() < 1e-9);
        assert_eq!(by_duals.gradient.len(), x.len());
        for i in 0..x.len() {
            let h = 1e-5;
            let at = |step: f64| {
                let mut moved = x;
                moved[i] += step;
                cost(&moved)
            };
            let difference = (at(h) - at(-h)) / (2.0 * h);
            // h² times a third derivative of some units, and rounding of 1e-13 over h; kinks are not near.
            let error = (by_duals.gradient[i] - difference).abs();
            assert!(error < 1e-6, "{level}, variable {i}: {difference} and {error:e}");
        }
    }
}

/// Down the gradient through the whole flight, and by the simplex that knows none: the same minimum, with fewer flights.
#[test]
fn agree_quasi_newton_with_the_simplex() {
    let problem = nominal(Choice::Two, 10.0, Level::Three);
    let mut simplex = NelderMead::new(problem.variables(), &problem.start(), Default::default()).unwrap();
    let cost = |x: &[f64]| problem.evaluate(x).unwrap().cost;
    let by_simplex = minimise(&mut simplex, cost, Limits::evaluations(300)).unwrap();
    let mut newton = QuasiNewton::new(problem.variables(), &problem.start(), Default::default()).unwrap();
    let slope = |x: &[f64]| {
        let found = problem.gradient(x).unwrap();
        CostAndGradient {
            cost: found.cost,
            gradient: found.gradient,
        }
    };
    let by_newton = minimise(&mut newton, slope, Limits::evaluations(300)).unwrap();
    // The simplex ends within a millionth of its cost.
    assert!((by_newton.best.cost - by_simplex.best.cost).abs() < 1e-5);
    assert!(by_newton.evaluations < by_simplex.evaluations);
}
