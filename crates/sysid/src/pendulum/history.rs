//! A recorded angle history: can it be used, and where does a fit begin?

use super::{PendulumError, Suspension};
use crate::estimate::Warning;
use serde::{Deserialize, Serialize};

/// A sample of the angle: a row of a CSV file.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AngleSample {
    /// Time, s, from any origin.
    pub time_s: f64,
    /// Angle about the vertical, rad, from any origin within half a turn.
    pub angle_rad: f64,
}

/// What a look at the history tells.
pub(super) struct History {
    /// Middle of the swing, rad.
    pub(super) middle: f64,
    /// Mean period, s, and how many were seen.
    pub(super) period_s: f64,
    pub(super) periods: f64,
    /// Amplitudes of the half swings, rad, in order.
    pub(super) amplitudes: Vec<f64>,
    pub(super) warnings: Vec<Warning>,
}

/// Mean square of the steps over the variance from which no oscillation can be seen: eight samples a period, or a noise of
/// half the signal's deviation. 2 for noise alone.
const ROUGH: f64 = 0.5;
/// Band about the middle, in amplitudes of the record, that a passage must cross: noise makes no passages of its own.
const HYSTERESIS: f64 = 0.15;
/// Passages through the middle that a fit needs: one and a half periods.
const LEAST_CROSSINGS: usize = 4;
/// Periods below which damping and period are poorly distinguished.
const FEW_PERIODS: f64 = 5.0;
/// Steps longer than this many median steps are gaps.
const GAP: f64 = 1.5;

/// Checks a history.
pub(super) fn look(suspension: &Suspension, samples: &[AngleSample]) -> Result<History, PendulumError> {
    for (index, sample) in samples.iter().enumerate() {
        if !(sample.time_s.is_finite() && sample.angle_rad.is_finite()) {
            return Err(PendulumError::NotFinite { index });
        }
        if sample.angle_rad.abs() > std::f64::consts::PI {
            return Err(PendulumError::Angle {
                index,
                angle_rad: sample.angle_rad,
            });
        }
    }
    if let Some(i) = samples
        .windows(2)
        .position(|pair| pair[1].time_s <= pair[0].time_s)
    {
        return Err(PendulumError::TimeNotIncreasing {
            index: i + 1,
            before_s: samples[i].time_s,
            time_s: samples[i + 1].time_s,
        });
    }
    let angles: Vec<f64> = samples.iter().map(|s| s.angle_rad).collect();
    let roughness = roughness(&angles);
    if !(roughness > 0.0 && roughness < ROUGH) {
        return Err(PendulumError::NoOscillation { roughness });
    }
    let (low, high) = ends(&angles);
    let (middle, amplitude) = (0.5 * (low + high), 0.5 * (high - low));
    if amplitude >= suspension.limit() {
        return Err(PendulumError::BeyondStrings {
            amplitude_rad: amplitude,
            limit_rad: suspension.limit(),
        });
    }
    let crossings = crossings(samples, middle, HYSTERESIS * amplitude);
    if crossings.len() < LEAST_CROSSINGS {
        return Err(PendulumError::TooFewPeriods {
            crossings: crossings.len(),
        });
    }
    let span_s = crossings[crossings.len() - 1].time_s - crossings[0].time_s;
    // Counted by the usual half swing, so that passages inside a gap are not forgotten.
    let half_swings = (span_s / usual_half_swing_s(&crossings)).round();
    let (periods, period_s) = (0.5 * half_swings, 2.0 * span_s / half_swings);
    let amplitudes = crossings
        .windows(2)
        .map(|pair| &angles[pair[0].index..pair[1].index])
        .map(|half| half.iter().map(|a| (a - middle).abs()).fold(0.0, f64::max))
        .collect();
    let few = (periods < FEW_PERIODS).then_some(Warning::FewPeriods { periods });
    let saturated = [low, high]
        .into_iter()
        .filter_map(|limit| saturated(samples, limit, middle, period_s));
    Ok(History {
        middle,
        period_s,
        periods,
        amplitudes,
        warnings: few.into_iter().chain(gaps(samples)).chain(saturated).collect(),
    })
}

