//! What any simulation can be asked: to run, and to be recorded.
//!
//! [`Engine`](crate::Engine) runs agents that see each other, at their own steps; [`Rollout`](crate::Rollout) runs a batch of
//! flights that don't, as pure closed loops. Both record the same channels into the same black boxes, and a flight that depends on no
//! other is the same in both, bit for bit. An [`Optimiser`](crate::Optimiser) or a study that is written for
//! `&mut dyn Simulation` takes either, and yours.

use crate::agent::Published;
use crate::black_box::{BlackBox, BlackBoxError, Channel};
use crate::clock::{StepSize, seconds};
use crate::engine::{Observer, RecorderId, RunReport};
use crate::error::SimulationError;

/// Agents in time that can be run and recorded.
pub trait Simulation {
    /// Names of the agents, in the order of a row.
    fn names(&self) -> &[String];

    /// The present, ns.
    fn now_ns(&self) -> u64;

    /// The present, s.
    fn now_s(&self) -> f64 {
        seconds(self.now_ns())
    }

    /// What the agent of this name published last.
    fn published(&self, name: &str) -> Option<&Published>;

    /// All channels in the order of a row, each with its agent's name before its own.
    fn channels(&self) -> Vec<Channel>;

    /// Attaches a black box that records all channels at multiples of a step, from now on.
    ///
    /// # Errors
    /// If it can't be opened or can't begin at the present.
    fn attach_box(
        &mut self,
        step: StepSize,
        black_box: Box<dyn BlackBox>,
    ) -> Result<RecorderId, SimulationError>;

    /// Detaches a black box and finishes it; `None` if there is none with this number.
    fn detach_box(&mut self, id: RecorderId) -> Option<Result<Box<dyn BlackBox>, BlackBoxError>>;

    /// Runs to an end time, s, or to whatever ends the run before; can be called again with a later end.
    ///
    /// # Errors
    /// An end before the present, or one that the clock doesn't have. All that happens during the run is a
    /// [`RunStatus`](crate::RunStatus) instead.
    fn run(&mut self, end_s: f64, observer: &mut dyn Observer) -> Result<RunReport, SimulationError>;
}
