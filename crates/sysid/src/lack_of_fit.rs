//! Lack of fit: is a model's error larger than the scatter of repeated measurements?
//!
//! ```text
//! F = [Σ_g n_g r̄_g² / (G − p)] / [Σ_g Σ_i (r_gi − r̄_g)² / (N − G)]
//! ```
//!
//! with G groups of repetitions, their mean residuals `r̄_g`, N data and p parameters; F's distribution if the model is
//! right. Assumptions: independent normal errors of equal variance, and as many parameters as the fit had.
//! Source: Draper and Smith, *Applied Regression Analysis*, section on pure error.

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
}

impl LackOfFit {
    /// Tests residuals whose groups are told by equal keys; `None` without repetitions, without more groups than
    /// parameters, or without any scatter.
    pub fn test<K: PartialEq>(residuals: &[f64], keys: &[K], parameters: usize) -> Option<Self> {
        let mut groups: Vec<(&K, Vec<f64>)> = Vec::new();
        for (residual, key) in residuals.iter().zip(keys) {
            match groups.iter_mut().find(|(known, _)| *known == key) {
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
        if between < 1.0 || within < 1.0 || scatter <= 0.0 {
            return None;
        }
        let f = (means / between) / (scatter / within);
        let p_value = FisherSnedecor::new(between, within).ok()?.sf(f);
        Some(Self {
            f,
            p_value,
            between,
            within,
        })
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
    }
}
