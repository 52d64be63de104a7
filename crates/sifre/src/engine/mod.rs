//! The simulation: agents on one exact clock.
//!
//! Time is a whole number of nanoseconds. An agent with step h has its instants at `0, h, 2h, …`; steps need not
//! be multiples of each other. At each instant of anyone, the agents due
//!
//! 1. publish,
//! 2. decide, seeing what everybody has published up to now,
//! 3. are recorded,
//! 4. move to their next instant.
//!
//! Nothing that an agent does at an instant is visible to another before the first one's next instant, so neither the
//! order of agents nor threads matter. Runs end at a time, at a [`StopCondition`], where an agent diverges, or where
//! the [`Observer`] asks for it; they can always be continued, and [saved](Engine::save) and
//! [resumed](Engine::resume), bit for bit.

mod group;
mod recorder;
mod run;
mod snapshot;
mod stop;

pub use group::Execution;
pub use recorder::RecorderId;
pub use snapshot::{AgentSnapshot, Phase, ResumeError, SimulationSnapshot};
pub use stop::{
    LastSeen, Observer, PROGRESS_EVERY, Progress, RunReport, RunStatus, Scene, StopCondition, Test, Who,
};

use crate::agent::{Agent, AgentId, Directory, Member, Published};
use crate::black_box::{BlackBox, BlackBoxError, Channel};
use crate::clock::{StepSize, seconds};
use crate::error::SimulationError;
use crate::event::Event;
use crate::names::Names;
use crate::simulation::Simulation;
use group::{Group, Slot};
use recorder::Recorder;
use std::any::Any;
use stop::Watched;

/// Agents, time, and what watches them.
#[derive(Debug)]
pub struct Engine {
    /// Names in the order in which the agents were given: the order of rows.
    names: Names,
    /// Where each of them is.
    places: Vec<Place>,
    groups: Vec<Group>,
    /// What each has published last.
    scene: Vec<Published>,
    recorders: Vec<Recorder>,
    recorders_ever: usize,
    conditions: Vec<Watched>,
    events: Vec<Event>,
    execution: Execution,
    now_ns: u64,
    phase: Phase,
}

/// Where an agent is among the groups.
#[derive(Clone, Copy, Debug)]
struct Place {
    group: usize,
    slot: usize,
}

impl Engine {
    /// A simulation of these agents at time 0.
    ///
    /// # Errors
    /// No agents, two of one name, an agent that looks at one that isn't there or can't have its step.
    pub fn new(members: Vec<Member>) -> Result<Self, SimulationError> {
        let names = Names::new(members.iter().map(|m| m.agent.name().to_owned()))
            .map_err(|name| SimulationError::DuplicateName { name })?;
        if names.is_empty() {
            return Err(SimulationError::Empty);
        }
        let mut simulation = Self {
            places: Vec::with_capacity(names.len()),
            groups: Vec::new(),
            scene: members.iter().map(|m| m.agent.published()).collect(),
            recorders: Vec::new(),
            recorders_ever: 0,
            conditions: Vec::new(),
            events: Vec::new(),
            execution: Execution::default(),
            now_ns: 0,
            phase: Phase::Fresh,
            names,
        };
        for (id, member) in members.into_iter().enumerate() {
            simulation.add(id, member)?;
        }
        Ok(simulation)
    }

    fn add(&mut self, id: usize, Member { mut agent, step }: Member) -> Result<(), SimulationError> {
        agent.bind(&Directory {
            step,
            asking: &self.names[id],
            names: &self.names,
        })?;
        let group = match self.groups.iter().position(|group| group.step == step) {
            Some(group) => group,
            None => {
                self.groups.push(Group {
                    step,
                    step_s: step.seconds(),
                    next_ns: 0,
                    slots: Vec::new(),
                });
                self.groups.len() - 1
            }
        };
        let slots = &mut self.groups[group].slots;
        let slot = slots.len();
        slots.push(Slot {
            id: AgentId(id),
            row: vec![0.0; agent.channels().len()],
            agent,
            row_is_current: false,
            event: None,
        });
        self.places.push(Place { group, slot });
        Ok(())
    }

    /// Moves agents on other threads too, or on one only (the default).
    pub fn execute(&mut self, execution: Execution) {
        self.execution = execution;
    }

    /// Ends runs at this condition too.
    ///
    /// # Errors
    /// If it is on an agent that isn't there.
    pub fn stop_when(&mut self, condition: StopCondition) -> Result<(), SimulationError> {
        let of = match &condition {
            StopCondition::Below {
                who: Who::Agent(name),
                ..
            } => {
                let unknown = || SimulationError::UnknownInCondition {
                    wanted: name.clone(),
                    known: self.names.to_vec(),
                };
                Some(self.find(name).ok_or_else(unknown)?)
            }
            _ => None,
        };
        self.conditions.push(Watched { condition, of });
        Ok(())
    }

    /// Forgets all stop conditions.
    pub fn clear_stop_conditions(&mut self) {
        self.conditions.clear();
    }

    /// The present, s.
    pub fn now_s(&self) -> f64 {
        seconds(self.now_ns)
    }

    /// The present, ns.
    pub fn now_ns(&self) -> u64 {
        self.now_ns
    }

    /// What happened so far, in order of time; by name at one instant.
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// Names of the agents, in the order in which they were given.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The agent of this name, as a [`Scene`] knows it.
    pub fn find(&self, name: &str) -> Option<AgentId> {
        self.place(name).map(AgentId)
    }

    /// What the agent of this name has published last.
    pub fn published(&self, name: &str) -> Option<&Published> {
        self.place(name).map(|id| &self.scene[id])
    }

    /// The agent of this name, if it is of this type.
    pub fn agent<A: Agent>(&self, name: &str) -> Option<&A> {
        let agent: &dyn Any = self.slot(self.place(name)?).agent.as_ref();
        agent.downcast_ref()
    }

    /// The agent of this name, if it is of this type, to be changed between runs.
    pub fn agent_mut<A: Agent>(&mut self, name: &str) -> Option<&mut A> {
        let Place { group, slot } = self.places[self.place(name)?];
        let agent: &mut dyn Any = self.groups[group].slots[slot].agent.as_mut();
        agent.downcast_mut()
    }

    fn place(&self, name: &str) -> Option<usize> {
        self.names.find(name)
    }

    fn slot(&self, id: usize) -> &Slot {
        let Place { group, slot } = self.places[id];
        &self.groups[group].slots[slot]
    }
}

impl Simulation for Engine {
    fn names(&self) -> &[String] {
        Self::names(self)
    }

    fn now_ns(&self) -> u64 {
        self.now_ns
    }

    fn published(&self, name: &str) -> Option<&Published> {
        Self::published(self, name)
    }

    fn channels(&self) -> Vec<Channel> {
        Self::channels(self)
    }

    fn attach_box(
        &mut self,
        step: StepSize,
        black_box: Box<dyn BlackBox>,
    ) -> Result<RecorderId, SimulationError> {
        self.attach_boxed(step, black_box)
    }

    fn detach_box(&mut self, id: RecorderId) -> Option<Result<Box<dyn BlackBox>, BlackBoxError>> {
        self.detach_boxed(id)
    }

    fn run(&mut self, end_s: f64, observer: &mut dyn Observer) -> Result<RunReport, SimulationError> {
        Self::run(self, end_s, observer)
    }
}
