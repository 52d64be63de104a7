//! The unscented Kalman filter on the error state, with Merwe's scaled points.
//!
//! ```text
//! points    δ_0 = 0, δ_±i = ± γ column_i(L),  P = L Lᵀ,  γ² = n + λ = α² (n + κ)
//! weights   W_0ᵐ = λ/(n + λ),  W_0ᶜ = W_0ᵐ + 1 − α² + β,  W_i = 1/(2 (n + λ))
//! predict   x_i = Φ(x̂ ⊞ δ_i),  e_i = x_i ⊟ x_0,  ē = Σ Wᵐ e_i,  x̂ ← x_0 ⊞ ē,  P ← Σ Wᶜ (e_i − ē)(e_i − ē)ᵀ + Q
//! update    y_i = h(x̂ ⊞ δ_i),  S = Σ Wᶜ (y_i − ȳ)(y_i − ȳ)ᵀ + R,  C = Σ Wᶜ δ_i (y_i − ȳ)ᵀ,  K = C S⁻¹
//!           P ← P − K S Kᵀ,  then the reset of the extended filter
//! ```
//!
//! Needs no Jacobians (but the reset's) and follows curvature to second order. On a linear process it is the Kalman
//! filter exactly. Source: van der Merwe, *Sigma-Point Kalman Filters* (2004); Crassidis and Markley, *J. Guidance* 26 (2003),
//! for the attitude's errors.

use crate::belief::{Belief, Innovation};
use crate::filter::{Comparison, Filter, Observation, checked, noise_of, weighed, with_noise};
use crate::{EstimationError, Process};
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

/// How the points are spread.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spread {
    /// α: distance of the points from the mean is `α √(n + κ)` standard deviations, 0 < α ≤ 1.
    pub alpha: f64,
    /// β: what is known of the distribution's kurtosis; 2 for a Gaussian.
    pub beta: f64,
    /// κ, usually 0.
    pub kappa: f64,
}

impl Default for Spread {
    /// α = 1, β = 2, κ = 0: no weight is negative, so that covariances stay positive definite whatever the model's kinks do. The
    /// points of 20 to 40 errors then lie 4 to 6 standard deviations away; a smaller α brings them nearer at the price of a negative
    /// weight of the middle.
    fn default() -> Self {
        Self {
            alpha: 1.0,
            beta: 2.0,
            kappa: 0.0,
        }
    }
}

/// The unscented Kalman filter on a process.
#[derive(Clone, Debug)]
pub struct UnscentedFilter<P> {
    process: P,
    belief: Belief,
    spread: Spread,
}

/// Errors of the points, and the weights.
struct Points {
    errors: Vec<DVector<f64>>,
    mean_weight: f64,
    covariance_weight: f64,
    other_weight: f64,
}

impl Points {
    fn mean(&self, values: &[DVector<f64>]) -> DVector<f64> {
        let rest = values[1..]
            .iter()
            .fold(DVector::zeros(values[0].len()), |sum, v| sum + v);
        &values[0] * self.mean_weight + rest * self.other_weight
    }

    /// `Σ Wᶜ a_i b_iᵀ`.
    fn covariance(&self, a: &[DVector<f64>], b: &[DVector<f64>]) -> DMatrix<f64> {
        let mut sum = &a[0] * b[0].transpose() * self.covariance_weight;
        for (a, b) in a.iter().zip(b).skip(1) {
            sum.ger(self.other_weight, a, b, 1.0);
        }
        sum
    }
}

/// Each less the mean.
fn centred(values: &[DVector<f64>], mean: &DVector<f64>) -> Vec<DVector<f64>> {
    values.iter().map(|v| v - mean).collect()
}

impl<P: Process> UnscentedFilter<P> {
    /// A filter that begins with a belief.
    ///
    /// # Errors
    /// A belief of another size than the process has; a spread without width.
    pub fn new(process: P, belief: Belief, spread: Spread) -> Result<Self, EstimationError> {
        let Spread { alpha, beta, kappa } = spread;
        let n = process.error_len();
        let width = alpha * alpha * (n as f64 + kappa);
        if !(alpha > 0.0 && alpha <= 1.0 && beta.is_finite() && width.is_finite() && width > 0.0) {
            return Err(EstimationError::BadSpread {
                alpha,
                beta,
                kappa,
                n,
            });
        }
        let belief = checked(&process, belief)?;
        Ok(Self {
            process,
            belief,
            spread,
        })
    }

    fn points(&self) -> Result<Points, EstimationError> {
        let p = &self.belief.covariance;
        let n = p.nrows();
        let Spread { alpha, beta, kappa } = self.spread;
        // n + λ.
        let width = alpha * alpha * (n as f64 + kappa);
        let mean_weight = 1.0 - n as f64 / width;
        let factor = p.clone().cholesky().ok_or(EstimationError::NotPositiveDefinite)?;
        let l = factor.l() * width.sqrt();
        let mut errors = vec![DVector::zeros(n)];
        for sign in [1.0, -1.0] {
            errors.extend((0..n).map(|i| l.column(i) * sign));
        }
        Ok(Points {
            errors,
            mean_weight,
            covariance_weight: mean_weight + 1.0 - alpha * alpha + beta,
            other_weight: 0.5 / width,
        })
    }
}

impl<P: Process> Filter for UnscentedFilter<P> {
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
        let points = self.points()?;
        let mean = &self.belief.mean;
        let moved: Vec<DVector<f64>> = points
            .errors
            .iter()
            .map(|error| {
                let x = self.process.retract(mean, error);
                self.process.transition(&x, input, step_s)
            })
            .collect();
        let errors: Vec<DVector<f64>> = moved.iter().map(|x| self.process.local(&moved[0], x)).collect();
        let mean_error = points.mean(&errors);
        let about = centred(&errors, &mean_error);
        let g = self.process.reset_jacobian(&mean_error);
        let p = &g * points.covariance(&about, &about) * g.transpose();
        let mean = self.process.retract(&moved[0], &mean_error);
        Ok(with_noise(mean, p, &self.process.process_noise(step_s)))
    }

    fn corrected(
        &mut self,
        input: &P::Input,
        observation: &Observation<P::Instrument>,
        gate: Option<f64>,
    ) -> Result<(Belief, Innovation), EstimationError> {
        let points = self.points()?;
        let Belief { mean, covariance: p } = &self.belief;
        let read: Vec<DVector<f64>> = points
            .errors
            .iter()
            .map(|error| {
                let x = self.process.retract(mean, error);
                self.process.observe(&x, input, observation.instrument)
            })
            .collect();
        let expected = points.mean(&read);
        let about = centred(&read, &expected);
        let comparison = Comparison {
            residual: &observation.values - &expected,
            spread: points.covariance(&about, &about),
            noise: noise_of(observation),
            cross: points.covariance(&points.errors, &about),
        };
        weighed(&self.process, &self.belief, comparison, gate, |weight| {
            p - weight.gain * weight.s * weight.gain.transpose()
        })
    }
}