/// Von Neumann's ratio: mean square of the steps over the variance; 0 for a constant.
fn roughness(angles: &[f64]) -> f64 {
    let mean = angles.iter().sum::<f64>() / angles.len() as f64;
    let variance: f64 = angles.iter().map(|a| (a - mean).powi(2)).sum();
    let steps: f64 = angles.windows(2).map(|pair| (pair[1] - pair[0]).powi(2)).sum();
    if variance > 0.0 { steps / variance } else { 0.0 }
}

fn ends(angles: &[f64]) -> (f64, f64) {
    angles
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &a| {
            (low.min(a), high.max(a))
        })
}

/// A passage through the middle.
struct Crossing {
    /// Sample that completes it.
    index: usize,
    time_s: f64,
}

/// Passages from one side of the band about the middle to the other, each timed between the samples that bracket the middle.
fn crossings(samples: &[AngleSample], middle: f64, band: f64) -> Vec<Crossing> {
    let mut found = Vec::new();
    let mut side = 0.0;
    let mut last_on_side = 0;
    for (index, sample) in samples.iter().enumerate() {
        let departure = sample.angle_rad - middle;
        if departure * side > 0.0 || side == 0.0 {
            last_on_side = index;
        }
        if departure.abs() <= band || departure * side > 0.0 {
            continue;
        }
        if side != 0.0 {
            let (a, b) = (&samples[last_on_side], sample);
            let share = (middle - a.angle_rad) / (b.angle_rad - a.angle_rad);
            found.push(Crossing {
                index,
                time_s: a.time_s + share * (b.time_s - a.time_s),
            });
        }
        side = departure.signum();
        last_on_side = index;
    }
    found
}

/// Half the median time between two passages in the same direction, s.
fn usual_half_swing_s(crossings: &[Crossing]) -> f64 {
    let mut periods: Vec<f64> = crossings.windows(3).map(|c| c[2].time_s - c[0].time_s).collect();
    periods.sort_unstable_by(f64::total_cmp);
    0.5 * periods[periods.len() / 2]
}

fn gaps(samples: &[AngleSample]) -> Option<Warning> {
    let steps: Vec<f64> = samples.windows(2).map(|p| p[1].time_s - p[0].time_s).collect();
    let mut sorted = steps.clone();
    sorted.sort_unstable_by(f64::total_cmp);
    let usual = sorted[sorted.len() / 2];
    let long = steps.iter().filter(|step| **step > GAP * usual);
    let gaps = long.clone().count();
    let longest_s = long.copied().fold(0.0, f64::max);
    (gaps > 0).then_some(Warning::MissingSamples { gaps, longest_s })
}

/// Samples that sit at an end of the record for longer than a turning point explains.
///
/// A harmonic swing of amplitude A stays within one quantum q of its turning point for `2 √(2q/A)/ω`; the
/// quantum is taken as the smallest step of the record. Twice that is allowed, and three samples in any case.
fn saturated(samples: &[AngleSample], limit: f64, middle: f64, period_s: f64) -> Option<Warning> {
    let quantum = samples
        .windows(2)
        .map(|pair| (pair[1].angle_rad - pair[0].angle_rad).abs())
        .filter(|step| *step > 0.0)
        .fold(f64::INFINITY, f64::min);
    let allowed_s = 2.0 * (2.0 * quantum / (limit - middle).abs()).sqrt() * period_s / std::f64::consts::PI;
    let runs = samples.chunk_by(|a, b| a.angle_rad == b.angle_rad);
    let stuck = runs.filter(|run| {
        let stays_s = run[run.len() - 1].time_s - run[0].time_s;
        run[0].angle_rad == limit && run.len() > 3 && stays_s > allowed_s
    });
    let samples = stuck.map(<[AngleSample]>::len).sum();
    (samples > 0).then_some(Warning::Saturated { samples, limit })
}
