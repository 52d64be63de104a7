//! Total least squares: a line through points that are uncertain along both axes.
//!
//! ```text
//! y = a + b x,   S(a, b) = Σ W_i (y_i − a − b x_i)²,   W_i = 1 / (σ_y,i² + b² σ_x,i²),   (â, b̂) = argmin S
//! b = Σ W_i β_i V_i / Σ W_i β_i U_i,   β_i = W_i (U_i σ_y,i² + b V_i σ_x,i²),   U_i = x_i − x̄_W,   V_i = y_i − ȳ_W
//! σ_b² = 1 / Σ W_i u_i²,   σ_a² = 1 / Σ W_i + ξ̄² σ_b²,   ξ_i = x̄_W + β_i,   u_i = ξ_i − ξ̄
//! ```
//!
//! The iteration starts from the orthogonal fit: the smallest singular value of the points, each axis divided by its mean
//! deviation. With the same deviations at every point this start is the answer already (Deming's line).
//!
//! Assumptions: errors normal, independent between points and axes; standard errors to first order, so the scatter must
//! be small beside the spread of the points. An ordinary fit of such points is biased towards zero slope.
//! Source: York, Evensen, Martínez, Delgado, *Unified equations for the slope, intercept, and standard errors of the
//! best straight line*, American Journal of Physics 72, 2004; Golub and Van Loan, *Matrix Computations*, 6.3.

use super::{FitError, ILL_CONDITIONED};
use crate::estimate::{Convergence, Estimate, Fit, Goodness, Warning};
use faer::Mat;
use nalgebra::Matrix2;
use serde::{Deserialize, Serialize};
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// A point whose coordinates are both uncertain.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NoisyPoint {
    /// Abscissa.
    pub x: f64,
    /// Ordinate.
    pub y: f64,
    /// Standard deviation σ_x of the abscissa, in its unit; 0 for an exact one.
    pub x_deviation: f64,
    /// Standard deviation σ_y of the ordinate, in its unit; 0 for an exact one.
    pub y_deviation: f64,
}

/// What the stated standard deviations mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Deviations {
    /// They are known: intervals follow from them alone, and χ² tells whether the points agree with them.
    Known,
    /// Only their ratios are: intervals are scaled by the scatter that is found, `√(S/(n − 2))`.
    Relative,
}

/// The line and how well it agrees with the points.
#[derive(Clone, Debug, PartialEq)]
pub struct TotalFit {
    /// Intercept a and slope b; residuals `y − a − b x` along y.
    pub line: Fit<2>,
    /// Residuals along x: measured minus the point of the line that is most likely.
    pub x_residuals: Vec<f64>,
    /// `S` at the minimum: χ² with n − 2 degrees of freedom where the deviations are known.
    pub chi_squared: f64,
    /// Probability of a χ² at least as large if the deviations are as stated.
    pub p_value: f64,
}

/// Relative change of the slope at which the iteration ends: rounding of sums over the points.
const SETTLED: f64 = 1e-14;
/// Iterations allowed; the map contracts by about the square of scatter over spread, so a handful are needed.
const PATIENCE: usize = 200;
/// Ratio of the scatter across the line to the spread along it from which first-order errors mislead: their next term
/// is of the order of its square, a tenth.
const INDISTINCT: f64 = 0.3;
/// p-value of χ² below which, or above one minus which, the stated deviations are doubted.
const DOUBTFUL: f64 = 1e-3;

