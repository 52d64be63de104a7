//! SciPy as oracle.

use crate::support::{
    Found, GlobalCase, LocalCase, SimplexCase, annealing, evolution, function, lines, scipy, solve, space,
};
use optim::{
    Coefficients, CostAndGradient, NelderMead, QuasiNewton, QuasiNewtonSettings, Report, SimplexSettings,
};

fn scipys(case: &SimplexCase) -> NelderMead {
    let settings = SimplexSettings {
        coefficients: if case.adaptive {
            Coefficients::Adaptive
        } else {
            Coefficients::Standard
        },
        ..SimplexSettings::default()
    };
    let variables = space(case.simplex[0].len(), case.lower, case.upper);
    NelderMead::from_simplex(variables, case.simplex.clone(), settings).unwrap()
}

/// The same rules in the same order of operations: every point evaluated is SciPy's, bit for bit, also where it is
/// clipped to a bound, and so are the numbers of evaluations and iterations and the minimum.
#[test]
fn agree_nelder_mead_evaluates_scipys_points() {
    let scipy = scipy();
    assert_eq!(scipy.scipy, "1.16.3");
    for case in &scipy.nelder_mead {
        let cost = function(&case.function);
        let mut points = Vec::new();
        let mut simplex = scipys(case);
        let report = solve(&mut simplex, |x| {
            points.push(x.to_vec());
            cost(x)
        });
        assert_eq!(report.evaluations, case.found.evaluations, "{}", case.function);
        // SciPy counts the first simplex as its first iteration, too.
        assert_eq!(simplex.rule().iterations(), case.iterations, "{}", case.function);
        assert_eq!(report.best.candidate.values, case.found.x, "{}", case.function);
        assert_eq!(report.best.cost, case.found.cost);
        assert!(case.points.is_empty() || points == case.points);
    }
}

/// Both are within their tolerance of the minimum; SciPy's end is the looser one.
fn same_minimum(report: &Report, found: &Found, tolerance: f64, name: &str) {
    for (a, b) in report.best.candidate.values.iter().zip(&found.x) {
        assert!(
            (a - b).abs() < tolerance,
            "{name}: {:?} {:?} {}",
            report.best,
            found.x,
            report.stop
        );
    }
}

fn with_differences(cost: fn(&[f64]) -> f64) -> impl Fn(&[f64]) -> CostAndGradient {
    move |x| {
        let slope = |i: usize| {
            let at = |h: f64| {
                let mut x = x.to_vec();
                x[i] += h;
                cost(&x)
            };
            // Fourth order in 1e-3, exact for these polynomials of degree four but for rounding of about 1e-12.
            (8.0 * (at(1e-3) - at(-1e-3)) - (at(2e-3) - at(-2e-3))) / 12e-3
        };
        CostAndGradient {
            cost: cost(x),
            gradient: (0..x.len()).map(slope).collect(),
        }
    }
}

/// L-BFGS-B stops at differences of 1e-8 in the cost's gradient, which leave 1e-5 along Rosenbrock's valley (its curvature
/// there is about 0.4).
#[test]
fn agree_quasi_newton_with_l_bfgs_b() {
    for case in scipy().l_bfgs_b {
        let variables = space(case.start.len(), case.lower, case.upper);
        let mut search = QuasiNewton::new(variables, &case.start, QuasiNewtonSettings::default()).unwrap();
        let report = solve(&mut search, with_differences(function(&case.function)));
        same_minimum(&report, &case.found, 2e-5, &case.function);
        assert!(report.best.cost <= case.found.cost + 1e-10);
        assert!(
            report.evaluations < 100,
            "{} {}",
            case.function,
            report.evaluations
        );
    }
}

/// Any of Himmelblau's minima will do.
fn global(report: &Report, case: &GlobalCase, tolerance: f64) {
    if case.function == "himmelblau" {
        assert!(report.best.cost < 1e-6 && case.found.cost < 1e-6);
    } else {
        same_minimum(report, &case.found, tolerance, &case.function);
    }
}

/// Populations end when their costs differ by 1e-8, that is 1e-4 in a valley of curvature one; Rosenbrock's is flatter by 2.5 in
/// two variables and by twenty in four.
#[test]
fn agree_differential_evolution_with_scipys() {
    for case in scipy().differential_evolution {
        let variables = space(case.variables, case.lower, case.upper);
        let report = solve(&mut evolution(variables, 1), function(&case.function));
        global(&report, &case, 5e-4);
        // The same settings take about as many evaluations: within a factor of 1.5 of SciPy's random numbers.
        let ratio = report.evaluations as f64 / case.found.evaluations as f64;
        assert!((1.0 / 1.5..1.5).contains(&ratio), "{}: {ratio}", case.function);
    }
}

/// The walk ends when costs change by 1e-6; Rastrigin's curvature at the origin is 400.
#[test]
fn agree_annealing_with_dual_annealing() {
    for case in scipy().dual_annealing {
        let variables = space(case.variables, case.lower, case.upper);
        let report = solve(
            &mut annealing(variables, &[3.5, -3.5], 1),
            function(&case.function),
        );
        global(&report, &case, 1e-3);
    }
}

/// Golden sections end at 1e-6 of a box of ten.
#[test]
fn agree_line_search_with_powells() {
    for case in scipy().powell {
        let LocalCase {
            function: name,
            lower,
            upper,
            start,
            found,
        } = case;
        let variables = space(start.len(), lower, upper);
        let report = solve(&mut lines(variables, &start), function(&name));
        same_minimum(&report, &found, 1e-4, &name);
    }
}
