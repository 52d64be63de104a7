//! The simulation framework for robotic engineering: agents on one exact clock, recorded, stopped, saved and resumed.
//!
//! ```
//! use quad_dynamics::{Level, Vehicle};
//! use quad_ndi::{AnyController, C3, Reference, Settings};
//! use sifre::black_box::MemoryBox;
//! use sifre::quadrotor::{Setup, Start};
//! use sifre::{Engine, Follow, Member, ModelQuadrotor, steps};
//! use std::sync::Arc;
//!
//! let vehicle = Arc::new(Vehicle::qball_x4());
//! let c3 = AnyController::C3(C3::new(&vehicle, &Settings::default())?.into());
//!
//! // Alpha climbs a metre at level 3; bravo, at level 5, keeps two metres west of it. z points down.
//! let climb = Reference::hold([0.0, 0.0, -1.0].into(), 0.0);
//! let alpha = Setup::new("alpha", &vehicle, Level::Three, c3.clone(), climb);
//! let follow = Follow::agent("alpha", [0.0, -2.0, 0.0], 0.0);
//! let start = Start { position_m: [0.0, -2.0, 0.0], yaw_rad: 0.0 };
//! let bravo = Setup { start, ..Setup::new("bravo", &vehicle, Level::Five, c3, follow) };
//!
//! let mut simulation = Engine::new(vec![
//!     Member::new(ModelQuadrotor::new(alpha)?, steps::QUADROTOR.step),
//!     Member::new(ModelQuadrotor::new(bravo)?, steps::QUADROTOR.step),
//! ])?;
//! let id = simulation.attach(steps::BLACK_BOX.step, MemoryBox::default())?;
//! let report = simulation.run(5.0, &mut ())?;
//! assert!(report.status.is_completed());
//!
//! let recording = simulation.detach::<MemoryBox>(id).expect("attached above")?.recording;
//! let z = recording.column("alpha.position.z").expect("every quadrotor has it").last();
//! assert!((z.unwrap_or(0.0) + 1.0).abs() < 1e-3);
//!
//! // Saved to JSON, it resumes bit for bit.
//! let mut file = Vec::new();
//! simulation.save()?.write_json(&mut file)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Parts
//!
//! The six classes of the source's appendix A are six traits. Your own type can take the place of any of them:
//! `examples/your_own.rs` does so for each.
//!
//! | trait | standard implementations |
//! | --- | --- |
//! | [`Simulation`] | [`Engine`]: agents that see each other; [`Rollout`]: a batch of flights that don't, as pure loops |
//! | [`BlackBox`] | [`CsvBox`](black_box::CsvBox), [`JsonLinesBox`](black_box::JsonLinesBox), `ParquetBox`, [`MemoryBox`](black_box::MemoryBox) |
//! | [`Agent`] | every quadrotor and station below, and [`Target`] |
//! | [`Quadrotor`]: `Agent` | [`ModelQuadrotor`]: a model at any level; [`RecordedQuadrotor`]: a flight that happened, played back |
//! | [`Ets`]: `Agent` | [`GimballedEts`]: camera, tracker and gimbal; [`IdealEts`]: exact pointing, as the bound |
//! | [`Optimiser`] | those of [`optim`]: simplex, line search, annealing, evolution, random search |
//!
//! A [`ModelQuadrotor`] is flown by a [`Pilot`](quadrotor::Pilot) (any controller, or [`OpenLoop`](quadrotor::OpenLoop)) along the
//! reference of a [`Guidance`] ([`Mission`], [`Follow`], [`Facing`], a fixed reference). It may carry an
//! [`Estimation`](quadrotor::Estimation), in the loop or beside it.
//!
//! # Time
//!
//! Time is a whole number of nanoseconds; every agent and every black box has its own [`StepSize`], and they need not be
//! multiples of each other. At an instant the agents due publish, decide, are recorded and move. Everyone sees what was
//! published up to that instant and nothing else; between an agent's instants its publication is **held**. So the
//! order of agents and the number of threads can't matter, and coupled agents converge at first order in their steps,
//! as sampled controllers do; a single agent whose inputs don't depend on the step converges at its integrator's order.
//! These are tests: `tests/engine/laws.rs`, `convergence.rs`.
//!
//! # Ends
//!
//! [`Engine::run`] ends at its time, at a [`StopCondition`], at an agent's first non-finite value, where an estimator's filter
//! refuses to continue, where the [`Observer`] asks for it (Ctrl-C), or where a black box fails: each is a [`RunStatus`] and loses
//! nothing. The simulation can continue from there, or be saved ([`Engine::save`]) and resumed elsewhere ([`Engine::resume`]) as if
//! nothing had happened.
//!
//! # What it does not do
//!
//! It reads no scenario files and has no command line. Agents do not collide. A saved simulation holds states, not how the agents
//! were assembled: to resume, pass the same agents again. The engine is `f64`; batches of other scalars call
//! the physics' pure steps, which are what the agents call.
//!
//! # Features
//!
//! `parquet` (on by default): [`ParquetBox`](black_box), with the crate `parquet` without Arrow.

mod agent;
pub mod black_box;
mod clock;
mod engine;
mod error;
mod ets;
mod event;
mod exact;
mod guidance;
mod names;
pub mod quadrotor;
mod rollout;
mod schedule;
mod simulation;
mod speed;
pub mod steps;
mod target;

/// Controllers and, below them, models, in the version that fits.
#[doc(no_inline)]
pub use quad_ndi;

pub use crate::ets::{Ets, EtsSetup, GimballedEts, IdealEts};
pub use agent::{
    Agent, AgentId, Directory, FARTHEST_M, Invalid, Member, MemoryError, Moment, Published,
    SPEED_OF_SOUND_M_S,
};
pub use black_box::{BlackBox, BlackBoxError, Channel, Recording};
pub use clock::StepSize;
pub use engine::{
    AgentSnapshot, Engine, Execution, LastSeen, Observer, PROGRESS_EVERY, Phase, Progress, RecorderId,
    ResumeError, RunReport, RunStatus, Scene, SimulationSnapshot, StopCondition, Test, Who,
};
pub use error::{BindError, SimulationError, SnapshotError, UnknownAgent};
pub use event::{AgentEvent, Event};
pub use exact::Exact;
pub use guidance::{Facing, Follow, Guidance, Mission, Tilt};
pub use optim::Optimiser;
pub use quad_math::GridError;
pub use quadrotor::{ModelQuadrotor, Quadrotor, RecordedQuadrotor};
pub use rollout::{Course, Rollout};
pub use schedule::{Entry, Schedule, ScheduleError};
pub use simulation::Simulation;
pub use target::{Path, Target};

/// The example of the README, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
