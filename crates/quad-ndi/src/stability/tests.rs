use super::*;
use crate::roots::{roots, spectral_abscissa};
use crate::routh::{RouthArray, Stability};
use approx::assert_relative_eq;
use nalgebra::Complex;
use proptest::prelude::*;

fn second_order(omega: f64, zeta: f64) -> SecondOrder {
    SecondOrder::new(omega, zeta).unwrap()
}

fn is_stable(polynomial: &[f64]) -> bool {
    RouthArray::new(polynomial).unwrap().stability() == Stability::Asymptotic
}

/// The grid of both dampings and the ratio `ω_a/ω_p`.
fn grid() -> impl Iterator<Item = (f64, f64, f64)> {
    let dampings = || (0..10).map(|i| 0.2 + 0.2 * f64::from(i));
    dampings().flat_map(move |zeta_p| {
        dampings().flat_map(move |zeta_a| (0..39).map(move |i| (zeta_p, zeta_a, 1.0 + 0.5 * f64::from(i))))
    })
}

/// How near to the axis, in units of the fastest root, eigenvalues and array need not agree: the eigenvalues'
/// own accuracy, some hundred units in the last place for separate roots, with a margin for near-double ones.
const HAIR: f64 = 1e-9;

/// Whether Routh's verdict is the eigenvalues'; `None` if a root is within a hair of the axis.
fn verdicts_agree(polynomial: &[f64]) -> Option<bool> {
    let found = roots(polynomial).unwrap();
    let fastest = found.iter().map(|root| root.norm()).fold(0.0, f64::max);
    let nearest = found
        .iter()
        .map(|root| root.re.abs())
        .fold(f64::INFINITY, f64::min);
    if nearest < HAIR * fastest {
        return None;
    }
    let right = found.iter().filter(|root| root.re > 0.0).count();
    let verdict = spectral_abscissa(polynomial).unwrap() < 0.0;
    let array = RouthArray::new(polynomial).unwrap();
    Some(is_stable(polynomial) == verdict && array.right_half_plane() == right)
}

#[test]
fn thesis_polynomial_of_levels_1_and_2() {
    let (omega_p, zeta_p, omega_a, zeta_a) = (2.917, 0.9, 29.17, 0.7);
    let closed = HorizontalLoop {
        position: second_order(omega_p, zeta_p),
        attitude: AttitudeLoop::SecondOrder(second_order(omega_a, zeta_a)),
    };
    let expected = [
        1.0,
        2.0 * zeta_a * omega_a,
        omega_a.powi(2),
        2.0 * zeta_p * omega_p * omega_a.powi(2),
        omega_p.powi(2) * omega_a.powi(2),
    ];
    for (ours, theirs) in closed.characteristic().iter().zip(expected) {
        // Two products in another order.
        assert_relative_eq!(*ours, theirs, max_relative = 1e-15);
    }
}

#[test]
fn exact_polynomials_vanish_where_the_loop_closes() {
    // p(s) = s² A + A(0)(2ζ_p ω_p s + ω_p²) at complex points, A in factors.
    let (position, pair) = (second_order(2.0, 0.8), second_order(11.0, 0.6));
    let (pole, omega_r) = (17.0, 15.0);
    let quadratic = |s: Complex<f64>| s * s + s * pair.rate_gain() + pair.stiffness();
    type Factor<'a> = &'a dyn Fn(Complex<f64>) -> Complex<f64>;
    let cases: [(AttitudeLoop, Factor); 3] = [
        (AttitudeLoop::SecondOrder(pair), &quadratic),
        (
            AttitudeLoop::ThirdOrder {
                pair,
                pole_rad_s: pole,
            },
            &|s| (s + pole) * quadratic(s),
        ),
        (
            AttitudeLoop::IgnoredRotorLag {
                designed: pair,
                rotor_bandwidth_rad_s: omega_r,
            },
            &|s| (s * s * (s / omega_r + 1.0) + s * pair.rate_gain() + pair.stiffness()) * omega_r,
        ),
    ];
    for (attitude, a) in cases {
        let polynomial = HorizontalLoop { position, attitude }.characteristic();
        for s in [
            Complex::new(0.3, 1.7),
            Complex::new(-5.0, 9.0),
            Complex::new(20.0, -3.0),
        ] {
            let expanded = polynomial
                .iter()
                .fold(Complex::new(0.0, 0.0), |sum, &c| sum * s + c);
            let zero = Complex::new(0.0, 0.0);
            let factored = s * s * a(s) + a(zero) * (s * position.rate_gain() + position.stiffness());
            // A dozen roundings.
            assert!((expanded - factored).norm() < 1e-14 * factored.norm().max(a(zero).norm()));
        }
    }
}

