//! The order of a transfer function by the Bayesian information criterion.

use super::record::Record;
use super::{IdentificationError, ResponseFit, Start, Structure, identify};

/// One structure that was tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// The structure.
    pub structure: Structure,
    /// Its fit, or why it failed.
    pub fit: Result<ResponseFit, IdentificationError>,
}

/// The structures that were tried and the one chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct Selection {
    /// All candidates in the order given.
    pub candidates: Vec<Candidate>,
    /// The fit with the lowest criterion among those that converged.
    pub chosen: ResponseFit,
}

/// Identifies each candidate structure and chooses the one with the lowest Bayesian information criterion.
///
/// `BIC = n ln(Σ r²/n) + k ln n` with k parameters: unlike Akaike's criterion its chance of choosing too large a structure
/// goes to zero as the record grows (for one needless parameter it is `P(χ²_1 > ln n)`, 1 % at n = 1000, where Akaike's
/// stays at 16 %), and a needless pole would cost the other coefficients their precision.
///
/// A fit that did not converge is chosen only if none did; its warning reports it.
///
/// # Errors
/// The last candidate's, if none could be fitted; none given counts as all of [`Structure::ALL`].
///
/// Source: Schwarz, *Estimating the dimension of a model*, Annals of Statistics 6, 1978.
pub fn select(
    record: &Record,
    candidates: &[Structure],
    start: Start,
) -> Result<Selection, IdentificationError> {
    let structures = if candidates.is_empty() {
        &Structure::ALL
    } else {
        candidates
    };
    let tried: Vec<Candidate> = structures
        .iter()
        .map(|&structure| Candidate {
            structure,
            fit: identify(record, structure, start),
        })
        .collect();
    let converged = |fit: &ResponseFit| fit.convergence.is_some_and(|c| c.converged);
    let chosen = tried
        .iter()
        .filter_map(|candidate| candidate.fit.as_ref().ok())
        .min_by(|a, b| converged(b).cmp(&converged(a)).then(a.bic.total_cmp(&b.bic)))
        .cloned();
    match chosen {
        Some(chosen) => Ok(Selection {
            candidates: tried,
            chosen,
        }),
        None => Err(tried
            .into_iter()
            .filter_map(|candidate| candidate.fit.err())
            .next_back()
            .unwrap_or(IdentificationError::Fit {
                structure: structures[0],
                source: crate::regression::FitError::Decomposition,
            })),
    }
}
