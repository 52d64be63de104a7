//! State estimation with poor sensors; the prediction model is any level of the family.
//!
//! ```
//! use quad_dynamics::{AnyQuadrotor, Level, Vehicle};
//! use quad_estimation::sensor::{Quality, Seen};
//! use quad_estimation::{Estimator, ExtendedFilter, InitialUncertainty, LevelProcess, ProcessNoise};
//! use quad_math::FixedStep;
//! use rand_chacha::{ChaCha8Rng, rand_core::SeedableRng};
//!
//! // Level 5 hovers 1 m up (z points down); a filter on level 3 watches through poor sensors.
//! let (vehicle, on) = (Vehicle::qball_x4(), Level::Five.phenomena());
//! let mut truth = AnyQuadrotor::hovering(Level::Five, &vehicle, &on, [0.0, 0.0, -1.0].into(), 0.0)?;
//! let input = truth.hover_input();
//!
//! let suite = Quality::Poor.suite();
//! let noise = ProcessNoise::default().with_drifts_of(suite.sensors());
//! let process = LevelProcess::new(Level::Three, &vehicle, &Level::Three.phenomena(), noise)?;
//! let uncertain = InitialUncertainty::default().with_biases_of(suite.sensors());
//! let belief = process.belief(&truth.snapshot(&input), &input, &uncertain)?;
//! let filter = ExtendedFilter::new(process, belief)?;
//! let mut estimator = Estimator::new(filter, input, suite.longest_delay_ns() + 10_000_000);
//!
//! let mut random = ChaCha8Rng::seed_from_u64(1);
//! let mut sensors = suite.turned_on(&mut random);
//! for now_ns in (1..=300).map(|k| k * 10_000_000) {
//!     truth.step(FixedStep::Rk4, &input, 0.01);
//!     estimator.predict(&input, now_ns)?;
//!     for reading in suite.sample(&mut sensors, now_ns, &Seen::of(&truth, &input), &mut random) {
//!         estimator.update(&reading)?; // fixes come 50 ms late and are taken in where they belong
//!     }
//! }
//! let estimate = estimator.estimate();
//! let error = estimate.error(&truth.snapshot(&input).body);
//! println!("{:.3} m off, reported ± {:.3} m", error.position.norm(), estimate.deviations()[0]);
//! assert!(error.position.norm() < 0.3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Parts
//!
//! | part | here | equations |
//! | --- | --- | --- |
//! | what sensors read, and what makes them poor | [`sensor`] | heads of `sensor/mod.rs`, `imperfect.rs` |
//! | a level as a stochastic process | [`LevelProcess`] | head of `level/mod.rs` |
//! | errors of an attitude, the reset | | head of `level/layout.rs` |
//! | error-state extended Kalman filter | [`ExtendedFilter`] | head of `extended.rs` |
//! | unscented Kalman filter | [`UnscentedFilter`] | head of `unscented.rs` |
//! | a filter with a clock, late measurements | [`Estimator`] | head of `estimator.rs` |
//! | either filter by value; an estimator's memory, for files | [`AnyFilter`], [`EstimatorMemory`] | |
//! | estimate, NEES, NIS | [`Estimate`], [`LevelProcess::nees`], [`Innovation`] | |
//!
//! Both filters are a [`Filter`] on any [`Process`]; a quadrotor's level is one of them, a linear system in the tests is
//! another. The filter is driven by the rotor commands, and the inertial unit's readings are measurements like any other:
//! that is what makes the level of the model matter. What the level leaves out goes into a *disturbance* of its
//! specific force, which is estimated with the biases.
//!
//! # Conventions
//!
//! W north-east-down, B forward-right-down, SI units, rad; instants in whole nanoseconds, as the engine's. Randomness comes
//! from a generator that is passed in. All noise is a standard deviation per reading or a density per root of a second.
//!
//! # What it does not do
//!
//! A barometer's bias is not estimated, nor misalignment, scale errors or lever arms of sensors. Vibration is white noise.
//! The error of an attitude is unique up to half a turn, Euler angles at level 1 up to its small angles. Process noise is of first
//! order in the step. Matrices are of run-time size, so that a step allocates.

mod any;
mod belief;
mod error;
mod estimate;
mod estimator;
mod extended;
mod filter;
mod level;
mod process;
pub mod sensor;
mod unscented;

pub use any::AnyFilter;
pub use belief::{Belief, Innovation, Verdict};
pub use error::EstimationError;
pub use estimate::{Estimate, EstimateError, estimate};
pub use estimator::{Estimator, EstimatorMemory, RememberedInstant, RememberedReading};
pub use extended::ExtendedFilter;
pub use filter::{Filter, Observation};
pub use level::{InitialUncertainty, LevelError, LevelProcess, ProcessNoise, places};
pub use process::Process;
pub use unscented::{Spread, UnscentedFilter};

/// The example of the README, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
