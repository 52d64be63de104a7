//! Thrust curve, lag, roll and pitch inertia from one vehicle's flights, with one delay of the inertial unit for all.
//!
//! The accelerometer's filter delays the thrust as the gyroscope's delays the rates, and the rates tell δ far better. So
//! both take turns until δ stays: thrust with the last δ gives curve and lag, roll and pitch with these give the next δ.

use super::rotation::{Axis, InertiaFit, RotationModel, SensorDelay, identify_inertia};
use super::thrust::{ThrustFit, ThrustSettings, identify_thrust};
use super::{FlightError, LagOn, ThrustCurve};
use crate::recorded::InertialLog;
use crate::regression::FitError;
use nalgebra::SVector;
use quad_dynamics::Vehicle;
use std::ops::Range;

/// Lengths of the bins for roll, pitch and yaw, s: an increment of a rate over them stands well above the gyroscope's noise.
const BIN_S: f64 = 0.02;
/// Slowest motion used for roll and pitch, s: above 2 Hz the coherence of moment and angular acceleration is 0.99, at
/// 1 Hz it has fallen below 0.9.
const SLOWEST_S: f64 = 0.5;
/// Rounds of thrust and rotation taking turns, and the change of the common delay, s, that ends them.
const ROUNDS: usize = 20;
const DELAY_TOLERANCE_S: f64 = 1e-5;

/// Part of a standard error over which a derivative is taken: small against the lag, whatever its error.
const PART_OF_ERROR: f64 = 0.1;

/// A window, s, of a flight.
#[derive(Clone, Debug)]
pub struct Window<'a> {
    /// The flight.
    pub log: &'a InertialLog,
    /// From and to, s.
    pub span: Range<f64>,
}

/// What [`identify_thrust_and_inertia`] finds, with lag on the thrust.
#[derive(Clone, Debug, PartialEq)]
pub struct ThrustAndInertia {
    /// Thrust curve and lag.
    pub thrust: ThrustFit,
    /// `I_xx`.
    pub roll: InertiaFit,
    /// `I_yy`.
    pub pitch: InertiaFit,
}

impl ThrustAndInertia {
    /// The common delay δ of the inertial unit, s.
    pub fn delay_s(&self) -> f64 {
        0.5 * (self.roll.delay.value + self.pitch.delay.value)
    }

    /// The same with the errors of thrust curve and lag carried into both inertias.
    ///
    /// Above 2 Hz a moment goes nearly with the curve's slope over the lag, so that an error of the lag is one of the inertia:
    /// `I(p)` is identified anew along each column `l_k` of the Cholesky factor of the thrust fit's covariance, and
    /// `Σ_k (∂I/∂p · l_k)²` is added to its variance. The delay is held: the phase tells it, the amplitude tells I.
    ///
    /// # Errors
    /// As [`identify_inertia`].
    pub fn with_thrust_errors(mut self, vehicle: &Vehicle, moved: &Window<'_>) -> Result<Self, FlightError> {
        let fit = &self.thrust.fit;
        let factor = fit.covariance.cholesky().ok_or(FitError::Decomposition)?.l();
        let freedom = fit.goodness.degrees_of_freedom;
        let values = SVector::from(fit.values());
        for found in [&mut self.roll, &mut self.pitch] {
            let mut variance = 0.0;
            for column in factor.column_iter() {
                let [constant, linear, quadratic, lag_s] = (values + column * PART_OF_ERROR).into();
                let model = RotationModel {
                    curve: ThrustCurve {
                        constant,
                        linear,
                        quadratic,
                    },
                    lag_s,
                    ..found.model
                };
                let changed = identify_inertia(found.axis, &model, vehicle, moved.log, &moved.span)?;
                variance += ((changed.inertia.value - found.inertia.value) / PART_OF_ERROR).powi(2);
            }
            found.inertia = found.inertia.with_error(variance.sqrt(), freedom);
        }
        Ok(self)
    }

    /// The model of rotation at this thrust and delay, as another axis takes it.
    pub(super) fn rotation_model(&self) -> RotationModel {
        RotationModel {
            delay: SensorDelay::Known(self.delay_s()),
            ..rotation_model(&self.thrust)
        }
    }
}

fn rotation_model(thrust: &ThrustFit) -> RotationModel {
    RotationModel {
        curve: thrust.curve(),
        lag_on: LagOn::Thrust,
        lag_s: thrust.lag().value,
        delay: SensorDelay::Identified,
        bin_s: BIN_S,
        slowest_s: SLOWEST_S,
    }
}

/// Identifies thrust from one window and roll and pitch from another, or the same, of a vehicle of this mass, kg;
/// `vehicle` gives the rotors' places, nothing else.
///
/// # Errors
/// Those of the single identifications.
pub fn identify_thrust_and_inertia(
    up_down: &Window<'_>,
    moved: &Window<'_>,
    mass: f64,
    vehicle: &Vehicle,
) -> Result<ThrustAndInertia, FlightError> {
    let mut delay_s = 0.0;
    let mut round = 0;
    loop {
        let settings = ThrustSettings {
            mass,
            lag_on: LagOn::Thrust,
            delay_s,
        };
        let thrust = identify_thrust(up_down.log, &up_down.span, settings)?;
        let model = rotation_model(&thrust);
        let found = ThrustAndInertia {
            roll: identify_inertia(Axis::Roll, &model, vehicle, moved.log, &moved.span)?,
            pitch: identify_inertia(Axis::Pitch, &model, vehicle, moved.log, &moved.span)?,
            thrust,
        };
        round += 1;
        if (found.delay_s() - delay_s).abs() < DELAY_TOLERANCE_S || round == ROUNDS {
            return Ok(found);
        }
        delay_s = found.delay_s();
    }
}
