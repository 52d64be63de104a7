//! Flights of the truth, level 5 with noise, seen through sensors of some quality; and filters over them.

use crate::figures::{flight_settings, path_waypoints};
use crate::item::ItemError;
use nalgebra::{DVector, Vector3};
use quad_dynamics::{AnyQuadrotor, CommandLimits, Input, Level, RigidBodyState, Snapshot, Vehicle};
use quad_estimation::sensor::{Measurement, Quality};
use quad_estimation::{
    Belief, Estimate, Estimator, ExtendedFilter, Filter, InitialUncertainty, LevelProcess, Process,
    ProcessNoise,
};
use quad_ndi::{AnyController, C3, Reference, TiltLaw, Trajectory};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

/// Step of controller, truth and filters: that of the inertial unit.
const STEP_NS: u64 = 10_000_000;
pub(super) const STEP_S: f64 = 0.01;
/// Most of the trajectory.
const STEPS: u64 = 1000;
/// How far above the trajectory of figure 6.17 it is flown, m, within a sonar's range.
const ABOVE_M: f64 = 1.0;

/// An instant of the truth.
pub(super) struct Instant {
    pub(super) body: RigidBodyState<f64>,
    /// Held up to this instant.
    input: Input<f64>,
    /// Arrived at this instant.
    measurements: Vec<Measurement>,
}

/// A flight of the truth.
pub(super) struct Truth {
    start: Snapshot<f64>,
    input: Input<f64>,
    pub(super) instants: Vec<Instant>,
}

/// Who sees what: the controller flies by the truth, or by a filter on a level.
#[derive(Clone, Copy)]
pub(super) enum Eyes {
    Truth,
    Filter(Level),
}

/// What disturbs the truth; biases drift as the sensors' do.
pub(super) fn noise(quality: Quality) -> ProcessNoise {
    ProcessNoise::default().with_drifts_of(&quality.sensors())
}

fn uncertainty(quality: Quality) -> InitialUncertainty {
    InitialUncertainty::default().with_biases_of(&quality.sensors())
}

fn normals(n: usize, random: &mut ChaCha8Rng) -> DVector<f64> {
    DVector::from_fn(n, |_, _| StandardNormal.sample(random))
}

/// Errors of the process without its last six, the biases: those are the sensors' own.
fn without_biases(mut errors: DVector<f64>) -> DVector<f64> {
    let n = errors.len();
    errors.rows_mut(n - 6, 6).fill(0.0);
    errors
}

/// A filter on a level with its process noise.
pub(super) fn filter(
    vehicle: &Vehicle,
    level: Level,
    noise: ProcessNoise,
    quality: Quality,
    truth: &Truth,
) -> Result<ExtendedFilter<LevelProcess>, ItemError> {
    let (process, belief) = first(vehicle, level, noise, quality, &truth.start, &truth.input)?;
    Ok(ExtendedFilter::new(process, belief)?)
}

/// The process of a level and its first belief.
pub(super) fn first(
    vehicle: &Vehicle,
    level: Level,
    noise: ProcessNoise,
    quality: Quality,
    start: &Snapshot<f64>,
    input: &Input<f64>,
) -> Result<(LevelProcess, Belief), ItemError> {
    let process = LevelProcess::new(level, vehicle, &level.phenomena(), noise)?;
    let belief = process.belief(start, input, &uncertainty(quality))?;
    Ok((process, belief))
}

impl Truth {
    /// The initial estimate of any filter.
    pub(super) fn told(&self) -> (&Snapshot<f64>, &Input<f64>) {
        (&self.start, &self.input)
    }