/// Fits a line to points with errors along both axes.
///
/// ```
/// use sysid::regression::{Deviations, NoisyPoint, total};
/// let point = |x: f64, y: f64| NoisyPoint { x, y, x_deviation: 0.1, y_deviation: 0.2 };
/// let points = [point(0.0, 1.0), point(1.0, 3.1), point(2.0, 4.9), point(3.0, 7.0)];
/// let fit = total(&points, Deviations::Known)?;
/// assert!(fit.line.parameters[1].interval().contains(2.0));
/// # Ok::<(), sysid::regression::FitError>(())
/// ```
///
/// # Errors
/// Fewer than three points, numbers that are not finite, deviations that are negative or both zero, points that have no
/// direction or lie on a vertical line.
pub fn total(points: &[NoisyPoint], deviations: Deviations) -> Result<TotalFit, FitError> {
    check(points)?;
    let start = orthogonal(points)?;
    let (sums, convergence) = iterate(points, start.slope);
    let freedom = points.len() as f64 - 2.0;
    let b = sums.slope;
    let a = sums.y - b * sums.x;
    let line_residuals: Vec<f64> = points.iter().map(|p| p.y - a - b * p.x).collect();
    let chi_squared: f64 = points
        .iter()
        .zip(&line_residuals)
        .map(|(p, r)| weight(p, b) * r * r)
        .sum();
    let (scale, degrees_of_freedom) = match deviations {
        Deviations::Known => (1.0, f64::INFINITY),
        Deviations::Relative => (chi_squared / freedom, freedom),
    };
    let covariance = sums.covariance * scale;
    let p_value = ChiSquared::new(freedom).map_or(f64::NAN, |chi| chi.sf(chi_squared));
    let ys: Vec<f64> = points.iter().map(|p| p.y).collect();
    let estimate = |value: f64, i: usize| Estimate {
        value,
        standard_error: covariance[(i, i)].sqrt(),
        degrees_of_freedom,
    };
    let x_residuals = points
        .iter()
        .zip(&line_residuals)
        .map(|(p, r)| -b * p.x_deviation.powi(2) * weight(p, b) * r)
        .collect();
    Ok(TotalFit {
        line: Fit {
            parameters: [estimate(a, 0), estimate(b, 1)],
            covariance,
            goodness: Goodness::of(&line_residuals, &ys, 2),
            residuals: line_residuals,
            condition_number: sums.condition_number,
            convergence: Some(convergence),
            warnings: warnings(&start, &sums, convergence, deviations, p_value),
        },
        x_residuals,
        chi_squared,
        p_value,
    })
}

fn check(points: &[NoisyPoint]) -> Result<(), FitError> {
    if points.len() < 3 {
        return Err(FitError::TooFewPoints {
            points: points.len(),
            unknowns: 2,
        });
    }
    for (index, p) in points.iter().enumerate() {
        if ![p.x, p.y, p.x_deviation, p.y_deviation]
            .iter()
            .all(|v| v.is_finite())
        {
            return Err(FitError::NotFinite { index });
        }
        let largest = p.x_deviation.max(p.y_deviation);
        if p.x_deviation < 0.0 || p.y_deviation < 0.0 || largest == 0.0 {
            return Err(FitError::Deviation {
                index,
                x_deviation: p.x_deviation,
                y_deviation: p.y_deviation,
            });
        }
    }
    Ok(())
}

/// `W_i`.
fn weight(p: &NoisyPoint, slope: f64) -> f64 {
    1.0 / (p.y_deviation.powi(2) + (slope * p.x_deviation).powi(2))
}

/// The line through points of equal deviations.
struct Orthogonal {
    slope: f64,
    /// Smallest over largest singular value: scatter across the line over spread along it.
    scatter: f64,
}

/// The direction of the largest singular value of the centred points, each axis over its root mean square deviation.
fn orthogonal(points: &[NoisyPoint]) -> Result<Orthogonal, FitError> {
    let n = points.len() as f64;
    let mean = |value: fn(&NoisyPoint) -> f64| points.iter().map(value).sum::<f64>() / n;
    let (x, y) = (mean(|p| p.x), mean(|p| p.y));
    let deviation = [
        mean(|p| p.x_deviation.powi(2)).sqrt(),
        mean(|p| p.y_deviation.powi(2)).sqrt(),
    ];
    let spread = |value: f64, centre: f64| (value - centre).abs();
    let width = points.iter().map(|p| spread(p.x, x)).fold(0.0, f64::max);
    // An exact axis takes all the weight; a small number stands for zero, and the iteration settles the rest.
    let floor = 1e-6 * deviation[0].max(deviation[1]);
    let unit = deviation.map(|d| d.max(floor));
    if width <= f64::EPSILON * x.abs() || width == 0.0 {
        return Err(FitError::RankDeficient { rank: 1, unknowns: 2 });
    }
    let centred = Mat::from_fn(points.len(), 2, |i, j| {
        if j == 0 {
            (points[i].x - x) / unit[0]
        } else {
            (points[i].y - y) / unit[1]
        }
    });
    let svd = centred.thin_svd().map_err(|_| FitError::Decomposition)?;
    let along = [svd.V()[(0, 0)], svd.V()[(1, 0)]];
    let scatter = svd.S().column_vector()[1] / svd.S().column_vector()[0];
    let slope = along[1] * unit[1] / (along[0] * unit[0]);
    if !slope.is_finite() || scatter > 1.0 - super::RANK_TOLERANCE {
        return Err(FitError::NoDirection { scatter });
    }
    Ok(Orthogonal { slope, scatter })
}

