//! A recorded flight played back as an agent, so that a station can track a flight that happened.
//!
//! ```text
//! position    cubic Hermite through positions and velocities
//! attitude    R(s) = R_0 exp(s log(R_0ᵀ R_1)),  s from 0 to 1 between two poses
//! body rates  linear between two poses
//! ```
//!
//! A flight whose position is a cubic in time between two poses is played back exactly. Before its first and
//! after its last pose the vehicle rests there.

use super::Quadrotor;
use crate::agent::{Agent, MemoryError, Moment, Published};
use crate::black_box::{Channel, Frame, Recording, Role};
use crate::event::AgentEvent;
use nalgebra::{Matrix3, Rotation3, Vector3};
use quad_dynamics::{Flight, Level};
use quad_kinematics::{EulerAngles, Rotation};

/// One pose of a recorded flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// When, s.
    pub time_s: f64,
    /// Position, velocity, attitude and body rates.
    pub published: Published,
}

/// A quadrotor that repeats a recorded flight, whatever the others do.
#[derive(Clone, Debug)]
pub struct RecordedQuadrotor {
    name: String,
    poses: Vec<Pose>,
    time_s: f64,
    published: Published,
}

/// Why a recording can't be played back.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RecordedFlightError {
    /// Too few poses.
    #[error("a recorded flight needs at least two poses, got {found}")]
    TooShort {
        /// How many there are.
        found: usize,
    },
    /// Times that don't increase.
    #[error(
        "times of a recorded flight must increase: pose {row} is at {time_s} s, the one before at {before_s} s"
    )]
    NotIncreasing {
        /// The pose, from 1.
        row: usize,
        /// Its time, s.
        time_s: f64,
        /// The time before, s.
        before_s: f64,
    },
    /// A value that isn't finite.
    #[error("pose {row} of the recorded flight contains a non-finite value")]
    NotFinite {
        /// The pose, from 1.
        row: usize,
    },
    /// A recording without a channel that is needed.
    #[error("the recording has no channel `{channel}`; its agents: {}", agents.join(", "))]
    NoChannel {
        /// The channel.
        channel: String,
        /// Names of the agents in the recording.
        agents: Vec<String>,
    },
}

impl RecordedQuadrotor {
    /// A flight through poses in order of time.
    ///
    /// # Errors
    /// Fewer than two poses, times that don't increase, values that are not finite.
    pub fn new(name: impl Into<String>, poses: Vec<Pose>) -> Result<Self, RecordedFlightError> {
        if poses.len() < 2 {
            return Err(RecordedFlightError::TooShort { found: poses.len() });
        }
        let bad = |pose: &Pose| !(pose.time_s.is_finite() && pose.published.is_finite());
        if let Some(k) = poses.iter().position(bad) {
            return Err(RecordedFlightError::NotFinite { row: k + 1 });
        }
        if let Some(k) = poses.windows(2).position(|pair| pair[0].time_s >= pair[1].time_s) {
            return Err(RecordedFlightError::NotIncreasing {
                row: k + 2,
                time_s: poses[k + 1].time_s,
                before_s: poses[k].time_s,
            });
        }
        let mut flight = Self {
            name: name.into(),
            published: poses[0].published,
            time_s: 0.0,
            poses,
        };
        flight.move_to(0.0);
        Ok(flight)
    }

    /// The flight of an agent of a recording, from its channels `position`, `velocity`, `attitude` and `body_rate`.
    ///
    /// # Errors
    /// A channel that the recording doesn't have; else as [`Self::new`].
    pub fn from_recording(
        name: impl Into<String>,
        recording: &Recording,
        agent: &str,
    ) -> Result<Self, RecordedFlightError> {
        let [position, velocity] =
            ["position", "velocity"].map(|what| [(what, "x"), (what, "y"), (what, "z")]);
        let attitude = ["roll", "pitch", "yaw"].map(|end| ("attitude", end));
        let body_rate = ["p", "q", "r"].map(|end| ("body_rate", end));
        let mut places = [[0; 3]; 4];
        for (group, names) in places.iter_mut().zip([position, velocity, attitude, body_rate]) {
            for (place, (what, end)) in group.iter_mut().zip(names) {
                let channel = format!("{agent}.{what}.{end}");
                *place = recording
                    .channels()
                    .iter()
                    .position(|c| c.name == channel)
                    .ok_or_else(|| RecordedFlightError::NoChannel {
                        channel,
                        agents: agents(recording),
                    })?;
            }
        }
        let poses = recording.times_s().zip(recording.rows()).map(|(time_s, row)| {
            let [position, velocity, attitude, body_rates] =
                places.map(|group| Vector3::from(group.map(|place| row.values[place])));
            Pose {
                time_s,
                published: Published {
                    position,
                    velocity,
                    rotation: EulerAngles::new(attitude.x, attitude.y, attitude.z).rotation(),
                    body_rates,
                },
            }
        });
        Self::new(name, poses.collect())
    }

