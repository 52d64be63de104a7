//! The output-error fit of one structure.

use super::model::Model;
use super::record::{Record, RecordError};
use super::result::ResponseFit;
use super::{Start, Structure, start};
use crate::regression::{FitError, nonlinear};

/// Why a response was not identified.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum IdentificationError {
    /// The record was refused.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// The regression was refused.
    #[error("the record does not determine a {structure:?} transfer function: {source}")]
    Fit {
        /// The structure.
        structure: Structure,
        /// Why.
        source: FitError,
    },
}

/// Identifies a transfer function of one structure from a record.
///
/// ```
/// use sysid::rotor_dynamics::{Coefficients, Record, ResponseSample, Start, Structure, identify};
/// // A first-order lag of 0.1 s answers a unit step at t = 0.2 s.
/// let sample = |k: u32| {
///     let t = 0.02 * f64::from(k);
///     let output = if t < 0.2 { 0.0 } else { 1.0 - (-(t - 0.2) / 0.1).exp() };
///     ResponseSample { time_s: t, input: if k < 10 { 0.0 } else { 1.0 }, output }
/// };
/// let record = Record::new(&(0..60).map(sample).collect::<Vec<_>>())?;
/// let fit = identify(&record, Structure::FirstOrder, Start::Equilibrium)?;
/// let Coefficients::FirstOrder { bandwidth } = fit.coefficients else { unreachable!() };
/// assert!((bandwidth.value - 10.0).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Data that don't determine the parameters: see [`IdentificationError`].
pub fn identify(
    record: &Record,
    structure: Structure,
    start: Start,
) -> Result<ResponseFit, IdentificationError> {
    let model = Model {
        record,
        structure,
        start,
    };
    // The first number counts all parameters, the second the linear ones.
    match (structure, start) {
        (Structure::FirstOrder, Start::Equilibrium) => run::<3, 2>(&model),
        (Structure::FirstOrder, Start::Free) => run::<4, 3>(&model),
        (Structure::SecondOrder, Start::Equilibrium) => run::<4, 2>(&model),
        (Structure::SecondOrder, Start::Free) => run::<6, 4>(&model),
        (Structure::SecondOrderWithZero, Start::Equilibrium) => run::<5, 3>(&model),
        (Structure::SecondOrderWithZero, Start::Free) => run::<7, 5>(&model),
    }
    .map_err(|source| IdentificationError::Fit { structure, source })
}

fn run<const N: usize, const M: usize>(model: &Model) -> Result<ResponseFit, FitError> {
    let start = start::best::<N, M>(model)?;
    let fit = nonlinear::<N>(&model.record.outputs, model, start)?;
    Ok(ResponseFit::of(model, fit))
}
