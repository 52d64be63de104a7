//! A record of input and output over time, checked before anything is fitted to it.

use crate::estimate::Warning;
use serde::{Deserialize, Serialize};

/// One sample of a thrust stand in motion; a row of a CSV with these columns.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DynamicSample {
    /// Time, s.
    pub time_s: f64,
    /// Raw PWM duty ū, held from this sample to the next.
    pub duty: f64,
    /// Battery voltage `V_b`, V.
    pub battery_voltage_v: f64,
    /// Thrust T, N, positive up.
    pub thrust_n: f64,
    /// Reaction torque Q, N m, positive against the spin: aerodynamic and spin-up together.
    pub torque_n_m: f64,
    /// Rotor speed Ω, rad/s.
    pub speed_rad_s: f64,
}

/// One sample of a response; a row of a CSV with these columns.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ResponseSample {
    /// Time, s.
    pub time_s: f64,
    /// Input, held from this sample to the next, in a unit of the caller's.
    pub input: f64,
    /// Output at this time, in a unit of the caller's.
    pub output: f64,
}

/// A checked record: finite numbers, rising time, an input and an output that change.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    pub(super) times: Vec<f64>,
    pub(super) inputs: Vec<f64>,
    pub(super) outputs: Vec<f64>,
    /// What is odd about the data: gaps, a saturated sensor.
    pub warnings: Vec<Warning>,
}

/// Why a record was refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum RecordError {
    /// Too few samples to speak of a response.
    #[error("a response needs at least {needed} samples, got {samples}")]
    TooFewSamples {
        /// How many there are.
        samples: usize,
        /// How many are needed.
        needed: usize,
    },
    /// A number is NaN or infinite.
    #[error("sample {index} (counted from 0) contains a non-finite number")]
    NotFinite {
        /// Place in the order of the data.
        index: usize,
    },
    /// Time stands still or goes backwards.
    #[error("time must increase, got {time_s} s after {previous_s} s at sample {index} (counted from 0)")]
    TimeNotRising {
        /// Place in the order of the data.
        index: usize,
        /// Its time, s.
        time_s: f64,
        /// The time before, s.
        previous_s: f64,
    },
    /// The input excites nothing.
    #[error("the input stays at {value}: step it or drive it with a pseudo-random sequence")]
    ConstantInput {
        /// The value.
        value: f64,
    },
    /// The output does not answer.
    #[error("the output stays at {value}: is the sensor connected, or at the end of its range?")]
    ConstantOutput {
        /// The value.
        value: f64,
    },
}

/// Samples of the shortest record: as many as the largest structure has unknowns, and one.
const FEWEST: usize = 8;

/// An interval this many times the median one is a gap.
const GAP: f64 = 5.0;

/// Equal readings in a row at the end of the range from which a sensor counts as saturated.
const STUCK: usize = 5;

/// Change into such a run, in smallest changes of the record, from which it counts as sudden.
const JUMP: f64 = 3.0;

impl Record {
    /// Checks the samples of a response.
    ///
    /// # Errors
    /// See [`RecordError`].
    pub fn new(samples: &[ResponseSample]) -> Result<Self, RecordError> {
        let finite = |s: &ResponseSample| [s.time_s, s.input, s.output].iter().all(|x| x.is_finite());
        if let Some(index) = samples.iter().position(|s| !finite(s)) {
            return Err(RecordError::NotFinite { index });
        }
        if samples.len() < FEWEST {
            return Err(RecordError::TooFewSamples {
                samples: samples.len(),
                needed: FEWEST,
            });
        }
        if let Some(k) = samples.windows(2).position(|p| p[1].time_s <= p[0].time_s) {
            return Err(RecordError::TimeNotRising {
                index: k + 1,
                time_s: samples[k + 1].time_s,
                previous_s: samples[k].time_s,
            });
        }
        let column = |f: fn(&ResponseSample) -> f64| samples.iter().map(f).collect::<Vec<_>>();
        let mut record = Self {
            times: column(|s| s.time_s),
            inputs: column(|s| s.input),
            outputs: column(|s| s.output),
            warnings: Vec::new(),
        };
        // The last input acts after the record's end.
        if let Some(value) = constant_value(&record.inputs[..samples.len() - 1]) {
            return Err(RecordError::ConstantInput { value });
        }
        if let Some(value) = constant_value(&record.outputs) {
            return Err(RecordError::ConstantOutput { value });
        }
        record.warnings = [gaps(&record.times), saturation(&record.inputs, &record.outputs)]
            .into_iter()
            .flatten()
            .collect();
        Ok(record)
    }

