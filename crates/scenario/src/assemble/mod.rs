//! From a scenario to agents.

mod controller;
mod estimator;
mod guidance;
mod quadrotor;
mod start;
mod station;

pub(crate) use guidance::Task;

use crate::cost::{self, Judged};
use crate::error::ScenarioError;
use crate::file::{OutputFile, Scenario, StopFile};
use crate::library::{Files, Library};
use ets::Station;
use nalgebra::Vector3;
use quad_dynamics::{Level, Vehicle};
use quad_ndi::{Law, Waypoint};
use sifre::black_box::Selection;
use sifre::{FARTHEST_M, Member, StepSize};
use start::Starts;
use std::sync::Arc;

/// What may not be in a name: it separates keys and columns.
const FORBIDDEN: [char; 4] = ['.', ',', '"', '*'];

/// Most characters of a name: more fit into no line of a report.
const LONGEST_NAME: usize = 100;

/// The agents of a scenario, and what is to happen to them.
#[derive(Debug)]
pub struct Built {
    /// The agents with their steps.
    pub members: Vec<Member>,
    /// What there is to know about them, in the same order.
    pub agents: Vec<AgentInfo>,
    /// How long it lasts, s.
    pub duration_s: f64,
    /// What ends it before.
    pub stop: StopFile,
    /// What is recorded.
    pub output: OutputFile,
    /// Where quadrotors are to end up, in W, m; those whose references end.
    pub(crate) goals: Vec<Goal>,
    /// What may surprise, in words.
    pub notes: Vec<String>,
    /// Whose cost Φ can be asked for.
    pub(crate) judged: Vec<Judged>,
}

/// Where a quadrotor is to end up.
#[derive(Clone, Debug)]
pub(crate) struct Goal {
    pub(crate) agent: String,
    pub(crate) position: Vector3<f64>,
    /// From when on it is asked to be there, s.
    pub(crate) from_s: f64,
}

/// What an animation or a report needs to know about an agent.
#[derive(Clone, Debug)]
pub struct AgentInfo {
    /// Its name.
    pub name: String,
    /// What it is.
    pub kind: AgentKind,
}

/// What an agent is.
#[derive(Clone, Debug)]
pub enum AgentKind {
    /// A quadrotor.
    Quadrotor {
        /// Its vehicle, with its geometry.
        vehicle: Arc<Vehicle>,
        /// The level that it begins at.
        level: Level,
        /// Who flies it.
        law: Law,
    },
    /// An energy transmission system.
    Ets {
        /// The station, with its geometry.
        station: Box<Station>,
        /// Name of the agent that it tracks.
        tracks: String,
    },
    /// A target.
    Target,
}

impl Scenario {
    /// Makes the agents. Files that the scenario names are read by `files`; give `&()` if it names none.
    ///
    /// # Errors
    /// Anything that can't be: a vehicle that isn't there, a controller above its level, waypoints that go back in time.
    /// [`Built::start`] checks that agents refer to existing others.
    pub fn build(&self, files: &dyn Files) -> Result<Built, ScenarioError> {
        self.check()?;
        let mut built = Built {
            members: Vec::new(),
            agents: Vec::new(),
            duration_s: self.duration_s,
            stop: self.stop.clone(),
            output: self.output.clone(),
            goals: Vec::new(),
            notes: Vec::new(),
            judged: Vec::new(),
        };
        let library = Library::new(files);
        let starts = Starts::of(self, &library);
        for file in &self.quadrotor {
            quadrotor::add(&mut built, self, file, (&library, &starts))?;
        }
        built.notes.extend(library.warnings());
        if self.stop.arrived_within_m.is_some() && built.goals.len() < self.quadrotor.len() {
            let note = "stop.arrived_within_m is never met: a quadrotor on a circle or following another never arrives";
            built.notes.push(note.to_owned());
        }
        for file in &self.ets {
            station::add(&mut built, own_seed(self.seed, &file.name), file, &library)?;
        }
        for file in &self.target {
            station::add_target(&mut built, file)?;
        }
        for member in &built.members {
            let step_s = member.step.seconds();
            if step_s > self.duration_s {
                let name = member.agent.name();
                let note = format!(
                    "\"{name}\" decides once and never moves: its step_s = {step_s} is longer than the flight"
                );
                built.notes.push(note);
            }
        }
        built.judged = cost::judged(self, &built.agents)?;
        Ok(built)
    }

