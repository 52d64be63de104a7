//! An estimator on board: what a quadrotor's pilot may know of its flight.
//!
//! ```text
//! at t_k   predict   the filter resumes from t_k-1 with the commands that the pilot sent, in still air
//!          sense     the sensors read the flight as it is, with random numbers of stream k
//!          update    what has arrived is filed at the instant at which it was taken
//!          pilot     sees what the filter believes (in the loop) or the flight (beside it)
//! ```
//!
//! The filter knows the commands, the vehicle that it believes in and where it was put down (rightly or wrongly, [`InitialError`]); it knows neither wind nor
//! disturbances of the commands: its estimated disturbance of the specific force accounts for them. What is published is the flight,
//! not the estimate, so others and guidance that looks at others or at itself (`Facing`) see the truth.
//!
//! Filters work on matrices of run-time size: a step with an estimator allocates, a step without does not. A filter that
//! refuses (a covariance that is none, numbers beyond the numbers) ends the run with
//! [`RunStatus::EstimatorFailed`](crate::RunStatus::EstimatorFailed); the pilot sees the last good belief at that instant.

use super::LevelChoice;
use super::air::{random, step_number};
use super::initial_error::{InitialError, InitialErrorFault};
use crate::agent::{MemoryError, Moment};
use crate::exact::Exact;
use quad_dynamics::{AnyQuadrotor, Input, Snapshot, Vehicle};
use quad_estimation::sensor::{Seen, SensorSuite, SuiteState};
use quad_estimation::{
    AnyFilter, Estimate, EstimationError, Estimator, EstimatorMemory, ExtendedFilter, Filter,
    InitialUncertainty, LevelError, LevelProcess, ProcessNoise, Spread, UnscentedFilter, estimate,
};
use quad_ndi::{ControllerError, check_pairing};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Marks the streams of the sensors, so that one seed for them and for the air makes no twins.
const SENSOR_STREAM: u64 = 1 << 62;

/// Which Kalman filter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FilterKind {
    /// Error-state extended.
    #[default]
    Extended,
    /// Unscented.
    Unscented,
}

/// What an estimate is used for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum EstimateUse {
    /// The pilot sees it instead of the flight.
    #[default]
    InLoop,
    /// The estimate is recorded; the pilot sees the true state, and the flight is bit-identical to one without an estimator.
    Beside,
}

/// Sensors and a filter for a quadrotor.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimation {
    /// The level of the filter's model, and what is switched on in it.
    pub level: LevelChoice,
    /// The vehicle in the filter's model; by default the one that flies.
    pub vehicle: Option<Arc<Vehicle>>,
    /// The sensors.
    pub sensors: SensorSuite,
    /// Which filter.
    pub filter: FilterKind,
    /// What the estimate is used for.
    pub used: EstimateUse,
    /// What disturbs the filter's model.
    pub noise: ProcessNoise,
    /// The error of its initial estimate; none by default.
    pub error: InitialError,
    /// Its stated initial uncertainty.
    pub uncertainty: InitialUncertainty,
    /// Seed of biases and noise of the sensors, and of errors that are drawn.
    pub seed: u64,
}

impl Estimation {
    /// An extended filter in the loop, on a level that may leave things out (disturbances of 0.3 m/s²/√s, moments of
    /// 0.3 rad/s/√s), which knows how its sensors' biases are and drift.
    pub fn new(level: impl Into<LevelChoice>, sensors: SensorSuite, seed: u64) -> Self {
        let noise = ProcessNoise {
            disturbance: 0.3,
            rates: 0.3,
            ..ProcessNoise::default()
        };
        Self {
            level: level.into(),
            vehicle: None,
            filter: FilterKind::default(),
            used: EstimateUse::default(),
            noise: noise.with_drifts_of(sensors.sensors()),
            uncertainty: InitialUncertainty::default().with_biases_of(sensors.sensors()),
            sensors,
            error: InitialError::default(),
            seed,
        }
    }

    /// The filter's initial estimate of a flight.
    fn told(&self, flight: &Snapshot<f64>) -> Snapshot<f64> {
        // Before the stream that the sensors are turned on with; no run has that many steps.
        self.error.told(flight, &mut random(self.seed, SENSOR_STREAM - 2))
    }
}

