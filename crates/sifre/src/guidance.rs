//! Guidance: what a quadrotor is asked to do, as a function of the time and of what others have published.
//!
//! ```text
//! facing an agent   ψ = atan2(Δy, Δx),  ψ̇ = (Δx Δv_y − Δy Δv_x) / (Δx² + Δy²)
//! ```
//!
//! with Δ from the quadrotor to the agent, both as published; higher derivatives of the heading are left at
//! zero. Near the vertical above or below the agent, where there is no bearing, the path's own heading holds
//! ([`FlatOutput::facing`]). The tilt that the path feeds forward is turned into the new heading, as far as the path says
//! how it came by it ([`Guidance::tilt`]).
//! Source: thesis appendix A (the quadrotor yaws to face the ground station).

use crate::agent::{AgentId, Directory, Moment};
use crate::error::UnknownAgent;
use crate::speed::Hook;
use nalgebra::Vector3;
use quad_ndi::{AttitudeFeedForward, FlatOutput, Reference, TiltLaw, Trajectory, TrajectoryError, Waypoint};
use serde::{Deserialize, Serialize};
use std::fmt::Debug;

/// By which law a guidance feeds forward the tilt that its path implies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tilt {
    /// Gravity g, m/s².
    pub gravity: f64,
    /// How acceleration and tilt go together.
    pub law: TiltLaw,
}

/// Anything that tells a quadrotor what to do.
///
/// A pure function: what it answers depends on itself and the [`Moment`] alone, so there is nothing to save.
pub trait Guidance: Debug + Send {
    /// Looks up the agents that it will look at.
    ///
    /// # Errors
    /// A name that nobody has.
    fn bind(&mut self, _directory: &Directory<'_>) -> Result<(), UnknownAgent> {
        Ok(())
    }

    /// What to do from this instant on.
    fn reference(&self, now: &Moment<'_>) -> Reference<f64>;

    /// The same by reference: its own, where it is always the same, or else put into `room`.
    #[doc(hidden)]
    fn show<'a>(&'a self, now: &Moment<'_>, room: &'a mut Reference<f64>, _: Hook) -> &'a Reference<f64> {
        *room = self.reference(now);
        room
    }

    /// By which law its reference feeds the attitude forward, for who gives the path another heading; `None` if it feeds
    /// forward nothing or something else.
    fn tilt(&self) -> Option<Tilt> {
        None
    }
}

/// A fixed reference.
impl Guidance for Reference<f64> {
    #[inline]
    fn reference(&self, _now: &Moment<'_>) -> Reference<f64> {
        *self
    }

    /// Nothing is copied.
    #[inline]
    fn show<'a>(&'a self, _: &Moment<'_>, _: &'a mut Reference<f64>, _: Hook) -> &'a Reference<f64> {
        self
    }
}

/// A trajectory with the rates of the attitude that it implies fed forward.
#[derive(Clone, Debug, PartialEq)]
pub struct Mission {
    /// Where to be when.
    pub trajectory: Trajectory,
    /// Gravity g, m/s².
    pub gravity: f64,
    /// How acceleration and tilt go together: small angles for c1, exact above.
    pub tilt_law: TiltLaw,
}

impl Mission {
    /// The mission through waypoints in gravity g, m/s².
    ///
    /// # Errors
    /// Waypoints that make no trajectory.
    pub fn through(waypoints: &[Waypoint], gravity: f64, tilt_law: TiltLaw) -> Result<Self, TrajectoryError> {
        Ok(Self {
            trajectory: Trajectory::through(waypoints)?,
            gravity,
            tilt_law,
        })
    }
}

impl Guidance for Mission {
    fn reference(&self, now: &Moment<'_>) -> Reference<f64> {
        Reference::following(
            self.trajectory.flat_output(now.time_s),
            self.gravity,
            self.tilt_law,
        )
    }

    fn tilt(&self) -> Option<Tilt> {
        Some(Tilt {
            gravity: self.gravity,
            law: self.tilt_law,
        })
    }
}

/// Keep a fixed offset from another agent and its velocity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Follow {
    /// Name of the agent.
    pub agent: String,
    /// Offset from it in W, m.
    pub offset_m: [f64; 3],
    /// Heading ψ, rad.
    #[serde(default)]
    pub yaw_rad: f64,
    #[serde(skip)]
    leader: Option<AgentId>,
}

