//! One scalar sensor: `y = clamp(round((x + b + σ ε) / q) q)`, ε standard normal.

use super::Generator;
use rand_distr::{Distribution, StandardNormal};
use serde::{Deserialize, Serialize};

/// A scalar sensor with its imperfections, in the unit of what it measures.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sensor {
    /// Standard deviation σ of the noise, white from sample to sample.
    pub noise: f64,
    /// Bias b, constant over a test.
    pub bias: f64,
    /// Step q of the digital reading; 0 for none.
    pub quantum: f64,
    /// Lower end of the range.
    pub minimum: f64,
    /// Upper end of the range.
    pub maximum: f64,
}

/// Why a sensor is refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SensorError {
    /// Noise or quantum negative, or a number that is not finite.
    #[error("a sensor's {what} must be finite and not negative, got {value}")]
    Imperfection {
        /// `noise` or `quantum`.
        what: &'static str,
        /// The value.
        value: f64,
    },
    /// Bias not finite.
    #[error("a sensor's bias must be finite, got {bias}")]
    Bias {
        /// The value.
        bias: f64,
    },
    /// A range without width.
    #[error("a sensor's range must not be empty, got {minimum} to {maximum}")]
    EmptyRange {
        /// Lower end.
        minimum: f64,
        /// Upper end.
        maximum: f64,
    },
}

impl Sensor {
    /// A sensor that tells the truth.
    pub const PERFECT: Self = Self {
        noise: 0.0,
        bias: 0.0,
        quantum: 0.0,
        minimum: f64::NEG_INFINITY,
        maximum: f64::INFINITY,
    };

    /// A sensor with white noise alone.
    pub const fn noisy(noise: f64) -> Self {
        Self {
            noise,
            ..Self::PERFECT
        }
    }

    /// Checks the numbers.
    ///
    /// # Errors
    /// Negative or infinite imperfections, an empty range.
    pub fn validate(&self) -> Result<(), SensorError> {
        for (what, value) in [("noise", self.noise), ("quantum", self.quantum)] {
            if !(value.is_finite() && value >= 0.0) {
                return Err(SensorError::Imperfection { what, value });
            }
        }
        if !self.bias.is_finite() {
            return Err(SensorError::Bias { bias: self.bias });
        }
        if self.minimum.is_nan() || self.maximum.is_nan() || self.minimum >= self.maximum {
            return Err(SensorError::EmptyRange {
                minimum: self.minimum,
                maximum: self.maximum,
            });
        }
        Ok(())
    }

    /// One reading of the truth.
    pub fn read(&self, truth: f64, generator: &mut Generator) -> f64 {
        let noise: f64 = StandardNormal.sample(generator);
        let analogue = truth + self.bias + self.noise * noise;
        let digital = if self.quantum > 0.0 {
            (analogue / self.quantum).round() * self.quantum
        } else {
            analogue
        };
        digital.clamp(self.minimum, self.maximum)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laboratory::generator;

    #[test]
    fn exact_mean_and_deviation_of_many_readings() {
        let sensor = Sensor {
            noise: 0.5,
            bias: 0.2,
            ..Sensor::PERFECT
        };
        let mut random = generator(1);
        let n = 40_000;
        let readings: Vec<f64> = (0..n).map(|_| sensor.read(3.0, &mut random)).collect();
        let mean = readings.iter().sum::<f64>() / f64::from(n);
        let variance = readings.iter().map(|y| (y - mean).powi(2)).sum::<f64>() / f64::from(n - 1);
        // Four standard errors: 0.5/√n of the mean, 0.5/√(2n) of the deviation.
        assert!((mean - 3.2).abs() < 4.0 * 0.5 / f64::from(n).sqrt());
        assert!((variance.sqrt() - 0.5).abs() < 4.0 * 0.5 / f64::from(2 * n).sqrt());
    }

    #[test]
    fn exact_quantised_and_limited() {
        let sensor = Sensor {
            quantum: 0.25,
            minimum: -1.0,
            maximum: 1.0,
            ..Sensor::PERFECT
        };
        let mut random = generator(0);
        let read = [0.3, 0.4, -5.0, 5.0].map(|x| sensor.read(x, &mut random));
        assert_eq!(read, [0.25, 0.5, -1.0, 1.0]);
    }

    #[test]
    fn exact_refusals() {
        assert!(Sensor::noisy(-1.0).validate().is_err());
        assert!(Sensor::noisy(f64::NAN).validate().is_err());
        let empty = Sensor {
            minimum: 1.0,
            maximum: 1.0,
            ..Sensor::PERFECT
        };
        assert_eq!(
            empty.validate(),
            Err(SensorError::EmptyRange {
                minimum: 1.0,
                maximum: 1.0
            })
        );
        assert_eq!(Sensor::PERFECT.validate(), Ok(()));
    }
}
