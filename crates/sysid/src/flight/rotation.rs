//! Moments of inertia in roll and pitch: `I ω̇ = M(t − δ)`, integrated over short bins, without what is slow.

use super::signal::{Comparison, Segment, at, decay, lag_step, without_slow};
use super::{FlightError, LagOn, ThrustCurve};
use crate::estimate::{Estimate, Goodness, Warning};
use crate::recorded::InertialLog;
use crate::regression::{Row, linear};
use quad_dynamics::Vehicle;
use std::ops::Range;

/// Iterations for the delay; each gains two digits or more.
const DELAY_ITERATIONS: usize = 30;
/// Change of the delay, s, at which it counts as found: a thousandth of a sample.
const DELAY_TOLERANCE_S: f64 = 1e-6;

/// An axis of rotation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// About `x_B`.
    Roll,
    /// About `y_B`.
    Pitch,
}

/// Delay of the gyroscope behind the motion, and so behind the motors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SensorDelay {
    /// Known, s.
    Known(f64),
    /// To be identified with the inertia.
    Identified,
}

/// What an identification of inertia takes as known, and how it looks at the data.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotationModel {
    /// Thrust of one rotor over its command.
    pub curve: ThrustCurve,
    /// Where the lag acts.
    pub lag_on: LagOn,
    /// Motor lag τ, s.
    pub lag_s: f64,
    /// Delay δ.
    pub delay: SensorDelay,
    /// Length of the bins, s.
    pub bin_s: f64,
    /// Motion slower than about this, s, is left out, because moments that are not modelled (drag on the body and the
    /// rotors) take part in it.
    pub slowest_s: f64,
}

/// An identified moment of inertia.
#[derive(Clone, Debug, PartialEq)]
pub struct InertiaFit {
    /// The axis.
    pub axis: Axis,
    /// What was taken as known; the delay is the identified one.
    pub model: RotationModel,
    /// Moment of inertia, kg m²; its error includes that of the delay; that of thrust curve and lag
    /// if it was carried ([`super::ThrustAndInertia::with_thrust_errors`]).
    pub inertia: Estimate,
    /// Delay δ, s; without error if it was known.
    pub delay: Estimate,
    /// Fit of the increments of the rate, rad/s.
    pub goodness: Goodness,
    /// What a reader must know.
    pub warnings: Vec<Warning>,
}

impl InertiaFit {
    /// Angular acceleration, rad/s², measured and predicted over another window or flight, without what is slow.
    ///
    /// # Errors
    /// A window without enough samples, or with constant commands.
    pub fn compare(
        &self,
        vehicle: &Vehicle,
        log: &InertialLog,
        window: &Range<f64>,
    ) -> Result<Comparison, FlightError> {
        compare(self.axis, &self.model, self.inertia.value, vehicle, log, window)
    }
}

/// The angular acceleration that a model and an inertia predict, beside the measured one.
pub(super) fn compare(
    axis: Axis,
    model: &RotationModel,
    inertia: f64,
    vehicle: &Vehicle,
    log: &InertialLog,
    window: &Range<f64>,
) -> Result<Comparison, FlightError> {
    let data = RotationData::new(axis, model, vehicle, log, window)?;
    let delay = match model.delay {
        SensorDelay::Known(delay) => delay,
        SensorDelay::Identified => 0.0,
    };
    let per_second = |values: Vec<f64>| values.iter().zip(&data.lengths).map(|(v, h)| v / h).collect();
    Ok(Comparison {
        time: data.segment.times(),
        measured: per_second(data.rate_increments.clone()),
        predicted: per_second(data.impulses(delay).iter().map(|j| j / inertia).collect()),
    })
}

/// Identifies the moment of inertia about an axis over a window, s, of a flight, and the delay if it is not known.
///
/// # Errors
/// A window without enough samples, constant commands, data that don't determine the inertia, an inertia that comes out
/// negative.
pub fn identify_inertia(
    axis: Axis,
    model: &RotationModel,
    vehicle: &Vehicle,
    log: &InertialLog,
    window: &Range<f64>,
) -> Result<InertiaFit, FlightError> {
    let data = RotationData::new(axis, model, vehicle, log, window)?;
    let noticed = data
        .segment
        .inspect("gyroscope, rad/s,", |k| rate(axis, log, k))?;
    let mut fit = match model.delay {
        SensorDelay::Known(delay) => data.with_delay(axis, model, delay),
        SensorDelay::Identified => data.with_unknown_delay(axis, model),
    }?;
    fit.warnings.extend(noticed);
    Ok(fit)
}

