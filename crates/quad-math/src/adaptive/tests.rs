use super::*;
use crate::F64x4;
use approx::assert_relative_eq;
use differential_equations::prelude::{ExplicitRungeKutta, IVP, ODE};
use nalgebra::{SimdValue, Vector1, Vector2, Vector4};
use proptest::prelude::*;
use std::f64::consts::TAU;

fn integrator(tolerance: f64) -> DormandPrince {
    DormandPrince::new(AdaptiveOptions {
        absolute_tolerance: tolerance,
        relative_tolerance: tolerance,
        ..AdaptiveOptions::default()
    })
    .unwrap()
}

fn oscillator(_: f64, x: &Vector2<f64>) -> Vector2<f64> {
    Vector2::new(x.y, -x.x)
}

/// `ẋ = -2 t x²` with `x(0) = 1` has `x = 1/(1 + t²)`: non-linear and explicit in time.
fn bell(t: f64, x: &Vector1<f64>) -> Vector1<f64> {
    Vector1::new(-2.0 * t * x.x * x.x)
}

fn bell_truth(t: f64) -> f64 {
    1.0 / (1.0 + t * t)
}

/// The planar restricted three-body problem of Earth, Moon and a satellite on a closed orbit.
///
/// Source: Hairer, Nørsett, Wanner I, (II.0.1) and (II.0.2).
struct Arenstorf;

impl Arenstorf {
    const MOON: f64 = 0.012277471;
    const PERIOD: f64 = 17.065_216_560_157_96;
    const START: [f64; 4] = [0.994, 0.0, 0.0, -2.001_585_106_379_082_5];

    fn rate(x: [f64; 4]) -> [f64; 4] {
        let (moon, earth) = (Self::MOON, 1.0 - Self::MOON);
        let to_earth = ((x[0] + moon).powi(2) + x[1].powi(2)).powf(1.5);
        let to_moon = ((x[0] - earth).powi(2) + x[1].powi(2)).powf(1.5);
        [
            x[2],
            x[3],
            x[0] + 2.0 * x[3] - earth * (x[0] + moon) / to_earth - moon * (x[0] - earth) / to_moon,
            x[1] - 2.0 * x[2] - earth * x[1] / to_earth - moon * x[1] / to_moon,
        ]
    }
}

impl ODE<f64, [f64; 4]> for Arenstorf {
    fn diff(&self, _t: f64, y: &[f64; 4], dydt: &mut [f64; 4]) {
        *dydt = Self::rate(*y);
    }
}

/// `ẍ = μ (1 - x²) ẋ - x`, μ = 5: a relaxation oscillation with slow and fast arcs.
struct VanDerPol;

impl VanDerPol {
    fn rate(x: [f64; 2]) -> [f64; 2] {
        [x[1], 5.0 * (1.0 - x[0] * x[0]) * x[1] - x[0]]
    }
}

impl ODE<f64, [f64; 2]> for VanDerPol {
    fn diff(&self, _t: f64, y: &[f64; 2], dydt: &mut [f64; 2]) {
        *dydt = Self::rate(*y);
    }
}

#[test]
fn exact_harmonic_oscillator_within_the_tolerance() {
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
        let run = integrator(tolerance)
            .run(oscillator, 0.0..10.0 * TAU, Vector2::x())
            .unwrap();
        assert!(run.is_complete());
        assert_eq!(run.last.time_s, 10.0 * TAU, "the end is met exactly");
        let worst = (0..=1000)
            .map(|k| f64::from(k) * 10.0 * TAU / 1000.0)
            .map(|t| (run.at(t).unwrap() - Vector2::new(t.cos(), -t.sin())).norm())
            .fold(0.0, f64::max);
        // Nothing damps the local errors: they add up over the 63 s at up to one or two tolerances
        // per unit of time (error per step). Measured: 20 to 130 times the tolerance.
        assert!(worst < 200.0 * tolerance, "{worst} at tolerance {tolerance}");
        assert!(
            worst > 0.1 * tolerance,
            "suspiciously accurate: {worst} at tolerance {tolerance}"
        );
    }
}

