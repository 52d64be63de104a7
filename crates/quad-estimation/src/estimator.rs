//! A filter with a clock and a memory: measurements that come late are taken in where they belong.
//!
//! It remembers what it believed before the measurements of each instant, the inputs since and the measurements. A
//! reading taken at τ < t is filed at τ, and the filter resumes from there again: exactly what it would believe had the
//! reading come in time (Larsen et al., *CDC* 1998, compare the cheaper approximations). Costs the delay's predictions once more for
//! each late reading. A measurement older than the memory is an error and changes nothing.

mod memory;

pub use memory::{EstimatorMemory, RememberedInstant, RememberedReading};

use crate::belief::{Belief, Innovation};
use crate::filter::{Filter, Observation};
use crate::sensor::{Instrument, Measurement};
use crate::{EstimationError, LevelProcess, Process};
use nalgebra::DVector;
use quad_dynamics::Input;
use std::collections::VecDeque;

/// Nanoseconds to seconds.
const SECONDS: f64 = 1e-9;

/// An instant that the filter can go back to.
#[derive(Clone, Debug)]
struct Epoch {
    time_ns: u64,
    /// Before the measurements of this instant.
    prior: Belief,
    /// What acted up to this instant.
    input_before: Input<f64>,
    /// In the order of their arrival.
    measurements: Vec<Observation<Instrument>>,
}

/// A filter on a level that knows the time and takes measurements in late.
#[derive(Clone, Debug)]
pub struct Estimator<F> {
    filter: F,
    epochs: VecDeque<Epoch>,
    memory_ns: u64,
    /// NIS per reading beyond which a measurement is not believed.
    gate: Option<f64>,
    input: Input<f64>,
    now_ns: u64,
}

impl<F: Filter<Process = LevelProcess>> Estimator<F> {
    /// An estimator that begins at time 0 with what its filter believes, this input acting, and remembers for this long.
    pub fn new(filter: F, input: Input<f64>, memory_ns: u64) -> Self {
        let epoch = Epoch {
            time_ns: 0,
            prior: filter.belief().clone(),
            input_before: input,
            measurements: Vec::new(),
        };
        Self {
            filter,
            epochs: VecDeque::from([epoch]),
            memory_ns,
            gate: None,
            input,
            now_ns: 0,
        }
    }

    /// Disbelieves measurements with a NIS beyond this value times their number of readings.
    ///
    /// # Errors
    /// A gate that is not positive.
    pub fn with_gate(mut self, gate: f64) -> Result<Self, EstimationError> {
        crate::error::positive("a gate on the normalised innovation", gate)?;
        self.gate = Some(gate);
        Ok(self)
    }

    /// Remembers for this long from now on, ns.
    pub fn remember(&mut self, memory_ns: u64) {
        self.memory_ns = memory_ns;
    }

    /// Begins anew at the present with this belief, this input acting: all that was measured before is forgotten.
    ///
    /// # Errors
    /// A belief of another size; the estimator is then as it was.
    pub fn restart(&mut self, belief: Belief, input: Input<f64>) -> Result<(), EstimationError> {
        self.filter
            .believe(crate::filter::checked(self.filter.process(), belief)?);
        self.input = input;
        self.epochs = VecDeque::from([Epoch {
            time_ns: self.now_ns,
            prior: self.filter.belief().clone(),
            input_before: input,
            measurements: Vec::new(),
        }]);
        Ok(())
    }

    /// The filter.
    pub fn filter(&self) -> &F {
        &self.filter
    }

    /// The filter, for evaluating its model.
    pub fn filter_mut(&mut self) -> &mut F {
        &mut self.filter
    }

    /// The filter, its clock and memory left behind.
    pub fn into_filter(self) -> F {
        self.filter
    }

    /// The time it has reached, ns.
    pub fn now_ns(&self) -> u64 {
        self.now_ns
    }

    /// The oldest instant it can go back to, ns.
    pub fn oldest_ns(&self) -> u64 {
        self.epochs.front().map_or(self.now_ns, |epoch| epoch.time_ns)
    }

    /// What it says of the rigid body now.
    pub fn estimate(&mut self) -> crate::Estimate {
        crate::estimate(&mut self.filter)
    }

