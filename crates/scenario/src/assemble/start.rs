//! Where agents begin: as their references do, unless the file says otherwise.

use super::guidance::Task;
use crate::error::ScenarioError;
use crate::file::{PathFile, QuadrotorFile, ReferenceFile, Scenario};
use crate::library::{Files, station};
use nalgebra::Vector3;
use quad_ndi::TiltLaw;

/// Where an agent begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct Begin {
    pub(super) position: Vector3<f64>,
    pub(super) velocity: Vector3<f64>,
    pub(super) yaw: f64,
}

/// Gravity and tilt are of no account for where a path begins.
const ANY_GRAVITY: f64 = 9.81;

/// Where a quadrotor begins, its nose towards the agent that it is to face.
pub(super) fn of(
    scenario: &Scenario,
    file: &QuadrotorFile,
    files: &dyn Files,
) -> Result<Begin, ScenarioError> {
    let mut begin = unturned(scenario, file, scenario.quadrotor.len())?;
    if let (Some(faced), None) = (&file.facing, &file.start)
        && let Some(at) = position(scenario, faced, files)?
    {
        let d = at - begin.position;
        if d.x != 0.0 || d.y != 0.0 {
            begin.yaw = d.y.atan2(d.x);
        }
    }
    Ok(begin)
}

/// The same, whatever it faces. Chains of followers end after as many links as there are quadrotors.
fn unturned(scenario: &Scenario, file: &QuadrotorFile, links: usize) -> Result<Begin, ScenarioError> {
    if let Some(start) = &file.start {
        return Ok(Begin {
            position: start.position_m.into(),
            velocity: start.velocity_m_s.into(),
            yaw: start.yaw_deg.to_radians(),
        });
    }
    if let ReferenceFile::Follow {
        agent,
        offset_m,
        yaw_deg,
    } = &file.reference
    {
        let leader = scenario.quadrotor.iter().find(|other| other.name == *agent);
        let target = scenario.target.iter().find(|other| other.name == *agent);
        let begin = match (leader, target) {
            (Some(leader), _) if links > 1 => unturned(scenario, leader, links - 1).ok(),
            (None, Some(target)) => Some(still(path_start(&target.path))),
            _ => None,
        };
        let begin = begin.ok_or_else(|| ScenarioError::NoStart {
            agent: file.name.clone(),
            leader: agent.clone(),
        })?;
        return Ok(Begin {
            position: begin.position + Vector3::from(*offset_m),
            velocity: begin.velocity,
            yaw: yaw_deg.to_radians(),
        });
    }
    let flat = Task::of(file, ANY_GRAVITY, TiltLaw::Exact)?.first();
    // Only a follower has none, and that was the case above.
    Ok(flat.map_or(still(Vector3::zeros()), |flat| Begin {
        position: flat.position,
        velocity: flat.velocity,
        yaw: flat.yaw,
    }))
}

fn still(position: Vector3<f64>) -> Begin {
    Begin {
        position,
        velocity: Vector3::zeros(),
        yaw: 0.0,
    }
}

/// Where the agent of a name begins; `None` if there is none of that name, which the engine will tell.
fn position(
    scenario: &Scenario,
    name: &str,
    files: &dyn Files,
) -> Result<Option<Vector3<f64>>, ScenarioError> {
    if let Some(file) = scenario.quadrotor.iter().find(|other| other.name == name) {
        return Ok(Some(unturned(scenario, file, scenario.quadrotor.len())?.position));
    }
    if let Some(file) = scenario.ets.iter().find(|other| other.name == name) {
        return match file.position_m {
            Some(at) => Ok(Some(at.into())),
            None => Ok(Some(
                station(name, &file.station, files)?.pedestal.position.into(),
            )),
        };
    }
    let target = scenario.target.iter().find(|other| other.name == name);
    Ok(target.map(|file| path_start(&file.path)))
}

fn path_start(path: &PathFile) -> Vector3<f64> {
    match path {
        PathFile::Fixed { position_m, .. } => Vector3::from(*position_m),
        PathFile::Waypoints { waypoints } => waypoints
            .first()
            .map_or_else(Vector3::zeros, |point| point.position_m.into()),
    }
}
