//! Where agents begin: as their references do, unless the file says otherwise.

use super::guidance::Task;
use crate::error::ScenarioError;
use crate::file::{EtsFile, PathFile, QuadrotorFile, ReferenceFile, Scenario, TargetFile};
use crate::library::Library;
use nalgebra::Vector3;
use quad_ndi::TiltLaw;
use std::cell::RefCell;
use std::collections::HashMap;

/// Where an agent begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct Begin {
    pub(super) position: Vector3<f64>,
    pub(super) velocity: Vector3<f64>,
    pub(super) yaw: f64,
}

/// Gravity and tilt are of no account for where a path begins.
const ANY_GRAVITY: f64 = 9.81;

/// Where the agents of a scenario begin, each found by name and worked out once.
pub(super) struct Starts<'a> {
    library: &'a Library<'a>,
    quadrotors: HashMap<&'a str, &'a QuadrotorFile>,
    stations: HashMap<&'a str, &'a EtsFile>,
    targets: HashMap<&'a str, &'a TargetFile>,
    known: RefCell<HashMap<&'a str, Begin>>,
}

impl<'a> Starts<'a> {
    /// Those of a scenario.
    pub(super) fn of(scenario: &'a Scenario, library: &'a Library<'a>) -> Self {
        Self {
            library,
            quadrotors: scenario
                .quadrotor
                .iter()
                .map(|file| (file.name.as_str(), file))
                .collect(),
            stations: scenario
                .ets
                .iter()
                .map(|file| (file.name.as_str(), file))
                .collect(),
            targets: scenario
                .target
                .iter()
                .map(|file| (file.name.as_str(), file))
                .collect(),
            known: RefCell::default(),
        }
    }

    /// Where a quadrotor begins, its nose towards the agent that it is to face.
    pub(super) fn start(&self, file: &'a QuadrotorFile) -> Result<Begin, ScenarioError> {
        let mut begin = self.unturned(file)?;
        if let (Some(faced), None) = (&file.facing, &file.start)
            && let Some(at) = self.position(faced)?
        {
            let d = at - begin.position;
            if d.x != 0.0 || d.y != 0.0 {
                begin.yaw = d.y.atan2(d.x);
            }
        }
        Ok(begin)
    }

    /// The same, whatever it faces: up the chain of those whom it follows to one whose start is known, and down again.
    fn unturned(&self, file: &'a QuadrotorFile) -> Result<Begin, ScenarioError> {
        let (mut chain, mut at) = (Vec::new(), file);
        let mut begin = loop {
            if let Some(known) = self.known.borrow().get(at.name.as_str()) {
                break Some(*known);
            }
            let Some((leader, ..)) = followed(at) else {
                // What is wrong with a leader is reported where the leader is added.
                let own = own(at);
                break if chain.is_empty() { Some(own?) } else { own.ok() };
            };
            chain.push(at);
            match (self.quadrotors.get(leader), self.targets.get(leader)) {
                // A chain with more links than there are quadrotors is a ring.
                (Some(next), _) if chain.len() < self.quadrotors.len() => at = next,
                (None, Some(target)) => break Some(still(path_start(&target.path))),
                _ => break None,
            }
        }
        .ok_or_else(|| ScenarioError::NoStart {
            agent: file.name.clone(),
            leader: followed(file).map_or_else(String::new, |(leader, ..)| leader.to_owned()),
        })?;
        let mut known = self.known.borrow_mut();
        for follower in chain.into_iter().rev() {
            if let Some((_, offset_m, yaw_deg)) = followed(follower) {
                begin = Begin {
                    position: begin.position + Vector3::from(offset_m),
                    velocity: begin.velocity,
                    yaw: yaw_deg.to_radians(),
                };
            }
            known.insert(&follower.name, begin);
        }
        Ok(begin)
    }

    /// Where the agent of a name begins; `None` if there is none of that name, which the engine will tell.
    fn position(&self, name: &str) -> Result<Option<Vector3<f64>>, ScenarioError> {
        if let Some(file) = self.quadrotors.get(name) {
            return Ok(Some(self.unturned(file)?.position));
        }
        if let Some(file) = self.stations.get(name) {
            let at = match file.position_m {
                Some(at) => at,
                None => self.library.station(name, &file.station)?.pedestal.position,
            };
            return Ok(Some(at.into()));
        }
        Ok(self.targets.get(name).map(|file| path_start(&file.path)))
    }
}

/// Whom a quadrotor without a start of its own follows, at which offset, m, and with which heading, degrees.
fn followed(file: &QuadrotorFile) -> Option<(&str, [f64; 3], f64)> {
    match (&file.start, &file.reference) {
        (
            None,
            ReferenceFile::Follow {
                agent,
                offset_m,
                yaw_deg,
            },
        ) => Some((agent, *offset_m, *yaw_deg)),
        _ => None,
    }
}

/// Where a quadrotor that waits for nobody begins.
fn own(file: &QuadrotorFile) -> Result<Begin, ScenarioError> {
    if let Some(start) = &file.start {
        return Ok(Begin {
            position: start.position_m.into(),
            velocity: start.velocity_m_s.into(),
            yaw: start.yaw_deg.to_radians(),
        });
    }
    let flat = Task::of(file, ANY_GRAVITY, TiltLaw::Exact)?.first();
    // Only a follower has none, and it waits for its leader.
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

fn path_start(path: &PathFile) -> Vector3<f64> {
    match path {
        PathFile::Fixed { position_m, .. } => Vector3::from(*position_m),
        PathFile::Waypoints { waypoints } => waypoints
            .first()
            .map_or_else(Vector3::zeros, |point| point.position_m.into()),
    }
}
