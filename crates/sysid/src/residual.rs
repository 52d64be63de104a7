//! Residuals of a time series: are they white?
//!
//! `r_k = Σ e_t e_{t−k} / Σ e_t²`, Ljung-Box `Q = n (n+2) Σ r_k²/(n−k)`, χ² with as many degrees of freedom as lags,
//! less the fitted parameters of a noise model (none here: output-error fits have none). White residuals mean that the
//! model left nothing behind that its standard errors would need to know.
//!
//! Source: Ljung and Box, *On a measure of lack of fit in time series models*, Biometrika 65, 1978.

use crate::estimate::{Fit, Warning};
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// p-value below which residuals are called correlated: a false alarm once in a thousand fits.
pub const CORRELATED_BELOW: f64 = 1e-3;

/// Result of a test for whiteness.
#[derive(Clone, Debug, PartialEq)]
pub struct Whiteness {
    /// Autocorrelation at lags 1, 2, ..., dimensionless.
    pub autocorrelation: Vec<f64>,
    /// Ljung-Box statistic Q.
    pub statistic: f64,
    /// Probability of a Q at least as large if the residuals are white.
    pub p_value: f64,
}

impl Whiteness {
    /// Tests residuals in order of time over lags 1 to `lags`, cut to a quarter of the series.
    ///
    /// A series that is zero throughout, or too short to have a lag, counts as white.
    pub fn test(residuals: &[f64], lags: usize) -> Self {
        let n = residuals.len();
        let lags = lags.min(n / 4);
        let power: f64 = residuals.iter().map(|e| e * e).sum();
        if lags == 0 || power == 0.0 {
            return Self {
                autocorrelation: vec![0.0; lags],
                statistic: 0.0,
                p_value: 1.0,
            };
        }
        let correlation = |k: usize| {
            let shifted = residuals[k..].iter().zip(residuals);
            shifted.map(|(a, b)| a * b).sum::<f64>() / power
        };
        let autocorrelation: Vec<f64> = (1..=lags).map(correlation).collect();
        let count = n as f64;
        let statistic = count
            * (count + 2.0)
            * (1..=lags)
                .zip(&autocorrelation)
                .map(|(k, r)| r * r / (count - k as f64))
                .sum::<f64>();
        let p_value = ChiSquared::new(lags as f64).map_or(f64::NAN, |chi| chi.sf(statistic));
        Self {
            autocorrelation,
            statistic,
            p_value,
        }
    }

    /// Whether the residuals pass as white.
    pub fn is_white(&self) -> bool {
        self.p_value >= CORRELATED_BELOW
    }

    /// The bound `1.96/√n` within which an autocorrelation of white residuals of this length stays 95 times in 100.
    pub fn bound(samples: usize) -> f64 {
        1.96 / (samples as f64).sqrt()
    }
}

impl<const N: usize> Fit<N> {
    /// The fit with a warning added if its residuals, in order of time, are correlated.
    #[must_use]
    pub fn with_whiteness_checked(mut self, lags: usize) -> Self {
        let whiteness = Whiteness::test(&self.residuals, lags);
        if !whiteness.is_white() {
            self.warnings.push(Warning::CorrelatedResiduals {
                p_value: whiteness.p_value,
                lags: whiteness.autocorrelation.len(),
            });
        }
        self
    }
}
