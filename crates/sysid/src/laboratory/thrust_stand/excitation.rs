//! Commands and sampling patterns of a test.

use super::StandError;
use crate::laboratory::Generator;
use rand::RngExt;
use serde::{Deserialize, Serialize};

/// A step of the duty.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Step {
    /// Duty before.
    pub before: f64,
    /// Duty from `at_s` on.
    pub after: f64,
    /// Time of the step, s.
    pub at_s: f64,
}

impl Step {
    /// The duty at a time, s.
    pub fn at(&self, time_s: f64) -> f64 {
        if time_s < self.at_s {
            self.before
        } else {
            self.after
        }
    }
}

/// A pseudo-random binary sequence about a working point: maximal length, `2¹⁰ − 1 = 1023` bits, from a shift register
/// with feedback `x¹⁰ + x⁷ + 1`.
///
/// Its power is flat to about `0.44/hold_s` Hz. Source: Golomb, *Shift Register Sequences*, 1967; Ljung, *System
/// Identification*, 2nd ed., section 13.3.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Prbs {
    /// Duty in the middle.
    pub centre: f64,
    /// How far it goes to either side.
    pub amplitude: f64,
    /// Time that each bit is held, s.
    pub hold_s: f64,
    /// Bits skipped at the beginning, so that two tests can differ.
    pub skipped_bits: usize,
}

/// Number of bits in the register.
const REGISTER_BITS: u32 = 10;

/// Period of the sequence.
pub(super) const PERIOD: usize = (1 << REGISTER_BITS) - 1;

impl Prbs {
    /// The duty over time, s, from time 0 on.
    pub fn signal(&self) -> impl Fn(f64) -> f64 + use<> {
        let Self {
            centre,
            amplitude,
            hold_s,
            skipped_bits,
        } = *self;
        let bits = maximal_sequence();
        move |time_s: f64| {
            // A grain of 1e-9 so that a sample taken at the change of a bit sees the new one whatever the rounding.
            let bit = (time_s / hold_s + 1e-9).floor().max(0.0) as usize;
            if bits[(bit + skipped_bits) % PERIOD] {
                centre + amplitude
            } else {
                centre - amplitude
            }
        }
    }
}

/// One period of the sequence.
pub(super) fn maximal_sequence() -> Vec<bool> {
    let mut register: u32 = (1 << REGISTER_BITS) - 1;
    (0..PERIOD)
        .map(|_| {
            let feedback = ((register >> 9) ^ (register >> 6)) & 1;
            register = ((register << 1) | feedback) & ((1 << REGISTER_BITS) - 1);
            feedback == 1
        })
        .collect()
}

/// Times from 0 to the duration at a constant period, s.
///
/// # Errors
/// A period or duration that is not positive.
pub fn uniform_times(period_s: f64, duration_s: f64) -> Result<Vec<f64>, StandError> {
    let count = samples(period_s, duration_s)?;
    Ok((0..count).map(|k| k as f64 * period_s).collect())
}

/// Times from 0 to about the duration at irregular intervals, even between half and one and a half times the mean period, s.
///
/// # Errors
/// A period or duration that is not positive.
pub fn irregular_times(
    mean_period_s: f64,
    duration_s: f64,
    generator: &mut Generator,
) -> Result<Vec<f64>, StandError> {
    let count = samples(mean_period_s, duration_s)?;
    let mut time = 0.0;
    Ok((0..count)
        .map(|_| {
            let now = time;
            time += mean_period_s * generator.random_range(0.5..1.5);
            now
        })
        .collect())
}

fn samples(period_s: f64, duration_s: f64) -> Result<usize, StandError> {
    for (what, value) in [
        ("the sampling period in s", period_s),
        ("the duration in s", duration_s),
    ] {
        if !(value.is_finite() && value > 0.0) {
            return Err(StandError::NotPositive { what, value });
        }
    }
    // As above: the last sample must not depend on rounding.
    Ok((duration_s / period_s + 1e-9).floor() as usize + 1)
}