/// What one pass over the points gives.
struct Sums {
    slope: f64,
    x: f64,
    y: f64,
    /// Of intercept and slope, with the deviations taken as known.
    covariance: Matrix2<f64>,
    condition_number: f64,
}

fn iterate(points: &[NoisyPoint], start: f64) -> (Sums, Convergence) {
    let mut sums = pass(points, start);
    for evaluations in 2..=PATIENCE {
        let next = pass(points, sums.slope);
        let change = (next.slope - sums.slope).abs();
        let settled = change <= SETTLED * next.slope.abs().max(sums.slope.abs());
        if !next.slope.is_finite() {
            return (
                sums,
                Convergence {
                    converged: false,
                    evaluations,
                },
            );
        }
        sums = next;
        if settled || change == 0.0 {
            return (
                sums,
                Convergence {
                    converged: true,
                    evaluations,
                },
            );
        }
    }
    let unfinished = Convergence {
        converged: false,
        evaluations: PATIENCE,
    };
    (sums, unfinished)
}

/// The next slope from the last one, and the covariance there.
fn pass(points: &[NoisyPoint], b: f64) -> Sums {
    let weights: Vec<f64> = points.iter().map(|p| weight(p, b)).collect();
    let total: f64 = weights.iter().sum();
    let mean =
        |value: &dyn Fn(usize) -> f64| (0..points.len()).map(|i| weights[i] * value(i)).sum::<f64>() / total;
    let (x, y) = (mean(&|i| points[i].x), mean(&|i| points[i].y));
    let beta: Vec<f64> = points
        .iter()
        .zip(&weights)
        .map(|(p, w)| w * ((p.x - x) * p.y_deviation.powi(2) + b * (p.y - y) * p.x_deviation.powi(2)))
        .collect();
    let slope = mean(&|i| beta[i] * (points[i].y - y)) / mean(&|i| beta[i] * (points[i].x - x));
    let centre = mean(&|i| beta[i]);
    let spread = total * mean(&|i| (beta[i] - centre).powi(2));
    let slope_variance = 1.0 / spread;
    let xi = x + centre;
    let mixed = -xi * slope_variance;
    Sums {
        slope,
        x,
        y,
        covariance: Matrix2::new(
            1.0 / total + xi * xi * slope_variance,
            mixed,
            mixed,
            slope_variance,
        ),
        // Of the scaled 2 × 2 problem: columns 1 and ξ at the angle whose cosine is ξ̄ / rms ξ.
        condition_number: {
            let cosine = xi.abs() / (xi * xi + spread / total).sqrt();
            ((1.0 + cosine) / (1.0 - cosine)).sqrt()
        },
    }
}

fn warnings(
    start: &Orthogonal,
    sums: &Sums,
    convergence: Convergence,
    deviations: Deviations,
    p_value: f64,
) -> Vec<Warning> {
    let mut found = Vec::new();
    if sums.condition_number > ILL_CONDITIONED {
        found.push(Warning::IllConditioned {
            condition_number: sums.condition_number,
        });
    }
    if !convergence.converged {
        found.push(Warning::NotConverged {
            evaluations: convergence.evaluations,
        });
    }
    if start.scatter > INDISTINCT {
        found.push(Warning::IndistinctLine {
            scatter: start.scatter,
        });
    }
    let doubtful = !(DOUBTFUL..=1.0 - DOUBTFUL).contains(&p_value);
    if deviations == Deviations::Known && doubtful {
        found.push(Warning::ScatterUnlikeStated { p_value });
    }
    found
}

#[cfg(test)]
mod tests;
