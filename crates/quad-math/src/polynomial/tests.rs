use super::*;
use crate::F64x4;
use approx::assert_relative_eq;
use nalgebra::SimdValue;
use num_dual::{Dual3_64, Dual64};
use proptest::prelude::*;

#[test]
fn exact_derivatives_of_powers() {
    // p = 1 + 2s + 3s² + 4s³ at s = 2: whole numbers, no rounding.
    let p = Polynomial {
        coefficients: [1.0, 2.0, 3.0, 4.0],
    };
    assert_eq!(p.value(2.0), 49.0);
    assert_eq!(p.derivatives(2.0), [49.0, 62.0, 54.0, 24.0, 0.0]);
    for order in 0..5 {
        assert_eq!(p.derivative(order, 2.0), [49.0, 62.0, 54.0, 24.0, 0.0][order]);
    }
    let none: [f64; 0] = p.derivatives(2.0);
    assert!(none.is_empty());
}

#[test]
fn exact_minimum_jerk_and_minimum_snap() {
    // Flash and Hogan (1985): the curve of least jerk between rest and rest; its sister for snap. The
    // construction uses whole numbers only, so the coefficients are exact.
    let jerk = Polynomial::<f64, 6>::between([0.0; 3], [1.0, 0.0, 0.0]);
    assert_eq!(jerk.coefficients, [0.0, 0.0, 0.0, 10.0, -15.0, 6.0]);
    let snap = Polynomial::<f64, 8>::between([0.0; 4], [1.0, 0.0, 0.0, 0.0]);
    assert_eq!(snap.coefficients, [0.0, 0.0, 0.0, 0.0, 35.0, -84.0, 70.0, -20.0]);
}

#[test]
fn exact_line_and_cubic() {
    let line = Segment::<f64, 2>::new([1.0], [5.0], 2.0).unwrap();
    assert_eq!(line.derivatives(0.5), [2.0, 2.0, 0.0]);
    // Hermite's cubic from 0 with slope 1 to 0 with slope 1 over T = 1: s - 3s² + 2s³.
    let cubic = Polynomial::<f64, 4>::between([0.0, 1.0], [0.0, 1.0]);
    assert_eq!(cubic.coefficients, [0.0, 1.0, -3.0, 2.0]);
}

#[test]
fn exact_wrong_questions_are_errors() {
    for duration_s in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let segment = Segment::<f64, 2>::new([0.0], [1.0], duration_s);
        assert!(matches!(segment, Err(SegmentError::BadDuration { .. })));
    }
    assert_eq!(
        Segment::<f64, 4>::new([0.0, f64::NAN], [1.0, 0.0], 1.0),
        Err(SegmentError::NotFinite {
            end: End::Start,
            order: 1
        })
    );
    assert_eq!(
        Segment::<f64, 4>::new([0.0, 0.0], [f64::INFINITY, 0.0], 1.0),
        Err(SegmentError::NotFinite {
            end: End::Finish,
            order: 0
        })
    );
    let mut lanes = F64x4::splat(0.0);
    lanes.replace(2, f64::NAN);
    assert!(Segment::<F64x4, 2>::new([F64x4::splat(0.0)], [lanes], 1.0).is_err());
}

#[test]
fn exact_boundary_values_carry_dual_numbers() {
    // ∂p/∂(end value) of the minimum-jerk curve is the curve itself, 1/2 at half time.
    let end = Dual64::from_re(3.0).derivative();
    let zero = Dual64::from_re(0.0);
    let segment = Segment::<Dual64, 6>::new([zero; 3], [end, zero, zero], 4.0).unwrap();
    let half = segment.value(Dual64::from_re(2.0));
    assert_eq!((half.re, half.eps), (1.5, 0.5));
}

#[test]
fn agree_lanes_with_scalars() {
    let starts = [0.3, -1.0, 2.0, 7.0];
    let lanes = F64x4::from(starts);
    let zero = F64x4::splat(0.0);
    let wide = Segment::<F64x4, 6>::new([lanes, zero, zero], [zero, lanes, zero], 1.7).unwrap();
    for (lane, start) in starts.into_iter().enumerate() {
        let scalar = Segment::<f64, 6>::new([start, 0.0, 0.0], [0.0, start, 0.0], 1.7).unwrap();
        // Ten operations with factors up to a hundred: a few hundred units in the last place at most.
        assert_relative_eq!(
            wide.value(F64x4::splat(0.9)).extract(lane),
            scalar.value(0.9),
            max_relative = 1e-13
        );
    }
}

