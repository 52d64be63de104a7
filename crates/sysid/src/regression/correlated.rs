//! Standard errors under correlated residuals: Newey and West's estimator.
//!
//! ```text
//! cov p̂ = B M B,   B = (XᵀX)⁻¹,   M = Σ_k w_k Σ_t (g_t g_{t−k}ᵀ + g_{t−k} g_tᵀ),   g_t = x_t r_t,   w_k = 1 − k/(L+1)
//! ```
//!
//! The estimates stay; only what is said of their uncertainty changes. L follows from the correlation of the residuals and
//! of the g by Andrews' rule for a first-order process, `L = 1.1447 (α n)^{1/3}`, `α = 4ρ² / (1−ρ²)²`. A sum over L lags of
//! n data is itself uncertain, as if from about `1.5 n / L` independent ones, which is the intervals' number of degrees
//! of freedom. Assumptions: residuals in order of time, equally spaced, stationary, forgotten within a small part of the
//! series. Tested by coverage on simulated data.
//!
//! Source: Newey and West, Econometrica 55 (1987) 703; Andrews, Econometrica 59 (1991) 817.

use crate::estimate::{Fit, Warning};
use nalgebra::{SMatrix, SVector};

/// Bartlett's kernel: constant of Andrews' rule, and equivalent degrees of freedom per `n / L`.
const BARTLETT_RULE: f64 = 1.1447;
const BARTLETT_FREEDOM: f64 = 1.5;

/// Largest correlation from sample to sample taken for the rule: beyond, the rule asks for the whole series.
const LARGEST_CORRELATION: f64 = 0.99;

impl<const N: usize> Fit<N> {
    /// The fit with standard errors that hold under residuals correlated in time.
    ///
    /// `slopes` are the rows of X: a linear fit's regressors, a non-linear fit's [`super::slopes`]. Intervals never become
    /// narrower by this.
    ///
    /// # Panics
    /// If there is not one row for each residual: a programming error.
    #[must_use]
    pub fn with_correlated_errors(mut self, slopes: &[[f64; N]]) -> Self {
        assert_eq!(slopes.len(), self.residuals.len(), "one row for each residual");
        let n = self.residuals.len();
        let scores: Vec<SVector<f64, N>> = slopes
            .iter()
            .zip(&self.residuals)
            .map(|(x, r)| SVector::from(*x) * *r)
            .collect();
        let lags = lags(&self.residuals, &scores);
        let mut middle = autocovariance(&scores, 0);
        for k in 1..=lags {
            let shifted = autocovariance(&scores, k);
            middle += (shifted + shifted.transpose()) * (1.0 - k as f64 / (lags as f64 + 1.0));
        }
        let variance = self.goodness.standard_deviation.powi(2);
        if variance <= 0.0 {
            return self;
        }
        let bread = self.covariance / variance;
        let covariance = bread * middle * bread;
        let freedom = self.goodness.degrees_of_freedom;
        let freedom = freedom
            .min(BARTLETT_FREEDOM * n as f64 / lags.max(1) as f64)
            .max(1.0);
        let mut factor = 1.0_f64;
        for (i, estimate) in self.parameters.iter_mut().enumerate() {
            let widened = covariance[(i, i)].max(0.0).sqrt();
            factor = factor.max(widened / estimate.standard_error);
            estimate.standard_error = estimate.standard_error.max(widened);
            estimate.degrees_of_freedom = freedom;
        }
        self.covariance = covariance;
        self.goodness.degrees_of_freedom = freedom;
        if lags > 1 {
            self.warnings.push(Warning::IntervalsWidened { lags, factor });
        }
        self
    }
}

/// `Σ_t g_t g_{t−k}ᵀ`.
fn autocovariance<const N: usize>(scores: &[SVector<f64, N>], k: usize) -> SMatrix<f64, N, N> {
    let pairs = scores[k..].iter().zip(scores);
    pairs.fold(SMatrix::zeros(), |sum, (now, before)| {
        sum + now * before.transpose()
    })
}

