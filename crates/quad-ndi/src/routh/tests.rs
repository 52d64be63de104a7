use super::*;
use crate::roots::roots;
use proptest::prelude::*;

fn array(coefficients: &[f64]) -> RouthArray {
    RouthArray::new(coefficients).unwrap()
}

/// The product of two polynomials in descending powers.
fn product(a: &[f64], b: &[f64]) -> Vec<f64> {
    let mut result = vec![0.0; a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            result[i + j] += x * y;
        }
    }
    result
}

#[test]
fn exact_regular_array() {
    // s⁴ + 2s³ + 3s² + 4s + 5: by hand, whole numbers; two roots to the right.
    let array = array(&[1.0, 2.0, 3.0, 4.0, 5.0]);
    let rows: Vec<_> = array.rows().iter().map(|row| row.entries.clone()).collect();
    assert_eq!(
        rows,
        [
            vec![1.0, 3.0, 5.0],
            vec![2.0, 4.0],
            vec![1.0, 5.0],
            vec![-6.0],
            vec![5.0]
        ]
    );
    assert_eq!(array.first_column(), [1.0, 2.0, 1.0, -6.0, 5.0]);
    assert_eq!(
        array.stability(),
        Stability::Unstable {
            right_half_plane: 2,
            imaginary_axis: 0
        }
    );
    assert_eq!(array.degree(), 4);
}

#[test]
fn exact_zero_pivot_counts_as_the_limit() {
    // Ogata's s⁵ + 2s⁴ + 2s³ + 4s² + 11s + 10 and Gantmacher's kind: ε gives two sign changes in each.
    for coefficients in [
        vec![1.0, 2.0, 2.0, 4.0, 11.0, 10.0],
        vec![1.0, 1.0, 2.0, 2.0, 5.0],
        vec![1.0, 1.0, 1.0, 1.0, 2.0],
        vec![1.0, 0.0, 1.0, 1.0],
    ] {
        let array = array(&coefficients);
        assert!(
            array
                .rows()
                .iter()
                .any(|row| matches!(row.origin, RowOrigin::ZeroPivot { .. }))
        );
        assert_eq!(
            array.stability(),
            Stability::Unstable {
                right_half_plane: 2,
                imaginary_axis: 0
            },
            "{coefficients:?}"
        );
    }
}

#[test]
fn exact_several_leading_zeros() {
    // sⁿ + 1: roots are known; rows begin with many zeros or are zero.
    for (degree, right, axis) in [
        (1, 0, 0),
        (2, 0, 2),
        (3, 2, 0),
        (4, 2, 0),
        (5, 2, 0),
        (6, 2, 2),
        (7, 4, 0),
        (8, 4, 0),
    ] {
        let mut coefficients = vec![0.0; degree + 1];
        (coefficients[0], coefficients[degree]) = (1.0, 1.0);
        let array = array(&coefficients);
        assert_eq!(
            (array.right_half_plane(), array.imaginary_axis()),
            (right, axis),
            "s^{degree} + 1"
        );
    }
}

#[test]
fn exact_zero_row() {
    // (s² + 4)(s + 1)(s + 2) = s⁴ + 3s³ + 6s² + 12s + 8.
    let marginal = array(&[1.0, 3.0, 6.0, 12.0, 8.0]);
    assert_eq!(marginal.rows()[3].origin, RowOrigin::ZeroRow);
    // Auxiliary 2s² + 8, derivative 4s.
    assert_eq!(marginal.rows()[3].entries, [4.0]);
    assert_eq!(marginal.stability(), Stability::Marginal { imaginary_axis: 2 });

    // Symmetric real roots ±2: a zero row without roots on the axis.
    let symmetric = array(&[1.0, 3.0, -2.0, -12.0, -8.0]);
    assert_eq!(
        symmetric.stability(),
        Stability::Unstable {
            right_half_plane: 1,
            imaginary_axis: 0
        }
    );

    // (s² + 1)² (s + 1): repeated on the axis grows like t.
    let repeated = array(&[1.0, 1.0, 2.0, 2.0, 1.0, 1.0]);
    assert_eq!(
        repeated.stability(),
        Stability::Unstable {
            right_half_plane: 0,
            imaginary_axis: 4
        }
    );

    // (s² + 1)(s² + 4)(s + 1): two different pairs do not.
    let two_pairs = array(&product(
        &product(&[1.0, 0.0, 1.0], &[1.0, 0.0, 4.0]),
        &[1.0, 1.0],
    ));
    assert_eq!(two_pairs.stability(), Stability::Marginal { imaginary_axis: 4 });
}

#[test]
fn exact_roots_at_the_origin() {
    assert_eq!(
        array(&[1.0, 1.0, 0.0]).stability(),
        Stability::Marginal { imaginary_axis: 1 }
    );
    let double = Stability::Unstable {
        right_half_plane: 0,
        imaginary_axis: 2,
    };
    assert_eq!(array(&[1.0, 0.0, 0.0]).stability(), double);
    assert_eq!(array(&[1.0, 1.0, 0.0, 0.0]).stability(), double);
    let triple = Stability::Unstable {
        right_half_plane: 0,
        imaginary_axis: 3,
    };
    assert_eq!(array(&[1.0, 0.0, 0.0, 0.0]).stability(), triple);
    // s (s² + 1)(s - 1): the origin, a pair and one to the right.
    let mixed = array(&product(&[1.0, 0.0, 1.0, 0.0], &[1.0, -1.0]));
    assert_eq!(
        mixed.stability(),
        Stability::Unstable {
            right_half_plane: 1,
            imaginary_axis: 3
        }
    );
}

