//! References: what a quadrotor is asked to do, as the engine's guidance.
//!
//! ```text
//! circle   r = c + ρ (cos β, sin β, 0) − (0, 0, w t),  β = β₀ + Ω t,  Ω = 2π / T
//! ```
//!
//! with T the time of a turn, clockwise seen from above, and w the speed upwards; the derivatives are exact.

use super::Goal;
use crate::error::ScenarioError;
use crate::file::{Circle, QuadrotorFile, ReferenceFile, SetPoint};
use nalgebra::Vector3;
use quad_ndi::{FlatOutput, Reference, TiltLaw, Waypoint};
use sifre::{Directory, Follow, Guidance, Mission, Moment, Schedule, Tilt, UnknownAgent};

/// What a quadrotor is asked to do.
#[derive(Clone, Debug)]
pub(crate) enum Task {
    Hold(Reference<f64>),
    Steps {
        first: Reference<f64>,
        schedule: Schedule<Reference<f64>>,
        last: SetPoint,
    },
    Mission(Mission),
    Circle(Turn),
    Follow(Follow),
}

/// A circle and what turns it into a reference.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn {
    circle: Circle,
    gravity: f64,
    law: TiltLaw,
}

impl Task {
    /// The task of a quadrotor in gravity g, m/s².
    pub(super) fn of(file: &QuadrotorFile, gravity: f64, law: TiltLaw) -> Result<Self, ScenarioError> {
        let agent = &file.name;
        let mission = |waypoints: &[Waypoint], key| {
            super::finite_waypoints(&format!("quadrotor \"{agent}\""), key, waypoints)?;
            Mission::through(waypoints, gravity, law)
                .map(Self::Mission)
                .map_err(|source| ScenarioError::Trajectory {
                    agent: agent.clone(),
                    source,
                })
        };
        match &file.reference {
            ReferenceFile::Hold { position_m, yaw_deg } => {
                finite(agent, position_m.iter().chain([yaw_deg]))?;
                Ok(Self::Hold(hold(*position_m, *yaw_deg)))
            }
            ReferenceFile::Steps { steps } => set_points(agent, steps),
            ReferenceFile::Waypoints { waypoints } => {
                let waypoints: Vec<Waypoint> = waypoints.iter().map(Waypoint::from).collect();
                mission(&waypoints, "reference.waypoints")
            }
            ReferenceFile::Polynomial(polynomial) => {
                for (key, value) in polynomial.conditions() {
                    super::finite(
                        &format!("quadrotor \"{agent}\""),
                        format!("reference.{key}"),
                        value,
                    )?;
                }
                mission(&polynomial.waypoints(), "reference")
            }
            ReferenceFile::Circle(circle) => turn(agent, circle, gravity, law),
            ReferenceFile::Follow {
                agent: leader,
                offset_m,
                yaw_deg,
            } => {
                finite(agent, offset_m.iter().chain([yaw_deg]))?;
                Ok(Self::Follow(Follow::agent(
                    leader.clone(),
                    *offset_m,
                    yaw_deg.to_radians(),
                )))
            }
        }
    }

    /// What it asks for at the start; `None` if that depends on another agent.
    pub(super) fn first(&self) -> Option<FlatOutput<f64>> {
        match self {
            Self::Hold(reference) => Some(reference.flat),
            Self::Steps { first, .. } => Some(first.flat),
            Self::Mission(mission) => Some(mission.trajectory.flat_output(0.0)),
            Self::Circle(turn) => Some(turn.flat_output(0.0)),
            Self::Follow(_) => None,
        }
    }

    /// Where it ends; `None` if it doesn't.
    pub(super) fn goal(&self, agent: &str) -> Option<Goal> {
        let goal = |position: Vector3<f64>, from_s| Goal {
            agent: agent.to_owned(),
            position,
            from_s,
        };
        match self {
            Self::Hold(reference) => Some(goal(reference.flat.position, 0.0)),
            Self::Steps { last, .. } => Some(goal(last.position_m.into(), last.from_s)),
            Self::Mission(Mission { trajectory, .. }) => {
                let end_s = trajectory.end_s();
                Some(goal(trajectory.flat_output(end_s).position, end_s))
            }
            Self::Circle(_) | Self::Follow(_) => None,
        }
    }
}

