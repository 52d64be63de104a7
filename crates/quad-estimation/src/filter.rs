//! What extended and unscented filters have in common.

use crate::belief::{Belief, Innovation, Verdict, symmetrised};
use crate::error::{finite, positive};
use crate::{EstimationError, Process};
use nalgebra::{DMatrix, DVector};

/// Readings of an instrument, all of one accuracy, at the filter's instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation<I> {
    /// What was read.
    pub instrument: I,
    /// The readings y.
    pub values: DVector<f64>,
    /// Standard deviation of each reading's white noise, > 0.
    pub deviation: f64,
}

/// A Kalman filter of some kind on a process.
///
/// [`Filter::predicted`] and [`Filter::corrected`] are its equations; [`Filter::predict`] and [`Filter::update`] check what
/// goes in and comes out, and leave the filter as it was where something is wrong.
pub trait Filter {
    /// The process it filters.
    type Process: Process;

    /// The process.
    fn process(&self) -> &Self::Process;

    /// The process, for evaluating its model.
    fn process_mut(&mut self) -> &mut Self::Process;

    /// What it believes.
    fn belief(&self) -> &Belief;

    /// Makes it believe something else, of the same size.
    fn believe(&mut self, belief: Belief);

    /// The belief one step of h seconds later.
    ///
    /// # Errors
    /// A covariance without Cholesky factor (unscented).
    fn predicted(
        &mut self,
        input: &<Self::Process as Process>::Input,
        step_s: f64,
    ) -> Result<Belief, EstimationError>;

    /// The belief after an observation, and its innovation; the belief is unchanged where the NIS is beyond the gate.
    ///
    /// # Errors
    /// A covariance without Cholesky factor.
    fn corrected(
        &mut self,
        input: &<Self::Process as Process>::Input,
        observation: &Observation<<Self::Process as Process>::Instrument>,
        gate: Option<f64>,
    ) -> Result<(Belief, Innovation), EstimationError>;

    /// Continues by a step of h seconds with this input held.
    ///
    /// # Errors
    /// A step that is not positive; a belief that leaves the numbers or loses its covariance, the old
    /// one being kept.
    fn predict(
        &mut self,
        input: &<Self::Process as Process>::Input,
        step_s: f64,
    ) -> Result<(), EstimationError> {
        if !(step_s.is_finite() && step_s > 0.0) {
            return Err(EstimationError::BadStep { step_s });
        }
        let belief = self.predicted(input, step_s)?;
        self.take(belief)
    }

    /// Takes an observation of the present in; `input` is what acts now.
    ///
    /// # Errors
    /// Readings that are not finite or of the wrong number, a deviation that is not positive; a belief that leaves the
    /// numbers or loses its covariance, the old one being kept.
    fn update(
        &mut self,
        input: &<Self::Process as Process>::Input,
        observation: &Observation<<Self::Process as Process>::Instrument>,
        gate: Option<f64>,
    ) -> Result<Innovation, EstimationError> {
        positive("a measurement's standard deviation", observation.deviation)?;
        let (expected, found) = (
            self.process().readings(observation.instrument),
            observation.values.len(),
        );
        if expected != found {
            let what = "a measurement of this instrument";
            return Err(EstimationError::Length {
                what,
                expected,
                found,
            });
        }
        for &value in observation.values.iter() {
            finite("a reading", value)?;
        }
        let (belief, innovation) = self.corrected(input, observation, gate)?;
        self.take(belief)?;
        Ok(innovation)
    }

    /// Believes it if its numbers are numbers and its covariance is one.
    ///
    /// # Errors
    /// [`EstimationError::Diverged`], [`EstimationError::NotPositiveDefinite`].
    fn take(&mut self, belief: Belief) -> Result<(), EstimationError> {
        if !belief.is_finite() {
            return Err(EstimationError::Diverged);
        }
        if belief.covariance.clone().cholesky().is_none() {
            return Err(EstimationError::NotPositiveDefinite);
        }
        self.believe(belief);
        Ok(())
    }
}

/// A belief of the process' size.
pub(crate) fn checked<P: Process>(process: &P, belief: Belief) -> Result<Belief, EstimationError> {
    let sizes = [
        ("a belief's mean", process.state_len(), belief.mean.len()),
        (
            "a covariance's row",
            process.error_len(),
            belief.covariance.nrows(),
        ),
    ];
    for (what, expected, found) in sizes {
        if expected != found {
            return Err(EstimationError::Length {
                what,
                expected,
                found,
            });
        }
    }
    Belief::new(belief.mean, belief.covariance)
}

/// The belief about errors of covariance P once Q has been added, with its mean.
pub(crate) fn with_noise(mean: DVector<f64>, mut p: DMatrix<f64>, noise: &DVector<f64>) -> Belief {
    for (i, q) in noise.iter().enumerate() {
        p[(i, i)] += q;
    }
    Belief {
        mean,
        covariance: symmetrised(&p),
    }
}

/// What a filter expects of an observation, and what it finds.
pub(crate) struct Comparison {
    /// ν = y − ŷ.
    pub(crate) residual: DVector<f64>,
    /// S without R.
    pub(crate) spread: DMatrix<f64>,
    /// R.
    pub(crate) noise: DMatrix<f64>,
    /// Covariance C of errors and readings, the `P Hᵀ` of a linear filter.
    pub(crate) cross: DMatrix<f64>,
}

/// Gain K and innovation covariance S.
pub(crate) struct Weight<'a> {
    pub(crate) gain: &'a DMatrix<f64>,
    pub(crate) s: &'a DMatrix<f64>,
}

/// `K = C S⁻¹`, `δ̂ = K ν`, `x̂ ← x̂ ⊞ δ̂`, `P ← G P⁺ Gᵀ` with P⁺ as the filter has it, unless the NIS is beyond the gate.
pub(crate) fn weighed<P: Process>(
    process: &P,
    belief: &Belief,
    comparison: Comparison,
    gate: Option<f64>,
    left: impl FnOnce(&Weight<'_>) -> DMatrix<f64>,
) -> Result<(Belief, Innovation), EstimationError> {
    let Comparison {
        residual,
        spread,
        noise,
        cross,
    } = comparison;
    let s = symmetrised(&(spread + noise));
    let factor = s.clone().cholesky().ok_or(EstimationError::NotPositiveDefinite)?;
    let nis = residual.dot(&factor.solve(&residual));
    let verdict = match gate {
        Some(gate) if nis > gate => Verdict::Rejected,
        _ => Verdict::Used,
    };
    let belief = match verdict {
        Verdict::Rejected => belief.clone(),
        Verdict::Used => {
            let gain = cross * factor.inverse();
            let error = &gain * &residual;
            let g = process.reset_jacobian(&error);
            let left = left(&Weight { gain: &gain, s: &s });
            Belief {
                mean: process.retract(&belief.mean, &error),
                covariance: symmetrised(&(&g * left * g.transpose())),
            }
        }
    };
    let innovation = Innovation {
        residual,
        covariance: s,
        nis,
        verdict,
    };
    Ok((belief, innovation))
}

/// R of an observation.
pub(crate) fn noise_of<I>(observation: &Observation<I>) -> DMatrix<f64> {
    let m = observation.values.len();
    DMatrix::from_diagonal_element(m, m, observation.deviation.powi(2))
}
