//! Tuning of the cascade by seeded optimisation, loop by loop as a practitioner does it.
//!
//! Order: attitude (a step in roll, position loops open, height and yaw held), yaw, height, position (a step
//! in x, all loops closed). Each flight takes a step and, later, a constant load at the input of the loop: lost
//! thrust, a moment, a tilted horizon; see [`TunedLoop::load`]. Reference model is the second-order response,
//! ζ = 1, of the loop's settling time τ, with `ω = 5.834/τ`: the speed that a dynamic inversion of the same
//! settling time is designed for, so that the two can be compared fairly. The cost is
//!
//! ```text
//! J = ∫ s ∣y_m − y∣/A ds  +  ∫ s ∣A − y∣/A ds  +  0.005 Σ ∣Δu_i∣/(4 u_h)  +  300 max(0, overshoot − 1 %)²
//!     step, 0 … 2τ           load, 2τ … 4τ        command activity           overshoot
//! ```
//!
//! with `s` the time since step or load over τ, `A` the step, `u_h` the hover command, `Δu_i` the change of a
//! command from one sample to the next. A flight that stops being finite costs 10⁶ and more, the more the sooner.
//!
//! Unknowns are the logarithms of the three gains over those that place the poles of `ÿ = u` at the reference
//! model's and at `−ω/2` ([`PidGains::placed`]): `k_p = 2ω²`, `k_d = 2.5ω`, `k_i = 0.5ω³`, with the set-point weight
//! ½ that makes the step of such a loop the reference model. The search moves them to what the rotors' lag, the
//! limits and the load leave best, in a box: factor 10 either way for `k_p` and `k_d`, 30 for `k_i`. Nelder-Mead
//! ([`optim::NelderMead`]) searches from a few starts drawn within a factor 4 by ChaCha8 (rand_chacha) seeded with [`TuningOptions::seed`], and once more from the
//! best end. The same options give the same gains to the last bit on the same build.

mod search;
mod trial;

use super::{PidGains, PidSettings};
use crate::controller::ControllerError;
use crate::settling::{self, LoopError};
use optim::{RunError, SetupError, StopReason};
use quad_dynamics::{BuildError, Level, Phenomenon, PhenomenonSet, Vehicle};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use std::fmt;

/// Pole of the integral in the gains before the search, in ω: an integral time `k_p/k_i` of 4/ω.
const INTEGRAL_POLE: f64 = 0.5;

/// The set-point weight that belongs to it, `ω²/k_p`.
const SET_POINT_WEIGHT: f64 = 1.0 / (1.0 + 2.0 * INTEGRAL_POLE);

/// Fewest and most samples of one flight that make sense.
const SAMPLES: [f64; 2] = [100.0, 1e6];

/// A loop of the cascade, in the order of tuning.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TunedLoop {
    /// Roll and pitch, tuned in roll.
    Attitude,
    /// Yaw.
    Yaw,
    /// Height.
    Height,
    /// Horizontal position, tuned in x.
    Position,
}

/// How fast a loop is to be, and the step it is judged by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopTarget {
    /// Settling time τ of the reference model to 2 %, s.
    pub settling_time_s: f64,
    /// Step A, rad (attitude, yaw) or m (height, counted upwards; position).
    pub step: f64,
}

/// What is tuned, on what, and how long.
#[derive(Clone, Debug, PartialEq)]
pub struct TuningOptions {
    /// Level of the model.
    pub level: Level,
    /// Its phenomena. With input limits the controller knows them too, for its anti-windup.
    pub phenomena: PhenomenonSet,
    /// Target of roll and pitch; the step in rad.
    pub attitude: LoopTarget,
    /// Target of yaw; the step in rad.
    pub yaw: LoopTarget,
    /// Target of height; the step in m.
    pub height: LoopTarget,
    /// Target of horizontal position; the step in m.
    pub position: LoopTarget,
    /// Bandwidth N of the derivative filters, rad/s; not tuned.
    pub filter_bandwidth_rad_s: f64,
    /// Largest demanded tilt, rad; not tuned.
    pub tilt_limit_rad: f64,
    /// Rate `k_w` of the back-calculation, 1/s; not tuned.
    pub anti_windup_per_s: f64,
    /// Set-point weight `b`; not tuned.
    pub set_point_weight: f64,
    /// Time between two samples, s; the model takes one RK4 step between them.
    pub step_s: f64,
    /// Seed of the starts.
    pub seed: u64,
    /// Random starts per loop; one more follows from the best end.
    pub starts: usize,
    /// Most flights per start.
    pub flights: u64,
}

