//! The error-state (multiplicative) extended Kalman filter.
//!
//! ```text
//! predict   x̂ ← Φ(x̂, u, h),  P ← F P Fᵀ + Q
//! update    S = H P Hᵀ + R,  K = P Hᵀ S⁻¹,  δ̂ = K (y − h(x̂, u))
//!           P ← (1 − K H) P (1 − K H)ᵀ + K R Kᵀ        (Joseph)
//! reset     x̂ ← x̂ ⊞ δ̂,  P ← G P Gᵀ
//! ```
//!
//! F and H come from the process by automatic differentiation; G is the reset's Jacobian, which turns the attitude's errors
//! into those about the new mean. Valid where Φ and h are close to linear over the spread of P. Source: Solà, *Quaternion
//! kinematics for the error-state Kalman filter* (2017), chapters 5 and 6; Markley, *J. Guidance* 26 (2003); Crassidis and
//! Junkins, *Optimal Estimation of Dynamic Systems*, 2nd ed., section 3.7.

use crate::belief::{Belief, Innovation, Verdict, symmetrised};
use crate::filter::{Filter, Observation, checked, normalised_square};
use crate::{EstimationError, Process};
use nalgebra::{DMatrix, DVector};

/// The extended Kalman filter on a process.
#[derive(Clone, Debug)]
pub struct ExtendedFilter<P> {
    process: P,
    belief: Belief,
}

impl<P: Process> ExtendedFilter<P> {
    /// A filter that begins with a belief.
    ///
    /// # Errors
    /// A belief of another size than the process has.
    pub fn new(process: P, belief: Belief) -> Result<Self, EstimationError> {
        let belief = checked(&process, belief)?;
        Ok(Self { process, belief })
    }
}

impl<P: Process> Filter for ExtendedFilter<P> {
    type Process = P;

    fn process(&self) -> &P {
        &self.process
    }

    fn process_mut(&mut self) -> &mut P {
        &mut self.process
    }

    fn belief(&self) -> &Belief {
        &self.belief
    }

    fn believe(&mut self, belief: Belief) {
        self.belief = belief;
    }

    fn predicted(&mut self, input: &P::Input, step_s: f64) -> Result<Belief, EstimationError> {
        let Belief { mean, covariance } = &self.belief;
        let f = self.process.transition_jacobian(mean, input, step_s);
        let mut p = &f * covariance * f.transpose();
        let noise = self.process.process_noise(step_s);
        for (i, q) in noise.iter().enumerate() {
            p[(i, i)] += q;
        }
        Ok(Belief {
            mean: self.process.transition(mean, input, step_s),
            covariance: symmetrised(&p),
        })
    }

    fn corrected(
        &mut self,
        input: &P::Input,
        observation: &Observation<P::Instrument>,
        gate: Option<f64>,
    ) -> Result<(Belief, Innovation), EstimationError> {
        let Belief { mean, covariance: p } = &self.belief;
        let h = self.process.observe_jacobian(mean, input, observation.instrument);
        let residual = &observation.values - self.process.observe(mean, input, observation.instrument);
        let m = residual.len();
        let r = DMatrix::from_diagonal_element(m, m, observation.deviation.powi(2));
        let p_ht = p * h.transpose();
        let s = symmetrised(&(&h * &p_ht + &r));
        let whitened = normalised_square(&s, &residual)?;
        let verdict = match gate {
            Some(gate) if whitened.nis > gate => Verdict::Rejected,
            _ => Verdict::Used,
        };
        let belief = match verdict {
            Verdict::Rejected => self.belief.clone(),
            Verdict::Used => {
                let gain = &p_ht * &whitened.inverse;
                let error: DVector<f64> = &gain * &residual;
                let n = p.nrows();
                let rest = DMatrix::identity(n, n) - &gain * &h;
                let joseph = &rest * p * rest.transpose() + &gain * &r * gain.transpose();
                let g = self.process.reset_jacobian(&error);
                Belief {
                    mean: self.process.retract(mean, &error),
                    covariance: symmetrised(&(&g * joseph * g.transpose())),
                }
            }
        };
        let innovation = Innovation {
            residual,
            covariance: s,
            nis: whitened.nis,
            verdict,
        };
        Ok((belief, innovation))
    }
}
