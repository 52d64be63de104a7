use super::*;
use crate::laboratory::{Sensor, generator};
use crate::regression::{Row, linear};
use crate::test_coverage::assert_covers;
use approx::assert_relative_eq;

fn points(x: &[f64], y: &[f64], x_deviation: f64, y_deviation: f64) -> Vec<NoisyPoint> {
    x.iter()
        .zip(y)
        .map(|(&x, &y)| NoisyPoint {
            x,
            y,
            x_deviation,
            y_deviation,
        })
        .collect()
}

const X: [f64; 6] = [0.3, 1.1, 1.8, 3.2, 4.1, 4.7];
const Y: [f64; 6] = [1.2, 2.1, 3.9, 6.2, 7.4, 9.6];

/// Deming's closed form, `δ = σ_y²/σ_x²`.
fn deming(x: &[f64], y: &[f64], delta: f64) -> (f64, f64) {
    let n = x.len() as f64;
    let (mx, my) = (x.iter().sum::<f64>() / n, y.iter().sum::<f64>() / n);
    let sum = |f: &dyn Fn(f64, f64) -> f64| x.iter().zip(y).map(|(x, y)| f(x - mx, y - my)).sum::<f64>();
    let (xx, yy, xy) = (sum(&|u, _| u * u), sum(&|_, v| v * v), sum(&|u, v| u * v));
    let slope = (yy - delta * xx + ((yy - delta * xx).powi(2) + 4.0 * delta * xy * xy).sqrt()) / (2.0 * xy);
    (my - slope * mx, slope)
}

#[test]
fn exact_equal_deviations_give_demings_line() {
    for (x_deviation, y_deviation) in [(0.1, 0.1), (0.3, 0.02), (0.01, 0.5)] {
        let fit = total(&points(&X, &Y, x_deviation, y_deviation), Deviations::Relative).unwrap();
        let (a, b) = deming(&X, &Y, (y_deviation / x_deviation).powi(2));
        // Rounding of the closed form, which subtracts numbers up to (0.5/0.01)² = 2500 times the result.
        assert_relative_eq!(fit.line.parameters[0].value, a, epsilon = 1e-11);
        assert_relative_eq!(fit.line.parameters[1].value, b, epsilon = 1e-11);
        assert!(fit.line.convergence.unwrap().converged);
    }
}

#[test]
fn exact_without_error_along_x_it_is_the_ordinary_fit() {
    let fit = total(&points(&X, &Y, 0.0, 0.4), Deviations::Relative).unwrap();
    let rows: Vec<Row<2>> = X
        .iter()
        .zip(Y)
        .map(|(&x, y)| Row {
            regressors: [1.0, x],
            y,
        })
        .collect();
    let ordinary = linear(&rows).unwrap();
    for i in 0..2 {
        // Rounding of two ways to solve the same 6 × 2 problem.
        assert_relative_eq!(fit.line.values()[i], ordinary.values()[i], epsilon = 1e-12);
        assert_relative_eq!(
            fit.line.parameters[i].standard_error,
            ordinary.parameters[i].standard_error,
            epsilon = 1e-12
        );
    }
    assert_relative_eq!(
        fit.line.covariance[(0, 1)],
        ordinary.covariance[(0, 1)],
        epsilon = 1e-12
    );
    assert_relative_eq!(
        fit.line.condition_number,
        ordinary.condition_number,
        epsilon = 1e-9
    );
}

#[test]
fn prop_exchanging_the_axes_inverts_the_slope() {
    let fit = total(&points(&X, &Y, 0.2, 0.3), Deviations::Known).unwrap();
    let swapped = total(&points(&Y, &X, 0.3, 0.2), Deviations::Known).unwrap();
    let [b, c] = [&fit, &swapped].map(|f| f.line.parameters[1]);
    assert_relative_eq!(b.value * c.value, 1.0, epsilon = 1e-12);
    assert_relative_eq!(fit.chi_squared, swapped.chi_squared, epsilon = 1e-11);
    // d(1/b) = db/b².
    assert_relative_eq!(
        c.standard_error,
        b.standard_error / b.value.powi(2),
        max_relative = 1e-9
    );
}

#[test]
fn data_pearson_with_yorks_weights() {
    // Pearson's points (1901) with York's weights (1966); line, standard errors and S as York et al. (2004) print them.
    let x = [0.0, 0.9, 1.8, 2.6, 3.3, 4.4, 5.2, 6.1, 6.5, 7.4];
    let y = [5.9, 5.4, 4.4, 4.6, 3.5, 3.7, 2.8, 2.8, 2.4, 1.5];
    let wx = [1000.0, 1000.0, 500.0, 800.0, 200.0, 80.0, 60.0, 20.0, 1.8, 1.0];
    let wy = [1.0, 1.8, 4.0, 8.0, 20.0, 20.0, 70.0, 70.0, 100.0, 500.0];
    let points: Vec<NoisyPoint> = (0..10)
        .map(|i| NoisyPoint {
            x: x[i],
            y: y[i],
            x_deviation: 1.0 / f64::sqrt(wx[i]),
            y_deviation: 1.0 / f64::sqrt(wy[i]),
        })
        .collect();
    let fit = total(&points, Deviations::Known).unwrap();
    let [a, b] = fit.line.parameters;
    // Half a unit of the last digit printed.
    assert_relative_eq!(a.value, 5.479_910_22, epsilon = 5e-9);
    assert_relative_eq!(b.value, -0.480_533_407, epsilon = 5e-10);
    assert_relative_eq!(fit.chi_squared, 11.866_353_19, epsilon = 5e-9);
    // The published errors, 0.295 and 0.0580.
    assert_relative_eq!(a.standard_error, 0.295, epsilon = 5e-4);
    assert_relative_eq!(b.standard_error, 0.0580, epsilon = 5e-5);
}

