//! Black boxes and their rates.

use super::{Engine, Phase};
use crate::black_box::{BlackBox, BlackBoxError, Channel};
use crate::clock::{StepSize, seconds};
use crate::error::SimulationError;
use std::any::Any;

/// A black box attached to a simulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct RecorderId(pub(crate) usize);

/// A black box and when it is due.
pub(super) struct Recorder {
    id: RecorderId,
    step: StepSize,
    /// Its next sample, ns; the present one until the instant is left.
    pub(super) next_ns: u64,
    black_box: Box<dyn BlackBox>,
    row: Vec<f64>,
}

impl std::fmt::Debug for Recorder {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "Recorder {{ step: {:?}, next_ns: {} }}",
            self.step, self.next_ns
        )
    }
}

impl Recorder {
    /// Leaves the present instant; its next sample.
    pub(super) fn leave(&mut self, now_ns: u64) -> u64 {
        if self.next_ns == now_ns {
            self.next_ns += self.step.ns();
        }
        self.next_ns
    }
}

/// The first whole multiple of a step not before an instant, ns.
pub(super) fn first_not_before(now_ns: u64, step: StepSize) -> u64 {
    now_ns.div_ceil(step.ns()) * step.ns()
}

impl Engine {
    /// Attaches a black box that records every agent's channels at the whole multiples of a step, from now on.
    ///
    /// # Errors
    /// If it can't be opened; if an agent is in the middle of a step that the first sample falls in, since what the
    /// agent held at its last instant was not kept.
    pub fn attach(
        &mut self,
        step: StepSize,
        black_box: impl BlackBox,
    ) -> Result<RecorderId, SimulationError> {
        self.attach_boxed(step, Box::new(black_box))
    }

    pub(super) fn attach_boxed(
        &mut self,
        step: StepSize,
        mut black_box: Box<dyn BlackBox>,
    ) -> Result<RecorderId, SimulationError> {
        // The present instant is over unless it is still fresh.
        let from_ns = self.now_ns + u64::from(self.phase != Phase::Fresh);
        let next_ns = first_not_before(from_ns, step);
        for group in &self.groups {
            let due_ns = first_not_before(from_ns, group.step);
            let unknown = group
                .slots
                .iter()
                .find(|slot| !slot.row_is_current && due_ns > next_ns);
            if let Some(slot) = unknown {
                return Err(SimulationError::AttachedMidStep {
                    agent: slot.agent.name().to_owned(),
                    now_s: self.now_s(),
                    due_s: seconds(due_ns),
                });
            }
        }
        let channels = self.channels();
        black_box.begin(&channels)?;
        let id = RecorderId(self.recorders_ever);
        self.recorders_ever += 1;
        self.recorders.push(Recorder {
            id,
            step,
            next_ns,
            black_box,
            row: vec![0.0; channels.len()],
        });
        Ok(id)
    }

    /// Detaches a black box and finishes it; `None` if there is none with this number and of this type.
    pub fn detach<B: BlackBox>(&mut self, id: RecorderId) -> Option<Result<B, BlackBoxError>> {
        let place = self.recorders.iter().position(|recorder| recorder.id == id)?;
        if !(self.recorders[place].black_box.as_ref() as &dyn Any).is::<B>() {
            return None;
        }
        let (black_box, finished) = self.take(place);
        let black_box = (black_box as Box<dyn Any>).downcast::<B>().ok()?;
        Some(finished.map(|()| *black_box))
    }

    pub(super) fn detach_boxed(
        &mut self,
        id: RecorderId,
    ) -> Option<Result<Box<dyn BlackBox>, BlackBoxError>> {
        let place = self.recorders.iter().position(|recorder| recorder.id == id)?;
        let (black_box, finished) = self.take(place);
        Some(finished.map(|()| black_box))
    }

    fn take(&mut self, place: usize) -> (Box<dyn BlackBox>, Result<(), BlackBoxError>) {
        let mut black_box = self.recorders.swap_remove(place).black_box;
        let finished = black_box.finish();
        (black_box, finished)
    }

    /// Finishes and detaches all black boxes: files are complete after it.
    ///
    /// # Errors
    /// The first that can't be finished; the others are finished all the same.
    pub fn finish_recordings(&mut self) -> Result<(), BlackBoxError> {
        let mut first = Ok(());
        for mut recorder in self.recorders.drain(..) {
            let finished = recorder.black_box.finish();
            first = first.and(finished);
        }
        first
    }

    /// All channels in the order of a row, each with its agent's name before its own.
    pub fn channels(&self) -> Vec<Channel> {
        let slots = (0..self.names.len()).map(|id| self.slot(id));
        slots
            .flat_map(|slot| {
                let agent = slot.agent.name();
                let channels = slot.agent.channels();
                channels.into_iter().map(move |channel| channel.of(agent))
            })
            .collect()
    }

    /// The next sample of any black box, ns.
    pub(super) fn next_sample_ns(&self) -> u64 {
        self.recorders.iter().map(|r| r.next_ns).min().unwrap_or(u64::MAX)
    }

    /// Records the present instant where it is due; all black boxes, even if one fails.
    pub(super) fn record(&mut self) -> Result<(), BlackBoxError> {
        let mut first = Ok(());
        for k in 0..self.recorders.len() {
            if self.recorders[k].next_ns != self.now_ns {
                continue;
            }
            let mut row = std::mem::take(&mut self.recorders[k].row);
            let mut rest = row.as_mut_slice();
            for id in 0..self.names.len() {
                let held = &self.slot(id).row;
                let (now, later) = rest.split_at_mut(held.len());
                now.copy_from_slice(held);
                rest = later;
            }
            let recorded = self.recorders[k].black_box.record(self.now_ns, &row);
            self.recorders[k].row = row;
            first = first.and(recorded);
        }
        first
    }
}

impl Drop for Engine {
    /// Files of a simulation that is dropped in mid-run are completed as far as possible; who wants to know whether
    /// it worked calls [`Engine::finish_recordings`].
    fn drop(&mut self) {
        let _ = self.finish_recordings();
    }
}
