//! Bad input, and the limits of a run.

use crate::support::{annealing, evolution, go_on, lines, simplex, space};
use optim::test_functions::himmelblau;
use optim::{
    Annealing, AnnealingSettings, CostAndGradient, Evolution, EvolutionSettings, Limits, LineSearch,
    LineSearchSettings, NelderMead, Optimiser, QuasiNewton, QuasiNewtonSettings, RunError, SetupError,
    SimplexSettings, StopReason, TellError, run,
};
use std::ops::ControlFlow;
use std::time::Duration;

fn setup(lower: f64, upper: f64, start: &[f64]) -> Vec<SetupError> {
    let n = 2;
    let variables = || space(n, lower, upper);
    vec![
        NelderMead::new(variables(), start, SimplexSettings::default()).unwrap_err(),
        LineSearch::new(variables(), start, LineSearchSettings::default()).unwrap_err(),
        Annealing::new(variables(), start, AnnealingSettings::default()).unwrap_err(),
        QuasiNewton::new(variables(), start, QuasiNewtonSettings::default()).unwrap_err(),
    ]
}

#[test]
fn exact_bounds_that_enclose_nothing() {
    for (lower, upper) in [
        (1.0, 0.0),
        (1.0, 1.0),
        (f64::NAN, 1.0),
        (0.0, f64::INFINITY),
        (-f64::MAX, f64::MAX),
    ] {
        let evolution = Evolution::new(space(2, lower, upper), EvolutionSettings::default()).unwrap_err();
        for error in setup(lower, upper, &[1.0, 1.0]).into_iter().chain([evolution]) {
            assert!(
                matches!(error, SetupError::BadBounds { ref name, .. } if name == "x_0"),
                "{error}"
            );
        }
    }
    let none = Evolution::new(Vec::new(), EvolutionSettings::default()).unwrap_err();
    assert_eq!(none, SetupError::NoVariables);
    let twice = [space(1, 0.0, 1.0), space(1, 0.0, 1.0)].concat();
    let error = Evolution::new(twice, EvolutionSettings::default()).unwrap_err();
    assert_eq!(error, SetupError::Twice { name: "x_0".into() });
}

#[test]
fn exact_starts_outside_the_bounds() {
    for error in setup(0.0, 1.0, &[0.5, 1.5]) {
        let expected = SetupError::StartOutside {
            name: "x_1".into(),
            value: 1.5,
            lower: 0.0,
            upper: 1.0,
        };
        assert_eq!(error, expected);
        assert!(error.to_string().contains("within its bounds [0, 1], got 1.5"));
    }
    for error in setup(0.0, 1.0, &[f64::NAN, 0.5]) {
        assert!(matches!(error, SetupError::StartOutside { .. }));
    }
    for error in setup(0.0, 1.0, &[0.5]) {
        assert_eq!(
            error,
            SetupError::StartLength {
                expected: 2,
                found: 1
            }
        );
    }
    let simplex = NelderMead::from_simplex(
        space(2, 0.0, 1.0),
        vec![vec![0.0; 2]; 2],
        SimplexSettings::default(),
    );
    assert_eq!(
        simplex.unwrap_err(),
        SetupError::SimplexSize {
            variables: 2,
            found: 2
        }
    );
}

#[test]
fn exact_settings_out_of_range() {
    let s = SimplexSettings::default();
    let l = LineSearchSettings::default();
    let a = AnnealingSettings::default();
    let e = EvolutionSettings::default();
    let (v, x) = (|| space(2, 0.0, 1.0), [0.5, 0.5]);
    let errors = [
        NelderMead::new(v(), &x, SimplexSettings { step: 0.0, ..s }).err(),
        NelderMead::new(
            v(),
            &x,
            SimplexSettings {
                spread: f64::NAN,
                ..s
            },
        )
        .err(),
        LineSearch::new(v(), &x, LineSearchSettings { scan: 2, ..l }).err(),
        LineSearch::new(v(), &x, LineSearchSettings { narrowing: 1.0, ..l }).err(),
        LineSearch::new(v(), &x, LineSearchSettings { rounds: 0, ..l }).err(),
        Annealing::new(v(), &x, AnnealingSettings { cooling: 1.0, ..a }).err(),
        Annealing::new(
            v(),
            &x,
            AnnealingSettings {
                temperature: Some(-1.0),
                ..a
            },
        )
        .err(),
        Evolution::new(v(), EvolutionSettings { crossover: 1.1, ..e }).err(),
        Evolution::new(
            v(),
            EvolutionSettings {
                mutation: [1.0, 0.5],
                ..e
            },
        )
        .err(),
        QuasiNewton::new(
            v(),
            &x,
            QuasiNewtonSettings {
                gradient: -1.0,
                gain: 0.0,
            },
        )
        .err(),
    ];
    for error in errors {
        assert!(matches!(error, Some(SetupError::BadSetting { .. })), "{error:?}");
    }
}

