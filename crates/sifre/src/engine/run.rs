//! Running: from instant to instant, until something says stop.

use super::group::Work;
use super::{Engine, LastSeen, Observer, PROGRESS_EVERY, Phase, Progress, RunReport, RunStatus, Scene};
use crate::agent::Invalid;
use crate::clock::{StepSize, instant_ns, seconds};
use crate::error::SimulationError;
use crate::event::{AgentEvent, Event};
use crate::speed::Hook;

impl Engine {
    /// Runs to an end time, s, or to whatever ends the run before; can be called again with a later end.
    ///
    /// The instant at which a run ends is complete but for the move to the next: everybody has published, decided and
    /// been recorded there.
    ///
    /// # Errors
    /// An end before the present, or one that the clock doesn't have. All that happens during the run is a
    /// [`RunStatus`] instead.
    pub fn run(&mut self, end_s: f64, observer: &mut dyn Observer) -> Result<RunReport, SimulationError> {
        let end_ns = instant_ns(end_s)?;
        if end_ns < self.now_ns {
            let now_s = self.now_s();
            return Err(SimulationError::EndBeforeNow { end_s, now_s });
        }
        let mut agent_steps = 0;
        let mut instants: u64 = 0;
        let status = loop {
            if self.phase == Phase::Fresh
                && let Some(status) = self.live(end_ns, &mut agent_steps, observer)
            {
                break status;
            }
            if self.now_ns >= end_ns {
                break RunStatus::Completed;
            }
            if self.phase == Phase::Decided {
                agent_steps += self.advance();
            }
            instants += 1;
            if instants.is_multiple_of(PROGRESS_EVERY) {
                let time_s = self.now_s();
                let progress = Progress {
                    time_s,
                    end_s,
                    agent_steps,
                };
                if observer.progress(&progress).is_break() {
                    break RunStatus::Interrupted;
                }
            }
            self.go_to_next_instant(end_ns);
        };
        Ok(RunReport {
            status,
            time_s: self.now_s(),
            agent_steps,
        })
    }

    /// Everything of a fresh instant, the move included unless the run ends here; why it ends, if it does.
    fn live(&mut self, end_ns: u64, agent_steps: &mut u64, observer: &mut dyn Observer) -> Option<RunStatus> {
        if let Some(diverged) = self.publish() {
            return Some(diverged);
        }
        let mut stop = self.stop_reason();
        let advance = stop.is_none() && self.now_ns < end_ns;
        let (moved, happened) = self.decide(advance);
        if happened {
            let failed = self.note_events(observer);
            stop = stop.or(failed);
        }
        self.phase = if advance {
            *agent_steps += moved;
            Phase::Moved
        } else {
            Phase::Decided
        };
        if let Err(source) = self.record() {
            return Some(RunStatus::RecordingFailed { source });
        }
        stop
    }

    /// The agents due publish. An invalid state is not published: the last valid one remains.
    fn publish(&mut self) -> Option<RunStatus> {
        let mut diverged: Option<(usize, StepSize, Invalid)> = None;
        for group in self.groups.iter().filter(|group| group.next_ns == self.now_ns) {
            for slot in &group.slots {
                let id = slot.id.0;
                let first = |(other, ..): (usize, _, _)| self.names[id] < self.names[other];
                if let Err(why) = slot.agent.publish(&mut self.scene[id], Hook(()))
                    && diverged.is_none_or(first)
                {
                    diverged = Some((id, group.step, why));
                }
            }
        }
        diverged.map(|(id, step, why)| RunStatus::Diverged {
            agent: self.names[id].clone(),
            why,
            likely_cause: self.slot(id).agent.likely_cause(step),
            last: self.now_ns.checked_sub(step.ns()).map(|ns| {
                let (time_s, published) = (seconds(ns), self.scene[id]);
                Box::new(LastSeen { time_s, published })
            }),
        })
    }

    /// The first stop condition that is met.
    fn stop_reason(&self) -> Option<RunStatus> {
        if self.conditions.is_empty() {
            return None;
        }
        let scene = Scene {
            time_ns: self.now_ns,
            names: &self.names,
            published: &self.scene,
        };
        self.conditions.iter().find_map(|condition| condition.met(&scene))
    }

    /// The agents due decide, and move if they are to; how many there were, and whether something happened.
    fn decide(&mut self, advance: bool) -> (u64, bool) {
        let (now_ns, sample_ns) = (self.now_ns, self.next_sample_ns());
        let (mut count, mut happened) = (0, false);
        for group in self.groups.iter_mut().filter(|group| group.next_ns == now_ns) {
            let work = Work {
                // A black box will look at the row before the agents make a new one.
                capture: sample_ns < now_ns + group.step.ns(),
                advance,
                execution: self.execution,
            };
            happened |= group.live(&self.scene, work);
            count += group.slots.len() as u64;
        }
        (count, happened)
    }

    /// The agents due move with what they decided before; how many there were.
    fn advance(&mut self) -> u64 {
        let now_ns = self.now_ns;
        let mut count = 0;
        for group in self.groups.iter_mut().filter(|group| group.next_ns == now_ns) {
            group.advance(&self.scene, self.execution);
            count += group.slots.len() as u64;
        }
        self.phase = Phase::Moved;
        count
    }

    /// Collects what happened at this instant, in the order of names; why it ends the run, if it does.
    fn note_events(&mut self, observer: &mut dyn Observer) -> Option<RunStatus> {
        let first = self.events.len();
        for slot in self.groups.iter_mut().flat_map(|group| &mut group.slots) {
            if let Some(what) = slot.event.take() {
                self.events.push(Event {
                    time_ns: self.now_ns,
                    agent: slot.agent.name().to_owned(),
                    what,
                });
            }
        }
        self.events[first..].sort_by(|a, b| a.agent.cmp(&b.agent));
        self.events[first..]
            .iter()
            .for_each(|event| observer.event(event));
        self.events[first..].iter().find_map(|event| match &event.what {
            AgentEvent::EstimatorFailed { reason } => Some(RunStatus::EstimatorFailed {
                agent: event.agent.clone(),
                reason: reason.clone(),
            }),
            _ => None,
        })
    }

    /// Leaves the present instant for the next of anyone, or for the end.
    fn go_to_next_instant(&mut self, end_ns: u64) {
        let now_ns = self.now_ns;
        let mut next_ns = end_ns;
        for group in &mut self.groups {
            if group.next_ns == now_ns {
                group.next_ns += group.step.ns();
            }
            next_ns = next_ns.min(group.next_ns);
        }
        for recorder in &mut self.recorders {
            next_ns = next_ns.min(recorder.leave(now_ns));
        }
        self.now_ns = next_ns;
        self.phase = Phase::Fresh;
    }
}
