//! How uncertain a flight is at first, and what keeps it so.

use super::layout::{EXTRAS, Layout, places};
use crate::EstimationError;
use crate::error::positive;
use crate::sensor::{Instrument, Sensor};
use nalgebra::DVector;
use serde::{Deserialize, Serialize};

/// Standard deviations of a first belief, each along every axis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct InitialUncertainty {
    /// Of the position, m.
    pub position_m: f64,
    /// Of the velocity, m/s.
    pub velocity_m_s: f64,
    /// Of the attitude, rad.
    pub attitude_rad: f64,
    /// Of the rates, rad/s.
    pub rates_rad_s: f64,
    /// Of the rotors' states and the charge drawn, relative to hover and to 0.01 Ah.
    pub own: f64,
    /// Of the disturbance, m/s².
    pub disturbance_m_s2: f64,
    /// Of the gyroscope's bias, rad/s.
    pub gyroscope_bias_rad_s: f64,
    /// Of the accelerometer's bias, m/s².
    pub accelerometer_bias_m_s2: f64,
}

impl Default for InitialUncertainty {
    /// A vehicle put down roughly where it is said to be, with poor sensors.
    fn default() -> Self {
        Self {
            position_m: 0.1,
            velocity_m_s: 0.1,
            attitude_rad: 0.05,
            rates_rad_s: 0.05,
            own: 0.05,
            disturbance_m_s2: 0.3,
            gyroscope_bias_rad_s: 0.03,
            accelerometer_bias_m_s2: 0.3,
        }
    }
}

/// Densities of the white noise that drives the errors: after a step of h seconds each error has the variance
/// `density² h` more.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ProcessNoise {
    /// Of the position, m/√s; small, for what integration leaves.
    pub position: f64,
    /// Of the velocity, m/s/√s: gusts too short for the disturbance.
    pub velocity: f64,
    /// Of the attitude, rad/√s; small.
    pub attitude: f64,
    /// Of the rates, rad/s/√s: moments that the level has not.
    pub rates: f64,
    /// Of the rotors' states and the charge drawn, 1/√s, relative to hover and to 0.01 Ah.
    pub own: f64,
    /// Of the disturbance's random walk, m/s²/√s.
    pub disturbance: f64,
    /// Of the gyroscope's bias, rad/s/√s.
    pub gyroscope_bias: f64,
    /// Of the accelerometer's bias, m/s²/√s.
    pub accelerometer_bias: f64,
}

impl Default for ProcessNoise {
    /// Light air about a small vehicle whose model is right.
    fn default() -> Self {
        Self {
            position: 1e-3,
            velocity: 0.02,
            attitude: 1e-3,
            rates: 0.1,
            own: 0.02,
            disturbance: 0.1,
            gyroscope_bias: 5e-4,
            accelerometer_bias: 5e-3,
        }
    }
}

/// A number of the sensor of this kind, where there is one and the number is not zero.
fn of_sensor(sensors: &[Sensor], kind: Instrument, number: fn(&Sensor) -> f64) -> Option<f64> {
    let sensor = sensors.iter().find(|s| s.instrument == kind);
    sensor.map(number).filter(|&value| value > 0.0)
}

/// The eight groups of numbers in the order of the error state.
struct Groups {
    first: [f64; 4],
    own: f64,
    extras: [f64; 3],
}

impl Groups {
    fn spread(&self, layout: &Layout) -> DVector<f64> {
        let mut all = Vec::with_capacity(places::OWN + EXTRAS + layout.own_scales.len());
        all.extend(self.first.iter().flat_map(|&value| [value; 3]));
        all.extend(layout.own_scales.iter().map(|scale| scale * self.own));
        all.extend(self.extras.iter().flat_map(|&value| [value; 3]));
        DVector::from_vec(all)
    }
}

impl InitialUncertainty {
    /// The same with the biases that these sensors are turned on with.
    #[must_use]
    pub fn with_biases_of(self, sensors: &[Sensor]) -> Self {
        let bias = |kind| of_sensor(sensors, kind, |s| s.turn_on_bias);
        Self {
            gyroscope_bias_rad_s: bias(Instrument::Gyroscope).unwrap_or(self.gyroscope_bias_rad_s),
            accelerometer_bias_m_s2: bias(Instrument::Accelerometer).unwrap_or(self.accelerometer_bias_m_s2),
            ..self
        }
    }

    /// Checks that every deviation is positive.
    ///
    /// # Errors
    /// The first that is not, by its name.
    pub fn validate(&self) -> Result<(), EstimationError> {
        for (what, value) in [
            ("the position's deviation, m,", self.position_m),
            ("the velocity's deviation, m/s,", self.velocity_m_s),
            ("the attitude's deviation, rad,", self.attitude_rad),
            ("the rates' deviation, rad/s,", self.rates_rad_s),
            ("the rotors' relative deviation", self.own),
            ("the disturbance's deviation, m/s²,", self.disturbance_m_s2),
            ("the gyroscope bias' deviation, rad/s,", self.gyroscope_bias_rad_s),
            (
                "the accelerometer bias' deviation, m/s²,",
                self.accelerometer_bias_m_s2,
            ),
        ] {
            positive(what, value)?;
        }
        Ok(())
    }

    pub(super) fn deviations(&self, layout: &Layout) -> DVector<f64> {
        Groups {
            first: [
                self.position_m,
                self.velocity_m_s,
                self.attitude_rad,
                self.rates_rad_s,
            ],
            own: self.own,
            extras: [
                self.disturbance_m_s2,
                self.gyroscope_bias_rad_s,
                self.accelerometer_bias_m_s2,
            ],
        }
        .spread(layout)
    }
}

impl ProcessNoise {
    /// The same with the drifts of these sensors' biases.
    #[must_use]
    pub fn with_drifts_of(self, sensors: &[Sensor]) -> Self {
        let drift = |kind| of_sensor(sensors, kind, |s| s.bias_drift);
        Self {
            gyroscope_bias: drift(Instrument::Gyroscope).unwrap_or(self.gyroscope_bias),
            accelerometer_bias: drift(Instrument::Accelerometer).unwrap_or(self.accelerometer_bias),
            ..self
        }
    }

    /// Checks that every density is positive: an error that nothing drives would end with no variance at all.
    ///
    /// # Errors
    /// The first that is not, by its name.
    pub fn validate(&self) -> Result<(), EstimationError> {
        for (what, value) in [
            ("the position's noise density, m/√s,", self.position),
            ("the velocity's noise density, m/s/√s,", self.velocity),
            ("the attitude's noise density, rad/√s,", self.attitude),
            ("the rates' noise density, rad/s/√s,", self.rates),
            ("the rotors' relative noise density, 1/√s,", self.own),
            ("the disturbance's noise density, m/s²/√s,", self.disturbance),
            (
                "the gyroscope bias' noise density, rad/s/√s,",
                self.gyroscope_bias,
            ),
            (
                "the accelerometer bias' noise density, m/s²/√s,",
                self.accelerometer_bias,
            ),
        ] {
            positive(what, value)?;
        }
        Ok(())
    }

    pub(super) fn densities(&self, layout: &Layout) -> DVector<f64> {
        Groups {
            first: [self.position, self.velocity, self.attitude, self.rates],
            own: self.own,
            extras: [self.disturbance, self.gyroscope_bias, self.accelerometer_bias],
        }
        .spread(layout)
    }
}