/// The inertia as the reference identification finds it, kg m²: `M = I ω̇ + b` by least squares *on the moment*, no delay.
///
/// It takes ω̇ as exact and the moment as noisy. Where the residual is in ω̇, because the model misses some of it, the result is
/// too small by the factor R². Kept for comparison with the published numbers.
///
/// # Errors
/// As [`identify_inertia`].
pub fn inertia_by_moment_regression(
    axis: Axis,
    model: &RotationModel,
    vehicle: &Vehicle,
    log: &InertialLog,
    window: &Range<f64>,
) -> Result<Estimate, FlightError> {
    let segment = Segment::new(log, window, model.bin_s)?;
    let moments = moment(axis, model, vehicle, &segment);
    let start = segment.samples.start;
    let rates = segment.increments(|k| rate(axis, log, k));
    let lengths = segment.lengths();
    let means = segment.means(|k| moments[k - start]);
    let rows: Vec<Row<2>> = (0..means.len())
        .map(|k| Row {
            regressors: [rates[k] / lengths[k], 1.0],
            y: means[k],
        })
        .collect();
    let regressors: Vec<[f64; 2]> = rows.iter().map(|row| row.regressors).collect();
    Ok(linear(&rows)?.with_correlated_errors(&regressors).parameters[0])
}

fn rate(axis: Axis, log: &InertialLog, k: usize) -> f64 {
    match axis {
        Axis::Roll => log.body_rates[k].x,
        Axis::Pitch => log.body_rates[k].y,
    }
}

/// Moment of the rotors at each sample of a segment, N m, without delay.
fn moment(axis: Axis, model: &RotationModel, vehicle: &Vehicle, segment: &Segment<'_>) -> Vec<f64> {
    let arms = vehicle.hubs().map(|hub| match axis {
        Axis::Roll => -hub.y,
        Axis::Pitch => hub.x,
    });
    let thrusts = lagged_thrusts(model, segment);
    let sum = |thrusts: &[f64; 4]| thrusts.iter().zip(&arms).map(|(t, a)| t * a).sum();
    thrusts.iter().map(sum).collect()
}

/// Thrust of each rotor at each sample of a segment, N.
pub(super) fn lagged_thrusts(model: &RotationModel, segment: &Segment<'_>) -> Vec<[f64; 4]> {
    let time = &segment.log.time[segment.samples.clone()];
    let commands = &segment.log.commands[segment.samples.clone()];
    let drive = |c: f64| match model.lag_on {
        LagOn::Command => c,
        LagOn::Thrust => model.curve.thrust(c),
    };
    let mut state = commands[0].map(drive);
    let mut thrusts = Vec::with_capacity(time.len());
    for k in 0..time.len() {
        thrusts.push(match model.lag_on {
            LagOn::Command => state.map(|c| model.curve.thrust(c)),
            LagOn::Thrust => state,
        });
        if let Some(next) = time.get(k + 1) {
            let decay = decay(next - time[k], model.lag_s);
            for (state, c) in state.iter_mut().zip(commands[k]) {
                *state = lag_step(*state, drive(c), decay);
            }
        }
    }
    thrusts
}

/// A window, prepared.
struct RotationData<'a> {
    segment: Segment<'a>,
    lengths: Vec<f64>,
    /// Increments of the rate over the bins, rad/s, without what is slow.
    rate_increments: Vec<f64>,
    moment: Vec<f64>,
    /// Integral of the moment from the segment's start to each sample, N m s.
    impulse: Vec<f64>,
    /// Bins in the window that the slow motion is averaged over.
    slow_bins: usize,
}

impl<'a> RotationData<'a> {
    fn new(
        axis: Axis,
        model: &RotationModel,
        vehicle: &Vehicle,
        log: &'a InertialLog,
        window: &Range<f64>,
    ) -> Result<Self, FlightError> {
        super::positive("the motor lag, s,", model.lag_s)?;
        super::positive("the length of the bins, s,", model.bin_s)?;
        let segment = Segment::new(log, window, model.bin_s)?;
        let moment = moment(axis, model, vehicle, &segment);
        let time = &log.time[segment.samples.clone()];
        let mut impulse = vec![0.0];
        for k in 1..time.len() {
            let mean = 0.5 * (moment[k - 1] + moment[k]);
            impulse.push(impulse[k - 1] + mean * (time[k] - time[k - 1]));
        }
        let slow_bins = (model.slowest_s / model.bin_s).round() as usize;
        let increments = segment.increments(|k| rate(axis, log, k));
        Ok(Self {
            lengths: segment.lengths(),
            rate_increments: without_slow(&increments, slow_bins),
            moment,
            impulse,
            slow_bins,
            segment,
        })
    }