#[test]
fn exact_trivial_degrees() {
    assert_eq!(array(&[7.0]).stability(), Stability::Asymptotic);
    assert_eq!(array(&[-1.0, -2.0]).stability(), Stability::Asymptotic);
    assert_eq!(
        array(&[1.0, -2.0]).stability(),
        Stability::Unstable {
            right_half_plane: 1,
            imaginary_axis: 0
        }
    );
}

#[test]
fn exact_wrong_questions_are_errors() {
    assert_eq!(RouthArray::new(&[]), Err(PolynomialError::Empty));
    assert_eq!(
        RouthArray::new(&[0.0, 1.0]),
        Err(PolynomialError::ZeroLeading { degree: 1 })
    );
    assert_eq!(
        RouthArray::new(&[1.0, f64::NAN, 2.0]),
        Err(PolynomialError::NotFinite { power: 1 })
    );
    assert_eq!(
        RouthArray::new(&[f64::INFINITY]),
        Err(PolynomialError::NotFinite { power: 0 })
    );
    assert!(matches!(
        RouthArray::new(&[1e300, 1e-300, 1.0, 1e300]),
        Err(PolynomialError::Overflow { .. })
    ));
}

#[test]
fn exact_display_is_the_table() {
    let text = array(&[1.0, 3.0, 6.0, 12.0, 8.0]).to_string();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 5);
    assert_eq!(lines[0], "s⁴ │            1            6            8");
    assert_eq!(
        lines[3],
        "s¹ │            4   (zero row: derivative of the row above)"
    );
    let wide = array(&[1.0, -850.9, 1234567.8, 0.25]).to_string();
    assert!(
        wide.contains("-850.9") && wide.contains("1.23457e6") && wide.contains("0.25"),
        "{wide}"
    );
    assert!(array(&[1.0; 12]).to_string().starts_with("s¹¹ │"));
}

/// Real roots and pairs, all between 0.2 and 3 rad/s and at least 0.1 rad/s from the axis.
fn factor() -> impl Strategy<Value = (Vec<f64>, usize)> {
    let magnitude = 0.2..3.0_f64;
    let real = (magnitude.clone(), any::<bool>())
        .prop_map(|(r, right)| (vec![1.0, if right { -r } else { r }], usize::from(right)));
    let pair = (magnitude, 0.1..3.0_f64, any::<bool>()).prop_map(|(omega, re, right)| {
        let sigma = if right { -re } else { re };
        (
            vec![1.0, 2.0 * sigma, sigma * sigma + omega * omega],
            if right { 2 } else { 0 },
        )
    });
    prop_oneof![real, pair]
}

proptest! {
    #[test]
    fn prop_counts_the_roots_it_was_built_from(factors in prop::collection::vec(factor(), 1..6)) {
        let mut coefficients = vec![1.0];
        let mut right = 0;
        for (factor, count) in factors {
            if coefficients.len() + factor.len() - 2 <= 7 {
                coefficients = product(&coefficients, &factor);
                right += count;
            }
        }
        let array = array(&coefficients);
        prop_assert_eq!(array.right_half_plane(), right, "{}", array);
        prop_assert_eq!(array.imaginary_axis(), 0);
        // And the eigenvalues say the same; none is nearer to the axis than 0.1 rad/s, a repeated one of
        // order seven is found to ε^(1/7) = 6e-3 of 5 rad/s.
        let found = roots(&coefficients).unwrap().iter().filter(|root| root.re > 0.0).count();
        prop_assert_eq!(found, right);
    }

    #[test]
    fn prop_pairs_on_the_axis_are_seen(
        omega in 0.3..3.0_f64,
        magnitude in 0.1..3.0_f64,
        real_is_right in any::<bool>(),
        damping in 0.1..1.0_f64,
        right in any::<bool>(),
    ) {
        let real = if real_is_right { magnitude } else { -magnitude };
        let sign = if right { -1.0 } else { 1.0 };
        let rest = product(&[1.0, -real], &[1.0, sign * 2.0 * damping, 1.0]);
        let array = array(&product(&rest, &[1.0, 0.0, omega * omega]));
        prop_assert_eq!(array.imaginary_axis(), 2, "{}", array);
        prop_assert_eq!(array.right_half_plane(), usize::from(real > 0.0) + 2 * usize::from(right));
    }

    #[test]
    fn prop_scale_and_time_scale_do_not_matter(
        leading in prop_oneof![-3.0..-0.1_f64, 0.1..3.0_f64],
        rest in prop::collection::vec(-3.0..3.0_f64, 1..7),
        log_gain in -3..4_i32,
        log_time in -8..9_i32,
    ) {
        let coefficients: Vec<f64> = std::iter::once(leading).chain(rest).collect();
        // Powers of two, so that both arrays round alike.
        let gain = 2.0_f64.powi(log_gain);
        let scaled_by = |k: usize| gain * 2.0_f64.powi(log_time * k as i32);
        let scaled: Vec<f64> = coefficients.iter().enumerate().map(|(k, a)| a * scaled_by(k)).collect();
        prop_assert_eq!(array(&coefficients).stability(), array(&scaled).stability());
    }
}
