//! How well a prediction ŷ agrees with a measurement y.
//!
//! ```text
//! fit      = 100 (1 − |y − ŷ| / |y − ȳ|) %         normalised root mean square error; 0 % is what the mean would do
//! Theil U  = rms(ŷ − y) / (rms y + rms ŷ)           0 perfect, 1 worst
//! U_m      = (mean ŷ − mean y)² / MSE               share of the error from bias,
//! U_s      = (s_ŷ − s_y)² / MSE                     from unequal variance,
//! U_c      = 2 (1 − ρ) s_ŷ s_y / MSE                from imperfect covariance; U_m + U_s + U_c = 1
//! ```
//!
//! Sources: Ljung, *System Identification*, 1999; Theil, *Economic Forecasts and Policy*, 1961; Jategaonkar, *Flight Vehicle
//! System Identification*, 2006 (chapter 11: U below 0.25 to 0.3 counts as good agreement in flight dynamics).

use crate::residual::Whiteness;
use serde::{Deserialize, Serialize};

/// Lags over which residuals are tested for whiteness.
const WHITENESS_LAGS: usize = 20;

/// Agreement of a prediction with a measurement.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Agreement {
    /// Number of samples.
    pub samples: usize,
    /// Fit, %; at most 100, 0 for the mean, below it for worse than the mean. `None` if the measurement is constant.
    pub fit_percent: Option<f64>,
    /// Theil's inequality coefficient U, 0 to 1; 0 where both are zero throughout.
    pub theil: f64,
    /// Shares of the error in Theil's decomposition; `None` where there is no error.
    pub shares: Option<TheilShares>,
    /// Correlation coefficient; `None` if either is constant.
    pub correlation: Option<f64>,
    /// The residuals `y − ŷ`.
    pub residuals: ResidualStatistics,
}

/// Shares of the mean square error; their sum is 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TheilShares {
    /// Bias.
    pub bias: f64,
    /// Unequal variance.
    pub variance: f64,
    /// Imperfect covariance.
    pub covariance: f64,
}

/// Statistics of residuals, in the unit of the data.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ResidualStatistics {
    /// Mean.
    pub mean: f64,
    /// Standard deviation about the mean.
    pub standard_deviation: f64,
    /// Largest absolute value.
    pub largest: f64,
    /// Autocorrelation from sample to sample.
    pub autocorrelation: f64,
    /// Probability of residuals so correlated if they were white (Ljung-Box).
    pub whiteness_p_value: f64,
}

/// Why a prediction can't be compared.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum AgreementError {
    /// Series of unequal length.
    #[error("measured and predicted samples must be equal in number, got {measured} and {predicted}")]
    Lengths {
        /// Measured samples.
        measured: usize,
        /// Predicted samples.
        predicted: usize,
    },
    /// Too short.
    #[error("a comparison needs at least 2 samples, got {samples}")]
    TooShort {
        /// Samples.
        samples: usize,
    },
    /// NaN or infinity: a prediction that ran away.
    #[error("sample {index} (counted from 0) must be finite")]
    NotFinite {
        /// Place of the first.
        index: usize,
    },
}

impl Agreement {
    /// Compares a prediction with a measurement, sample by sample in order of time.
    ///
    /// # Errors
    /// Series of unequal length, shorter than two, or not finite.
    pub fn of(measured: &[f64], predicted: &[f64]) -> Result<Self, AgreementError> {
        let n = measured.len();
        if n != predicted.len() {
            return Err(AgreementError::Lengths {
                measured: n,
                predicted: predicted.len(),
            });
        }
        if n < 2 {
            return Err(AgreementError::TooShort { samples: n });
        }
        let pairs = || measured.iter().zip(predicted);
        if let Some(index) = pairs().position(|(y, p)| !(y.is_finite() && p.is_finite())) {
            return Err(AgreementError::NotFinite { index });
        }
        let residuals: Vec<f64> = pairs().map(|(y, p)| y - p).collect();
        let (y, p) = (Moments::of(measured), Moments::of(predicted));
        let covariance = mean(n, pairs().map(|(a, b)| (a - y.mean) * (b - p.mean)));
        let error = mean(n, residuals.iter().map(|r| r * r));
        let scale = y.rms + p.rms;
        Ok(Self {
            samples: n,
            fit_percent: (y.deviation > 0.0).then(|| 100.0 * (1.0 - error.sqrt() / y.deviation)),
            theil: if scale > 0.0 { error.sqrt() / scale } else { 0.0 },
            shares: (error > 0.0).then(|| TheilShares {
                bias: (p.mean - y.mean).powi(2) / error,
                variance: (p.deviation - y.deviation).powi(2) / error,
                covariance: 2.0 * (p.deviation * y.deviation - covariance) / error,
            }),
            correlation: (y.deviation > 0.0 && p.deviation > 0.0)
                .then(|| covariance / (y.deviation * p.deviation)),
            residuals: ResidualStatistics::of(&residuals),
        })
    }
}