    /// Growth over each bin of a quantity of the samples as it was δ before.
    fn earlier(&self, values: &[f64], delay: f64) -> Vec<f64> {
        let (log, start) = (self.segment.log, self.segment.samples.start);
        let time = &log.time[self.segment.samples.clone()];
        self.segment
            .increments(|k| at(time, values, time[k - start] - delay))
    }

    /// `∫ M(t − δ) dt` over each bin, N m s, without what is slow.
    fn impulses(&self, delay: f64) -> Vec<f64> {
        without_slow(&self.earlier(&self.impulse, delay), self.slow_bins)
    }

    /// Its derivative with respect to δ: minus the growth of the moment over the bin.
    fn impulse_slopes(&self, delay: f64) -> Vec<f64> {
        let growth = without_slow(&self.earlier(&self.moment, delay), self.slow_bins);
        growth.iter().map(|g| -g).collect()
    }

    fn with_delay(&self, axis: Axis, model: &RotationModel, delay: f64) -> Result<InertiaFit, FlightError> {
        let impulses = self.impulses(delay);
        let rows: Vec<Row<1>> = impulses
            .iter()
            .zip(&self.rate_increments)
            .map(|(&j, &y)| Row { regressors: [j], y })
            .collect();
        let regressors: Vec<[f64; 1]> = rows.iter().map(|row| row.regressors).collect();
        let fit = linear(&rows)?.with_correlated_errors(&regressors);
        Ok(InertiaFit {
            axis,
            model: RotationModel {
                delay: SensorDelay::Known(delay),
                ..*model
            },
            inertia: inverse(fit.parameters[0])?,
            delay: Estimate::known(delay, 0.0),
            goodness: fit.goodness,
            warnings: fit.warnings,
        })
    }

    /// Gauss-Newton on δ: `Δω ≈ α J(δ₀) + (α dδ) J'(δ₀)` is linear in α = 1/I and α dδ.
    fn with_unknown_delay(&self, axis: Axis, model: &RotationModel) -> Result<InertiaFit, FlightError> {
        let mut delay = 0.0;
        let mut last = None;
        for _ in 0..DELAY_ITERATIONS {
            let (impulses, slopes) = (self.impulses(delay), self.impulse_slopes(delay));
            let rows: Vec<Row<2>> = (0..impulses.len())
                .map(|k| Row {
                    regressors: [impulses[k], slopes[k]],
                    y: self.rate_increments[k],
                })
                .collect();
            let fit = linear(&rows)?;
            let [inverse_inertia, product] = fit.values();
            let change = product / inverse_inertia;
            last = Some((fit, rows));
            if change.abs() < DELAY_TOLERANCE_S {
                break;
            }
            delay += change;
        }
        let (fit, rows) = last.ok_or(FlightError::NotPhysical {
            what: "delay, s,",
            value: delay,
        })?;
        let regressors: Vec<[f64; 2]> = rows.iter().map(|row| row.regressors).collect();
        let fit = fit.with_correlated_errors(&regressors);
        let [inverse_inertia, product] = fit.parameters;
        if !(0.0..0.1).contains(&delay) {
            return Err(FlightError::NotPhysical {
                what: "delay of the gyroscope, s,",
                value: delay,
            });
        }
        Ok(InertiaFit {
            axis,
            model: RotationModel {
                delay: SensorDelay::Known(delay),
                ..*model
            },
            inertia: inverse(inverse_inertia)?,
            delay: product.mapped(delay, 1.0 / inverse_inertia.value),
            goodness: fit.goodness,
            warnings: fit.warnings,
        })
    }
}

/// I from 1/I.
fn inverse(inverse_inertia: Estimate) -> Result<Estimate, FlightError> {
    let value = 1.0 / inverse_inertia.value;
    if value.is_finite() && value > 0.0 {
        Ok(inverse_inertia.mapped(value, value * value))
    } else {
        Err(FlightError::NotPhysical {
            what: "moment of inertia, kg m²,",
            value,
        })
    }
}