impl Default for TuningOptions {
    /// Level 3 with input limits; settling times 0.8, 2, 2 and 5 s, steps of 0.1 rad, 1 rad, 1 m and 1 m.
    ///
    /// The attitude loop's 0.8 s is `ω` = 7.3 rad/s: half the bandwidth of 15 rad/s of the nominal vehicle's rotors,
    /// of which PID knows nothing, and six times the position loop's.
    fn default() -> Self {
        let target = |settling_time_s, step| LoopTarget {
            settling_time_s,
            step,
        };
        Self {
            level: Level::Three,
            phenomena: Level::Three.phenomena().with(Phenomenon::InputLimits),
            attitude: target(0.8, 0.1),
            yaw: target(2.0, 1.0),
            height: target(2.0, 1.0),
            position: target(5.0, 1.0),
            filter_bandwidth_rad_s: 100.0,
            tilt_limit_rad: std::f64::consts::FRAC_PI_6,
            anti_windup_per_s: 2.0,
            set_point_weight: SET_POINT_WEIGHT,
            step_s: 0.002,
            seed: 1,
            starts: 3,
            flights: 200,
        }
    }
}

/// Gains found, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct Tuned {
    /// The controller's settings.
    pub settings: PidSettings,
    /// One report per loop, in the order of tuning.
    pub loops: Vec<LoopReport>,
}

/// How the search for one loop's gains went.
#[derive(Clone, Debug, PartialEq)]
pub struct LoopReport {
    /// The loop.
    pub tuned: TunedLoop,
    /// Gains found.
    pub gains: PidGains,
    /// Their cost J.
    pub cost: f64,
    /// Cost of the placed gains, which need no search.
    pub cost_before: f64,
    /// One report per start, the last being that from the best end.
    pub starts: Vec<StartReport>,
    /// Best cost so far after each flight, over all starts.
    pub history: Vec<f64>,
}

/// How one start ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StartReport {
    /// Best cost.
    pub cost: f64,
    /// Flights flown.
    pub evaluations: u64,
    /// Why it stopped.
    pub stop: StopReason,
}

/// A tuning that can't be done.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TuningError {
    /// No start or no flight.
    #[error("tuning option `{key}` must be at least 1, got 0")]
    Nothing {
        /// Which.
        key: &'static str,
    },
    /// A step that is zero, NaN or infinite.
    #[error("tuning option `{tuned}.step` must be finite and not zero, got {step}")]
    Step {
        /// The loop.
        tuned: TunedLoop,
        /// What it was.
        step: f64,
    },
    /// A sampling time that a flight of 4τ can't have.
    #[error(
        "tuning option `step_s`: a flight of the {tuned} loop needs 100 to 1e6 samples, got {samples} from {step_s} s"
    )]
    Sampling {
        /// The loop.
        tuned: TunedLoop,
        /// The sampling time, s.
        step_s: f64,
        /// How many samples that would be.
        samples: f64,
    },
    /// A settling time that is not positive and finite.
    #[error("tuning option `{tuned}.settling_time_s`: {source}")]
    Settling {
        /// The loop.
        tuned: TunedLoop,
        /// Why.
        source: LoopError,
    },
    /// The model can't be built.
    #[error(transparent)]
    Model(#[from] BuildError),
    /// The controller can't be built.
    #[error(transparent)]
    Controller(#[from] ControllerError),
    /// The simplex refused its start.
    #[error(transparent)]
    Simplex(#[from] SetupError),
    /// The search has no result.
    #[error(transparent)]
    Search(#[from] RunError),
}

impl TunedLoop {
    /// All, in the order of tuning.
    pub const ALL: [Self; 4] = [Self::Attitude, Self::Yaw, Self::Height, Self::Position];

    /// The load on the loop in the second half of a flight: a tenth of the acceleration `ω² A` with which the
    /// reference model starts, against the step.
    pub const fn load(self) -> &'static str {
        match self {
            Self::Attitude => "a constant moment about the roll axis, as of a load off the centre",
            Self::Yaw => "a constant moment about the yaw axis, as of a twisted rotor",
            Self::Height => "thrust lost, as of a battery that sags",
            Self::Position => "a pitch measured wrong, as of a tilted sensor, or a steady wind",
        }
    }

    /// The gains of this loop.
    fn gains_mut(self, settings: &mut PidSettings) -> &mut PidGains {
        match self {
            Self::Attitude => &mut settings.attitude,
            Self::Yaw => &mut settings.yaw,
            Self::Height => &mut settings.height,
            Self::Position => &mut settings.position,
        }
    }
}

impl fmt::Display for TunedLoop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Attitude => "attitude",
            Self::Yaw => "yaw",
            Self::Height => "height",
            Self::Position => "position",
        })
    }
}

