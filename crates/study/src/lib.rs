//! Studies of the model family: which level is enough, what separates two levels, what a vehicle's standard errors do to a result.
//!
//! | you want to know | use | from |
//! | --- | --- | --- |
//! | which level is enough for your metric | [`selection::select`] | one answer per level, and its price |
//! | which phenomenon makes the difference between two levels | [`attribution::Parts::attribute`] | a closure that flies a level with phenomena |
//! | what the vehicle's standard errors do to a result | [`sensitivity::by_differentiation`], [`sensitivity::by_differences`] | a closure from vehicle to results |
//!
//! Each takes a closure or numbers, so the metric is your choice: a step metric, an error on a trajectory, a cost. Everything is pure.
//!
//! ```
//! use nalgebra::Vector3;
//! use quad_dynamics::{AnyQuadrotor, BuildError, Feature, Input, Level, Phenomenon, PhenomenonSet, Vehicle};
//! use quad_math::FixedStep;
//! use study::attribution::Parts;
//! use study::selection::{Answer, Tolerance, select};
//!
//! // Distance, m, that a wind of 5 m/s carries a hovering vehicle in two seconds.
//! let vehicle = Vehicle::qball_x4();
//! let carried = |level: Level, on: &PhenomenonSet| -> Result<f64, BuildError> {
//!     let mut quadrotor = AnyQuadrotor::<f64>::hovering(level, &vehicle, on, Vector3::zeros(), 0.0)?;
//!     let input = Input::in_wind(quadrotor.hover_input().commands, Vector3::new(5.0, 0.0, 0.0));
//!     for _ in 0..200 {
//!         quadrotor.step(FixedStep::Rk4, &input, 0.01);
//!     }
//!     Ok(quadrotor.flight().position.x)
//! };
//!
//! // Which level is enough to a centimetre, where a level costs its number?
//! let ask = |level: Level| {
//!     let values = vec![carried(level, &level.phenomena())?];
//!     Ok::<_, BuildError>(Answer { level, values, price: f64::from(level.number()) })
//! };
//! let answers = Level::ALL.into_iter().map(ask).collect::<Result<Vec<_>, _>>()?;
//! let enough = select(&answers, Tolerance { absolute: 0.01, relative: 0.0 })?;
//! assert_eq!(enough.dependable, Level::Four);
//!
//! // And why not level 3? It has no drag.
//! let why = Parts::between_levels(Level::Three, Level::Four).attribute(carried)?;
//! let drag = why.share(Feature::Phenomenon(Phenomenon::Drag)).expect("a part of level 4");
//! assert!((drag.shapley / why.difference() - 1.0).abs() < 0.01);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What it does not do
//!
//! It flies nothing by itself, reads and writes nothing, and draws no random numbers.

pub mod attribution;
pub mod selection;
pub mod sensitivity;

/// The README's example is tested with the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
