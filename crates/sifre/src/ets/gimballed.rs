//! The station as it is built: a camera and a laser on a gimbal, driven by the tracker.
//!
//! ```text
//! decide at t_n    a frame is captured or delivered if due; the tracker commands the gimbal's rates
//! advance          the gimbal turns, rates held
//! ```
//!
//! The two halves of [`ets::Ets::step`], so that engine and rollout agree bit for bit. The target is the centre of the
//! receiver that the tracked agent is taken to carry: the station's [`ets::Receiver`] at its offset in that agent's B.
//! The agent's pose is its moving platform: position of the crossing axes, rotation `R_WE`. Noise of the image, if the
//! station's camera has some, is drawn from stream n of a ChaCha8 generator for step n: a pure function of the seed and
//! the step, with nothing to save.

use super::record::{self, Seen};
use super::{Ets, EtsSetup, pose};
use crate::agent::{Agent, AgentId, Directory, MemoryError, Moment, Published};
use crate::black_box::Channel;
use crate::clock::StepSize;
use crate::error::BindError;
use crate::event::AgentEvent;
use crate::exact::{Exact, exact, plain};
use ::ets::{Ets as Physics, EtsInput, EtsState, Face, FrameClock, FrameEvent, GimbalState, Link, Mode};
use nalgebra::Vector2;
use quad_math::Flat;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use serde::{Deserialize, Serialize};

/// A ground station that tracks an agent with a camera on a gimbal.
#[derive(Debug)]
pub struct GimballedEts {
    setup: EtsSetup,
    physics: Physics<f64>,
    timing: Option<Timing>,
    state: EtsState<f64>,
    /// Whether the last frame that was delivered showed the target.
    tracking: bool,
    /// The receiver at the latest instant.
    face: Face<f64>,
}

/// What the agent learns when the simulation is put together.
#[derive(Clone, Copy, Debug)]
struct Timing {
    target: AgentId,
    clock: FrameClock,
    step: StepSize,
}

/// Everything a station needs to resume.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Memory {
    state: Vec<Exact>,
    tracking: bool,
    face_centre: [Exact; 3],
    face_axes: [[Exact; 3]; 3],
}

impl GimballedEts {
    /// The station at rest, nothing seen yet: it searches first.
    pub fn new(setup: EtsSetup) -> Self {
        let physics = Physics::new(&setup.station);
        let state = physics.at_rest(setup.pan_rad, setup.tilt_rad);
        Self {
            // Until the first instant the receiver is taken to be at the station.
            face: physics
                .receiver
                .on(&physics.pedestal.origin(), &nalgebra::Matrix3::identity()),
            timing: None,
            tracking: false,
            physics,
            state,
            setup,
        }
    }

    /// Its state at its latest instant.
    pub fn state(&self) -> &EtsState<f64> {
        &self.state
    }

    /// What there is to record.
    fn seen(&self) -> Seen {
        Seen {
            gimbal: self.state.gimbal,
            command: self.physics.command(&self.state),
            mode: self.mode(),
            face: self.face,
        }
    }

    /// Noise of the image captured at step `n`, px.
    fn noise(&self, clock: &FrameClock, n: u64) -> Vector2<f64> {
        let deviation = self.setup.station.frames.noise;
        if deviation == 0.0 || matches!(clock.event(n), FrameEvent::None | FrameEvent::Deliver) {
            return Vector2::zeros();
        }
        let mut generator = ChaCha8Rng::seed_from_u64(self.setup.seed);
        generator.set_stream(n);
        let mut sample = || -> f64 { StandardNormal.sample(&mut generator) };
        Vector2::new(sample(), sample()) * deviation
    }
}

impl Ets for GimballedEts {
    fn target(&self) -> &str {
        &self.setup.target
    }

    fn mode(&self) -> Mode {
        self.state.sight.mode(&self.physics.tracker)
    }

    fn gimbal(&self) -> GimbalState<f64> {
        self.state.gimbal
    }

    fn link(&self) -> Link<f64> {
        self.physics.link(&self.state.gimbal, &self.face)
    }
}

impl Agent for GimballedEts {
    fn name(&self) -> &str {
        &self.setup.name
    }

    fn kind(&self) -> &'static str {
        "ets"
    }

    fn bind(&mut self, directory: &Directory<'_>) -> Result<(), BindError> {
        let (step, frames) = (directory.step, &self.setup.station.frames);
        let clock = FrameClock::new(step.seconds(), frames.rate, frames.latency);
        self.timing = Some(Timing {
            target: directory.find(&self.setup.target)?,
            clock: clock.map_err(|source| BindError::Step {
                agent: self.setup.name.clone(),
                step_s: step.seconds(),
                source: Box::new(source),
            })?,
            step,
        });
        Ok(())
    }

    fn published(&self) -> Published {
        pose(&self.physics, &self.state.gimbal)
    }

    fn decide(&mut self, now: &Moment<'_>) -> Option<AgentEvent> {
        // Set when the simulation was put together.
        let Timing { target, clock, step } = self.timing?;
        let n = now.time_ns / step.ns();
        let target = now.published(target);
        self.face = self
            .physics
            .receiver
            .on(&target.position, &target.rotation.matrix);
        let input = EtsInput {
            target: self.face.centre,
            noise: self.noise(&clock, n),
        };
        self.state = self.physics.look(&clock, n, &self.state, &input);
        let before = self.tracking;
        self.tracking = self.mode() == Mode::Tracking;
        match (before, self.tracking) {
            (true, false) => Some(AgentEvent::TargetLost),
            (false, true) => Some(AgentEvent::TargetFound),
            _ => None,
        }
    }

    fn advance(&mut self, now: &Moment<'_>) {
        self.state = self.physics.turn(&self.state, now.step_s);
    }

    fn channels(&self) -> Vec<Channel> {
        record::channels()
    }

    fn record(&self, row: &mut [f64]) {
        record::write(&self.physics, &self.setup.station, &self.seen(), row);
    }

    fn save(&self) -> Result<serde_json::Value, serde_json::Error> {
        let mut state = [0.0; <EtsState<f64> as Flat<f64>>::LEN];
        self.state.write(&mut state);
        serde_json::to_value(Memory {
            state: exact(&state),
            tracking: self.tracking,
            face_centre: <[f64; 3]>::from(self.face.centre).map(Exact),
            face_axes: <[[f64; 3]; 3]>::from(self.face.axes).map(|axis| axis.map(Exact)),
        })
    }

    fn restore(&mut self, memory: &serde_json::Value) -> Result<(), MemoryError> {
        let memory = Memory::deserialize(memory)?;
        let state = plain(&memory.state);
        MemoryError::check_length(
            "the station's state",
            <EtsState<f64> as Flat<f64>>::LEN,
            state.len(),
        )?;
        let numbers = memory.face_centre.iter().chain(memory.face_axes.as_flattened());
        MemoryError::check_numbers(
            "the receiver that it sees",
            &numbers.map(|x| x.0).collect::<Vec<_>>(),
        )?;
        MemoryError::check_numbers("the station's state", &state)?;
        self.state = EtsState::read(&state);
        self.tracking = memory.tracking;
        self.face = Face {
            centre: memory.face_centre.map(|x| x.0).into(),
            axes: memory.face_axes.map(|axis| axis.map(|x| x.0)).into(),
        };
        Ok(())
    }
}