#[test]
fn thesis_table_f1_is_the_array() {
    let mut skipped = 0;
    for (zeta_p, zeta_a, ratio) in grid() {
        let loops = TwoLoops {
            position: second_order(2.917, zeta_p),
            attitude: second_order(2.917 * ratio, zeta_a),
        };
        let array = RouthArray::new(&loops.horizontal().characteristic()).unwrap();
        let is_regular = array
            .rows()
            .iter()
            .all(|row| row.origin == crate::routh::RowOrigin::Regular);
        if !is_regular {
            // On a boundary (ω_a/ω_p = ζ_p/ζ_a, say) the symbolic entry is zero, and so was the numeric one.
            skipped += 1;
            continue;
        }
        for entry in TABLE_F1 {
            let row = array.rows().iter().find(|row| row.power == entry.power).unwrap();
            let (numeric, symbolic) = (row.entries[entry.column], (entry.value)(&loops));
            // Cancellation in the rows of s² and s¹: rounding relative to the terms, of which the largest is
            // ω_p² ω_a⁴/(ω_a ω_p) over the pivot's distance from zero.
            let pivot = 1.0 - zeta_p / (zeta_a * ratio);
            let scale =
                symbolic.abs() + loops.position.rate_gain() * loops.attitude.stiffness() / pivot.abs();
            let tolerance = 1e-13 * if entry.power <= 2 { scale } else { symbolic.abs() };
            assert!(
                (numeric - symbolic).abs() <= tolerance,
                "{}: {numeric} and {symbolic}",
                entry.expression
            );
        }
    }
    assert!(skipped < 100, "{skipped} of 3900");
    // Every entry of the numeric array is listed, but for the trailing zeros.
    let count: usize = [3, 2, 2, 1, 1].iter().sum();
    assert_eq!(TABLE_F1.len(), count);
}

#[test]
fn agree_routh_with_eigenvalues_on_the_grid() {
    let omega_p = 2.917;
    let (mut compared, mut on_the_boundary) = (0, 0);
    for (zeta_p, zeta_a, ratio) in grid() {
        let position = second_order(omega_p, zeta_p);
        let pair = second_order(ratio * omega_p, zeta_a);
        for attitude in [
            AttitudeLoop::SecondOrder(pair),
            AttitudeLoop::ThirdOrder {
                pair,
                pole_rad_s: 3.0,
            },
            AttitudeLoop::ThirdOrder {
                pair,
                pole_rad_s: 20.0 * omega_p,
            },
            AttitudeLoop::IgnoredRotorLag {
                designed: pair,
                rotor_bandwidth_rad_s: 15.0,
            },
        ] {
            let closed = HorizontalLoop { position, attitude };
            for polynomial in [closed.characteristic(), attitude.characteristic()] {
                match verdicts_agree(&polynomial) {
                    Some(agree) => {
                        assert!(agree, "{closed:?}");
                        compared += 1;
                    }
                    None => on_the_boundary += 1,
                }
            }
        }
    }
    // Only equal dampings with the ratio 2 and their like fall on the boundary.
    assert!(
        compared > 31_000 && on_the_boundary < 50,
        "{compared} compared, {on_the_boundary} not"
    );
}

#[test]
fn agree_limit_of_levels_1_and_2_with_the_array_on_the_grid() {
    let mut stable = 0;
    for (zeta_p, zeta_a, ratio) in grid() {
        let limit = frequency_ratio_limit(zeta_p, zeta_a).unwrap();
        let closed = TwoLoops {
            position: second_order(1.0, zeta_p),
            attitude: second_order(ratio, zeta_a),
        }
        .horizontal();
        // Within rounding of the boundary the array says marginal.
        if (ratio - limit).abs() > 1e-12 * limit {
            assert_eq!(
                is_stable(&closed.characteristic()),
                ratio > limit,
                "{zeta_p} {zeta_a} {ratio}"
            );
            stable += usize::from(ratio > limit);
        }
    }
    assert!(stable > 1000 && stable < 3900, "both verdicts occur");
}

#[test]
fn exact_the_boundary_is_marginal() {
    // Equal damping, ratio 2: (s² + …)(…) with a pair at ±iω.
    let loops = TwoLoops {
        position: second_order(1.0, 1.0),
        attitude: second_order(2.0, 1.0),
    };
    let array = RouthArray::new(&loops.horizontal().characteristic()).unwrap();
    assert_eq!(array.stability(), Stability::Marginal { imaginary_axis: 2 });
}

