//! Non-linear least squares: Levenberg-Marquardt with Jacobians by automatic differentiation.

use super::linear::{fit, solve};
use super::{FitError, linear};
use crate::estimate::{Convergence, Fit};
use faer::Mat;
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra_034::{Const, DVector, Dyn, OMatrix, OVector, SVector, U1, storage::Owned};
use quad_math::{Dual, Real};

/// A model that predicts data from `N` parameters; generic in the scalar, so that its Jacobian is exact.
pub trait Predictor<const N: usize> {
    /// The predictions, one for each datum, in the unit of the data.
    fn predict<R: Real>(&self, parameters: &[R; N]) -> Vec<R>;
}

/// Evaluations allowed per parameter before the iteration is called unfinished.
const PATIENCE: usize = 200;

/// Residual that stands for a prediction that is not finite: larger than any datum, and its square is still a number.
const BAD_STEP: f64 = 1e100;

/// Fits a model to data by least squares from a start.
///
/// Data of unequal noise: divide data and predictions by each datum's standard deviation.
///
/// An iteration that does not converge is no error: the best parameters come with a warning.
///
/// # Errors
/// Too few data, data or a start without finite predictions, data that don't determine the parameters.
///
/// # Panics
/// If the model predicts another number of data than there are: a programming error.
pub fn nonlinear<const N: usize>(
    data: &[f64],
    model: &impl Predictor<N>,
    start: [f64; N],
) -> Result<Fit<N>, FitError> {
    if let Some(index) = data.iter().position(|y| !y.is_finite()) {
        return Err(FitError::NotFinite { index });
    }
    if data.len() <= N {
        return Err(FitError::TooFewPoints {
            points: data.len(),
            unknowns: N,
        });
    }
    let problem = Problem {
        data,
        model,
        parameters: start,
    };
    if problem.residual_values().iter().any(|r| !r.is_finite()) || problem.jacobian().is_none() {
        return Err(FitError::NoStart { start: start.into() });
    }
    let (problem, report) = LevenbergMarquardt::new()
        .with_patience(PATIENCE)
        .minimize(problem);
    let convergence = Convergence {
        converged: report.termination.was_successful(),
        evaluations: report.number_of_evaluations,
    };
    let residuals = problem.residual_values();
    let slopes = problem.slopes();
    if let Some(index) = slopes.iter().position(|row| row.iter().any(|x| !x.is_finite())) {
        return Err(FitError::NotFinite { index });
    }
    let design = Mat::from_fn(data.len(), N, |i, j| slopes[i][j]);
    let mut solution: linear::Solution<N> = solve(&design, &residuals)?;
    solution.parameters = problem.parameters.into();
    Ok(fit(solution, residuals, data, Some(convergence)))
}

/// Rows of the Jacobian of the predictions at these parameters.
pub fn slopes<const N: usize>(model: &impl Predictor<N>, parameters: &[f64; N]) -> Vec<[f64; N]> {
    let seeded: [Dual<N>; N] = std::array::from_fn(|i| {
        let mut dual = Dual::<N>::from_re(parameters[i]);
        dual.eps = num_dual::Derivative::derivative_generic(nalgebra::Const::<N>, nalgebra::U1, i);
        dual
    });
    let predicted = model.predict(&seeded);
    let row = |p: &Dual<N>| p.eps.0.map_or([0.0; N], Into::into);
    predicted.iter().map(row).collect()
}

struct Problem<'a, M, const N: usize> {
    data: &'a [f64],
    model: &'a M,
    parameters: [f64; N],
}

impl<M: Predictor<N>, const N: usize> Problem<'_, M, N> {
    /// Measured minus predicted.
    fn residual_values(&self) -> Vec<f64> {
        let predicted = self.model.predict(&self.parameters);
        assert_eq!(predicted.len(), self.data.len(), "one prediction per datum");
        self.data.iter().zip(predicted).map(|(y, p)| y - p).collect()
    }

    fn slopes(&self) -> Vec<[f64; N]> {
        slopes(self.model, &self.parameters)
    }
}

impl<M: Predictor<N>, const N: usize> LeastSquaresProblem<f64, Dyn, Const<N>> for Problem<'_, M, N> {
    type ResidualStorage = Owned<f64, Dyn, U1>;
    type JacobianStorage = Owned<f64, Dyn, Const<N>>;
    type ParameterStorage = Owned<f64, Const<N>, U1>;

    fn set_params(&mut self, x: &SVector<f64, N>) {
        self.parameters = (*x).into();
    }

    fn params(&self) -> SVector<f64, N> {
        self.parameters.into()
    }

    fn residuals(&self) -> Option<OVector<f64, Dyn>> {
        let residuals = self.residual_values();
        // A trial step beyond what the model can predict is a bad step, from which the iteration turns back.
        Some(if residuals.iter().all(|r| r.is_finite()) {
            DVector::from_vec(residuals)
        } else {
            DVector::repeat(residuals.len(), BAD_STEP)
        })
    }

    fn jacobian(&self) -> Option<OMatrix<f64, Dyn, Const<N>>> {
        let slopes = self.slopes();
        let finite = slopes.iter().flatten().all(|x| x.is_finite());
        // Residuals fall where predictions rise.
        finite.then(|| OMatrix::from_fn_generic(Dyn(slopes.len()), Const::<N>, |i, j| -slopes[i][j]))
    }
}
