//! Saving and resuming.
//!
//! A snapshot holds the time, and each agent's state, memory and what others see of it. It does not hold how the
//! agents were put together (vehicles, gains, guidance, closures): that is the scenario's, and is given again to
//! [`Engine::resume`]. Nor does it hold black boxes, stop conditions and threads, which are attached anew.

use super::recorder::first_not_before;
use super::{Engine, Place};
use crate::agent::{Member, MemoryError, Published};
use crate::clock::StepSize;
use crate::error::SnapshotError;
use crate::event::Event;
use crate::exact::{Exact, exact, plain};
use quad_math::TimeGrid;
use serde::{Deserialize, Serialize};
use std::io::{Read, Write};

/// The version of what snapshots hold.
const FORMAT: u32 = 1;

/// What has been done at the present instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Phase {
    /// Nothing.
    Fresh,
    /// The agents due have published, decided and been recorded.
    Decided,
    /// They have moved too: the instant is over.
    Moved,
}

/// A simulation at rest between two runs, as JSON can hold it bit for bit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SimulationSnapshot {
    /// Version of the format.
    pub sifre_snapshot: u32,
    /// The present, ns.
    pub time_ns: u64,
    /// What has been done at it.
    pub phase: Phase,
    /// The agents.
    pub agents: Vec<AgentSnapshot>,
    /// What happened so far.
    pub events: Vec<Event>,
}

/// An agent at rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AgentSnapshot {
    /// Its name.
    pub name: String,
    /// Its kind.
    pub kind: String,
    /// Its step.
    pub step_s: StepSize,
    /// What others see: position and velocity (W), attitude matrix column by column, body rates.
    pub published: Vec<Exact>,
    /// What it recorded at its latest instant, if a black box was going to look.
    pub row: Option<Vec<Exact>>,
    /// What it saved of itself.
    pub memory: serde_json::Value,
}

impl SimulationSnapshot {
    /// Writes it as JSON.
    ///
    /// # Errors
    /// If it can't be written.
    pub fn write_json(&self, to: impl Write) -> Result<(), SnapshotError> {
        Ok(serde_json::to_writer(to, self)?)
    }

    /// Reads it from JSON.
    ///
    /// # Errors
    /// If it can't be read, is no snapshot, or one of another version.
    pub fn read_json(from: impl Read) -> Result<Self, SnapshotError> {
        let snapshot: Self = serde_json::from_reader(from)?;
        snapshot.check()?;
        Ok(snapshot)
    }

    fn check(&self) -> Result<(), SnapshotError> {
        let (expected, found) = (FORMAT, self.sifre_snapshot);
        if found != expected {
            return Err(SnapshotError::Version { expected, found });
        }
        let time_ns = self.time_ns;
        TimeGrid::new(1, time_ns).map_err(|_| SnapshotError::Time { time_ns })?;
        Ok(())
    }
}

impl Engine {
    /// The simulation as it is now.
    ///
    /// # Errors
    /// If an agent can't say its state as JSON.
    pub fn save(&self) -> Result<SimulationSnapshot, SnapshotError> {
        let agent = |(id, name): (usize, &String)| {
            let slot = self.slot(id);
            Ok(AgentSnapshot {
                name: name.clone(),
                kind: slot.agent.kind().to_owned(),
                step_s: self.groups[self.places[id].group].step,
                published: exact(&self.scene[id].to_array()),
                row: slot.row_is_current.then(|| exact(&slot.row)),
                memory: slot.agent.save()?,
            })
        };
        let agents: Result<Vec<_>, serde_json::Error> = self.names.iter().enumerate().map(agent).collect();
        Ok(SimulationSnapshot {
            sifre_snapshot: FORMAT,
            time_ns: self.now_ns,
            phase: self.phase,
            agents: agents?,
            events: self.events.clone(),
        })
    }

    /// The simulation of these agents, put together as they were at first, resuming from a snapshot.
    ///
    /// # Errors
    /// Agents that can't be simulated, as [`Engine::new`]; or other agents than the snapshot's.
    pub fn resume(members: Vec<Member>, snapshot: &SimulationSnapshot) -> Result<Self, ResumeError> {
        let mut simulation = Self::new(members)?;
        simulation.take_up(snapshot)?;
        Ok(simulation)
    }

    fn take_up(&mut self, snapshot: &SimulationSnapshot) -> Result<(), SnapshotError> {
        snapshot.check()?;
        let sorted = |mut names: Vec<String>| {
            names.sort();
            names
        };
        let theirs = sorted(snapshot.agents.iter().map(|agent| agent.name.clone()).collect());
        let ours = sorted(self.names.to_vec());
        if theirs != ours {
            return Err(SnapshotError::OtherAgents {
                snapshot: theirs,
                simulation: ours,
            });
        }
        let unknown =
            |event: &&Event| event.time_ns > snapshot.time_ns || self.names.find(&event.agent).is_none();
        if let Some(event) = snapshot.events.iter().find(unknown) {
            return Err(SnapshotError::Event {
                agent: event.agent.clone(),
                time_ns: event.time_ns,
            });
        }
        self.now_ns = snapshot.time_ns;
        self.phase = snapshot.phase;
        self.events.clone_from(&snapshot.events);
        for group in &mut self.groups {
            group.next_ns = first_not_before(snapshot.time_ns, group.step);
        }
        for agent in &snapshot.agents {
            self.take_up_agent(agent)?;
        }
        Ok(())
    }

    fn take_up_agent(&mut self, saved: &AgentSnapshot) -> Result<(), SnapshotError> {
        let agent = || saved.name.clone();
        let Some(id) = self.place(&saved.name) else {
            return Ok(()); // The names are the same: checked by the caller.
        };
        let Place { group, slot } = self.places[id];
        let step = self.groups[group].step;
        if step != saved.step_s {
            return Err(SnapshotError::OtherStep {
                agent: agent(),
                expected_s: step.seconds(),
                found_s: saved.step_s.seconds(),
            });
        }
        let slot = &mut self.groups[group].slots[slot];
        if slot.agent.kind() != saved.kind {
            return Err(SnapshotError::OtherKind {
                agent: agent(),
                expected: slot.agent.kind().to_owned(),
                found: saved.kind.clone(),
            });
        }
        let length = |expected: usize, found: usize| SnapshotError::Length {
            agent: agent(),
            expected,
            found,
        };
        let published: [f64; Published::LEN] = plain(&saved.published)
            .try_into()
            .map_err(|numbers: Vec<f64>| length(Published::LEN, numbers.len()))?;
        let published = Published::from_array(&published);
        let memory = |source: MemoryError| SnapshotError::Memory {
            agent: agent(),
            source: Box::new(source),
        };
        published.check().map_err(memory)?;
        self.scene[id] = published;
        if let Some(row) = &saved.row {
            if row.len() != slot.row.len() {
                return Err(length(slot.row.len(), row.len()));
            }
            slot.row = plain(row);
        }
        slot.row_is_current = saved.row.is_some();
        slot.agent.restore(&saved.memory).map_err(memory)
    }
}

/// Why a simulation can't be resumed.
#[derive(Debug, thiserror::Error)]
pub enum ResumeError {
    /// The agents can't be simulated at all.
    #[error(transparent)]
    Simulation(#[from] crate::SimulationError),
    /// They don't fit the snapshot.
    #[error(transparent)]
    Snapshot(#[from] SnapshotError),
}
