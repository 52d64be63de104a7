//! Lack of fit: is a model's error larger than the scatter of repeated measurements?
//!
//! ```text
//! F = [Σ_g n_g r̄_g² / (G − p)] / [Σ_g Σ_i (r_gi − r̄_g)² / (N − G)]
//! ```
//!
//! with G groups of repetitions, their mean residuals `r̄_g`, N data and p parameters; F's distribution if the model is
//! right. The denominator is the *pure error*: the variance of a datum whether the model is right or not. The numerator's sum over
//! N is the mean square of what the model misses, and of the means' own scatter.
//!
//! Assumptions: independent normal errors of equal variance, and as many parameters as the fit had. Groups may be near
//! repetitions, at almost the same place: of residuals, which are compared here, the model has taken the difference.
//! Source: Draper and Smith, *Applied Regression Analysis*, section on pure error.

use crate::residual::CORRELATED_BELOW;
use serde::Serialize;
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

/// Result of a test for lack of fit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LackOfFit {
    /// Variance of the group means about the model over the variance within groups.
    pub f: f64,
    /// Probability of an F at least as large if the model is right.
    pub p_value: f64,
    /// Degrees of freedom of the group means: groups less parameters.
    pub between: f64,
    /// Degrees of freedom within the groups: data less groups.
    pub within: f64,
    /// Standard deviation of a datum by pure error, `√(Σ_g Σ_i (r_gi − r̄_g)² / (N − G))`, in the unit of the data.
    pub pure_error: f64,
    /// Root mean square of the group means about the model, `√(Σ_g n_g r̄_g² / N)`, in the unit of the data.
    pub misfit: f64,
}

/// Scatter over the largest residual that is no scatter but rounding: copies of a reading, or a converter coarser than the noise.
const ROUNDING: f64 = 1e-9;

impl LackOfFit {
    /// Tests residuals in groups with equal keys; `None` without repetitions, without more groups than
    /// parameters, or without any scatter but rounding.
    pub fn test<K: PartialEq>(residuals: &[f64], keys: &[K], parameters: usize) -> Option<Self> {
        let mut groups: Vec<(&K, Vec<f64>)> = Vec::new();
        for (residual, key) in residuals.iter().zip(keys) {
            // From the last one on: repetitions usually follow each other.
            match groups.iter_mut().rev().find(|(known, _)| *known == key) {
                Some((_, members)) => members.push(*residual),
                None => groups.push((key, vec![*residual])),
            }
        }
        let between = groups.len() as f64 - parameters as f64;
        let within = residuals.len() as f64 - groups.len() as f64;
        let (mut means, mut scatter) = (0.0, 0.0);
        for (_, members) in &groups {
            let mean = members.iter().sum::<f64>() / members.len() as f64;
            means += members.len() as f64 * mean * mean;
            scatter += members.iter().map(|r| (r - mean).powi(2)).sum::<f64>();
        }
        let largest = residuals.iter().fold(0.0_f64, |m, r| m.max(r.abs()));
        let rounding = residuals.len() as f64 * (ROUNDING * largest).powi(2);
        if between < 1.0 || within < 1.0 || scatter <= rounding {
            return None;
        }
        let f = (means / between) / (scatter / within);
        let p_value = FisherSnedecor::new(between, within).ok()?.sf(f);
        Some(Self {
            f,
            p_value,
            between,
            within,
            pure_error: (scatter / within).sqrt(),
            misfit: (means / residuals.len() as f64).sqrt(),
        })
    }

    /// Whether the data reject the model, at the level of one false alarm in a thousand.
    pub fn is_significant(&self) -> bool {
        self.p_value < CORRELATED_BELOW
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_by_hand() {
        // Group means 1, −1, 0 of two each: Σ n r̄² = 4; scatter 3 · 2 · 0.1² = 0.06.
        let residuals = [0.9, 1.1, -1.1, -0.9, 0.1, -0.1];
        let test = LackOfFit::test(&residuals, &[1, 1, 2, 2, 3, 3], 2).unwrap();
        assert_eq!((test.between, test.within), (1.0, 3.0));
        // Rounding.
        assert!((test.f - 4.0 / (0.06 / 3.0)).abs() < 1e-9);
        // Six residuals, scatter 0.06 over 3, group means 1, 1 and 0. Rounding.
        assert!((test.pure_error - 0.02_f64.sqrt()).abs() < 1e-15);
        assert!((test.misfit - (4.0_f64 / 6.0).sqrt()).abs() < 1e-15);
        // F with 1 and 3 degrees of freedom is t² with 3: t = √200 = 14.142, and the tail of t with 3 degrees of
        // freedom is closed: P(|T| > t) = 1 − (2/π)[θ + sin θ cos θ], θ = arctan(t/√3).
        let theta = (200_f64.sqrt() / 3_f64.sqrt()).atan();
        let tail = 1.0 - 2.0 / std::f64::consts::PI * (theta + theta.sin() * theta.cos());
        // The library's incomplete beta function is good to ten digits or so.
        assert!((test.p_value - tail).abs() < 1e-10, "{} {tail}", test.p_value);
    }

    #[test]
    fn exact_none_without_repetitions_or_freedom() {
        assert_eq!(LackOfFit::test(&[0.1, 0.2, 0.3], &[1, 2, 3], 1), None);
        assert_eq!(LackOfFit::test(&[0.1, 0.2, 0.3, 0.4], &[1, 1, 2, 2], 2), None);
        assert_eq!(LackOfFit::test(&[0.0; 6], &[1, 1, 2, 2, 3, 3], 2), None);
        // Copies of readings, but for rounding.
        let copies = [0.1, 0.1 + 1e-16, -0.2, -0.2, 0.1, 0.1 - 1e-16];
        assert_eq!(LackOfFit::test(&copies, &[1, 1, 2, 2, 3, 3], 2), None);
    }
}
