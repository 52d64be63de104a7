//! The pendulum tests of this chapter: swings and timings in the virtual laboratory, and published timings.

use crate::item::ItemError;
use quad_dynamics::Vehicle;
use sysid::estimate::Estimate;
use sysid::laboratory::generator;
use sysid::laboratory::pendulum::{Axis, PendulumRig};
use sysid::pendulum::{AngleSample, Damping, Suspension, SwingFit, Timing, fit_history, from_timings};

/// Seed of a pendulum test: one for each axis and repetition.
pub(super) const fn seed(axis: Axis, repetition: u64) -> u64 {
    40 + axis as u64 + 100 * repetition
}

/// Seeds of the timings beyond those of the swings.
const TIMING_SEED: u64 = 10_000;
/// Angle of release for the small-angle law, rad; at 3° it is wrong by less than a thousandth.
const SMALL_RAD: f64 = 0.05;
/// Periods of a timing, and timings of a test.
const PERIODS: u32 = 20;
const TIMINGS: u32 = 4;

/// A swing about an axis and the equation fitted to it.
pub(super) struct Swing {
    pub(super) samples: Vec<AngleSample>,
    pub(super) fit: SwingFit,
}

/// Lets the vehicle swing and fits the equation.
pub(super) fn swing(
    vehicle: &Vehicle,
    rig: &PendulumRig,
    axis: Axis,
    repetition: u64,
) -> Result<Swing, ItemError> {
    let samples = rig.swing(vehicle, axis, &mut generator(seed(axis, repetition)))?;
    let fit = fit_history(&rig.suspension(vehicle), &samples, Damping::ViscousAndQuadratic)?;
    Ok(Swing { samples, fit })
}

/// A way to a moment of inertia, kg m², of a repetition of the test about an axis.
pub(super) type Method = fn(&Vehicle, Axis, u64) -> Result<Estimate, ItemError>;

/// By the equation fitted to a swing.
pub(super) fn fitted(vehicle: &Vehicle, axis: Axis, repetition: u64) -> Result<Estimate, ItemError> {
    Ok(swing(vehicle, &PendulumRig::default(), axis, repetition)?
        .fit
        .inertia)
}

/// By the small-angle law and a stopwatch.
pub(super) fn timed(vehicle: &Vehicle, axis: Axis, repetition: u64) -> Result<Estimate, ItemError> {
    let rig = PendulumRig {
        release_rad: SMALL_RAD,
        ..PendulumRig::default()
    };
    let mut random = generator(TIMING_SEED + seed(axis, repetition));
    let timings = rig.timings(vehicle, axis, PERIODS, TIMINGS, &mut random)?;
    Ok(from_timings(&rig.suspension(vehicle), &timings)?.inertia)
}

/// Share of `repetitions` further tests about each axis whose interval contains the vehicle's own moment of inertia.
pub(super) fn coverage(vehicle: &Vehicle, method: Method, repetitions: u64) -> Result<f64, ItemError> {
    let mut hits = 0_u32;
    for axis in Axis::ALL {
        for repetition in 1..=repetitions {
            let interval = method(vehicle, axis, repetition)?.interval();
            hits += u32::from(interval.contains(axis.inertia(vehicle)));
        }
    }
    Ok(f64::from(hits) / (3 * repetitions) as f64)
}

/// Real timings of 20 periods of a quadcopter of 0.958 kg on strings 0.235 m from its axis, and what was published from them:
/// marcv81, *Moment of inertia*, 2014-10-09.
pub(super) struct Published {
    pub(super) name: &'static str,
    length_m: f64,
    durations_s: &'static [f64],
    /// Moment of inertia, kg m².
    pub(super) inertia: f64,
}

/// The timings of both axes.
pub(super) const PUBLISHED: [Published; 2] = [
    Published {
        name: "*I*_{xx}, *I*_{yy}, **measured** on another quadcopter",
        length_m: 0.51,
        durations_s: &[13.312, 13.143, 13.144, 13.077],
        inertia: 0.0112,
    },
    Published {
        name: "*I*_{zz}, **measured** on another quadcopter",
        length_m: 0.70,
        durations_s: &[20.638, 20.570, 20.574],
        inertia: 0.0199,
    },
];

impl Published {
    /// The moment of inertia by the small-angle law.
    pub(super) fn timed(&self) -> Result<Estimate, ItemError> {
        let suspension = Suspension {
            mass_kg: 0.958,
            half_spacing_m: 0.235,
            length_m: self.length_m,
            gravity_m_s2: 9.81,
        };
        let timing = |&duration_s: &f64| Timing {
            periods: PERIODS,
            duration_s,
        };
        let timings: Vec<Timing> = self.durations_s.iter().map(timing).collect();
        Ok(from_timings(&suspension, &timings)?.inertia)
    }
}
