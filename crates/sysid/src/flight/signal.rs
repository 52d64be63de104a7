//! Series of a flight: lag and delay of commands, bins, removal of what is slow.

use super::FlightError;
use crate::estimate::Warning;
use crate::measurement::watch::{Saturation, saturation};
use crate::recorded::InertialLog;
use crate::validation::{Agreement, AgreementError};
use quad_math::{Real, constant};
use std::ops::Range;

/// How long before a window the lag is run in, s: more than ten times the lag of any motor here.
const RUN_IN_S: f64 = 1.0;

/// Fewest bins that an identification accepts: one second at 100 Hz.
const FEWEST_BINS: usize = 100;

/// A step in time counts as a gap from this multiple of the median step: two samples lost.
const GAP_FROM: f64 = 2.5;

/// A window of a log, cut into bins.
pub(super) struct Segment<'a> {
    pub(super) log: &'a InertialLog,
    /// Samples from the start of the run-in to the end of the last bin, which belongs to them.
    pub(super) samples: Range<usize>,
    /// Edges of the bins, as samples: bin k is `edges[k]..edges[k + 1]`.
    pub(super) edges: Vec<usize>,
}

/// A measured and a predicted series.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Time, s.
    pub time: Vec<f64>,
    /// Measured.
    pub measured: Vec<f64>,
    /// Predicted.
    pub predicted: Vec<f64>,
}

impl Comparison {
    /// How well they agree.
    ///
    /// # Errors
    /// As [`Agreement::of`].
    pub fn agreement(&self) -> Result<Agreement, AgreementError> {
        Agreement::of(&self.measured, &self.predicted)
    }
}

impl<'a> Segment<'a> {
    /// The window `from..to`, s, in bins of a length, s.
    pub(super) fn new(log: &'a InertialLog, window: &Range<f64>, bin_s: f64) -> Result<Self, FlightError> {
        let (from, to) = (window.start, window.end);
        let inside = log.window(from, to);
        let ends = log.time.first().zip(log.time.last());
        let (first, last) = ends.map_or((f64::NAN, f64::NAN), |(a, b)| (*a, *b));
        let too_few = |samples| FlightError::TooFewSamples {
            from,
            to,
            samples,
            first,
            last,
        };
        if inside.is_empty() {
            return Err(too_few(0));
        }
        let mut edges = vec![inside.start];
        let mut next = log.time[inside.start] + bin_s;
        for k in inside.clone() {
            // Half a nanosecond of rounding in the sums of bins must not make a bin one sample longer.
            if log.time[k] >= next - 5e-10 {
                edges.push(k);
                next = (next + bin_s).max(log.time[k] + 0.5 * bin_s);
            }
        }
        if edges.len() <= FEWEST_BINS {
            return Err(too_few(inside.len()));
        }
        let end = edges[edges.len() - 1];
        let start = log.window(from - RUN_IN_S, from).start.min(inside.start);
        let segment = Self {
            log,
            samples: start..end + 1,
            edges,
        };
        segment.refuse_constant_commands(window)?;
        Ok(segment)
    }

    fn refuse_constant_commands(&self, window: &Range<f64>) -> Result<(), FlightError> {
        for motor in 0..4 {
            let mut commands = self.log.commands[self.samples.clone()].iter().map(|c| c[motor]);
            let first = commands.next().unwrap_or(0.0);
            if commands.all(|c| c == first) {
                return Err(FlightError::ConstantInput {
                    motor: motor + 1,
                    value: first,
                    from: window.start,
                    to: window.end,
                });
            }
        }
        Ok(())
    }

    /// What a reader must know of the window: gaps in time, and a sensor that sat at an end of its range.
    ///
    /// # Errors
    /// A sensor that never changed.
    pub(super) fn inspect(
        &self,
        sensor: &'static str,
        reading: impl Fn(usize) -> f64,
    ) -> Result<Vec<Warning>, FlightError> {
        let readings: Vec<f64> = self.samples.clone().map(reading).collect();
        if readings.iter().all(|r| *r == readings[0]) {
            return Err(FlightError::ConstantSensor {
                sensor,
                value: readings[0],
            });
        }
        let mut steps: Vec<f64> = self.log.time[self.samples.clone()]
            .windows(2)
            .map(|t| t[1] - t[0])
            .collect();
        steps.sort_by(f64::total_cmp);
        let longest_regular = GAP_FROM * steps[steps.len() / 2];
        let gaps = steps.iter().filter(|step| **step > longest_regular).count();
        let mut warnings = Vec::new();
        if gaps > 0 {
            let longest_s = steps[steps.len() - 1];
            warnings.push(Warning::Gaps { gaps, longest_s });
        }
        if let Some(Saturation { limit, samples }) = saturation(&readings) {
            warnings.push(Warning::Saturated { samples, limit });
        }
        Ok(warnings)
    }

    /// The bins as ranges of samples.
    pub(super) fn bins(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        self.edges.windows(2).map(|pair| pair[0]..pair[1])
    }

    /// Middle of each bin, s.
    pub(super) fn times(&self) -> Vec<f64> {
        let time = &self.log.time;
        self.bins()
            .map(|bin| 0.5 * (time[bin.start] + time[bin.end]))
            .collect()
    }

    /// Length of each bin, s.
    pub(super) fn lengths(&self) -> Vec<f64> {
        let time = &self.log.time;
        self.bins().map(|bin| time[bin.end] - time[bin.start]).collect()
    }

    /// Mean of a quantity of the samples over each bin.
    pub(super) fn means(&self, value: impl Fn(usize) -> f64) -> Vec<f64> {
        let mean = |bin: Range<usize>| {
            let count = bin.len() as f64;
            bin.map(&value).sum::<f64>() / count
        };
        self.bins().map(mean).collect()
    }

    /// Growth of a quantity of the samples over each bin.
    pub(super) fn increments(&self, value: impl Fn(usize) -> f64) -> Vec<f64> {
        self.bins().map(|bin| value(bin.end) - value(bin.start)).collect()
    }
}

/// One step of a first-order lag with the input held, exact: `y ← u + (y − u) e^{−h/τ}`, with `decay = e^{−h/τ}`.
pub(super) fn lag_step<R: Real>(y: R, u: f64, decay: R) -> R {
    let u = constant::<R>(u);
    u + (y - u) * decay
}

/// `e^{−h/τ}`.
pub(super) fn decay<R: Real>(step_s: f64, lag_s: R) -> R {
    (-constant::<R>(step_s) / lag_s).simd_exp()
}

/// A sampled quantity at any time, linear between samples and held before the first and after the last.
pub(super) fn at(time: &[f64], values: &[f64], t: f64) -> f64 {
    let next = time.partition_point(|&s| s <= t);
    if next == 0 {
        return values[0];
    }
    if next == time.len() {
        return values[next - 1];
    }
    let share = (t - time[next - 1]) / (time[next] - time[next - 1]);
    values[next - 1] + share * (values[next] - values[next - 1])
}

/// The series less its mean over a centred window of so many values; shorter at the ends.
pub(super) fn without_slow(values: &[f64], window: usize) -> Vec<f64> {
    let mut sums = vec![0.0];
    for v in values {
        sums.push(sums[sums.len() - 1] + v);
    }
    let reach = window / 2;
    (0..values.len())
        .map(|k| {
            // As far on one side as on the other, so that the window stays centred.
            let reach = reach.min(k).min(values.len() - 1 - k);
            let (from, to) = (k - reach, k + reach + 1);
            values[k] - (sums[to] - sums[from]) / (to - from) as f64
        })
        .collect()
}