/// Distance of the segment's derivatives at both ends from the conditions, over its rounding allowance.
///
/// Allowance for derivative `k` in normalised time, per unit of the largest scaled condition: the series
/// `r` stays below `Σ 1/j! < 3` of it, products with `C(2M - 2, M - 1)` and `C(M - 1, ⌊M/2⌋)` make the
/// coefficients, a derivative at `s = 1` multiplies them by up to `(2M - 1)…(2M - k)`, and 2 M such terms
/// are summed, each rounded to ε.
fn worst_end_miss<const M: usize, const N: usize>(start: [f64; M], end: [f64; M], duration_s: f64) -> f64 {
    let segment = Segment::<f64, N>::new(start, end, duration_s).unwrap();
    let scale = (0..M)
        .map(|k| start[k].abs().max(end[k].abs()) * duration_s.powi(k as i32))
        .fold(0.0, f64::max);
    let at_start: [f64; M] = segment.derivatives(0.0);
    let at_end: [f64; M] = segment.derivatives(duration_s);
    (0..M)
        .map(|k| {
            let miss = (at_start[k] - start[k]).abs().max((at_end[k] - end[k]).abs());
            let growth = 3.0 * binomial(2 * M - 2, M - 1) * binomial(M - 1, M / 2);
            let allowance = growth * falling_factorial(N - 1, k) * N as f64 * f64::EPSILON * scale;
            miss * duration_s.powi(k as i32) / allowance
        })
        .fold(0.0, f64::max)
}

proptest! {
    #[test]
    fn prop_meets_the_boundary_conditions(
        start in prop::array::uniform5(-10.0..10.0_f64),
        end in prop::array::uniform5(-10.0..10.0_f64),
        log_duration in -2.0..2.0_f64,
    ) {
        fn first<const M: usize>(x: &[f64; 5]) -> [f64; M] {
            std::array::from_fn(|i| x[i])
        }
        let duration_s = 10.0_f64.powf(log_duration);
        let misses = [
            worst_end_miss::<1, 2>(first(&start), first(&end), duration_s),
            worst_end_miss::<2, 4>(first(&start), first(&end), duration_s),
            worst_end_miss::<3, 6>(first(&start), first(&end), duration_s),
            worst_end_miss::<4, 8>(first(&start), first(&end), duration_s),
            worst_end_miss::<5, 10>(start, end, duration_s),
        ];
        prop_assert!(misses.iter().all(|&miss| miss <= 1.0), "{misses:?}");
    }

    #[test]
    fn prop_derivatives_agree_with_automatic_differentiation(
        coefficients in prop::array::uniform10(-10.0..10.0_f64),
        s in -1.5..1.5_f64,
    ) {
        let p = Polynomial { coefficients };
        let jet = p.over::<Dual3_64>().value(Dual3_64::from_re(s).derivative());
        let ours: [f64; 4] = p.derivatives(s);
        let theirs = [jet.re, jet.v1, jet.v2, jet.v3];
        for k in 0..4 {
            // Rounding is relative to the sum of the terms' magnitudes, below 10 · 1.5⁹ · 10 · 9 · 8 · 7 =
            // 2e6; twenty operations of it at 1e-16 each.
            prop_assert!((ours[k] - theirs[k]).abs() < 4e-9);
            prop_assert!((ours[k] - p.derivative(k, s)).abs() < 4e-9);
        }
    }

    #[test]
    fn prop_a_polynomial_of_the_degree_is_reproduced(
        coefficients in prop::array::uniform6(-5.0..5.0_f64),
    ) {
        let p = Polynomial { coefficients };
        let rebuilt = Polynomial::<f64, 6>::between::<3>(p.derivatives(0.0), p.derivatives(1.0));
        for (a, b) in rebuilt.coefficients.iter().zip(&coefficients) {
            // Conditions up to 5 · (1 + 2 + … + 20) = 350, factors up to 20: 350 · 20 · some 20 ε.
            prop_assert!((a - b).abs() < 4e-11);
        }
    }
}