impl ResidualStatistics {
    fn of(residuals: &[f64]) -> Self {
        let moments = Moments::of(residuals);
        let centred: Vec<f64> = residuals.iter().map(|r| r - moments.mean).collect();
        let whiteness = Whiteness::test(&centred, WHITENESS_LAGS);
        Self {
            mean: moments.mean,
            standard_deviation: moments.deviation,
            largest: residuals.iter().fold(0.0_f64, |m, r| m.max(r.abs())),
            autocorrelation: whiteness.autocorrelation.first().copied().unwrap_or(0.0),
            whiteness_p_value: whiteness.p_value,
        }
    }
}

fn mean(count: usize, values: impl Iterator<Item = f64>) -> f64 {
    values.sum::<f64>() / count as f64
}

/// Mean, standard deviation (by n) and root mean square.
struct Moments {
    mean: f64,
    deviation: f64,
    rms: f64,
}

impl Moments {
    fn of(values: &[f64]) -> Self {
        let average = mean(values.len(), values.iter().copied());
        Self {
            mean: average,
            deviation: mean(values.len(), values.iter().map(|v| (v - average).powi(2))).sqrt(),
            rms: mean(values.len(), values.iter().map(|v| v * v)).sqrt(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    #[test]
    fn exact_numbers_by_hand() {
        // y = 1, 2, 3, 4; ŷ = y + 1: a pure bias. MSE 1, s_y² = 1.25, rms y = √7.5, rms ŷ = √13.5.
        let agreement = Agreement::of(&[1.0, 2.0, 3.0, 4.0], &[2.0, 3.0, 4.0, 5.0]).unwrap();
        assert_relative_eq!(
            agreement.fit_percent.unwrap(),
            100.0 * (1.0 - 1.0 / 1.25_f64.sqrt()),
            epsilon = 1e-12
        );
        assert_relative_eq!(
            agreement.theil,
            1.0 / (7.5_f64.sqrt() + 13.5_f64.sqrt()),
            epsilon = 1e-15
        );
        let shares = agreement.shares.unwrap();
        assert_relative_eq!(shares.bias, 1.0, epsilon = 1e-14);
        assert_relative_eq!(shares.variance, 0.0, epsilon = 1e-14);
        assert_relative_eq!(shares.covariance, 0.0, epsilon = 1e-14);
        assert_relative_eq!(agreement.correlation.unwrap(), 1.0, epsilon = 1e-14);
        assert_eq!(agreement.residuals.mean, -1.0);
        // Twice the amplitude about the same mean: all of the error is variance.
        let doubled = Agreement::of(&[-1.0, 1.0], &[-2.0, 2.0]).unwrap();
        assert_relative_eq!(doubled.shares.unwrap().variance, 1.0, epsilon = 1e-14);
        assert_relative_eq!(doubled.fit_percent.unwrap(), 0.0, epsilon = 1e-12);
        // The negative of the truth is as unequal as can be: U = 1.
        assert_relative_eq!(Agreement::of(&[-1.0, 1.0], &[1.0, -1.0]).unwrap().theil, 1.0);
    }

    #[test]
    fn exact_the_mean_has_no_fit_and_the_truth_all_of_it() {
        let y = [3.0, -1.0, 4.0, 1.0, 5.0];
        let mean = Agreement::of(&y, &[2.4; 5]).unwrap();
        assert_relative_eq!(mean.fit_percent.unwrap(), 0.0, epsilon = 1e-12);
        assert!(mean.correlation.is_none());
        let truth = Agreement::of(&y, &y).unwrap();
        assert_eq!(
            (truth.fit_percent, truth.theil, truth.shares),
            (Some(100.0), 0.0, None)
        );
        assert_eq!(Agreement::of(&[2.0; 3], &[1.0; 3]).unwrap().fit_percent, None);
    }

    #[test]
    fn exact_refusals() {
        assert_eq!(
            Agreement::of(&[1.0], &[]),
            Err(AgreementError::Lengths {
                measured: 1,
                predicted: 0
            })
        );
        assert_eq!(
            Agreement::of(&[1.0], &[1.0]),
            Err(AgreementError::TooShort { samples: 1 })
        );
        assert_eq!(
            Agreement::of(&[1.0, 2.0], &[1.0, f64::NAN]),
            Err(AgreementError::NotFinite { index: 1 })
        );
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn prop_shares_sum_to_one_and_theil_lies_between_zero_and_one(
            pairs in proptest::collection::vec((-9.0..9.0_f64, -9.0..9.0_f64), 2..60)
        ) {
            let (y, p): (Vec<f64>, Vec<f64>) = pairs.into_iter().unzip();
            let agreement = Agreement::of(&y, &p).unwrap();
            prop_assert!((0.0..=1.0 + 1e-12).contains(&agreement.theil));
            if let Some(s) = agreement.shares {
                // Differences of squares of numbers below 9 over a mean square error that may be small.
                prop_assert!((s.bias + s.variance + s.covariance - 1.0).abs() < 1e-9);
            }
            prop_assert!(agreement.fit_percent.is_none_or(|f| f <= 100.0));
        }
    }
}