#[test]
fn exact_ignored_rotor_lag() {
    // 15 rad/s, ζ = 1: the limit of 30 rad/s.
    let limit = ignored_lag_frequency_limit_rad_s(1.0, 15.0).unwrap();
    assert_eq!(limit, 30.0);
    for (factor, stable) in [(0.999, true), (1.001, false)] {
        let designed = second_order(limit * factor, 1.0);
        let attitude = AttitudeLoop::IgnoredRotorLag {
            designed,
            rotor_bandwidth_rad_s: 15.0,
        };
        assert_eq!(is_stable(&attitude.characteristic()), stable);
        assert_eq!(
            attitude.position_frequency_limit_rad_s(1.0).unwrap() > 0.0,
            stable
        );
    }
}

#[test]
fn exact_the_limit_is_the_first_of_three_crossings() {
    // r = ω_a/(2ζ_a ω_R) = 0.95 and c = (ζ_p/ζ_a)² = 0.18: the margin only just dips below zero near
    // u = 0.53, so that a bisection of the whole interval would find the far end of the island beyond.
    let zeta_p = 0.18_f64.sqrt();
    let attitude = AttitudeLoop::IgnoredRotorLag {
        designed: second_order(28.5, 1.0),
        rotor_bandwidth_rad_s: 15.0,
    };
    let stable_at = |omega_p: f64| {
        is_stable(
            &HorizontalLoop {
                position: second_order(omega_p, zeta_p),
                attitude,
            }
            .characteristic(),
        )
    };
    let limit = attitude.position_frequency_limit_rad_s(zeta_p).unwrap();
    let u = 2.0 * zeta_p * 15.0;
    assert!((0.45..0.54).contains(&(limit / u)), "{}", limit / u);
    assert!(stable_at(limit * (1.0 - 1e-6)) && !stable_at(limit * (1.0 + 1e-6)));
    assert!(stable_at(0.7 * u) && !stable_at(0.95 * u), "the island");
}

#[test]
fn exact_third_order_limit_tends_to_the_second_order_one() {
    let pair = second_order(10.0, 0.7);
    let limit = AttitudeLoop::SecondOrder(pair)
        .position_frequency_limit_rad_s(0.9)
        .unwrap();
    for pole in [1e4, 1e6] {
        let third = AttitudeLoop::ThirdOrder {
            pair,
            pole_rad_s: pole,
        };
        // A lag 1/p more: of relative order ω_a/p, with a factor of order one.
        let difference = third.position_frequency_limit_rad_s(0.9).unwrap() / limit - 1.0;
        assert!(difference.abs() < 10.0 * 10.0 / pole, "{difference}");
    }
}

#[test]
fn exact_wrong_questions_are_errors() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            SecondOrder::new(bad, 1.0),
            Err(LoopError::BadFrequency { .. })
        ));
        assert!(matches!(
            SecondOrder::new(1.0, bad),
            Err(LoopError::BadDamping { .. })
        ));
        assert!(matches!(
            SecondOrder::settling_in(bad, 1.0),
            Err(LoopError::BadSettlingTime { .. })
        ));
        assert!(frequency_ratio_limit(bad, 1.0).is_err() && frequency_ratio_limit(1.0, bad).is_err());
        assert!(ignored_lag_frequency_limit_rad_s(1.0, bad).is_err());
        let attitude = AttitudeLoop::SecondOrder(second_order(1.0, 1.0));
        assert!(attitude.position_frequency_limit_rad_s(bad).is_err());
    }
}

proptest! {
    #[test]
    fn prop_the_limit_separates_stable_from_unstable(
        zeta_p in 0.2..2.0_f64,
        zeta_a in 0.05..2.0_f64,
        omega_a in 0.5..50.0_f64,
        ratio in 0.05..20.0_f64,
        below in 0.0..1.0_f64,
        which in 0..3_usize,
    ) {
        let pair = second_order(omega_a, zeta_a);
        let attitude = [
            AttitudeLoop::SecondOrder(pair),
            AttitudeLoop::ThirdOrder { pair, pole_rad_s: ratio * omega_a },
            AttitudeLoop::IgnoredRotorLag { designed: pair, rotor_bandwidth_rad_s: ratio * omega_a },
        ][which];
        let limit = attitude.position_frequency_limit_rad_s(zeta_p).unwrap();
        let at = |omega_p: f64| {
            is_stable(&HorizontalLoop { position: second_order(omega_p, zeta_p), attitude }.characteristic())
        };
        if limit == 0.0 {
            prop_assert!(!is_stable(&attitude.characteristic()));
        } else {
            // A millionth beside the boundary: far from rounding, near enough to be the boundary.
            prop_assert!(at(limit * (1.0 - 1e-6)));
            prop_assert!(!at(limit * (1.0 + 1e-6)));
            prop_assert!(at(limit * (1e-3 + below * 0.99)));
        }
    }
}
