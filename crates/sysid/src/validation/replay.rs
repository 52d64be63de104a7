//! Replay: a level of the family driven by a flight's recorded motor commands and battery voltage.
//!
//! A quadrotor is unstable in attitude: an error of a thousandth of the thrust turns it over within seconds, whatever the
//! model. So it matters from where a prediction starts, and each is called by its name ([`Prediction`]):
//!
//! | prediction | the body starts anew from the measured state |
//! | --- | --- |
//! | one-step | at every sample: the model's accelerations at the measured state ('equation error') |
//! | short horizon | every 0.1 to 1 s: open loop in between |
//! | whole flight | once: open loop to the end |
//!
//! The rotors never start anew: they follow the recorded commands all the time. Compared are the accelerations along W and
//! the angular accelerations along B, as means over [`AVERAGE_S`] (growth of velocity and rates over its length), and
//! the body rates and velocities themselves at the end of each horizon, just before the next start (for one-step and
//! whole flight at the end of each average).
//!
//! Measured velocity and attitude are motion capture's, measured rates the gyroscope's. The battery is the recorded one: the
//! command of level 5 is scaled by `V_b/V_nominal` on a constant supply, which gives `x = ū V_b` exactly; levels 2 to 4 do not
//! see the voltage. Input limits are off, since what is recorded was flown.

use super::agreement::{Agreement, AgreementError};
use super::run::{Growth, Motion, Run};
use crate::flight::Comparison;
use crate::recorded::MotionCaptureFlight;
use quad_dynamics::{BuildError, Level, Vehicle, VehicleError};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::ops::Range;

/// Length of the means that accelerations are compared as, s.
pub const AVERAGE_S: f64 = 0.05;
/// How long before the window the rotors are run in, s.
const RUN_IN_S: f64 = 0.5;

/// From where a prediction starts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Prediction {
    /// Anew at every sample.
    OneStep,
    /// Anew every so many seconds.
    ShortHorizon(f64),
    /// Once.
    WholeFlight,
}

impl fmt::Display for Prediction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OneStep => write!(f, "one-step"),
            Self::ShortHorizon(seconds) => write!(f, "{seconds} s horizon"),
            Self::WholeFlight => write!(f, "whole flight"),
        }
    }
}

/// A vehicle to be driven by recordings.
#[derive(Clone, Debug, PartialEq)]
pub struct ReplayVehicle {
    /// Its parameters.
    pub vehicle: Vehicle,
    /// Offsets added to the recorded commands, duty.
    pub trim: [f64; 4],
    /// How long the records lag behind the commands, s: the commands of δ ago drive the model.
    pub delay_s: f64,
}

/// Why a replay is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReplayError {
    /// Level 1 has a state of its own kind.
    #[error("a replay needs level 2 to 5, got {level}")]
    Level {
        /// The level asked for.
        level: Level,
    },
    /// A window without samples enough for one average.
    #[error("the window {from} to {to} s has {samples} samples, too few for means over {AVERAGE_S} s")]
    Window {
        /// Start, s.
        from: f64,
        /// End, s.
        to: f64,
        /// Samples in it.
        samples: usize,
    },
    /// A horizon outside what makes sense.
    #[error("the horizon must be a multiple of the averaging time, {AVERAGE_S} s, got {horizon_s} s")]
    Horizon {
        /// The horizon, s.
        horizon_s: f64,
    },
    /// The model.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// The vehicle.
    #[error(transparent)]
    Vehicle(#[from] VehicleError),
}

/// A flight as a model predicts it, beside the measured one. Arrays are along x, y, z.
#[derive(Clone, Debug, PartialEq)]
pub struct Replay {
    /// Acceleration along W, m/s².
    pub acceleration: [Comparison; 3],
    /// Angular acceleration along B, rad/s².
    pub angular_acceleration: [Comparison; 3],
    /// Velocity along W, m/s, at the ends of the horizons.
    pub velocity: [Comparison; 3],
    /// Body rates, rad/s, at the ends of the horizons.
    pub body_rates: [Comparison; 3],
    /// When the prediction tumbled and ended, s.
    pub tumbled_at: Option<f64>,
}

/// Agreement of a replay, arrays along x, y, z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReplayAgreement {
    /// Of the acceleration along W.
    pub acceleration: [Agreement; 3],
    /// Of the angular acceleration along B.
    pub angular_acceleration: [Agreement; 3],
    /// Of the velocity along W.
    pub velocity: [Agreement; 3],
    /// Of the body rates.
    pub body_rates: [Agreement; 3],
}

impl Replay {
    /// How well prediction and measurement agree.
    ///
    /// # Errors
    /// A replay that tumbled before there was anything to compare.
    pub fn agreement(&self) -> Result<ReplayAgreement, AgreementError> {
        let of = |[x, y, z]: &[Comparison; 3]| -> Result<[Agreement; 3], AgreementError> {
            Ok([x.agreement()?, y.agreement()?, z.agreement()?])
        };
        Ok(ReplayAgreement {
            acceleration: of(&self.acceleration)?,
            angular_acceleration: of(&self.angular_acceleration)?,
            velocity: of(&self.velocity)?,
            body_rates: of(&self.body_rates)?,
        })
    }
}