#[test]
fn exact_a_budget_of_zero() {
    let mut search = simplex(space(2, -5.0, 5.0), &[0.0, 0.0]);
    let error = run(&mut search, himmelblau, Limits::evaluations(0), &mut go_on).unwrap_err();
    assert_eq!(error, RunError::ZeroBudget);
}

/// Failed everywhere: given up after 200 evaluations or earlier where a method is at its end, with the count.
#[test]
fn exact_costs_that_are_finite_nowhere() {
    let v = || space(2, -5.0, 5.0);
    for nothing in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let searches: [Box<dyn Optimiser>; 4] = [
            Box::new(simplex(v(), &[0.0, 0.0])),
            Box::new(lines(v(), &[0.0, 0.0])),
            Box::new(annealing(v(), &[0.0, 0.0], 1)),
            Box::new(evolution(v(), 1)),
        ];
        for mut search in searches {
            let error = run(
                search.as_mut(),
                |_: &[f64]| nothing,
                Limits::evaluations(1000),
                &mut go_on,
            )
            .unwrap_err();
            assert!(
                matches!(
                    error,
                    RunError::AllFailed {
                        evaluations: 1..=200,
                        ..
                    }
                ),
                "{error}"
            );
        }
        let failing = |_: &[f64]| CostAndGradient {
            cost: 1.0,
            gradient: vec![nothing; 2],
        };
        let mut search = QuasiNewton::new(v(), &[0.0, 0.0], QuasiNewtonSettings::default()).unwrap();
        let error = run(&mut search, failing, Limits::evaluations(1000), &mut go_on).unwrap_err();
        assert!(matches!(error, RunError::AllFailed { .. }));
    }
}

/// One that succeeds among many that fail is the best, and the failures are counted.
#[test]
fn exact_failures_are_counted() {
    let cost = |x: &[f64]| if x[0] < 0.0 { f64::NAN } else { himmelblau(x) };
    let mut search = evolution(space(2, -5.0, 5.0), 1);
    let mut failed = 0;
    let report = run(
        &mut search,
        |x| {
            failed += u64::from(x[0] < 0.0);
            cost(x)
        },
        Limits::evaluations(5000),
        &mut go_on,
    )
    .unwrap();
    assert_eq!(report.failed, failed);
    assert!(failed > 5 && report.best.cost < 1e-4);
    let candidate = optim::Candidate {
        id: u64::MAX,
        values: vec![0.0; 2],
    };
    assert!(matches!(
        search.tell(&candidate, 0.0),
        Err(TellError::NotAwaited { .. })
    ));
}

#[test]
fn exact_limits_end_a_run() {
    let new = || simplex(space(2, -5.0, 5.0), &[0.0, 0.0]);
    let limits = Limits::evaluations(500);
    let stop = |limits, observe: &mut dyn FnMut(&optim::Progress) -> ControlFlow<()>| {
        let report = run(&mut new(), himmelblau, limits, observe).unwrap();
        (report.stop, report.evaluations)
    };
    let budget = Limits::evaluations(17);
    assert_eq!(
        stop(budget, &mut go_on),
        (StopReason::Budget { evaluations: 17 }, 17)
    );
    let target = Limits {
        target: Some(1.0),
        ..limits
    };
    assert!(matches!(stop(target, &mut go_on), (StopReason::Target { cost }, n) if cost <= 1.0 && n < 60));
    let now = Limits {
        time: Some(Duration::ZERO),
        ..limits
    };
    assert!(matches!(stop(now, &mut go_on), (StopReason::Time { .. }, 1)));
    let mut interrupt = |p: &optim::Progress| {
        if p.evaluations == 9 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    assert_eq!(stop(limits, &mut interrupt), (StopReason::Interrupted, 9));
}

/// Run again after its end, a search evaluates nothing and answers as before.
#[test]
fn exact_an_ended_search_keeps_its_answer() {
    let mut search = simplex(space(2, -5.0, 5.0), &[0.0, 0.0]);
    let first = run(&mut search, himmelblau, Limits::evaluations(500), &mut go_on).unwrap();
    let second = run(&mut search, himmelblau, Limits::evaluations(500), &mut go_on).unwrap();
    assert_eq!(
        (second.evaluations, second.stop, second.best),
        (0, first.stop, first.best)
    );
}
