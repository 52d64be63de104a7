//! A target: an agent that stands still or moves as a script says, whatever the others do.

use crate::agent::{Agent, MemoryError, Moment, Published};
use crate::black_box::{Channel, Frame, Role};
use crate::event::AgentEvent;
use nalgebra::Vector3;
use quad_kinematics::EulerAngles;
use quad_ndi::{FlatOutput, Trajectory};

/// How a target moves.
#[derive(Clone, Debug, PartialEq)]
pub enum Path {
    /// It stands at a position.
    Fixed {
        /// Position in W, m.
        position: Vector3<f64>,
        /// Heading ψ, rad.
        yaw: f64,
    },
    /// It moves along a trajectory, level, and rests before its first and after its last waypoint.
    Scripted(Trajectory),
}

/// An agent on a [`Path`]. Its state is a function of the time, so its motion is exact at any step.
#[derive(Clone, Debug)]
pub struct Target {
    name: String,
    path: Path,
    time_s: f64,
    published: Published,
}

impl Target {
    /// A target of this name on a path, at time 0.
    pub fn new(name: impl Into<String>, path: Path) -> Self {
        Self {
            name: name.into(),
            time_s: 0.0,
            published: path.at(0.0),
            path,
        }
    }

    /// A target that stands at a position in W, m.
    pub fn fixed(name: impl Into<String>, position: Vector3<f64>) -> Self {
        Self::new(name, Path::Fixed { position, yaw: 0.0 })
    }

    fn move_to(&mut self, time_s: f64) {
        self.time_s = time_s;
        self.published = self.path.at(time_s);
    }
}

impl Path {
    fn at(&self, time_s: f64) -> Published {
        let flat = match self {
            Self::Fixed { position, yaw } => FlatOutput::at_rest(*position, *yaw),
            Self::Scripted(trajectory) => trajectory.flat_output(time_s),
        };
        Published {
            position: flat.position,
            velocity: flat.velocity,
            rotation: EulerAngles::level(flat.yaw).rotation(),
            body_rates: Vector3::new(0.0, 0.0, flat.yaw_rate),
        }
    }
}

impl Agent for Target {
    fn name(&self) -> &str {
        &self.name
    }

    fn kind(&self) -> &'static str {
        "target"
    }

    #[inline]
    fn published(&self) -> Published {
        self.published
    }

    fn decide(&mut self, _now: &Moment<'_>) -> Option<AgentEvent> {
        None
    }

    fn advance(&mut self, now: &Moment<'_>) {
        self.move_to(now.next_s());
    }

    fn channels(&self) -> Vec<Channel> {
        let xyz = ["x", "y", "z"];
        let mut all = Vec::new();
        all.extend(Channel::group("position", xyz, Role::State, "m", Frame::World));
        all.extend(Channel::group("velocity", xyz, Role::State, "m/s", Frame::World));
        all.push(Channel::new("attitude.yaw", Role::State, "rad", Frame::Scalar));
        all
    }

    fn record(&self, row: &mut [f64]) {
        row[..3].copy_from_slice(self.published.position.as_slice());
        row[3..6].copy_from_slice(self.published.velocity.as_slice());
        row[6] = self.published.rotation.euler_angles().yaw;
    }

    fn save(&self) -> Result<serde_json::Value, serde_json::Error> {
        serde_json::to_value(self.time_s)
    }

    fn restore(&mut self, memory: &serde_json::Value) -> Result<(), MemoryError> {
        let time_s: f64 = serde_json::from_value(memory.clone())?;
        MemoryError::check_numbers("the time", &[time_s])?;
        self.move_to(time_s);
        Ok(())
    }
}