#[test]
fn exact_local_order_of_the_step_and_its_extension() {
    // From the exact solution at t = 0.4, one step: error h⁶ at its end (order 5), h⁵ within (order 4),
    // and the error estimate h⁵ (order 4).
    let t = 0.4;
    let x = Vector1::new(bell_truth(t));
    let errors = |h: f64| {
        let step = dormand_prince_step(&bell, t, &x, bell(t, &x), h);
        [
            (step.dense.end.x - bell_truth(t + h)).abs(),
            (step.dense.at_fraction(0.3).x - bell_truth(t + 0.3 * h)).abs(),
            (h * step.error_rate.x).abs(),
        ]
    };
    let (coarse, fine) = (errors(0.1), errors(0.05));
    for (i, expected) in [6.0, 5.0, 5.0].into_iter().enumerate() {
        let slope = (coarse[i] / fine[i]).log2();
        // The next term of the expansion, O(h) relative, moves the slope by a few tenths at these steps.
        assert!(
            (slope - expected).abs() < 0.4,
            "slope {slope}, expected {expected}"
        );
    }
}

#[test]
fn exact_powers_of_time_up_to_the_order() {
    // ẋ = t^m has x = t^(m + 1)/(m + 1): the step is exact to m = 4, the estimate zero and the extension exact
    // to m = 3. These are order conditions of every coefficient, so a wrong digit shows.
    for m in 0..5 {
        let f = |t: f64, _: &Vector1<f64>| Vector1::new(t.powi(m));
        let truth = |t: f64| t.powi(m + 1) / f64::from(m + 1);
        let step = dormand_prince_step(&f, 0.0, &Vector1::zeros(), f(0.0, &Vector1::zeros()), 1.0);
        // Sums of seven terms up to six in size: a few units of rounding of that.
        assert_relative_eq!(step.dense.end.x, truth(1.0), epsilon = 1e-14);
        if m < 4 {
            assert!(step.error_rate.x.abs() < 1e-16, "t^{m}: {}", step.error_rate.x);
            for theta in [0.1, 0.35, 0.5, 0.8] {
                assert_relative_eq!(step.dense.at_fraction(theta).x, truth(theta), epsilon = 1e-15);
            }
        }
    }
}

#[test]
fn exact_extension_meets_the_step_at_both_ends() {
    let x = Vector1::new(1.0);
    let step = dormand_prince_step(&bell, 0.0, &x, bell(0.0, &x), 0.2).dense;
    assert_eq!(step.at(0.0), step.start);
    // The same sum in another order: a rounding or two.
    assert_relative_eq!(step.at_fraction(1.0).x, step.end.x, max_relative = 1e-15);
    let d = 1e-6;
    let slope_at_end = (step.at_fraction(1.0).x - step.at_fraction(1.0 - d).x) / (d * 0.2);
    // One-sided difference: d/2 of the curvature, plus rounding 1e-16/(d h) = 1e-9.
    assert!((slope_at_end - step.end_rate.x).abs() < 1e-6);
}

#[test]
fn agree_lanes_with_scalars() {
    let starts = [0.5, 1.0, 1.5, 2.0];
    let f = |t: F64x4, x: &Vector1<F64x4>| Vector1::new(-(t + t) * x.x * x.x);
    let x = Vector1::new(F64x4::from(starts));
    let (t, h) = (F64x4::splat(0.1), F64x4::splat(0.05));
    let wide = dormand_prince_step(&f, t, &x, f(t, &x), h)
        .dense
        .at_fraction(F64x4::splat(0.4));
    for (lane, start) in starts.into_iter().enumerate() {
        let x = Vector1::new(start);
        let scalar = dormand_prince_step(&bell, 0.1, &x, bell(0.1, &x), 0.05)
            .dense
            .at_fraction(0.4);
        // Some fifty operations, possibly fused in one of the two.
        assert_relative_eq!(wide.x.extract(lane), scalar.x, max_relative = 1e-14);
    }
}