impl Guidance for Task {
    fn bind(&mut self, directory: &Directory<'_>) -> Result<(), UnknownAgent> {
        match self {
            Self::Follow(follow) => follow.bind(directory),
            _ => Ok(()),
        }
    }

    fn tilt(&self) -> Option<Tilt> {
        match self {
            Self::Mission(mission) => mission.tilt(),
            Self::Circle(Turn { gravity, law, .. }) => Some(Tilt {
                gravity: *gravity,
                law: *law,
            }),
            Self::Hold(_) | Self::Steps { .. } | Self::Follow(_) => None,
        }
    }

    fn reference(&self, now: &Moment<'_>) -> Reference<f64> {
        match self {
            Self::Hold(reference) => *reference,
            Self::Steps { first, schedule, .. } => *schedule.at(now.time_ns).unwrap_or(first),
            Self::Mission(mission) => mission.reference(now),
            Self::Circle(turn) => Reference::following(turn.flat_output(now.time_s), turn.gravity, turn.law),
            Self::Follow(follow) => follow.reference(now),
        }
    }
}

impl Turn {
    fn flat_output(&self, t: f64) -> FlatOutput<f64> {
        let circle = &self.circle;
        let rate = std::f64::consts::TAU / circle.period_s;
        let (sin, cos) = (circle.bearing_deg.to_radians() + rate * t).sin_cos();
        // Each derivative of (cos, sin) is a quarter turn further.
        let quarter_turns = [
            Vector3::new(cos, sin, 0.0),
            Vector3::new(-sin, cos, 0.0),
            Vector3::new(-cos, -sin, 0.0),
            Vector3::new(sin, -cos, 0.0),
        ];
        let derivative = |k: usize| quarter_turns[k % 4] * (circle.radius_m * rate.powi(k as i32));
        let up = Vector3::new(0.0, 0.0, -circle.climb_m_s);
        FlatOutput {
            position: Vector3::from(circle.centre_m) + derivative(0) + up * t,
            velocity: derivative(1) + up,
            acceleration: derivative(2),
            jerk: derivative(3),
            snap: derivative(4),
            crackle: derivative(5),
            ..FlatOutput::at_rest(Vector3::zeros(), circle.yaw_deg.to_radians())
        }
    }
}

fn hold(position_m: [f64; 3], yaw_deg: f64) -> Reference<f64> {
    Reference::hold(position_m.into(), yaw_deg.to_radians())
}

fn set_points(agent: &str, steps: &[SetPoint]) -> Result<Task, ScenarioError> {
    let (Some(first), Some(last)) = (steps.first(), steps.last()) else {
        return Err(ScenarioError::Empty {
            agent: agent.to_owned(),
            key: "reference.steps",
        });
    };
    let reference = |point: &SetPoint| hold(point.position_m, point.yaw_deg);
    for point in steps {
        finite(agent, point.position_m.iter().chain([&point.yaw_deg]))?;
    }
    let schedule = Schedule::new(steps.iter().map(|point| (point.from_s, reference(point))));
    Ok(Task::Steps {
        first: reference(first),
        schedule: schedule.map_err(|source| ScenarioError::Schedule {
            agent: agent.to_owned(),
            key: "reference.steps",
            source,
        })?,
        last: *last,
    })
}

fn turn(agent: &str, circle: &Circle, gravity: f64, law: TiltLaw) -> Result<Task, ScenarioError> {
    let more = [
        circle.radius_m,
        circle.period_s,
        circle.climb_m_s,
        circle.bearing_deg,
        circle.yaw_deg,
    ];
    finite(agent, circle.centre_m.iter().chain(&more))?;
    if circle.period_s == 0.0 {
        return Err(ScenarioError::Number {
            agent: format!("quadrotor \"{agent}\""),
            key: "reference.period_s".to_owned(),
            value: circle.period_s,
            must: "non-zero",
        });
    }
    let circle = *circle;
    Ok(Task::Circle(Turn { circle, gravity, law }))
}

fn finite<'a>(agent: &str, numbers: impl IntoIterator<Item = &'a f64>) -> Result<(), ScenarioError> {
    let agent = format!("quadrotor \"{agent}\"");
    numbers
        .into_iter()
        .try_for_each(|&value| super::finite(&agent, "a number of the reference", value))
}