#[test]
fn prop_95_percent_intervals_cover_the_truth_and_the_ordinary_slope_is_biased() {
    let (a, b) = (0.5, 1.4);
    let (noise_x, noise_y) = (Sensor::noisy(0.25), Sensor::noisy(0.2));
    let measure = |seed, count: u32| {
        let mut random = generator(seed);
        let places = (0..count).map(|i| 4.0 * f64::from(i) / f64::from(count));
        let measured = places.map(|x| NoisyPoint {
            x: noise_x.read(x, &mut random),
            y: noise_y.read(a + b * x, &mut random),
            x_deviation: 0.25,
            y_deviation: 0.2,
        });
        measured.collect::<Vec<_>>()
    };
    let covers = |deviations: Deviations, i: usize, truth: f64| {
        assert_covers(|seed| {
            let fit = total(&measure(seed, 20), deviations).unwrap();
            fit.line.parameters[i].interval().contains(truth)
        });
    };
    for deviations in [Deviations::Known, Deviations::Relative] {
        covers(deviations, 0, a);
        covers(deviations, 1, b);
    }
    let mean_slope = |slope: &dyn Fn(&[NoisyPoint]) -> f64| {
        (0..200).map(|seed| slope(&measure(seed, 100))).sum::<f64>() / 200.0
    };
    let ordinary = mean_slope(&|points| {
        let rows: Vec<_> = points
            .iter()
            .map(|p| Row {
                regressors: [1.0, p.x],
                y: p.y,
            })
            .collect();
        linear(&rows).unwrap().values()[1]
    });
    let unbiased = mean_slope(&|points| total(points, Deviations::Known).unwrap().line.values()[1]);
    // Attenuation σ_ξ²/(σ_ξ² + σ_x²) with σ_ξ² = 4²/12: 4.5 % of 1.4, that is 0.063. A slope has the standard error
    // √(0.2² + 1.4² 0.25²)/√(100 · 1.33) = 0.035, the mean of 200 a fourteenth of it; three of those, and 2/100 of the
    // attenuation for the finite number of points.
    let tolerance = 3.0 * 0.035 / 200_f64.sqrt() + 0.0013;
    assert!(
        (ordinary - b / (1.0 + 0.0625 / (16.0 / 12.0))).abs() < tolerance,
        "{ordinary}"
    );
    assert!((unbiased - b).abs() < tolerance, "{unbiased}");
}

#[test]
fn exact_refusals() {
    let good = points(&X, &Y, 0.1, 0.1);
    let changed = |change: fn(&mut NoisyPoint)| {
        let mut bad = good.clone();
        change(&mut bad[2]);
        total(&bad, Deviations::Known)
    };
    assert_eq!(
        total(&good[..2], Deviations::Known),
        Err(FitError::TooFewPoints {
            points: 2,
            unknowns: 2
        })
    );
    assert_eq!(changed(|p| p.y = f64::NAN), Err(FitError::NotFinite { index: 2 }));
    assert!(matches!(
        changed(|p| p.x_deviation = -0.1),
        Err(FitError::Deviation { index: 2, .. })
    ));
    assert!(matches!(
        changed(|p| (p.x_deviation, p.y_deviation) = (0.0, 0.0)),
        Err(FitError::Deviation { index: 2, .. })
    ));
    // A vertical line, and a square, which has no direction.
    assert_eq!(
        total(&points(&[2.0; 6], &Y, 0.1, 0.1), Deviations::Known),
        Err(FitError::RankDeficient { rank: 1, unknowns: 2 })
    );
    let square = points(&[0.0, 1.0, 1.0, 0.0], &[0.0, 0.0, 1.0, 1.0], 0.1, 0.1);
    assert!(matches!(
        total(&square, Deviations::Known),
        Err(FitError::NoDirection { .. })
    ));
}

#[test]
fn exact_warnings() {
    // Deviations stated a tenth of what the scatter shows, and ten times.
    for (deviation, doubted) in [(0.02, true), (0.2, false), (20.0, true)] {
        let fit = total(&points(&X, &Y, deviation, deviation), Deviations::Known).unwrap();
        let found = fit
            .line
            .warnings
            .iter()
            .any(|w| matches!(w, Warning::ScatterUnlikeStated { .. }));
        assert_eq!(found, doubted, "{}", fit.p_value);
    }
    let cloud = points(&[0.0, 1.0, 0.9, 0.1], &[0.1, 0.0, 1.4, 1.3], 1.0, 1.0);
    let fit = total(&cloud, Deviations::Known).unwrap();
    assert!(
        fit.line
            .warnings
            .iter()
            .any(|w| matches!(w, Warning::IndistinctLine { .. }))
    );
}
