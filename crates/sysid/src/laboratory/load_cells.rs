//! The virtual load cells of the rotor rig: thrust, and torque in both directions.

use super::{Generator, Sensor, SensorError};
use crate::load_cell::Sample;
use quad_dynamics::Vehicle;
use serde::{Deserialize, Serialize};

/// What a cell measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Channel {
    /// Thrust, N.
    Thrust,
    /// Torque clockwise seen from above, N m, positive.
    TorqueClockwise,
    /// Torque counter-clockwise, N m, negative.
    TorqueCounterClockwise,
}

/// A cell with its amplifier: `y = a + s x + ε_nl s X [4 (x/X)(1 − x/X)]`, X the capacity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoadCell {
    /// Largest load X, N or N m, negative for counter-clockwise torque.
    pub capacity: f64,
    /// Sensitivity s, V per N or N m.
    pub sensitivity_v: f64,
    /// Zero a, V.
    pub zero_v: f64,
    /// Departure from the straight line in the middle of the range, as a share of full scale.
    pub non_linearity: f64,
    /// The reading, V.
    pub reading_v: Sensor,
}

/// Capacity over the largest load a rotor of the vehicle makes.
const RESERVE: f64 = 1.5;
/// Output of the amplifier at capacity, V.
const FULL_SCALE_V: f64 = 5.0;
/// Sensitivity to counter-clockwise torque over that to clockwise: why both are calibrated. Assumed.
const ASYMMETRY: f64 = 0.996;

/// Why a cell is refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum LoadCellRigError {
    /// A sensor's numbers are wrong.
    #[error(transparent)]
    Sensor(#[from] SensorError),
    /// A number of the cell is not finite, or zero.
    #[error("the cell's {what} must be finite and not zero, got {value}")]
    Number {
        /// Which.
        what: &'static str,
        /// The value.
        value: f64,
    },
    /// No steps, or no repetitions.
    #[error("a calibration needs at least one step and one repetition, got {steps} and {repetitions}")]
    Empty {
        /// Steps from no load to capacity.
        steps: u32,
        /// Readings of each load on the way up, and on the way down.
        repetitions: u32,
    },
}

impl LoadCell {
    /// A cell fit for a rotor of this vehicle at full command: 5 V at one and a half times its thrust or torque,
    /// 2 mV of noise, a 16 bit converter over ±10 V, 0.01 % off the straight line: assumed.
    pub fn of(vehicle: &Vehicle, channel: Channel) -> Self {
        let full = *vehicle.zeroed_range().end();
        let (largest, share) = match channel {
            Channel::Thrust => (vehicle.linear_rotor.thrust_gain * full, 1.0),
            Channel::TorqueClockwise => (vehicle.linear_rotor.torque_gain * full, 1.0),
            Channel::TorqueCounterClockwise => (-vehicle.linear_rotor.torque_gain * full, ASYMMETRY),
        };
        let capacity = RESERVE * largest;
        Self {
            capacity,
            sensitivity_v: share * FULL_SCALE_V / capacity.abs(),
            zero_v: 0.083,
            non_linearity: 1e-4,
            reading_v: Sensor {
                noise: 2e-3,
                quantum: 20.0 / f64::from(1 << 16),
                minimum: -10.0,
                maximum: 10.0,
                ..Sensor::PERFECT
            },
        }
    }

    /// The reading without noise, V.
    pub fn response(&self, load: f64) -> f64 {
        let share = load / self.capacity;
        let bow = self.non_linearity * 4.0 * share * (1.0 - share);
        self.zero_v + self.sensitivity_v * (load + self.capacity * bow)
    }

    /// One reading under a load, V.
    pub fn read(&self, load: f64, generator: &mut Generator) -> f64 {
        self.reading_v.read(self.response(load), generator)
    }

    /// Calibrates up and down: `steps` equal loads from none to capacity and back, each read `repetitions` times.
    ///
    /// # Errors
    /// A cell or a plan that makes no calibration.
    pub fn calibrate(
        &self,
        steps: u32,
        repetitions: u32,
        generator: &mut Generator,
    ) -> Result<Vec<Sample>, LoadCellRigError> {
        self.reading_v.validate()?;
        for (what, value) in [("capacity", self.capacity), ("sensitivity", self.sensitivity_v)] {
            if !(value.is_finite() && value != 0.0) {
                return Err(LoadCellRigError::Number { what, value });
            }
        }
        if steps == 0 || repetitions == 0 {
            return Err(LoadCellRigError::Empty { steps, repetitions });
        }
        let loads = (0..=steps).chain((0..=steps).rev());
        let loads = loads.map(|k| self.capacity * f64::from(k) / f64::from(steps));
        let repeated = loads.flat_map(|load| (0..repetitions).map(move |_| load));
        Ok(repeated
            .map(|load| Sample {
                load,
                reading_v: self.read(load, generator),
            })
            .collect())
    }
}
