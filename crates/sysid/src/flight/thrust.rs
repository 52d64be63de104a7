//! Thrust curve and motor lag from the accelerometer: `−m f_z = Σ T_i`.

use super::signal::{Comparison, Segment, at, decay, lag_step};
use super::{FlightError, LagOn, ThrustCurve, positive};
use crate::estimate::{Estimate, Fit};
use crate::recorded::InertialLog;
use crate::regression::{Predictor, nonlinear, slopes};
use quad_math::{Real, constant};
use std::ops::{Range, RangeInclusive};

/// Length of the bins over which thrust is averaged, s: a seventh of the lag that is sought.
const BIN_S: f64 = 0.01;

/// Start of the iteration: a plausible small motor, `0.1 c²` N behind 50 ms.
const START: [f64; 4] = [0.0, 0.0, 0.1, 0.05];

/// Settings of a thrust identification.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThrustSettings {
    /// Mass of the vehicle, kg.
    pub mass: f64,
    /// Where the lag acts.
    pub lag_on: LagOn,
    /// Delay δ of the accelerometer's filter, s, that is known or assumed.
    pub delay_s: f64,
}

/// An identified thrust curve with its lag.
#[derive(Clone, Debug, PartialEq)]
pub struct ThrustFit {
    /// How it was made.
    pub settings: ThrustSettings,
    /// `[k_0, k_1, k_2, τ]`, N and s, fitted to the total thrust, N.
    pub fit: Fit<4>,
}

impl ThrustFit {
    /// The curve of one rotor.
    pub fn curve(&self) -> ThrustCurve {
        let [constant, linear, quadratic, _] = self.fit.values();
        ThrustCurve {
            constant,
            linear,
            quadratic,
        }
    }

    /// The motor lag τ, s.
    pub fn lag(&self) -> Estimate {
        self.fit.parameters[3]
    }

    /// Thrust of one rotor, N, at a command, with its uncertainty: far smaller than the coefficients', which trade places.
    pub fn thrust(&self, command: f64) -> Estimate {
        self.fit.propagated(
            self.curve().thrust(command),
            &[1.0, command, command * command, 0.0],
        )
    }

    /// The least-squares line through the curve over a range of commands from a to b, evenly weighted:
    /// `K = k_1 + k_2 (a + b)`, intercept `k_0 − k_2 (a² + 4 a b + b²)/6`, zero `c_0 = −intercept/K`.
    pub fn line(&self, commands: &RangeInclusive<f64>) -> ThrustLine {
        let (a, b) = (*commands.start(), *commands.end());
        let [k0, k1, k2, _] = self.fit.values();
        let (sum, bend) = (a + b, (a * a + 4.0 * a * b + b * b) / 6.0);
        let gain = k1 + k2 * sum;
        let zero = (k2 * bend - k0) / gain;
        ThrustLine {
            gain: self.fit.propagated(gain, &[0.0, 1.0, sum, 0.0]),
            zero: self.fit.propagated(
                zero,
                &[-1.0 / gain, -zero / gain, (bend - zero * sum) / gain, 0.0],
            ),
        }
    }

    /// Total thrust, N, measured and predicted over another window or flight.
    ///
    /// # Errors
    /// A window without enough samples, or with constant commands.
    pub fn compare(&self, log: &InertialLog, window: &Range<f64>) -> Result<Comparison, FlightError> {
        let model = TotalThrust::new(log, window, self.settings)?;
        Ok(Comparison {
            time: model.segment.times(),
            measured: model.measured(),
            predicted: model.predict(&self.fit.values()),
        })
    }
}

/// A line through a thrust curve: `T = K (c − c_0)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThrustLine {
    /// Gain K of one rotor, N per unit of command.
    pub gain: Estimate,
    /// Zero-thrust command `c_0`.
    pub zero: Estimate,
}

