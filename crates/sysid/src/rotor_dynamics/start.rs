//! Where the iteration starts: for given poles all else is linear, so a grid of poles with linear least squares finds the
//! neighbourhood of the best fit without any hint from the user.

use super::Structure;
use super::model::Model;
use super::record::Record;
use crate::estimate::Fit;
use crate::regression::{FitError, Row, linear};

/// Poles per grid; neighbouring ones then differ by a factor of two to three in usual records.
const GRID: usize = 9;

/// Damping ratios of the complex pairs tried.
const DAMPING: [f64; 2] = [0.2, 0.6];

/// The best start on the grid: linear parameters, then logarithms of the denominator's coefficients.
pub(super) fn best<const N: usize, const M: usize>(model: &Model) -> Result<[f64; N], FitError> {
    let mut best: Option<([f64; N], f64)> = None;
    let mut refusal = FitError::Decomposition;
    for logarithms in denominators(model.structure, &rates(model.record)) {
        let fit = match linear_part::<M>(model, &logarithms) {
            Ok(fit) => fit,
            Err(error) => {
                refusal = error;
                continue;
            }
        };
        let deviation = fit.goodness.standard_deviation;
        if best.as_ref().is_none_or(|(_, least)| deviation < *least) {
            let linear = fit.values();
            let start = std::array::from_fn(|i| if i < M { linear[i] } else { logarithms[i - M] });
            best = Some((start, deviation));
        }
    }
    best.map(|(start, _)| start).ok_or(refusal)
}

/// Rates from the slowest that a record can show (once over its duration) to the fastest (once per interval).
fn rates(record: &Record) -> Vec<f64> {
    let (slow, fast) = (1.0 / record.duration(), 1.0 / record.median_interval());
    let step = (fast / slow).ln() / (GRID - 1) as f64;
    (0..GRID).map(|k| slow * (step * k as f64).exp()).collect()
}

/// Logarithms of denominators with poles on the grid.
fn denominators(structure: Structure, rates: &[f64]) -> Vec<Vec<f64>> {
    if structure.order() == 1 {
        return rates.iter().map(|a| vec![a.ln()]).collect();
    }
    let pairs = rates.iter().enumerate().flat_map(|(i, slow)| {
        let faster = rates[i + 1..].iter();
        faster.map(move |fast| vec![(slow + fast).ln(), (slow * fast).ln()])
    });
    let complex = rates.iter().flat_map(|w| {
        DAMPING
            .iter()
            .map(move |zeta| vec![(2.0 * zeta * w).ln(), (w * w).ln()])
    });
    pairs.chain(complex).collect()
}

/// Gain, offset, zero and initial state for given poles.
fn linear_part<const M: usize>(model: &Model, logarithms: &[f64]) -> Result<Fit<M>, FitError> {
    let columns: [Vec<f64>; M] = std::array::from_fn(|j| {
        let mut parameters = vec![0.0; M];
        parameters[j] = 1.0;
        parameters.extend(logarithms);
        model.output(&parameters)
    });
    let rows: Vec<Row<M>> = model
        .record
        .outputs
        .iter()
        .enumerate()
        .map(|(i, y)| Row {
            regressors: std::array::from_fn(|j| columns[j][i]),
            y: *y,
        })
        .collect();
    linear(&rows)
}