    /// Checks the samples of a stand, with an input and an output computed from each: the duty or the steady thrust of a
    /// static map, and thrust or torque.
    ///
    /// # Errors
    /// See [`RecordError`].
    pub fn of(
        samples: &[DynamicSample],
        input: impl Fn(&DynamicSample) -> f64,
        output: impl Fn(&DynamicSample) -> f64,
    ) -> Result<Self, RecordError> {
        let response = |s: &DynamicSample| ResponseSample {
            time_s: s.time_s,
            input: input(s),
            output: output(s),
        };
        Self::new(&samples.iter().map(response).collect::<Vec<_>>())
    }

    /// Times, s.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Inputs, each held to the next time.
    pub fn inputs(&self) -> &[f64] {
        &self.inputs
    }

    /// Measured outputs.
    pub fn outputs(&self) -> &[f64] {
        &self.outputs
    }

    /// Duration, s.
    pub(super) fn duration(&self) -> f64 {
        self.times[self.times.len() - 1] - self.times[0]
    }

    /// Median interval between samples, s.
    pub(super) fn median_interval(&self) -> f64 {
        median_interval(&self.times)
    }
}

fn constant_value(values: &[f64]) -> Option<f64> {
    values.iter().all(|v| *v == values[0]).then(|| values[0])
}

fn median_interval(times: &[f64]) -> f64 {
    let mut intervals: Vec<f64> = times.windows(2).map(|p| p[1] - p[0]).collect();
    intervals.sort_by(f64::total_cmp);
    intervals[intervals.len() / 2]
}

fn gaps(times: &[f64]) -> Option<Warning> {
    let from = GAP * median_interval(times);
    let long: Vec<f64> = times
        .windows(2)
        .map(|p| p[1] - p[0])
        .filter(|h| *h > from)
        .collect();
    let longest_s = long.iter().copied().fold(0.0, f64::max);
    (!long.is_empty()).then_some(Warning::Gaps {
        gaps: long.len(),
        longest_s,
    })
}

/// A run of equal readings at the largest or smallest value that began with a jump: a response that comes to rest there
/// creeps in, by a digit at a time. What was at rest before the input first changed is not looked at.
fn saturation(inputs: &[f64], outputs: &[f64]) -> Option<Warning> {
    let moving = inputs.iter().position(|u| *u != inputs[0]).unwrap_or(0);
    let outputs = &outputs[moving..];
    let ends = [
        outputs.iter().copied().fold(f64::INFINITY, f64::min),
        outputs.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    ];
    let changes = outputs.windows(2).map(|p| (p[1] - p[0]).abs());
    let digit = changes.filter(|d| *d > 0.0).fold(f64::INFINITY, f64::min);
    let runs: Vec<&[f64]> = outputs.chunk_by(|a, b| a == b).collect();
    let stuck = |pair: &&[&[f64]]| {
        let (last, run) = (pair[0][pair[0].len() - 1], pair[1]);
        run.len() >= STUCK && ends.contains(&run[0]) && (run[0] - last).abs() > JUMP * digit
    };
    let limit = runs.windows(2).find(stuck)?[1][0];
    Some(Warning::Saturated {
        samples: outputs.iter().filter(|y| **y == limit).count(),
        limit,
    })
}