/// Drives a level with a flight's recorded commands over a window, s.
///
/// # Errors
/// Level 1; a window that is too short; a horizon that is no multiple of [`AVERAGE_S`]; a vehicle without what the level needs.
pub fn replay(
    flight: &MotionCaptureFlight,
    window: &Range<f64>,
    level: Level,
    replayed: &ReplayVehicle,
    prediction: Prediction,
) -> Result<Replay, ReplayError> {
    let samples = flight.inertial.window(window.start, window.end);
    let (from, to) = (window.start, window.end);
    let mut run = Run::new(flight, level, replayed)?;
    let averages = averages(&flight.inertial.time, samples.clone());
    if averages.is_empty() {
        return Err(ReplayError::Window {
            from,
            to,
            samples: samples.len(),
        });
    }
    let per_horizon = averages_per_horizon(prediction)?;
    let start = flight.inertial.window(from - RUN_IN_S, from).start;
    for k in start..samples.start {
        run.start_anew(k);
        run.advance(k);
    }
    let mut record = Record::default();
    for (number, average) in averages.iter().enumerate() {
        if per_horizon.map_or(number == 0, |count| number % count == 0) {
            run.start_anew(average.start);
        }
        let mut growth = Growth::default();
        for k in average.clone() {
            if prediction == Prediction::OneStep {
                run.start_anew(k);
            }
            let before = run.motion();
            run.advance(k);
            growth.add(&before, &run.motion());
        }
        if !run.is_upright() {
            record.tumbled_at = Some(flight.inertial.time[average.start]);
            break;
        }
        record.push_mean(flight, average, &growth);
        if per_horizon.is_none_or(|count| (number + 1) % count == 0) {
            record.push_end(flight, average.end, &run.motion());
        }
    }
    Ok(record.finish())
}

/// How many averages a horizon has; `None` for one that never ends.
fn averages_per_horizon(prediction: Prediction) -> Result<Option<usize>, ReplayError> {
    match prediction {
        Prediction::OneStep => Ok(Some(1)),
        Prediction::WholeFlight => Ok(None),
        Prediction::ShortHorizon(horizon_s) => {
            let count = (horizon_s / AVERAGE_S).round();
            if (count * AVERAGE_S - horizon_s).abs() < 1e-9 && count >= 1.0 {
                Ok(Some(count as usize))
            } else {
                Err(ReplayError::Horizon { horizon_s })
            }
        }
    }
}

/// The samples cut into stretches of [`AVERAGE_S`]; each ends on the sample where the next begins.
fn averages(time: &[f64], samples: Range<usize>) -> Vec<Range<usize>> {
    let mut averages = Vec::new();
    let mut start = samples.start;
    for k in samples.start + 1..samples.end {
        // Half a sample early is nearer than half a sample late.
        let step = time[k] - time[k - 1];
        if time[k] - time[start] >= AVERAGE_S - 0.5 * step {
            averages.push(start..k);
            start = k;
        }
    }
    averages
}

/// Series under way.
#[derive(Default)]
struct Record {
    acceleration: [Pairs; 3],
    angular_acceleration: [Pairs; 3],
    velocity: [Pairs; 3],
    body_rates: [Pairs; 3],
    tumbled_at: Option<f64>,
}

#[derive(Default)]
struct Pairs(Vec<f64>, Vec<f64>, Vec<f64>);

impl Pairs {
    fn push(&mut self, time: f64, measured: f64, predicted: f64) {
        self.0.push(time);
        self.1.push(measured);
        self.2.push(predicted);
    }

    fn finish(self) -> Comparison {
        Comparison {
            time: self.0,
            measured: self.1,
            predicted: self.2,
        }
    }
}

impl Record {
    fn push_mean(&mut self, flight: &MotionCaptureFlight, average: &Range<usize>, growth: &Growth) {
        let (a, b) = (average.start, average.end);
        let times = &flight.inertial.time;
        let (span, middle) = (times[b] - times[a], 0.5 * (times[a] + times[b]));
        let gained = flight.velocity[b] - flight.velocity[a];
        let turned = flight.inertial.body_rates[b] - flight.inertial.body_rates[a];
        for axis in 0..3 {
            let predicted = growth.0.velocity[axis] / span;
            self.acceleration[axis].push(middle, gained[axis] / span, predicted);
            let predicted = growth.0.body_rates[axis] / span;
            self.angular_acceleration[axis].push(middle, turned[axis] / span, predicted);
        }
    }

    fn push_end(&mut self, flight: &MotionCaptureFlight, k: usize, motion: &Motion) {
        let time = flight.inertial.time[k];
        for axis in 0..3 {
            self.velocity[axis].push(time, flight.velocity[k][axis], motion.velocity[axis]);
            let measured = flight.inertial.body_rates[k][axis];
            self.body_rates[axis].push(time, measured, motion.body_rates[axis]);
        }
    }

    fn finish(self) -> Replay {
        Replay {
            acceleration: self.acceleration.map(Pairs::finish),
            angular_acceleration: self.angular_acceleration.map(Pairs::finish),
            velocity: self.velocity.map(Pairs::finish),
            body_rates: self.body_rates.map(Pairs::finish),
            tumbled_at: self.tumbled_at,
        }
    }
}
