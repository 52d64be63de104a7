//! All filters over all flights: what the figure and the table share.

use super::flight::{Eyes, Told, Truth, filter, first, noise};
use super::sums::Sums;
use crate::item::{Context, ItemError};
use crate::vehicle::{NOMINAL_VEHICLE, load_vehicle};
use quad_dynamics::{Level, Vehicle};
use quad_estimation::sensor::Quality;
use quad_estimation::{ProcessNoise, Spread, UnscentedFilter};
use rayon::prelude::*;
use std::sync::{Arc, Mutex, PoisonError};

/// Flights that are compared, and fewer of them for the unscented filter and in the loop.
const SEEDS: u64 = 4;
const FEW: u64 = 1;
/// A flight of its own to choose the process noise on.
const TRAINING_SEED: u64 = 1000;
/// Factors tried on the noise of the disturbance, then on that of the rates.
const FACTORS: [f64; 4] = [1.0, 3.0, 10.0, 30.0];

/// Which kind of filter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum KindOfFilter {
    Extended,
    Unscented,
}

/// A filter's errors over the flights of one quality of sensors.
#[derive(Clone, Debug)]
pub(super) struct Row {
    pub(super) quality: Quality,
    pub(super) level: Level,
    pub(super) kind: KindOfFilter,
    /// Of rates and disturbance, times that of the truth.
    pub(super) factors: [f64; 2],
    /// Root mean squares of position, m, velocity, m/s, tilt and heading, rad.
    pub(super) errors: [f64; 4],
    /// NEES of the rigid body at the end, summed over so many flights.
    pub(super) nees: f64,
    pub(super) flights: u64,
    pub(super) told: Told,
}

/// Tracking errors over the second half, m, with the truth and with level 5's estimate in the loop.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tracking {
    pub(super) quality: Quality,
    pub(super) by_truth: f64,
    pub(super) by_estimate: f64,
}

/// Everything.
#[derive(Debug)]
pub(super) struct Study {
    pub(super) rows: Vec<Row>,
    pub(super) tracking: Vec<Tracking>,
}

static STUDY: Mutex<Option<Arc<Study>>> = Mutex::new(None);

impl Study {
    /// The study, made once.
    pub(super) fn of(context: &Context) -> Result<Arc<Self>, ItemError> {
        let mut made = STUDY.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(study) = &*made {
            return Ok(Arc::clone(study));
        }
        let study = Arc::new(Self::make(&load_vehicle(context, NOMINAL_VEHICLE)?)?);
        *made = Some(Arc::clone(&study));
        Ok(study)
    }

    fn make(vehicle: &Vehicle) -> Result<Self, ItemError> {
        let mut study = Self {
            rows: Vec::new(),
            tracking: Vec::new(),
        };
        for quality in Quality::ALL {
            let fly = |seed| Truth::fly(vehicle, quality, seed, Eyes::Truth);
            let training = fly(TRAINING_SEED)?;
            let flights: Vec<Truth> = (0..SEEDS).map(fly).collect::<Result<_, _>>()?;
            let extended = |level| row(vehicle, quality, level, &training, &flights);
            let rows: Result<Vec<Row>, ItemError> = Level::ALL.into_par_iter().map(extended).collect();
            study.rows.extend(rows?);
            study
                .rows
                .push(unscented(vehicle, quality, &flights[..FEW as usize])?);
            let in_loop = |eyes| -> Result<f64, ItemError> {
                let squares = (0..FEW).map(|seed| {
                    let error = Truth::fly(vehicle, quality, seed, eyes)?.tracking_m()?;
                    Ok::<f64, ItemError>(error * error)
                });
                let sum: f64 = squares.sum::<Result<f64, _>>()?;
                Ok((sum / FEW as f64).sqrt())
            };
            study.tracking.push(Tracking {
                quality,
                by_truth: in_loop(Eyes::Truth)?,
                by_estimate: in_loop(Eyes::Filter(Level::Five))?,
            });
        }
        Ok(study)
    }

    /// The extended filter's row.
    pub(super) fn extended(&self, quality: Quality, level: Level) -> Result<&Row, ItemError> {
        let wanted = |r: &&Row| r.quality == quality && r.level == level && r.kind == KindOfFilter::Extended;
        let found = self.rows.iter().find(wanted);
        found.ok_or_else(|| ItemError::new(format!("{level} in {} sensors was not run", quality.name())))
    }
}

fn scaled(quality: Quality, [rates, disturbance]: [f64; 2]) -> ProcessNoise {
    let own = noise(quality);
    ProcessNoise {
        rates: rates * own.rates,
        disturbance: disturbance * own.disturbance,
        velocity: disturbance * own.velocity,
        ..own
    }
}

/// The process noise that makes the readings of the training flight likeliest; the truth's own for its own level.
fn tuned(vehicle: &Vehicle, quality: Quality, level: Level, training: &Truth) -> Result<[f64; 2], ItemError> {
    let mut best = [1.0; 2];
    if level == Level::Five {
        return Ok(best);
    }
    let mut likeliest = f64::NEG_INFINITY;
    for which in [1, 0] {
        for factor in FACTORS {
            let mut tried = best;
            tried[which] = factor;
            if tried == best && likeliest.is_finite() {
                continue;
            }
            let filter = filter(vehicle, level, scaled(quality, tried), quality, training)?;
            let memory_ns = quality.suite().longest_delay_ns();
            // A filter that diverges with this noise is no candidate.
            let told = training.filtered(filter, memory_ns, usize::MAX, |_, _, _| ());
            if let Ok(told) = told
                && told.log_likelihood > likeliest
            {
                (likeliest, best) = (told.log_likelihood, tried);
            }
        }
    }
    Ok(best)
}

fn row(
    vehicle: &Vehicle,
    quality: Quality,
    level: Level,
    training: &Truth,
    flights: &[Truth],
) -> Result<Row, ItemError> {
    let factors = tuned(vehicle, quality, level, training)?;
    let mut sums = Sums::new(quality, level, KindOfFilter::Extended, factors);
    for truth in flights {
        let filter = filter(vehicle, level, scaled(quality, factors), quality, truth)?;
        sums.add(truth, filter);
    }
    Ok(sums.finished())
}

fn unscented(vehicle: &Vehicle, quality: Quality, flights: &[Truth]) -> Result<Row, ItemError> {
    let mut sums = Sums::new(quality, Level::Five, KindOfFilter::Unscented, [1.0; 2]);
    for truth in flights {
        let (start, input) = truth.told();
        let (process, belief) = first(vehicle, Level::Five, noise(quality), quality, start, input)?;
        let filter = UnscentedFilter::new(process, belief, Spread::default())?;
        sums.add(truth, filter);
    }
    Ok(sums.finished())
}