    /// What concerns the scenario as a whole.
    fn check(&self) -> Result<(), ScenarioError> {
        let duration_s = self.duration_s;
        StepSize::from_seconds(duration_s)
            .map_err(|source| ScenarioError::Duration { duration_s, source })?;
        if !is_word(&self.name) {
            let name = self.name.clone();
            return Err(ScenarioError::Title { name });
        }
        let bad = |name: &&str| name.trim().is_empty() || name.contains(FORBIDDEN) || !is_word(name);
        if let Some(name) = self.names().find(bad) {
            let name = name.to_owned();
            return Err(ScenarioError::Name { name });
        }
        let stop = &self.stop;
        let corners = stop
            .outside
            .iter()
            .flat_map(|b| b.from_m.into_iter().chain(b.to_m));
        for value in corners.chain([stop.ground_height_m]) {
            finite("stop", "a length", value)?;
        }
        for axis in 0..3 {
            match stop.outside.map(|b| (b.from_m[axis], b.to_m[axis])) {
                Some((from, to)) if from >= to => return Err(ScenarioError::EmptyBox { axis, from, to }),
                _ => {}
            }
        }
        if let Some(path) = &self.output.path
            && self.output.form().is_none()
        {
            return Err(ScenarioError::Form { path: path.clone() });
        }
        match stop.arrived_within_m {
            Some(value) if !(value.is_finite() && value > 0.0) => Err(ScenarioError::Number {
                agent: "stop".to_owned(),
                key: "arrived_within_m".to_owned(),
                value,
                must: "positive and finite",
            }),
            _ => Ok(()),
        }
    }

    /// Names of all agents, in the order of the file's kinds.
    fn names(&self) -> impl Iterator<Item = &str> {
        let quadrotors = self.quadrotor.iter().map(|agent| agent.name.as_str());
        let stations = self.ets.iter().map(|agent| agent.name.as_str());
        let targets = self.target.iter().map(|agent| agent.name.as_str());
        quadrotors.chain(stations).chain(targets)
    }
}

impl Built {
    /// Which channels are recorded.
    #[must_use]
    pub fn selection(&self) -> Selection {
        Selection {
            patterns: self.output.channels.clone(),
        }
    }
}

/// Whether a name can be printed, as it is and in one line.
fn is_word(name: &str) -> bool {
    output::is_printable(name) && name.chars().count() <= LONGEST_NAME
}

/// The seed of an agent: by the scenario's seed and its name (FNV-1a), so that no two agents are twins and their order
/// doesn't matter.
fn own_seed(seed: u64, name: &str) -> u64 {
    const OFFSET: u64 = 0xcbf2_9ce4_8422_2325;
    const PRIME: u64 = 0x0100_0000_01b3;
    let bytes = seed.to_le_bytes().into_iter().chain(name.bytes());
    bytes.fold(OFFSET, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(PRIME))
}

/// Refuses NaN, infinities and numbers that are farther off than anything here: [`FARTHEST_M`] of lengths, as many of speeds and angles.
fn finite(agent: &str, key: impl Into<String>, value: f64) -> Result<(), ScenarioError> {
    if value.abs() <= FARTHEST_M {
        return Ok(());
    }
    Err(ScenarioError::Number {
        agent: agent.to_owned(),
        key: key.into(),
        value,
        must: "finite and at most 1e9 in magnitude",
    })
}

/// Refuses waypoints with such numbers; `key` is their list's.
fn finite_waypoints(agent: &str, key: &str, waypoints: &[Waypoint]) -> Result<(), ScenarioError> {
    for (k, point) in waypoints.iter().enumerate() {
        let groups = [
            ("time_s", &[point.time_s][..]),
            ("position_m", &point.position_m),
            ("velocity_m_s", &point.velocity_m_s),
            ("yaw_deg", &[point.yaw_rad.to_degrees()]),
        ];
        for (what, values) in groups {
            for value in values {
                finite(agent, format!("{key}[{k}].{what}"), *value)?;
            }
        }
    }
    Ok(())
}