impl TuningOptions {
    /// The target of a loop.
    pub fn target(&self, tuned: TunedLoop) -> LoopTarget {
        match tuned {
            TunedLoop::Attitude => self.attitude,
            TunedLoop::Yaw => self.yaw,
            TunedLoop::Height => self.height,
            TunedLoop::Position => self.position,
        }
    }

    /// Natural frequency ω of a loop's reference model, rad/s.
    fn frequency(&self, tuned: TunedLoop) -> Result<f64, TuningError> {
        settling::natural_frequency(self.target(tuned).settling_time_s, 1.0)
            .map_err(|source| TuningError::Settling { tuned, source })
    }

    /// Checks everything that the models and the controller don't check themselves.
    fn check(&self) -> Result<(), TuningError> {
        for (key, nothing) in [("starts", self.starts == 0), ("flights", self.flights == 0)] {
            if nothing {
                return Err(TuningError::Nothing { key });
            }
        }
        for tuned in TunedLoop::ALL {
            let LoopTarget {
                settling_time_s,
                step,
            } = self.target(tuned);
            if !step.is_finite() || step == 0.0 {
                return Err(TuningError::Step { tuned, step });
            }
            self.frequency(tuned)?;
            let (step_s, samples) = (self.step_s, trial::FLIGHT * settling_time_s / self.step_s);
            if !(SAMPLES[0]..=SAMPLES[1]).contains(&samples) {
                return Err(TuningError::Sampling {
                    tuned,
                    step_s,
                    samples,
                });
            }
        }
        Ok(())
    }

    /// Settings with placed gains everywhere.
    fn before(&self) -> Result<PidSettings, TuningError> {
        let gains = |tuned| -> Result<PidGains, TuningError> {
            let omega = self.frequency(tuned)?;
            Ok(PidGains::placed(omega, INTEGRAL_POLE * omega))
        };
        Ok(PidSettings {
            height: gains(TunedLoop::Height)?,
            yaw: gains(TunedLoop::Yaw)?,
            position: gains(TunedLoop::Position)?,
            attitude: gains(TunedLoop::Attitude)?,
            filter_bandwidth_rad_s: self.filter_bandwidth_rad_s,
            tilt_limit_rad: self.tilt_limit_rad,
            anti_windup_per_s: self.anti_windup_per_s,
            set_point_weight: self.set_point_weight,
        })
    }
}

/// Gains for a vehicle by optimisation on a model of it; see the head of this file for what is minimised.
///
/// # Errors
/// Options that make no tuning; a model or a controller that can't be built. A search that spent its
/// flights is no error: see [`StartReport::stop`].
pub fn tune(vehicle: &Vehicle, options: &TuningOptions) -> Result<Tuned, TuningError> {
    options.check()?;
    let mut settings = options.before()?;
    let mut generator = ChaCha8Rng::seed_from_u64(options.seed);
    let mut loops = Vec::with_capacity(TunedLoop::ALL.len());
    for tuned in TunedLoop::ALL {
        let bench = trial::Bench::new(vehicle, options, tuned, &settings)?;
        let report = search::search(&bench, options, tuned, &settings, &mut generator)?;
        *tuned.gains_mut(&mut settings) = report.gains;
        loops.push(report);
    }
    Ok(Tuned { settings, loops })
}

#[cfg(test)]
mod tests;
