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

use crate::belief::{Belief, Innovation};
use crate::filter::{Comparison, Filter, Observation, checked, noise_of, weighed, with_noise};
use crate::{EstimationError, Process};
use nalgebra::DMatrix;

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
        let p = &f * covariance * f.transpose();
        let moved = self.process.transition(mean, input, step_s);
        Ok(with_noise(moved, p, &self.process.process_noise(step_s)))
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
        let (p_ht, r) = (p * h.transpose(), noise_of(observation));
        let comparison = Comparison {
            residual,
            spread: &h * &p_ht,
            noise: r.clone(),
            cross: p_ht,
        };
        weighed(&self.process, &self.belief, comparison, gate, |weight| {
            let gain = weight.gain;
            let rest = DMatrix::identity(p.nrows(), p.nrows()) - gain * &h;
            &rest * p * rest.transpose() + gain * &r * gain.transpose()
        })
    }
}
