//! What makes a sensor poor: `y = round((x + b + σ ε) / q) q`, at its own rate, late, or not at all.
//!
//! The bias b is drawn once when it is turned on and drifts as a random walk, `b ← b + d √T ε` from reading to
//! reading, T being the time between them; each axis has its own.

use super::Instrument;
use serde::{Deserialize, Serialize};

/// A sensor with its imperfections, in the unit of what it measures.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sensor {
    /// What it measures.
    pub instrument: Instrument,
    /// Standard deviation σ of each reading's noise, white from reading to reading.
    pub noise: f64,
    /// Standard deviation of the bias it is turned on with.
    #[serde(default)]
    pub turn_on_bias: f64,
    /// Density d of the bias' random walk, unit/√s.
    #[serde(default)]
    pub bias_drift: f64,
    /// Step q of the digital reading; 0 for none.
    #[serde(default)]
    pub quantum: f64,
    /// Least and largest true value that it gives a reading of; none for no limits.
    #[serde(default)]
    pub range: Option<[f64; 2]>,
    /// Readings per second.
    pub rate_hz: f64,
    /// Time from the taking of a reading to its arrival, s.
    #[serde(default)]
    pub delay_s: f64,
    /// Probability that a reading never arrives, 0 ≤ p < 1.
    #[serde(default)]
    pub dropout: f64,
}

/// Why a sensor is refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SensorError {
    /// A rate that is zero, negative or not finite.
    #[error("the {instrument}'s rate must be positive and at most 1e9 Hz, got {rate_hz} Hz")]
    Rate {
        /// Which sensor.
        instrument: Instrument,
        /// The rate, Hz.
        rate_hz: f64,
    },
    /// A noise, bias, drift, quantum or delay that is negative or not finite.
    #[error("the {instrument}'s {what} must be finite and not negative, got {value}")]
    Imperfection {
        /// Which sensor.
        instrument: Instrument,
        /// Which number.
        what: &'static str,
        /// The value.
        value: f64,
    },
    /// A probability of losing a reading outside 0 to 1, or 1.
    #[error("the {instrument}'s probability of a lost reading must be at least 0 and below 1, got {dropout}")]
    Dropout {
        /// Which sensor.
        instrument: Instrument,
        /// The probability.
        dropout: f64,
    },
    /// A range without width.
    #[error("the {instrument}'s range must not be empty, got {minimum} to {maximum}")]
    EmptyRange {
        /// Which sensor.
        instrument: Instrument,
        /// Lower end.
        minimum: f64,
        /// Upper end.
        maximum: f64,
    },
    /// A magnetic field that tells no direction.
    #[error("the magnetometer needs a finite field that is not zero, got {field_ut:?} µT")]
    Field {
        /// The field, µT.
        field_ut: [f64; 3],
    },
    /// Noise and quantum are both zero: a filter can't weigh such a reading.
    #[error("the {instrument} needs noise or a quantum, so that a filter knows how far to trust it")]
    Perfect {
        /// Which sensor.
        instrument: Instrument,
    },
}

/// Nanoseconds in a second.
const NS: f64 = 1e9;

impl Sensor {
    /// A sensor with white noise alone.
    pub const fn noisy(instrument: Instrument, noise: f64, rate_hz: f64) -> Self {
        Self {
            instrument,
            noise,
            turn_on_bias: 0.0,
            bias_drift: 0.0,
            quantum: 0.0,
            range: None,
            rate_hz,
            delay_s: 0.0,
            dropout: 0.0,
        }
    }

    /// Checks the numbers.
    ///
    /// # Errors
    /// One kind for each number that makes no sense.
    pub fn validate(&self) -> Result<(), SensorError> {
        let Self {
            instrument,
            rate_hz,
            dropout,
            ..
        } = *self;
        if !(rate_hz > 0.0 && rate_hz <= NS) {
            return Err(SensorError::Rate { instrument, rate_hz });
        }
        for (what, value) in [
            ("noise", self.noise),
            ("turn-on bias", self.turn_on_bias),
            ("bias drift", self.bias_drift),
            ("quantum", self.quantum),
            ("delay", self.delay_s),
        ] {
            if !(value.is_finite() && value >= 0.0) {
                return Err(SensorError::Imperfection {
                    instrument,
                    what,
                    value,
                });
            }
        }
        if !(0.0..1.0).contains(&dropout) {
            return Err(SensorError::Dropout { instrument, dropout });
        }
        if let Some([minimum, maximum]) = self.range
            && (minimum.is_nan() || maximum.is_nan() || minimum >= maximum)
        {
            return Err(SensorError::EmptyRange {
                instrument,
                minimum,
                maximum,
            });
        }
        if let Instrument::Magnetometer { field_ut } = instrument
            && !(field_ut.iter().all(|m| m.is_finite()) && field_ut.iter().any(|&m| m != 0.0))
        {
            return Err(SensorError::Field { field_ut });
        }
        if self.deviation() == 0.0 {
            return Err(SensorError::Perfect { instrument });
        }
        Ok(())
    }

    /// Standard deviation of a reading's error without bias: noise and rounding, `√(σ² + q²/12)`.
    pub fn deviation(&self) -> f64 {
        (self.noise.powi(2) + self.quantum.powi(2) / 12.0).sqrt()
    }

    /// Time between readings, ns.
    pub fn period_ns(&self) -> u64 {
        // Validated: between 1 and 2⁶⁴, where the cast saturates.
        (NS / self.rate_hz).round() as u64
    }

    /// Delay, ns.
    pub fn delay_ns(&self) -> u64 {
        (self.delay_s * NS).round() as u64
    }
}
