//! Agents that share a step: what they do at one of their instants.

use crate::agent::{Agent, AgentId, Moment, Published};
use crate::clock::{StepSize, seconds};
use crate::event::AgentEvent;
use crate::speed::Hook;
use rayon::prelude::*;

/// Agents that one thread takes at least: below it, handing them over costs more than moving them.
const LEAST_PER_THREAD: usize = 32;

/// Which threads move the agents due at an instant. The result is the same, bit for bit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Execution {
    /// The one that runs the simulation. Best below some hundred agents.
    #[default]
    OneThread,
    /// Those of rayon's pool around the run. Begin the run inside the pool (`rayon::scope`): from outside, each instant is handed over to it
    /// and waited for, which costs what the second thread wins.
    Parallel,
}

/// An agent, and what the engine keeps of it.
#[derive(Debug)]
pub(super) struct Slot {
    pub(super) id: AgentId,
    pub(super) agent: Box<dyn Agent>,
    /// What it recorded at its latest instant, if somebody was going to look.
    pub(super) row: Vec<f64>,
    pub(super) row_is_current: bool,
    /// What happened at this instant.
    pub(super) event: Option<AgentEvent>,
}

/// Agents that share a step, and their next instant.
#[derive(Debug)]
pub(super) struct Group {
    pub(super) step: StepSize,
    /// The same, s.
    pub(super) step_s: f64,
    /// Their next instant, ns; the present one until it is left.
    pub(super) next_ns: u64,
    pub(super) slots: Vec<Slot>,
}

/// What is to be done at an instant beside deciding.
#[derive(Clone, Copy, Debug)]
pub(super) struct Work {
    pub(super) capture: bool,
    pub(super) advance: bool,
    pub(super) execution: Execution,
}

impl Slot {
    /// Decides, keeps the row, moves; tells whether something happened.
    #[inline]
    fn live(&mut self, now: &Moment<'_>, work: Work) -> bool {
        self.row_is_current = work.capture;
        let event = if work.advance && !work.capture {
            self.agent.decide_and_advance(now, Hook(()))
        } else {
            let event = self.agent.decide(now);
            if work.capture {
                self.agent.record(&mut self.row);
            }
            if work.advance {
                self.agent.advance(now);
            }
            event
        };
        let happened = event.is_some();
        if happened {
            self.event = event;
        }
        happened
    }
}

impl Group {
    /// The present instant of the group, as its first agent sees it.
    fn moment<'a>(&self, scene: &'a [Published]) -> Moment<'a> {
        Moment {
            time_s: seconds(self.next_ns),
            time_ns: self.next_ns,
            step: self.step,
            step_s: self.step_s,
            me: AgentId(0),
            scene,
        }
    }

    /// All agents decide, and move if they are to; tells whether something happened.
    pub(super) fn live(&mut self, scene: &[Published], work: Work) -> bool {
        let now = self.moment(scene);
        let one = |slot: &mut Slot| slot.live(&Moment { me: slot.id, ..now }, work);
        match work.execution {
            Execution::OneThread => self.slots.iter_mut().fold(false, |any, slot| one(slot) | any),
            Execution::Parallel => {
                let slots = self.slots.par_iter_mut().with_min_len(LEAST_PER_THREAD);
                slots.map(one).reduce(|| false, |a, b| a | b)
            }
        }
    }

    /// All agents move with what they decided before.
    pub(super) fn advance(&mut self, scene: &[Published], execution: Execution) {
        let now = self.moment(scene);
        let one = |slot: &mut Slot| slot.agent.advance(&Moment { me: slot.id, ..now });
        match execution {
            Execution::OneThread => self.slots.iter_mut().for_each(one),
            Execution::Parallel => self
                .slots
                .par_iter_mut()
                .with_min_len(LEAST_PER_THREAD)
                .for_each(one),
        }
    }
}