    /// Predicts to this time with this input held.
    ///
    /// # Errors
    /// A time that is not ahead; inputs that are not finite; a belief that leaves the numbers. It then stays where it is.
    pub fn predict(&mut self, input: &Input<f64>, until_ns: u64) -> Result<(), EstimationError> {
        for &value in input.commands.iter().chain(input.wind.iter()) {
            crate::error::finite("a command or the wind", value)?;
        }
        let step_s = until_ns as f64 * SECONDS - self.now_ns as f64 * SECONDS;
        if until_ns <= self.now_ns {
            return Err(EstimationError::BadStep { step_s });
        }
        let step_s = (until_ns - self.now_ns) as f64 * SECONDS;
        self.filter.predict(input, step_s)?;
        (self.now_ns, self.input) = (until_ns, *input);
        self.epochs.push_back(Epoch {
            time_ns: until_ns,
            prior: self.filter.belief().clone(),
            input_before: *input,
            measurements: Vec::new(),
        });
        // The instant at or before the memory's end stays: measurements up to there can be filed behind it.
        while self.epochs.len() > 1 && self.now_ns - self.epochs[1].time_ns >= self.memory_ns {
            self.epochs.pop_front();
        }
        Ok(())
    }

    /// Processes a measurement, however late; returns its innovation at the instant it belongs to.
    ///
    /// # Errors
    /// A measurement ahead of the filter or older than its memory; readings that are not finite or of the wrong number; a belief that
    /// leaves the numbers. The estimator is then as it was.
    pub fn update(&mut self, measurement: &Measurement) -> Result<Innovation, EstimationError> {
        let taken_ns = measurement.taken_ns;
        if taken_ns > self.now_ns {
            let now_ns = self.now_ns;
            return Err(EstimationError::FromTheFuture { taken_ns, now_ns });
        }
        if taken_ns < self.oldest_ns() {
            let oldest_ns = self.oldest_ns();
            return Err(EstimationError::TooOld { taken_ns, oldest_ns });
        }
        let observation = Observation {
            instrument: measurement.instrument,
            values: DVector::from_column_slice(&measurement.values),
            deviation: measurement.deviation,
        };
        if taken_ns == self.now_ns {
            let input = self.input;
            let innovation = self.observed(&input, &observation)?;
            if let Some(epoch) = self.epochs.back_mut() {
                epoch.measurements.push(observation);
            }
            return Ok(innovation);
        }
        let place = self.epochs.partition_point(|e| e.time_ns <= taken_ns) - 1;
        let belief = self.filter.belief().clone();
        let behind: Vec<Epoch> = self.epochs.range(place..).cloned().collect();
        let result = self.replay(place, taken_ns, observation);
        if result.is_err() {
            self.filter.believe(belief);
            self.epochs.truncate(place);
            self.epochs.extend(behind);
        }
        result
    }

    fn observed(
        &mut self,
        input: &Input<f64>,
        observation: &Observation<Instrument>,
    ) -> Result<Innovation, EstimationError> {
        let readings = self.filter.process().readings(observation.instrument) as f64;
        let gate = self.gate.map(|gate| gate * readings);
        self.filter.update(input, observation, gate)
    }

    /// Files the observation at its instant, at or behind epoch `place`, and resumes from there to the present.
    fn replay(
        &mut self,
        place: usize,
        taken_ns: u64,
        observation: Observation<Instrument>,
    ) -> Result<Innovation, EstimationError> {
        let at = if self.epochs[place].time_ns == taken_ns {
            place
        } else {
            self.split(place, taken_ns)?;
            place + 1
        };
        self.epochs[at].measurements.push(observation);
        let mut told = None;
        for k in at..self.epochs.len() {
            if k > at {
                let step_s = (self.epochs[k].time_ns - self.epochs[k - 1].time_ns) as f64 * SECONDS;
                let input = self.epochs[k].input_before;
                self.filter.predict(&input, step_s)?;
                self.epochs[k].prior = self.filter.belief().clone();
            } else {
                self.filter.believe(self.epochs[k].prior.clone());
            }
            let (input, measurements) = (self.epochs[k].input_before, self.epochs[k].measurements.clone());
            for observation in &measurements {
                let innovation = self.observed(&input, observation)?;
                if k == at {
                    told = Some(innovation);
                }
            }
        }
        // The instant `at` has at least the new one.
        told.ok_or(EstimationError::Diverged)
    }

    /// Makes an instant between two.
    fn split(&mut self, place: usize, time_ns: u64) -> Result<(), EstimationError> {
        let before = self.epochs[place].clone();
        self.filter.believe(before.prior);
        for observation in &before.measurements {
            self.observed(&before.input_before, observation)?;
        }
        let input = self.epochs[place + 1].input_before;
        self.filter
            .predict(&input, (time_ns - before.time_ns) as f64 * SECONDS)?;
        let epoch = Epoch {
            time_ns,
            prior: self.filter.belief().clone(),
            input_before: input,
            measurements: Vec::new(),
        };
        self.epochs.insert(place + 1, epoch);
        Ok(())
    }
}
