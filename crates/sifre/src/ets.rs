//! The energy transmission system as an agent: a ground station that keeps its beam on another agent's receiver.
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

use crate::agent::{Agent, AgentId, Directory, MemoryError, Moment, Published};
use crate::black_box::{Channel, Frame, Role};
use crate::clock::StepSize;
use crate::error::BindError;
use crate::event::AgentEvent;
use crate::exact::{Exact, exact, plain};
use ::ets::{Ets as Physics, EtsInput, EtsState, Face, FrameClock, FrameEvent, Link, Mode, Station};
use nalgebra::{Vector2, Vector3};
use quad_kinematics::Rotation;
use quad_math::Flat;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use serde::{Deserialize, Serialize};

/// Everything that makes an energy transmission system.
#[derive(Clone, Debug)]
pub struct EtsSetup {
    /// Name of the agent.
    pub name: String,
    /// Name of the agent that it tracks.
    pub target: String,
    /// Its parameters, and those of the receiver that the target carries.
    pub station: Station,
    /// Pan at the start, rad, clockwise from the pedestal's heading.
    pub pan_rad: f64,
    /// Tilt at the start, rad, upwards.
    pub tilt_rad: f64,
    /// Seed of the image's noise.
    pub seed: u64,
}

/// A ground station that tracks an agent.
#[derive(Debug)]
pub struct Ets {
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

/// All that a station needs to go on.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Memory {
    state: Vec<Exact>,
    tracking: bool,
    face_centre: [Exact; 3],
    face_axes: [[Exact; 3]; 3],
}

impl EtsSetup {
    /// The project's nominal station, at rest with zero pan and tilt.
    pub fn nominal(name: impl Into<String>, target: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            target: target.into(),
            station: Station::nominal(),
            pan_rad: 0.0,
            tilt_rad: 0.0,
            seed: 0,
        }
    }
}

impl Ets {
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

    /// What its tracker is doing.
    pub fn mode(&self) -> Mode {
        self.state.sight.mode(&self.physics.tracker)
    }

    /// The light on the receiver at its latest instant.
    pub fn link(&self) -> Link<f64> {
        self.physics.link(&self.state.gimbal, &self.face)
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

impl Agent for Ets {
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
        let gimbal = &self.state.gimbal;
        let rates =
            ::ets::platform_rate_matrix(gimbal.tilt) * Vector2::new(gimbal.pan_rate, gimbal.tilt_rate);
        Published {
            position: self.physics.pedestal.origin(),
            velocity: Vector3::zeros(),
            rotation: Rotation::from_matrix(self.physics.pedestal.rotation(gimbal).matrix),
            body_rates: rates,
        }
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
        let axes = ["pan", "tilt"];
        let mut all = Vec::new();
        all.extend(Channel::group("gimbal", axes, Role::State, "rad", Frame::Scalar));
        all.extend(Channel::group(
            "gimbal_rate",
            axes,
            Role::State,
            "rad/s",
            Frame::Scalar,
        ));
        // Where it stands does not change; it is recorded so that a recording can be understood alone.
        let xyz = ["x", "y", "z"];
        all.extend(Channel::group("position", xyz, Role::State, "m", Frame::World));
        all.push(Channel::new("heading", Role::State, "rad", Frame::Scalar));
        // 0 searching, 1 coasting, 2 tracking.
        all.push(Channel::new("mode", Role::State, "1", Frame::Scalar));
        all.extend(Channel::group(
            "command",
            axes,
            Role::Input,
            "rad/s",
            Frame::Scalar,
        ));
        all.extend(Channel::group(
            "target",
            ["x", "y", "z"],
            Role::Reference,
            "m",
            Frame::World,
        ));
        all.extend(Channel::group(
            "image",
            ["x", "y"],
            Role::Output,
            "px",
            Frame::Camera,
        ));
        all.push(Channel::new("visible", Role::Output, "1", Frame::Scalar));
        all.push(Channel::new("range", Role::Output, "m", Frame::Scalar));
        all.push(Channel::new("incidence", Role::Output, "rad", Frame::Scalar));
        // On the sensor's plane: to the right of one who looks at it, and up the vehicle.
        all.extend(Channel::group(
            "spot",
            ["right", "up"],
            Role::Output,
            "m",
            Frame::Body,
        ));
        let power = ["transmitted", "received", "missed", "electrical"];
        all.extend(Channel::group("power", power, Role::Output, "W", Frame::Scalar));
        all
    }

    fn record(&self, row: &mut [f64]) {
        let gimbal = &self.state.gimbal;
        let command = self.physics.command(&self.state);
        let image = self.physics.view(gimbal, &self.face.centre);
        let Link { geometry, power } = self.link();
        let mode = match self.mode() {
            Mode::Searching => 0.0,
            Mode::Coasting => 1.0,
            Mode::Tracking => 2.0,
        };
        let (target, pedestal) = (&self.face.centre, &self.setup.station.pedestal);
        row.copy_from_slice(&[
            gimbal.pan,
            gimbal.tilt,
            gimbal.pan_rate,
            gimbal.tilt_rate,
            pedestal.position[0],
            pedestal.position[1],
            pedestal.position[2],
            pedestal.heading,
            mode,
            command.pan_rate,
            command.tilt_rate,
            target.x,
            target.y,
            target.z,
            image.point.x,
            image.point.y,
            image.visible,
            geometry.range,
            geometry.incidence,
            geometry.spot.x,
            geometry.spot.y,
            power.transmitted,
            power.received,
            power.missed,
            power.electrical,
        ]);
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
        self.state = EtsState::read(&state);
        self.tracking = memory.tracking;
        self.face = Face {
            centre: memory.face_centre.map(|x| x.0).into(),
            axes: memory.face_axes.map(|axis| axis.map(|x| x.0)).into(),
        };
        Ok(())
    }
}
