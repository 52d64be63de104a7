//! What an estimator needs to resume later, bit for bit.
//!
//! The belief at the oldest instant, and the inputs and measurements since: going over them once more gives every later
//! belief as it was, so that none of them need be kept.

use super::{Epoch, Estimator, SECONDS};
use crate::filter::checked;
use crate::sensor::Instrument;
use crate::{Belief, EstimationError, Filter, LevelProcess, Observation};
use nalgebra::{DMatrix, DVector, Vector3};
use quad_dynamics::Input;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// What an estimator remembers, as numbers that a text file can hold; all of them are finite.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EstimatorMemory {
    /// Mean of the belief at the oldest instant, before its measurements.
    pub mean: Vec<f64>,
    /// Covariance of that belief, column by column.
    pub covariance: Vec<f64>,
    /// The instants that it can go back to, oldest first; the last is the present.
    pub instants: Vec<RememberedInstant>,
}

/// An instant that an estimator can go back to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RememberedInstant {
    /// When, ns.
    pub time_ns: u64,
    /// Commands u that acted up to it.
    pub commands: [f64; 4],
    /// Wind that acted up to it, m/s in W.
    pub wind_m_s: [f64; 3],
    /// Rotation of the air that acted up to it, rad/s in W.
    #[serde(default)]
    pub air_rates_rad_s: [f64; 3],
    /// What was read at it, in the order of arrival.
    pub readings: Vec<RememberedReading>,
}

/// A reading that was taken in.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RememberedReading {
    /// What was read.
    pub instrument: Instrument,
    /// The readings.
    pub values: Vec<f64>,
    /// Standard deviation of each reading's white error.
    pub deviation: f64,
}

impl RememberedInstant {
    fn of(epoch: &Epoch) -> Self {
        let reading = |observation: &Observation<Instrument>| RememberedReading {
            instrument: observation.instrument,
            values: observation.values.as_slice().to_vec(),
            deviation: observation.deviation,
        };
        Self {
            time_ns: epoch.time_ns,
            commands: epoch.input_before.commands,
            wind_m_s: epoch.input_before.wind.into(),
            air_rates_rad_s: epoch.input_before.air_rates.into(),
            readings: epoch.measurements.iter().map(reading).collect(),
        }
    }

    fn epoch(&self, prior: Belief) -> Epoch {
        let observation = |reading: &RememberedReading| Observation {
            instrument: reading.instrument,
            values: DVector::from_column_slice(&reading.values),
            deviation: reading.deviation,
        };
        Epoch {
            time_ns: self.time_ns,
            prior,
            input_before: Input {
                commands: self.commands,
                wind: Vector3::from(self.wind_m_s),
                air_rates: Vector3::from(self.air_rates_rad_s),
            },
            measurements: self.readings.iter().map(observation).collect(),
        }
    }
}

fn same_length(what: &'static str, expected: usize, found: usize) -> Result<(), EstimationError> {
    if expected == found {
        return Ok(());
    }
    Err(EstimationError::Length {
        what,
        expected,
        found,
    })
}

impl<F: Filter<Process = LevelProcess>> Estimator<F> {
    /// Everything it needs to resume later as if nothing had happened.
    pub fn memory(&self) -> EstimatorMemory {
        let oldest = self.epochs.front().map_or(self.filter.belief(), |e| &e.prior);
        EstimatorMemory {
            mean: oldest.mean.as_slice().to_vec(),
            covariance: oldest.covariance.as_slice().to_vec(),
            instants: self.epochs.iter().map(RememberedInstant::of).collect(),
        }
    }

    /// Takes up the memory of an estimator made in the same way.
    ///
    /// # Errors
    /// A belief of another size, instants out of order, readings that can't be; the estimator is then as it was.
    pub fn recall(&mut self, memory: &EstimatorMemory) -> Result<(), EstimationError> {
        let before = self.filter.belief().clone();
        match self.gone_over(memory) {
            Ok(epochs) => {
                if let Some(present) = epochs.back() {
                    (self.now_ns, self.input) = (present.time_ns, present.input_before);
                }
                self.epochs = epochs;
                Ok(())
            }
            Err(error) => {
                self.filter.believe(before);
                Err(error)
            }
        }
    }

    /// The instants with their beliefs; the filter has then reached the last.
    fn gone_over(&mut self, memory: &EstimatorMemory) -> Result<VecDeque<Epoch>, EstimationError> {
        use crate::Process;
        let n = self.filter.process().error_len();
        same_length("the remembered covariance", n * n, memory.covariance.len())?;
        let oldest = Belief {
            mean: DVector::from_column_slice(&memory.mean),
            covariance: DMatrix::from_column_slice(n, n, &memory.covariance),
        };
        self.filter.believe(checked(self.filter.process(), oldest)?);
        let mut epochs: VecDeque<Epoch> = VecDeque::new();
        for instant in &memory.instants {
            let epoch = instant.epoch(self.filter.belief().clone());
            let air = instant.wind_m_s.iter().chain(&instant.air_rates_rad_s);
            for &value in epoch.input_before.commands.iter().chain(air) {
                crate::error::finite("a remembered command, wind or rotation of the air", value)?;
            }
            let epoch = match epochs.back() {
                None => epoch,
                Some(last) => {
                    let step_s = instant.time_ns.saturating_sub(last.time_ns) as f64 * SECONDS;
                    self.filter.predict(&epoch.input_before, step_s)?;
                    let prior = self.filter.belief().clone();
                    Epoch { prior, ..epoch }
                }
            };
            for observation in &epoch.measurements {
                self.observed(&epoch.input_before, observation)?;
            }
            epochs.push_back(epoch);
        }
        if epochs.is_empty() {
            same_length("the list of remembered instants", 1, 0)?;
        }
        Ok(epochs)
    }
}