/// Why an estimator can't be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EstimationSetupError {
    /// Its model can't be built, or its noise is none.
    #[error("the estimator's model: {0}")]
    Level(#[from] LevelError),
    /// It can't begin.
    #[error("the estimator: {0}")]
    Filter(#[from] EstimationError),
    /// The initial error is invalid.
    #[error("the estimator: {0}")]
    Error(#[from] InitialErrorFault),
    /// The pilot can't fly by what it knows.
    #[error("the estimator is in the loop, but its model is too low for the pilot: {0}")]
    Pairing(#[from] ControllerError),
}

/// A quadrotor's sensors and filter in flight.
#[derive(Clone, Debug)]
pub(super) struct Estimating {
    setup: Estimation,
    estimator: Estimator<AnyFilter<LevelProcess>>,
    sensors: SuiteState,
    /// What the pilot has sent since the latest instant.
    sent: Input<f64>,
    /// From one instant to the next, ns; zero until it is bound.
    step_ns: u64,
}

/// Everything it needs to resume.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct EstimatingMemory {
    sensors: SuiteState,
    estimator: EstimatorMemory,
    sent: [Exact; 4],
}

impl Estimating {
    /// Sensors turned on, and a filter that knows the flight to within its first uncertainty.
    pub(super) fn new(
        setup: &Estimation,
        pilot: quad_dynamics::Level,
        flown: &Vehicle,
        quadrotor: &AnyQuadrotor<f64>,
    ) -> Result<Self, EstimationSetupError> {
        let level = setup.level.level;
        if setup.used == EstimateUse::InLoop {
            check_pairing(pilot, level)?;
        }
        let vehicle = setup.vehicle.as_deref().unwrap_or(flown);
        let process = LevelProcess::new(level, vehicle, &setup.level.phenomena(), setup.noise)?;
        let input = quadrotor.hover_input();
        setup.error.check()?;
        let told = setup.told(&quadrotor.snapshot(&input));
        let belief = process.belief(&told, &input, &setup.uncertainty)?;
        let filter = match setup.filter {
            FilterKind::Extended => AnyFilter::Extended(ExtendedFilter::new(process, belief)?),
            FilterKind::Unscented => {
                AnyFilter::Unscented(UnscentedFilter::new(process, belief, Spread::default())?)
            }
        };
        // The last stream before those of the steps; no run has that many steps of the air's.
        let sensors = setup
            .sensors
            .turned_on(&mut random(setup.seed, SENSOR_STREAM - 1));
        Ok(Self {
            estimator: Estimator::new(filter, input, setup.sensors.longest_delay_ns()),
            sensors,
            sent: input,
            step_ns: 0,
            setup: setup.clone(),
        })
    }

    /// Gets ready for steps of this length, ns: a reading is taken in up to one of them after it has arrived.
    pub(super) fn bind(&mut self, step_ns: u64) {
        let delay_ns = self.setup.sensors.longest_delay_ns();
        self.estimator.remember(delay_ns.saturating_add(step_ns));
        self.step_ns = step_ns;
    }

    /// The flight is moved elsewhere, and the filter with it.
    pub(super) fn put_in_flight(
        &mut self,
        quadrotor: &AnyQuadrotor<f64>,
        input: &Input<f64>,
    ) -> Result<(), EstimationError> {
        let told = self.setup.told(&quadrotor.snapshot(input));
        let process = self.estimator.filter().process();
        let belief = process.belief(&told, input, &self.setup.uncertainty)?;
        self.estimator.restart(belief, self.sent)?;
        self.sensors.pending.clear();
        Ok(())
    }

    /// Predicts, senses and updates at an instant; `input` has acted on the quadrotor up to it.
    pub(super) fn live(
        &mut self,
        quadrotor: &AnyQuadrotor<f64>,
        input: &Input<f64>,
        now: &Moment<'_>,
    ) -> Result<(), EstimationError> {
        let since_ns = now.time_ns.saturating_sub(self.estimator.now_ns());
        if since_ns > now.step.ns() {
            // Only a saved state that was changed has such a gap, and predicting over it would take as long.
            let step_s = since_ns as f64 * 1e-9;
            return Err(EstimationError::BadStep { step_s });
        }
        if since_ns > 0 {
            self.estimator.predict(&self.sent, now.time_ns)?;
        }
        let seen = Seen::of(quadrotor, input);
        let mut random = random(self.setup.seed, SENSOR_STREAM | step_number(now));
        let suite = &self.setup.sensors;
        for reading in suite.sample(&mut self.sensors, now.time_ns, &seen, &mut random) {
            self.estimator.update(&reading)?;
        }
        Ok(())
    }

    /// Whether the pilot sees the estimate.
    pub(super) fn is_in_loop(&self) -> bool {
        self.setup.used == EstimateUse::InLoop
    }

    /// The filter's model as it is believed to fly.
    pub(super) fn believed(&mut self) -> &AnyQuadrotor<f64> {
        let mean = self.estimator.filter().belief().mean.clone();
        self.estimator.filter_mut().process_mut().model_at(&mean)
    }

    /// The pilot sends these commands until the next instant.
    pub(super) fn send(&mut self, commands: [f64; 4]) {
        self.sent = Input::still_air(commands);
    }

    /// What the filter says of the flight.
    pub(super) fn estimate(&self) -> Estimate {
        // Evaluating a model needs one to evaluate.
        estimate(&mut self.estimator.filter().clone())
    }

    pub(super) fn memory(&self) -> EstimatingMemory {
        EstimatingMemory {
            sensors: self.sensors.clone(),
            estimator: self.estimator.memory(),
            sent: self.sent.commands.map(Exact),
        }
    }

    /// Refuses a memory that no flight of this step leads to: going over it would take as long as its times ask for.
    fn check(&self, memory: &EstimatingMemory) -> Result<(), MemoryError> {
        for pair in memory.estimator.instants.windows(2) {
            let (before_ns, time_ns) = (pair[0].time_ns, pair[1].time_ns);
            if before_ns.checked_add(self.step_ns) != Some(time_ns) {
                let step_ns = self.step_ns;
                return Err(MemoryError::Instants {
                    time_ns,
                    before_ns,
                    step_ns,
                });
            }
        }
        let numbers = |values: &[f64]| MemoryError::check_numbers("its sensors' memory", values);
        memory.sensors.biases.iter().try_for_each(|bias| numbers(bias))?;
        memory
            .sensors
            .pending
            .iter()
            .try_for_each(|reading| numbers(&reading.values))?;
        numbers(&memory.sent.map(|u| u.0))
    }

    /// It as it was remembered.
    pub(super) fn remembered(&self, memory: EstimatingMemory) -> Result<Self, MemoryError> {
        let count = self.setup.sensors.sensors().len();
        for found in [memory.sensors.biases.len(), memory.sensors.next_ns.len()] {
            MemoryError::check_length("the list of sensors", count, found)?;
        }
        self.check(&memory)?;
        let mut that = self.clone();
        that.estimator.recall(&memory.estimator)?;
        that.sensors = memory.sensors;
        that.send(memory.sent.map(|u| u.0));
        Ok(that)
    }
}
