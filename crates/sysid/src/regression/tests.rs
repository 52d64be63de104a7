use super::*;
use approx::assert_relative_eq;
use quad_math::{Real, constant};

#[test]
fn exact_line_through_points_by_hand() {
    // Draper and Smith's textbook sums by hand: x = 0..4, y = 1, 3, 2, 5, 4: slope 0.8, intercept 1.4, s² = 3.6/3.
    let y = [1.0, 3.0, 2.0, 5.0, 4.0];
    let rows: Vec<Row<2>> = (0..5)
        .map(|i| Row {
            regressors: [1.0, f64::from(i)],
            y: y[i as usize],
        })
        .collect();
    let fit = linear(&rows).unwrap();
    // Rounding of a 5 × 2 problem.
    assert_relative_eq!(fit.parameters[0].value, 1.4, epsilon = 1e-14);
    assert_relative_eq!(fit.parameters[1].value, 0.8, epsilon = 1e-14);
    let s2 = fit.goodness.standard_deviation.powi(2);
    assert_relative_eq!(s2, 1.2, epsilon = 1e-14);
    // cov = s² (XᵀX)⁻¹ with XᵀX = [[5, 10], [10, 30]].
    assert_relative_eq!(fit.covariance[(0, 0)], 1.2 * 30.0 / 50.0, epsilon = 1e-14);
    assert_relative_eq!(fit.covariance[(0, 1)], -1.2 * 10.0 / 50.0, epsilon = 1e-14);
    // Student's t with 3 degrees of freedom: 3.182446 at 97.5 % (any table).
    assert_relative_eq!(
        fit.parameters[1].half_width(),
        3.182_446_305 * (1.2_f64 / 10.0).sqrt(),
        epsilon = 1e-8
    );
    assert_relative_eq!(fit.goodness.r_squared.unwrap(), 1.0 - 3.6 / 10.0, epsilon = 1e-14);
}

/// `y = a e^(−b t)`.
struct Decay(Vec<f64>);

impl Predictor<2> for Decay {
    fn predict<R: Real>(&self, &[a, b]: &[R; 2]) -> Vec<R> {
        self.0
            .iter()
            .map(|&t| a * (-b * constant(t)).simd_exp())
            .collect()
    }
}

#[test]
fn exact_exponential_is_recovered_and_linear_in_disguise_agrees() {
    let times: Vec<f64> = (0..40).map(|i| f64::from(i) * 0.1).collect();
    let data: Vec<f64> = times.iter().map(|t| 2.5 * (-0.7 * t).exp()).collect();
    let fit = nonlinear(&data, &Decay(times), [1.0, 0.1]).unwrap();
    assert!(fit.convergence.unwrap().converged);
    // The minimum is zero: Levenberg-Marquardt ends at rounding.
    assert_relative_eq!(fit.values()[0], 2.5, epsilon = 1e-9);
    assert_relative_eq!(fit.values()[1], 0.7, epsilon = 1e-9);
}

#[test]
fn exact_refusals() {
    let flat = |x: f64| Row {
        regressors: [1.0, x],
        y: 2.0,
    };
    assert_eq!(
        linear(&[flat(1.0), flat(2.0)]),
        Err(FitError::TooFewPoints {
            points: 2,
            unknowns: 2
        })
    );
    assert_eq!(
        linear(&[flat(3.0); 9]),
        Err(FitError::RankDeficient { rank: 1, unknowns: 2 })
    );
    assert_eq!(
        linear(&[flat(0.0); 9]),
        Err(FitError::RankDeficient { rank: 1, unknowns: 2 })
    );
    assert_eq!(
        linear(&[flat(1.0), flat(f64::NAN), flat(2.0)]),
        Err(FitError::NotFinite { index: 1 })
    );
}

/// A stuck sensor: without the refusal the slope of these is 1e-17 with an interval as small that leaves zero out.
#[test]
fn exact_equal_data_under_a_changing_input_are_refused_and_a_mean_of_equal_data_is_not() {
    let stuck: Vec<Row<2>> = (0..9)
        .map(|i| Row {
            regressors: [1.0, 0.1 * f64::from(i)],
            y: 0.1,
        })
        .collect();
    assert_eq!(
        linear(&stuck),
        Err(FitError::ConstantData {
            points: 9,
            value: 0.1
        })
    );
    // One datum that answers is enough to have a scatter.
    let mut alive = stuck;
    alive[4].y = 0.2;
    assert!(linear(&alive).unwrap().goodness.standard_deviation > 0.01);
    let equal = [Row {
        regressors: [1.0],
        y: 0.1,
    }; 9];
    // Nine roundings of a sum.
    assert_relative_eq!(
        linear(&equal).unwrap().parameters[0].value,
        0.1,
        max_relative = 1e-15
    );
}

/// `y = √a`, without a value below zero.
struct Root;

impl Predictor<1> for Root {
    fn predict<R: Real>(&self, &[a]: &[R; 1]) -> Vec<R> {
        vec![a.simd_sqrt(); 3]
    }
}

#[test]
fn exact_a_step_beyond_the_model_is_taken_back() {
    // From 4, Newton's step ends at 4 − (2 − 0.1)/(1/4) = −3.6, where the root is NaN.
    let fit = nonlinear(&[0.09, 0.1, 0.11], &Root, [4.0]).unwrap();
    assert!(fit.convergence.unwrap().converged);
    // The square of the mean; the iteration ends at about the root of rounding.
    assert_relative_eq!(fit.values()[0], 0.01, epsilon = 1e-8);
}