    /// From the first to the last pose, s.
    pub fn span_s(&self) -> [f64; 2] {
        [self.poses[0].time_s, self.poses[self.poses.len() - 1].time_s]
    }

    fn move_to(&mut self, time_s: f64) {
        self.time_s = time_s;
        let later = self.poses.partition_point(|pose| pose.time_s <= time_s);
        self.published = match (later.checked_sub(1), self.poses.get(later)) {
            (Some(k), Some(next)) => between(&self.poses[k], next, time_s),
            (Some(k), None) if self.poses[k].time_s == time_s => self.poses[k].published,
            (place, _) => {
                let Published {
                    position, rotation, ..
                } = self.poses[place.unwrap_or(0)].published;
                Published::at_rest(position, rotation)
            }
        };
    }
}

/// The agents of a recording, in order.
fn agents(recording: &Recording) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for channel in recording.channels() {
        let name = channel.name.split('.').next().unwrap_or_default();
        if names.last().is_none_or(|last| last != name) {
            names.push(name.to_owned());
        }
    }
    names
}

/// The pose at a time between two.
fn between(from: &Pose, to: &Pose, time_s: f64) -> Published {
    let h = to.time_s - from.time_s;
    let s = (time_s - from.time_s) / h;
    let (a, b) = (&from.published, &to.published);
    // The cubic as `p_0 + s (h v_0 + s (c + s d))`.
    let chord = b.position - a.position;
    let (start, end) = (a.velocity * h, b.velocity * h);
    let c = chord * 3.0 - start * 2.0 - end;
    let d = start + end - chord * 2.0;
    let turn = Rotation3::from_matrix_unchecked(a.rotation.matrix.tr_mul(&b.rotation.matrix)).scaled_axis();
    let turned: Matrix3<f64> = a.rotation.matrix * Rotation3::new(turn * s).matrix();
    Published {
        position: a.position + (start + (c + d * s) * s) * s,
        velocity: (start + (c * 2.0 + d * (3.0 * s)) * s) / h,
        rotation: Rotation::from_matrix(turned),
        body_rates: a.body_rates.lerp(&b.body_rates, s),
    }
}

impl Quadrotor for RecordedQuadrotor {
    fn flight(&self) -> Flight<f64> {
        let Published {
            position,
            velocity,
            rotation,
            body_rates,
        } = self.published;
        Flight {
            position,
            velocity,
            attitude: rotation.euler_angles(),
            rotation,
            body_rates,
            thrusts: None,
        }
    }

    fn model_level(&self) -> Option<Level> {
        None
    }
}

impl Agent for RecordedQuadrotor {
    fn name(&self) -> &str {
        &self.name
    }

    fn kind(&self) -> &'static str {
        "recorded-quadrotor"
    }

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
        let (xyz, angles) = (["x", "y", "z"], ["roll", "pitch", "yaw"]);
        let mut all = Vec::new();
        all.extend(Channel::group("position", xyz, Role::State, "m", Frame::World));
        all.extend(Channel::group("velocity", xyz, Role::State, "m/s", Frame::World));
        all.extend(Channel::group(
            "attitude",
            angles,
            Role::State,
            "rad",
            Frame::Scalar,
        ));
        let rates = ["p", "q", "r"];
        all.extend(Channel::group(
            "body_rate",
            rates,
            Role::State,
            "rad/s",
            Frame::Body,
        ));
        all
    }

    fn record(&self, row: &mut [f64]) {
        row[..3].copy_from_slice(self.published.position.as_slice());
        row[3..6].copy_from_slice(self.published.velocity.as_slice());
        row[6..9].copy_from_slice(self.published.rotation.euler_angles().vector().as_slice());
        row[9..].copy_from_slice(self.published.body_rates.as_slice());
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
