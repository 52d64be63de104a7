//! Yaw: `I_zz ṙ = κ (Q + Q̇/z) + b − d r`, `Q = −Σ s_i T_i(t − δ)`, integrated over short bins.
//!
//! κ is the reaction torque per thrust, m; the zero z is what spinning up takes before there is thrust; b an offset of the
//! rotors, d the damping. Only the ratio `κ/I_zz` follows from a flight: a vehicle of twice the inertia with twice the torque turns
//! the same. One of the two must come from a bench or the literature.

use super::FlightError;
use super::rotation::{RotationModel, SensorDelay, lagged_thrusts};
use super::signal::{Comparison, Segment, at};
use crate::estimate::{Estimate, Fit};
use crate::recorded::InertialLog;
use crate::regression::{Row, linear};
use quad_dynamics::Vehicle;
use std::ops::Range;

/// An identified yaw response.
#[derive(Clone, Debug, PartialEq)]
pub struct YawFit {
    /// What was taken as known.
    pub model: RotationModel,
    /// `[κ/I_zz, κ/(I_zz z), b/I_zz, −d/I_zz]`, in 1/(kg m), s/(kg m), rad/s², 1/s.
    pub fit: Fit<4>,
}

impl YawFit {
    /// Torque per thrust over inertia, `κ/I_zz`, 1/(kg m).
    pub fn ratio(&self) -> Estimate {
        self.fit.parameters[0]
    }

    /// The zero z of the torque's response, rad/s.
    pub fn zero(&self) -> Estimate {
        let [ratio, lead, ..] = self.fit.values();
        let gradient = [1.0 / lead, -ratio / lead.powi(2), 0.0, 0.0];
        self.fit.propagated(ratio / lead, &gradient)
    }

    /// The inertia, kg m², that goes with a torque per thrust κ, m.
    pub fn inertia_for(&self, torque_per_thrust: f64) -> Estimate {
        let value = torque_per_thrust / self.ratio().value;
        self.ratio().mapped(value, value / self.ratio().value)
    }

    /// Yaw acceleration, rad/s², measured and predicted over another window or flight.
    ///
    /// # Errors
    /// A window without enough samples, or with constant commands.
    pub fn compare(
        &self,
        vehicle: &Vehicle,
        log: &InertialLog,
        window: &Range<f64>,
    ) -> Result<Comparison, FlightError> {
        let segment = Segment::new(log, window, self.model.bin_s)?;
        let rows = rows(&self.model, vehicle, &segment);
        let lengths = segment.lengths();
        let predicted = |row: &Row<4>| -> f64 {
            row.regressors
                .iter()
                .zip(self.fit.values())
                .map(|(x, p)| x * p)
                .sum()
        };
        Ok(Comparison {
            time: segment.times(),
            measured: rows.iter().zip(&lengths).map(|(row, h)| row.y / h).collect(),
            predicted: rows
                .iter()
                .zip(&lengths)
                .map(|(row, h)| predicted(row) / h)
                .collect(),
        })
    }
}

/// Identifies the yaw response over a window, s, of a flight. A known delay
/// is used, one to be identified counts as none, and slow motion stays in.
///
/// # Errors
/// A window without enough samples, constant commands, data that don't determine the response, a torque that acts the wrong way.
pub fn identify_yaw(
    model: &RotationModel,
    vehicle: &Vehicle,
    log: &InertialLog,
    window: &Range<f64>,
) -> Result<YawFit, FlightError> {
    let segment = Segment::new(log, window, model.bin_s)?;
    let rows = rows(model, vehicle, &segment);
    let regressors: Vec<[f64; 4]> = rows.iter().map(|row| row.regressors).collect();
    let noticed = segment.inspect("gyroscope, rad/s,", |k| log.body_rates[k].z)?;
    let mut fit = linear(&rows)?.with_correlated_errors(&regressors);
    fit.warnings.extend(noticed);
    let [ratio, lead, ..] = fit.values();
    if ratio <= 0.0 || lead <= 0.0 {
        let value = ratio.min(lead);
        return Err(FlightError::NotPhysical {
            what: "torque per thrust over inertia, 1/(kg m),",
            value,
        });
    }
    Ok(YawFit { model: *model, fit })
}

fn rows(model: &RotationModel, vehicle: &Vehicle, segment: &Segment<'_>) -> Vec<Row<4>> {
    let (log, start) = (segment.log, segment.samples.start);
    let spins = vehicle.rotors.each_ref().map(|rotor| rotor.spin.sign());
    let drive: Vec<f64> = lagged_thrusts(model, segment)
        .iter()
        .map(|thrusts| -thrusts.iter().zip(&spins).map(|(t, s)| t * s).sum::<f64>())
        .collect();
    let time = &log.time[segment.samples.clone()];
    let delay = match model.delay {
        SensorDelay::Known(delay) => delay,
        SensorDelay::Identified => 0.0,
    };
    let earlier = |k: usize| at(time, &drive, time[k - start] - delay);
    let impulses = segment.means(earlier);
    let growth = segment.increments(earlier);
    let rates = segment.means(|k| log.body_rates[k].z);
    let increments = segment.increments(|k| log.body_rates[k].z);
    let lengths = segment.lengths();
    (0..growth.len())
        .map(|k| Row {
            regressors: [
                impulses[k] * lengths[k],
                growth[k],
                lengths[k],
                rates[k] * lengths[k],
            ],
            y: increments[k],
        })
        .collect()
}
