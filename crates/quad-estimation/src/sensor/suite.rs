//! All sensors of a vehicle together: readings in the order in which they arrive.

use super::{Instrument, Seen, Sensor, SensorError};
use rand::Rng;
use rand_distr::{Distribution, StandardNormal, StandardUniform};
use serde::{Deserialize, Serialize};

/// Checked sensors.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorSuite {
    pub(super) sensors: Vec<Sensor>,
}

/// What sensors remember: biases, when each is due, and readings on their way.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SuiteState {
    /// Bias of each sensor along its axes, in its unit.
    pub biases: Vec<[f64; 3]>,
    /// When each gives its next reading, ns.
    pub next_ns: Vec<u64>,
    /// Readings taken that have not arrived.
    pub pending: Vec<Measurement>,
}

/// A reading with what a filter must know of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Measurement {
    /// What was read.
    pub instrument: Instrument,
    /// When it was taken, ns.
    pub taken_ns: u64,
    /// When it arrives, ns.
    pub arrives_ns: u64,
    /// The readings.
    pub values: Vec<f64>,
    /// Standard deviation of each reading's white error.
    pub deviation: f64,
}

fn normal<G: Rng + ?Sized>(generator: &mut G) -> f64 {
    StandardNormal.sample(generator)
}

impl SensorSuite {
    /// Sensors that make sense.
    ///
    /// # Errors
    /// The first sensor that does not.
    pub fn new(sensors: impl Into<Vec<Sensor>>) -> Result<Self, SensorError> {
        let sensors = sensors.into();
        sensors.iter().try_for_each(Sensor::validate)?;
        Ok(Self { sensors })
    }

    /// The sensors.
    pub fn sensors(&self) -> &[Sensor] {
        &self.sensors
    }

    /// The longest delay, ns: how far back a filter must be able to go.
    pub fn longest_delay_ns(&self) -> u64 {
        self.sensors.iter().map(Sensor::delay_ns).max().unwrap_or(0)
    }

    /// Turns all sensors on: biases are drawn, the first readings are due at once.
    pub fn turned_on<G: Rng + ?Sized>(&self, generator: &mut G) -> SuiteState {
        SuiteState {
            biases: self
                .sensors
                .iter()
                .map(|s| std::array::from_fn(|_| s.turn_on_bias * normal(generator)))
                .collect(),
            next_ns: vec![0; self.sensors.len()],
            pending: Vec::new(),
        }
    }

    /// Takes the readings that are due at this instant and gives those that have arrived, in the order of their taking.
    ///
    /// Call it at instants at least as close as the fastest sensor's readings; a sensor reads at the first call at or after it is due.
    pub fn sample<G: Rng + ?Sized>(
        &self,
        state: &mut SuiteState,
        now_ns: u64,
        seen: &Seen<f64>,
        generator: &mut G,
    ) -> Vec<Measurement> {
        for (i, sensor) in self.sensors.iter().enumerate() {
            if now_ns >= state.next_ns[i] {
                state.next_ns[i] = state.next_ns[i].saturating_add(sensor.period_ns().max(1));
                let taken = sensor.take(&mut state.biases[i], now_ns, seen, generator);
                state.pending.extend(taken);
            }
        }
        let (mut arrived, pending): (Vec<_>, Vec<_>) = std::mem::take(&mut state.pending)
            .into_iter()
            .partition(|m| m.arrives_ns <= now_ns);
        state.pending = pending;
        arrived.sort_by_key(|m| m.taken_ns);
        arrived
    }
}

impl Sensor {
    /// One reading, unless it is out of range or lost; the bias drifts either way.
    fn take<G: Rng + ?Sized>(
        &self,
        bias: &mut [f64; 3],
        now_ns: u64,
        seen: &Seen<f64>,
        generator: &mut G,
    ) -> Option<Measurement> {
        let truth = self.instrument.ideal(seen);
        let walk = self.bias_drift * (1.0 / self.rate_hz).sqrt();
        // Everything is drawn whatever becomes of the reading: what one sensor does can't shift another's numbers.
        let noise: [f64; 3] = std::array::from_fn(|_| normal(generator));
        let lot: f64 = StandardUniform.sample(generator);
        let values = truth
            .as_slice()
            .iter()
            .enumerate()
            .map(|(axis, x)| {
                let analogue = x + bias[axis] + self.noise * noise[axis];
                if self.quantum > 0.0 {
                    (analogue / self.quantum).round() * self.quantum
                } else {
                    analogue
                }
            })
            .collect();
        for b in bias.iter_mut() {
            *b += walk * normal(generator);
        }
        let within = |x: &f64| self.range.is_none_or(|[low, high]| (low..=high).contains(x));
        let arrives = lot >= self.dropout && truth.as_slice().iter().all(within);
        arrives.then(|| Measurement {
            instrument: self.instrument,
            taken_ns: now_ns,
            arrives_ns: now_ns.saturating_add(self.delay_ns()),
            values,
            deviation: self.deviation(),
        })
    }
}