#[test]
fn agree_arenstorf_with_an_independent_method() {
    let f = |_, x: &Vector4<f64>| Vector4::from(Arenstorf::rate((*x).into()));
    let run = integrator(1e-12)
        .run(f, 0.0..Arenstorf::PERIOD, Arenstorf::START.into())
        .unwrap();
    assert!(run.is_complete());
    let reference = IVP::ode(&Arenstorf, 0.0, Arenstorf::PERIOD, Arenstorf::START)
        .method(ExplicitRungeKutta::dop853().rtol(1e-13).atol(1e-13))
        .t_eval([5.0, 10.0, 15.0])
        .solve()
        .unwrap();
    for (&t, y) in reference.iter() {
        let miss = (run.at(t).unwrap() - Vector4::from(*y)).norm();
        // The passes by Moon and Earth amplify an error at the start by some 1e4 before the end of the orbit:
        // 1e-12 per step, a few hundred steps of which the first count most.
        assert!(miss < 1e-7, "{miss} at {t}");
    }
    // And the orbit closes (the printed initial values and period have 16 digits).
    assert!((run.last.state - Vector4::from(Arenstorf::START)).norm() < 1e-6);
}

#[test]
fn agree_van_der_pol_with_an_independent_method() {
    let f = |_, x: &Vector2<f64>| Vector2::from(VanDerPol::rate((*x).into()));
    let run = integrator(1e-10)
        .run(f, 0.0..30.0, Vector2::new(2.0, 0.0))
        .unwrap();
    let times: Vec<f64> = (1..30).map(f64::from).collect();
    let reference = IVP::ode(&VanDerPol, 0.0, 30.0, [2.0, 0.0])
        .method(ExplicitRungeKutta::dop853().rtol(1e-13).atol(1e-13))
        .t_eval(times)
        .solve()
        .unwrap();
    assert!(reference.iter().count() >= 29);
    for (&t, y) in reference.iter() {
        let miss = (run.at(t).unwrap() - Vector2::from(*y)).norm();
        // The limit cycle attracts, so only the phase error grows; the fast arcs (ẋ up to 7, ẍ up to 50) turn
        // it into a state error some hundred times larger.
        assert!(miss < 1e-7, "{miss} at {t}");
    }
}

#[test]
fn exact_a_pole_stops_the_run_and_keeps_its_points() {
    // ẋ = x², x(0) = 1: x = 1/(1 - t).
    let run = integrator(1e-8)
        .run(|_, x: &Vector1<f64>| x.component_mul(x), 0.0..2.0, Vector1::x())
        .unwrap();
    let AdaptiveStatus::StepTooSmall { time_s, .. } = run.status else {
        panic!("{:?}", run.status)
    };
    // The computed pole is the true one but for the tolerance.
    assert!((time_s - 1.0).abs() < 1e-6, "{time_s}");
    assert_eq!(run.last.time_s, time_s);
    assert!(run.steps.len() > 50);
    assert_relative_eq!(run.at(0.9).unwrap().x, 10.0, max_relative = 1e-6);
    assert_eq!(run.at(1.5), None);
}

#[test]
fn exact_numbers_that_are_not_finite_stop_the_run() {
    // The root of a negative number beyond t = 1/2; x = (1 - (1 - 2t)^(3/2))/3 before it.
    let f = |t: f64, _: &Vector1<f64>| Vector1::new((1.0 - 2.0 * t).sqrt());
    let run = integrator(1e-8).run(f, 0.0..1.0, Vector1::zeros()).unwrap();
    let AdaptiveStatus::NotFinite { time_s, state } = run.status else {
        panic!("{:?}", run.status)
    };
    assert!((time_s - 0.5).abs() < 1e-12, "{time_s}");
    assert_relative_eq!(state.x, 1.0 / 3.0, epsilon = 1e-7);
    assert_eq!(run.last.state, state);

    let from_nan = integrator(1e-8)
        .run(oscillator, 0.0..1.0, Vector2::new(f64::NAN, 0.0))
        .unwrap();
    assert!(matches!(
        from_nan.status,
        AdaptiveStatus::NotFinite { time_s: 0.0, .. }
    ));
    assert!(from_nan.steps.is_empty());
    assert_eq!(from_nan.samples().count(), 1);
}