impl Follow {
    /// Keep this offset, m in W, from the agent of this name, at this heading, rad.
    pub fn agent(name: impl Into<String>, offset_m: [f64; 3], yaw_rad: f64) -> Self {
        Self {
            agent: name.into(),
            offset_m,
            yaw_rad,
            leader: None,
        }
    }
}

impl Guidance for Follow {
    fn bind(&mut self, directory: &Directory<'_>) -> Result<(), UnknownAgent> {
        self.leader = Some(directory.find(&self.agent)?);
        Ok(())
    }

    fn reference(&self, now: &Moment<'_>) -> Reference<f64> {
        // Bound when the simulation was put together; until then it leads itself.
        let leader = now.published(self.leader.unwrap_or(now.me));
        let mut reference = Reference::hold(leader.position + Vector3::from(self.offset_m), self.yaw_rad);
        reference.flat.velocity = leader.velocity;
        reference
    }
}

/// Guidance with its heading turned towards another agent.
#[derive(Debug)]
pub struct Facing<G> {
    /// Where to be.
    pub guidance: G,
    /// Name of the agent to face.
    pub agent: String,
    faced: Option<AgentId>,
}

impl<G: Guidance> Facing<G> {
    /// This guidance, facing the agent of this name.
    pub fn agent(guidance: G, name: impl Into<String>) -> Self {
        Self {
            guidance,
            agent: name.into(),
            faced: None,
        }
    }
}

impl<G: Guidance> Guidance for Facing<G> {
    fn bind(&mut self, directory: &Directory<'_>) -> Result<(), UnknownAgent> {
        self.faced = Some(directory.find(&self.agent)?);
        self.guidance.bind(directory)
    }

    fn reference(&self, now: &Moment<'_>) -> Reference<f64> {
        let path = self.guidance.reference(now);
        let (own, faced) = (now.own(), now.published(self.faced.unwrap_or(now.me)));
        let flat = path
            .flat
            .facing(&(faced.position - own.position), &(faced.velocity - own.velocity));
        match self.guidance.tilt() {
            Some(Tilt { gravity, law }) => Reference::following(flat, gravity, law),
            None => Reference {
                flat,
                attitude: with_yaw(&path.attitude, &flat),
            },
        }
    }

    fn tilt(&self) -> Option<Tilt> {
        self.guidance.tilt()
    }
}

