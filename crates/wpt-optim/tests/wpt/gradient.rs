//! Gradients by dual numbers through the whole flight.

use crate::nominal;
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
