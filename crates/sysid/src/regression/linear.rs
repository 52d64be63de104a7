//! Linear least squares by the singular value decomposition.

use super::{FitError, ILL_CONDITIONED, RANK_TOLERANCE};
use crate::estimate::{Convergence, Estimate, Fit, Goodness, Warning};
use faer::Mat;
use nalgebra::{SMatrix, SVector};

/// One datum of a linear fit: `y = Σ regressors_i p_i + r`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row<const N: usize> {
    /// What multiplies the parameters.
    pub regressors: [f64; N],
    /// What was measured.
    pub y: f64,
}

/// Fits `y = X p` by least squares.
///
/// ```
/// use sysid::regression::{Row, linear};
/// let rows: Vec<Row<2>> = (0..9).map(|i| f64::from(i)).map(|x| Row { regressors: [1.0, x], y: 3.0 + 2.0 * x }).collect();
/// let fit = linear(&rows)?;
/// assert!((fit.parameters[1].value - 2.0).abs() < 1e-12);
/// # Ok::<(), sysid::regression::FitError>(())
/// ```
///
/// # Errors
/// Too few rows, rows that don't determine the parameters, numbers that are not finite, data that are all equal while the
/// regressors change (one unknown with a constant regressor is a mean, of which equal data are no error).
pub fn linear<const N: usize>(rows: &[Row<N>]) -> Result<Fit<N>, FitError> {
    if let Some(index) = rows
        .iter()
        .position(|row| !(row.y.is_finite() && row.regressors.iter().all(|x| x.is_finite())))
    {
        return Err(FitError::NotFinite { index });
    }
    let design = Mat::from_fn(rows.len(), N, |i, j| rows[i].regressors[j]);
    let y: Vec<f64> = rows.iter().map(|row| row.y).collect();
    let solution = solve::<N>(&design, &y)?;
    refuse_constant(rows)?;
    let residuals: Vec<f64> = rows
        .iter()
        .map(|row| row.y - SVector::from(row.regressors).dot(&solution.parameters))
        .collect();
    Ok(fit(solution, residuals, &y, None))
}

/// Refuses data that do not answer to regressors that change.
fn refuse_constant<const N: usize>(rows: &[Row<N>]) -> Result<(), FitError> {
    let Some(first) = rows.first() else {
        return Ok(());
    };
    let driven = rows.iter().any(|row| row.regressors != first.regressors);
    if driven && rows.iter().all(|row| row.y == first.y) {
        return Err(FitError::ConstantData {
            points: rows.len(),
            value: first.y,
        });
    }
    Ok(())
}

/// The least-squares solution of `X p = y` and what else the decomposition tells.
pub(super) struct Solution<const N: usize> {
    pub(super) parameters: SVector<f64, N>,
    /// `(Xᵀ X)⁻¹`.
    pub(super) unscaled_covariance: SMatrix<f64, N, N>,
    pub(super) condition_number: f64,
}

/// Solves `X p = y` with columns scaled to unit length.
pub(super) fn solve<const N: usize>(design: &Mat<f64>, y: &[f64]) -> Result<Solution<N>, FitError> {
    let points = design.nrows();
    if points <= N {
        return Err(FitError::TooFewPoints { points, unknowns: N });
    }
    let lengths: [f64; N] = std::array::from_fn(|j| design.col(j).norm_l2());
    let rank_of_columns = lengths.iter().filter(|length| **length > 0.0).count();
    if rank_of_columns < N {
        return Err(FitError::RankDeficient {
            rank: rank_of_columns,
            unknowns: N,
        });
    }
    let scaled = Mat::from_fn(points, N, |i, j| design[(i, j)] / lengths[j]);
    let svd = scaled.thin_svd().map_err(|_| FitError::Decomposition)?;
    let (u, v) = (svd.U(), svd.V());
    let singular: Vec<f64> = (0..N).map(|k| svd.S().column_vector()[k]).collect();
    let rank = singular
        .iter()
        .filter(|s| **s > RANK_TOLERANCE * singular[0])
        .count();
    if rank < N {
        return Err(FitError::RankDeficient { rank, unknowns: N });
    }
    // p = D⁻¹ V S⁻¹ Uᵀ y, (XᵀX)⁻¹ = D⁻¹ V S⁻² Vᵀ D⁻¹.
    let projected: Vec<f64> = (0..N)
        .map(|k| (0..points).map(|i| u[(i, k)] * y[i]).sum::<f64>() / singular[k])
        .collect();
    Ok(Solution {
        parameters: SVector::from_fn(|j, _| {
            (0..N).map(|k| v[(j, k)] * projected[k]).sum::<f64>() / lengths[j]
        }),
        unscaled_covariance: SMatrix::from_fn(|i, j| {
            let sum: f64 = (0..N).map(|k| v[(i, k)] * v[(j, k)] / singular[k].powi(2)).sum();
            sum / (lengths[i] * lengths[j])
        }),
        condition_number: singular[0] / singular[N - 1],
    })
}

/// Estimates with their uncertainty from a solution and its residuals.
pub(super) fn fit<const N: usize>(
    solution: Solution<N>,
    residuals: Vec<f64>,
    data: &[f64],
    convergence: Option<Convergence>,
) -> Fit<N> {
    let goodness = Goodness::of(&residuals, data, N);
    let covariance = solution.unscaled_covariance * goodness.standard_deviation.powi(2);
    let mut warnings = Vec::new();
    if solution.condition_number > ILL_CONDITIONED {
        warnings.push(Warning::IllConditioned {
            condition_number: solution.condition_number,
        });
    }
    if let Some(Convergence {
        converged: false,
        evaluations,
    }) = convergence
    {
        warnings.push(Warning::NotConverged { evaluations });
    }
    Fit {
        parameters: std::array::from_fn(|i| Estimate {
            value: solution.parameters[i],
            standard_error: covariance[(i, i)].sqrt(),
            degrees_of_freedom: goodness.degrees_of_freedom,
        }),
        covariance,
        residuals,
        goodness,
        condition_number: solution.condition_number,
        convergence,
        warnings,
    }
}