/// The feed-forward of the attitude with the yaw of a flat output.
fn with_yaw(attitude: &AttitudeFeedForward<f64>, flat: &FlatOutput<f64>) -> AttitudeFeedForward<f64> {
    let yawing = |v: Vector3<f64>, yaw| Vector3::new(v.x, v.y, yaw);
    AttitudeFeedForward {
        rates: yawing(attitude.rates, flat.yaw_rate),
        accelerations: yawing(attitude.accelerations, flat.yaw_acceleration),
        jerks: yawing(attitude.jerks, flat.yaw_jerk),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::agent::Published;
    use crate::clock::StepSize;
    use crate::names::Names;
    use proptest::prelude::*;
    use quad_kinematics::Rotation;

    /// Two agents at a time, s, each on a straight line: `[x, y, z, v_x, v_y, v_z]` at time 0.
    fn scene(lines: &[[f64; 6]; 2], time_s: f64) -> [Published; 2] {
        lines.map(|l| {
            let velocity = Vector3::new(l[3], l[4], l[5]);
            let position = Vector3::new(l[0], l[1], l[2]) + velocity * time_s;
            let at_rest = Published::at_rest(position, Rotation::identity());
            Published { velocity, ..at_rest }
        })
    }

    fn moment(scene: &[Published]) -> Moment<'_> {
        let step = StepSize::MILLISECOND;
        Moment {
            time_s: 0.0,
            time_ns: 0,
            step,
            step_s: step.seconds(),
            me: AgentId(0),
            scene,
        }
    }

    fn facing() -> Facing<Reference<f64>> {
        let names = Names::new(["me", "other"].map(str::to_owned)).unwrap();
        let mut facing = Facing::agent(Reference::hold(Vector3::zeros(), 0.7), "other");
        let directory = Directory {
            step: StepSize::MILLISECOND,
            asking: "me",
            names: &names,
        };
        facing.bind(&directory).unwrap();
        facing
    }

    proptest! {
        /// The nose points along the horizontal line of sight, and the rate is that of the bearing.
        #[test]
        fn agree_facing_with_differences_of_the_bearing(
            mine in prop::array::uniform6(-3.0..3.0_f64),
            mut other in prop::array::uniform6(-3.0..3.0_f64),
        ) {
            // Two metres of distance at least in x.
            other[0] += if other[0] < mine[0] { -2.0 } else { 2.0 };
            let (facing, lines) = (facing(), [mine, other]);
            let at = |time_s| {
                let scene = scene(&lines, time_s);
                facing.reference(&moment(&scene)).flat
            };
            let flat = at(0.0);
            let d = Vector3::new(other[0] - mine[0], other[1] - mine[1], 0.0);
            let nose = Vector3::new(flat.yaw.cos(), flat.yaw.sin(), 0.0);
            prop_assert!((nose - d.normalize()).norm() < 1e-14);
            let h = 1e-5;
            let turn = at(h).yaw - at(-h).yaw;
            // The bearing may jump by a turn.
            let turn = turn - (turn / std::f64::consts::TAU).round() * std::f64::consts::TAU;
            // h²/6 times a third derivative of at most some (6/2)³ = 1e2, and rounding 1e-16 / h.
            prop_assert!((flat.yaw_rate - turn / (2.0 * h)).abs() < 1e-8);
        }
    }

    /// A path that accelerates, flown with the nose on an agent far behind it: the tilt's feed-forward is that of the heading flown.
    #[test]
    fn agree_the_tilt_is_that_of_the_heading_flown() {
        let waypoint = |time_s, position_m, yaw_rad| Waypoint {
            time_s,
            position_m,
            velocity_m_s: [0.0; 3],
            yaw_rad,
            yaw_rate_rad_s: 0.0,
        };
        let path = |yaw| {
            let ends = [waypoint(0.0, [0.0; 3], yaw), waypoint(2.0, [1.0, 0.5, -0.3], yaw)];
            Mission::through(&ends, 9.81, TiltLaw::Exact).unwrap()
        };
        let far = Vector3::new(-1e9, 0.0, 0.0);
        let at = |position| Published::at_rest(position, Rotation::identity());
        let scene = [at(Vector3::zeros()), at(far)];
        let now = Moment {
            time_s: 0.4,
            ..moment(&scene)
        };
        let mut facing = Facing::agent(path(0.0), "other");
        facing.faced = Some(AgentId(1));
        let (flown, wanted) = (facing.reference(&now), path(std::f64::consts::PI).reference(&now));
        assert!(wanted.attitude.rates.x.abs() > 0.01 && wanted.attitude.rates.y.abs() > 0.01);
        // The bearing turns by 1e-9 rad/s and less; sines of π are 1e-16.
        assert!((flown.attitude.rates - wanted.attitude.rates).norm() < 1e-12);
        assert!((flown.attitude.jerks - wanted.attitude.jerks).norm() < 1e-12);
    }

    #[test]
    fn exact_right_above_there_is_no_bearing() {
        let scene = scene(
            &[[1.0, 2.0, -5.0, 0.0, 0.0, 0.0], [1.0, 2.0, 0.0, 1.0, 0.0, 0.0]],
            0.0,
        );
        let flat = facing().reference(&moment(&scene)).flat;
        assert_eq!((flat.yaw, flat.yaw_rate), (0.7, 0.0));
    }

    #[test]
    fn exact_following_keeps_the_offset_and_the_velocity() {
        let mut follow = Follow::agent("other", [-1.0, 0.5, 0.0], 0.3);
        follow.leader = Some(AgentId(1));
        let scene = scene(&[[0.0; 6], [1.0, 2.0, -3.0, 0.4, 0.5, 0.6]], 2.0);
        let flat = follow.reference(&moment(&scene)).flat;
        assert_eq!(flat.position, scene[1].position + Vector3::new(-1.0, 0.5, 0.0));
        assert_eq!((flat.velocity, flat.yaw), (Vector3::new(0.4, 0.5, 0.6), 0.3));
    }
}