    /// Flies the trajectory, the controller looking through these eyes.
    pub(super) fn fly(vehicle: &Vehicle, quality: Quality, seed: u64, eyes: Eyes) -> Result<Self, ItemError> {
        let waypoints: Vec<_> = path_waypoints()?
            .into_iter()
            .map(|mut w| {
                w.position_m[2] -= ABOVE_M;
                w
            })
            .collect();
        let path = Trajectory::through(&waypoints)?;
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let phenomena = Level::Five.phenomena();
        let at = Vector3::new(0.0, 0.0, -ABOVE_M);
        let hover = AnyQuadrotor::hovering(Level::Five, vehicle, &phenomena, at, 0.0)?;
        let mut input = hover.hover_input();
        let start = hover.snapshot(&input);
        let (mut process, belief) = first(vehicle, Level::Five, noise(quality), quality, &start, &input)?;
        let n = process.error_len();
        let spread = belief.covariance.diagonal().map(f64::sqrt);
        let drawn = without_biases(spread.component_mul(&normals(n, &mut random)));
        let mut x = process.retract(&belief.mean, &drawn);
        let suite = quality.suite();
        let mut sensors = suite.turned_on(&mut random);
        let mut truth = Self {
            start,
            input,
            instants: Vec::new(),
        };
        let mut eye = match eyes {
            Eyes::Truth => None,
            Eyes::Filter(level) => {
                let filter = filter(vehicle, level, noise(quality), quality, &truth)?;
                Some(Estimator::new(filter, input, suite.longest_delay_ns() + STEP_NS))
            }
        };
        // Only level 5 knows the limits: no command may be beyond them, or the others would predict what can't be.
        let limits = Some(CommandLimits::of(vehicle));
        let mut pilot = AnyController::C3(C3::new(vehicle, &flight_settings()?)?.into()).with_limits(limits);
        let per_step = process.process_noise(STEP_S).map(f64::sqrt);
        for k in 1..=STEPS {
            let flat = path.flat_output((k - 1) as f64 * STEP_S);
            let reference = Reference::following(flat, vehicle.environment.gravity, TiltLaw::Exact);
            let flight = match &mut eye {
                None => process.model_at(&x).flight(),
                Some(eye) => {
                    let mean = eye.filter().belief().mean.clone();
                    eye.filter_mut().process_mut().model_at(&mean).flight()
                }
            };
            input.commands = pilot.update(&flight, &reference, STEP_S);
            let moved = process.transition(&x, &input, STEP_S);
            let pushed = without_biases(per_step.component_mul(&normals(n, &mut random)));
            x = process.retract(&moved, &pushed);
            let seen = process.seen(&x, &input);
            let measurements = suite.sample(&mut sensors, k * STEP_NS, &seen, &mut random);
            if let Some(eye) = &mut eye {
                eye.predict(&input, k * STEP_NS)?;
                measurements.iter().try_for_each(|m| eye.update(m).map(|_| ()))?;
            }
            let body = process.model_at(&x).snapshot(&input).body;
            truth.instants.push(Instant {
                body,
                input,
                measurements,
            });
        }
        Ok(truth)
    }

    /// Root mean square of the distance from the trajectory over the second half, m.
    pub(super) fn tracking_m(&self) -> Result<f64, ItemError> {
        let path = Trajectory::through(&path_waypoints()?)?;
        let half = self.instants.len() / 2;
        let squares = |(k, instant): (usize, &Instant)| {
            let mut at = path.flat_output((k + 1) as f64 * STEP_S).position;
            at.z -= ABOVE_M;
            (at - instant.body.position).norm_squared()
        };
        let sum: f64 = self.instants.iter().enumerate().skip(half).map(squares).sum();
        Ok((sum / (self.instants.len() - half) as f64).sqrt())
    }

    /// Filters the flight, showing the estimate of every so many steps to `look`; the sum of NIS and log-likelihoods.
    pub(super) fn filtered<F: Filter<Process = LevelProcess>>(
        &self,
        filter: F,
        memory_ns: u64,
        every: usize,
        mut look: impl FnMut(usize, &RigidBodyState<f64>, Estimate),
    ) -> Result<Told, ItemError> {
        let mut estimator = Estimator::new(filter, self.input, memory_ns + STEP_NS);
        let mut told = Told::default();
        for (k, instant) in self.instants.iter().enumerate() {
            let at = |error| ItemError::new(format!("at step {k}: {error}"));
            estimator
                .predict(&instant.input, (k as u64 + 1) * STEP_NS)
                .map_err(at)?;
            for measurement in &instant.measurements {
                let innovation = estimator.update(measurement).map_err(at)?;
                told.nis += innovation.nis;
                told.readings += innovation.residual.len();
                told.log_likelihood += innovation.log_likelihood();
            }
            if (k + 1) % every == 0 {
                look(k + 1, &instant.body, estimator.estimate());
            }
        }
        Ok(told)
    }
}

/// Sums over a filtered flight.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Told {
    pub(super) nis: f64,
    pub(super) readings: usize,
    pub(super) log_likelihood: f64,
}