#[test]
fn exact_the_limit_on_steps_stops_the_run() {
    let options = AdaptiveOptions {
        maximum_steps: 20,
        ..AdaptiveOptions::default()
    };
    let run = DormandPrince::new(options)
        .unwrap()
        .run(oscillator, 0.0..100.0, Vector2::x())
        .unwrap();
    assert!(matches!(run.status, AdaptiveStatus::TooManySteps { time_s } if time_s == run.last.time_s));
    assert_eq!(run.statistics.accepted + run.statistics.rejected, 20);
    assert!(run.last.time_s > 0.0 && run.last.time_s < 100.0);
    assert!(
        (run.last.state.norm() - 1.0).abs() < 1e-7,
        "the points kept are good"
    );
}

#[test]
fn exact_wrong_questions_are_errors() {
    let defaults = AdaptiveOptions::default();
    for bad in [0.0, -1e-6, f64::NAN, f64::INFINITY] {
        for options in [
            AdaptiveOptions {
                absolute_tolerance: bad,
                ..defaults
            },
            AdaptiveOptions {
                relative_tolerance: bad,
                ..defaults
            },
        ] {
            assert!(matches!(
                DormandPrince::new(options),
                Err(AdaptiveError::BadTolerance { .. })
            ));
        }
        let options = AdaptiveOptions {
            initial_step_s: Some(bad),
            ..defaults
        };
        assert!(matches!(
            DormandPrince::new(options),
            Err(AdaptiveError::BadStep { .. })
        ));
    }
    let options = AdaptiveOptions {
        maximum_step_s: f64::NAN,
        ..defaults
    };
    assert!(matches!(
        DormandPrince::new(options),
        Err(AdaptiveError::BadStep { .. })
    ));

    for (start_s, end_s) in [(1.0, 0.0), (0.0, f64::NAN), (f64::NEG_INFINITY, 0.0)] {
        let run = integrator(1e-6).run(oscillator, start_s..end_s, Vector2::x());
        assert!(matches!(run, Err(AdaptiveError::BadSpan { .. })));
    }
}

#[test]
fn exact_an_empty_span_is_complete() {
    let run = integrator(1e-6).run(oscillator, 3.0..3.0, Vector2::x()).unwrap();
    assert!(run.is_complete());
    assert_eq!(run.at(3.0), Some(Vector2::x()));
    assert_eq!(run.samples().count(), 1);
}

#[test]
fn exact_steps_respect_the_longest() {
    let options = AdaptiveOptions {
        maximum_step_s: 0.01,
        initial_step_s: Some(5.0),
        ..AdaptiveOptions::default()
    };
    let run = DormandPrince::new(options)
        .unwrap()
        .run(oscillator, 0.0..1.0, Vector2::x())
        .unwrap();
    assert!(run.steps.iter().all(|step| step.step_s <= 0.01));
    // 6 evaluations per step, 1 for the start, none for the starting step that was given.
    let AdaptiveStatistics {
        accepted,
        rejected,
        evaluations,
    } = run.statistics;
    assert_eq!(
        (accepted, rejected, evaluations),
        (run.steps.len(), 0, 1 + 6 * run.steps.len())
    );
}

proptest! {
    #[test]
    fn prop_points_are_ordered_and_joined(
        end_s in 0.1..30.0_f64, x in -2.0..2.0_f64, log_tolerance in -10.0..-3.0_f64,
    ) {
        let integrator = integrator(10.0_f64.powf(log_tolerance));
        let run = integrator.run(oscillator, 0.0..end_s, Vector2::new(x, 1.0)).unwrap();
        prop_assert!(run.is_complete());
        let samples: Vec<_> = run.samples().collect();
        prop_assert_eq!(samples.len(), run.statistics.accepted + 1);
        prop_assert_eq!(samples.last().unwrap().time_s, end_s);
        for pair in samples.windows(2) {
            prop_assert!(pair[0].time_s < pair[1].time_s);
        }
        for pair in run.steps.windows(2) {
            prop_assert_eq!(pair[0].end, pair[1].start);
            prop_assert_eq!(pair[0].end_rate, pair[1].start_rate);
        }
    }
}