/// Identifies thrust curve and lag over a window, s, of a flight.
///
/// # Errors
/// Settings that are not positive, a window without enough samples, constant commands, data that don't determine the
/// curve, a lag that comes out negative.
pub fn identify_thrust(
    log: &InertialLog,
    window: &Range<f64>,
    settings: ThrustSettings,
) -> Result<ThrustFit, FlightError> {
    positive("the mass, kg,", settings.mass)?;
    let model = TotalThrust::new(log, window, settings)?;
    let noticed = model
        .segment
        .inspect("accelerometer, m/s²,", |k| log.specific_force[k].z)?;
    let mut fit = nonlinear(&model.measured(), &model, START)?;
    fit.warnings.extend(noticed);
    let lag = fit.parameters[3].value;
    if lag <= 0.0 {
        return Err(FlightError::NotPhysical {
            what: "motor lag, s,",
            value: lag,
        });
    }
    let rows = slopes(&model, &fit.values());
    Ok(ThrustFit {
        settings,
        fit: fit.with_correlated_errors(&rows),
    })
}

/// The model of the total thrust over the bins of a window.
struct TotalThrust<'a> {
    segment: Segment<'a>,
    settings: ThrustSettings,
    /// Commands as they were δ ago, for each sample of the segment.
    commands: Vec<[f64; 4]>,
}

impl<'a> TotalThrust<'a> {
    fn new(log: &'a InertialLog, window: &Range<f64>, settings: ThrustSettings) -> Result<Self, FlightError> {
        let segment = Segment::new(log, window, BIN_S)?;
        let samples = segment.samples.clone();
        let commands = if settings.delay_s == 0.0 {
            log.commands[samples].to_vec()
        } else {
            let motors: [Vec<f64>; 4] =
                std::array::from_fn(|i| log.commands[samples.clone()].iter().map(|c| c[i]).collect());
            let time = &log.time[samples.clone()];
            let earlier = |t: &f64| std::array::from_fn(|i| at(time, &motors[i], t - settings.delay_s));
            time.iter().map(earlier).collect()
        };
        Ok(Self {
            segment,
            settings,
            commands,
        })
    }

    /// `−m f_z` averaged over each bin, N.
    fn measured(&self) -> Vec<f64> {
        let log = self.segment.log;
        self.segment
            .means(|k| -self.settings.mass * log.specific_force[k].z)
    }
}

impl Predictor<4> for TotalThrust<'_> {
    fn predict<R: Real>(&self, &[k0, k1, k2, lag]: &[R; 4]) -> Vec<R> {
        let curve = ThrustCurve {
            constant: k0,
            linear: k1,
            quadratic: k2,
        };
        let time = &self.segment.log.time;
        let start = self.segment.samples.start;
        // The lagged command and, for a lag on the thrust, the lagged square: T is linear in both.
        let mut first = self.commands[0].map(constant::<R>);
        let mut second = self.commands[0].map(|c| constant::<R>(c * c));
        let mut totals = Vec::with_capacity(self.commands.len());
        for (k, commands) in self.commands.iter().enumerate() {
            let thrust = |i: usize| match self.settings.lag_on {
                LagOn::Command => curve.thrust(first[i]),
                LagOn::Thrust => k0 + k1 * first[i] + k2 * second[i],
            };
            totals.push((0..4).map(thrust).fold(R::zero(), |sum, t| sum + t));
            if let Some(next) = time.get(start + k + 1) {
                let decay = decay(next - time[start + k], lag);
                for i in 0..4 {
                    first[i] = lag_step(first[i], commands[i], decay);
                    second[i] = lag_step(second[i], commands[i].powi(2), decay);
                }
            }
        }
        let mean = |bin: Range<usize>| {
            let count = constant::<R>(bin.len() as f64);
            let sum = bin.fold(R::zero(), |sum, k| sum + totals[k - start]);
            sum / count
        };
        self.segment.bins().map(mean).collect()
    }
}