/// L of Andrews' rule for whatever is most correlated; at most a quarter of the series.
fn lags<const N: usize>(residuals: &[f64], scores: &[SVector<f64, N>]) -> usize {
    let correlation = |series: &dyn Fn(usize) -> f64| {
        let power: f64 = (0..residuals.len()).map(|t| series(t).powi(2)).sum();
        let shifted: f64 = (1..residuals.len()).map(|t| series(t) * series(t - 1)).sum();
        if power > 0.0 { shifted / power } else { 0.0 }
    };
    let of_scores = (0..N).map(|i| correlation(&|t| scores[t][i]));
    let rho = of_scores
        .fold(correlation(&|t| residuals[t]), f64::max)
        .clamp(0.0, LARGEST_CORRELATION);
    let alpha = 4.0 * rho.powi(2) / (1.0 - rho.powi(2)).powi(2);
    let rule = BARTLETT_RULE * (alpha * residuals.len() as f64).cbrt();
    // Bounded by the series before it is made an integer.
    rule.min(residuals.len() as f64 / 4.0).ceil() as usize
}

#[cfg(test)]
mod tests {
    use crate::laboratory::generator;
    use crate::regression::{Row, linear};
    use approx::assert_relative_eq;
    use rand_distr::{Distribution, StandardNormal};

    /// `y = 1 + 2 x + noise` with x and noise first-order processes of this correlation.
    fn rows(seed: u64, correlation: f64, count: usize) -> Vec<Row<2>> {
        let mut random = generator(seed);
        let mut next = || -> f64 { StandardNormal.sample(&mut random) };
        let fresh = (1.0 - correlation * correlation).sqrt();
        let (mut x, mut noise) = (next(), next());
        (0..count)
            .map(|_| {
                x = correlation * x + fresh * next();
                noise = correlation * noise + fresh * next();
                Row {
                    regressors: [1.0, x],
                    y: 1.0 + 2.0 * x + noise,
                }
            })
            .collect()
    }

    fn coverage(correlation: f64, widened: bool) -> f64 {
        let seeds = 400;
        let hits = (0..seeds).filter(|&seed| {
            let rows = rows(seed, correlation, 1500);
            let slopes: Vec<[f64; 2]> = rows.iter().map(|r| r.regressors).collect();
            let fit = linear(&rows).unwrap();
            let fit = if widened {
                fit.with_correlated_errors(&slopes)
            } else {
                fit
            };
            fit.parameters[1].interval().contains(2.0)
        });
        hits.count() as f64 / seeds as f64
    }

    #[test]
    fn prop_intervals_cover_the_truth_under_correlation() {
        // 400 flights: the fraction of a true 95 % interval has a standard deviation of 1.1 %. Bartlett's kernel
        // leaves out a few per cent of the variance at this correlation, so 90 % is asked for.
        let plain = coverage(0.9, false);
        let widened = coverage(0.9, true);
        assert!(plain < 0.6, "{plain}: the test would show nothing");
        assert!((0.90..=0.995).contains(&widened), "{widened}");
        let white = coverage(0.0, true);
        assert!((0.92..=0.98).contains(&white), "{white}");
    }

    #[test]
    fn exact_zero_lags_is_the_heteroscedastic_estimator_by_hand() {
        // One regressor of ones: the mean. B = 1/n; residuals alternate, so no lag is taken: M = Σ r².
        let rows: Vec<Row<1>> = (0..40)
            .map(|k| Row {
                regressors: [1.0],
                y: if k % 2 == 0 { 1.0 } else { -1.0 },
            })
            .collect();
        let fit = linear(&rows).unwrap();
        let plain = fit.parameters[0].standard_error;
        let fit = fit.with_correlated_errors(&vec![[1.0]; 40]);
        assert_relative_eq!(fit.covariance[(0, 0)], 40.0 / 1600.0, epsilon = 1e-15);
        // Narrower than s²/n, so the wider one is kept.
        assert_relative_eq!(fit.parameters[0].standard_error, plain, epsilon = 1e-15);
    }
}
