//! Pilots: who turns what is asked for into rotor commands.

use crate::agent::{MemoryError, Moment};
use crate::schedule::Schedule;
use crate::speed::Hook;
use nalgebra::Vector3;
use quad_dynamics::{AnyQuadrotor, Flight, Input, Level};
use quad_math::FixedStep;
use quad_ndi::{AnyController, Reference};
use std::fmt::Debug;

/// Whoever commands the rotors: a controller of the workspace, your own, or a list of commands.
pub trait Pilot: Debug + Send {
    /// The lowest level of model that it makes sense on.
    fn level(&self) -> Level;

    /// Zeroed rotor commands from this instant to the next. Of the quadrotor it is to look at its flight only.
    fn commands(
        &mut self,
        quadrotor: &AnyQuadrotor<f64>,
        reference: &Reference<f64>,
        now: &Moment<'_>,
    ) -> [f64; 4];

    /// Commands the rotors and flies the quadrotor one RK4 step in this wind, m/s in W, in one go; gives the commands.
    ///
    /// The same bit for bit as the two one after the other.
    #[doc(hidden)]
    fn fly(
        &mut self,
        quadrotor: &mut AnyQuadrotor<f64>,
        reference: &Reference<f64>,
        wind: &Vector3<f64>,
        now: &Moment<'_>,
        _: Hook,
    ) -> [f64; 4] {
        let commands = self.commands(quadrotor, reference, now);
        quadrotor.step(FixedStep::Rk4, &Input::in_wind(commands, *wind), now.step_s);
        commands
    }

    /// Called when the model changes its level, with the last observation before the change.
    fn level_changed(&mut self, _before: &Flight<f64>) {}

    /// What it remembers, as numbers.
    fn memory(&self) -> Vec<f64>;

    /// Takes up what it remembered.
    ///
    /// # Errors
    /// [`MemoryError::Length`] if it remembers another number of numbers; it is then unchanged.
    fn restore(&mut self, memory: &[f64]) -> Result<(), MemoryError>;
}

impl Pilot for AnyController<f64> {
    fn level(&self) -> Level {
        AnyController::level(self)
    }

    fn commands(
        &mut self,
        quadrotor: &AnyQuadrotor<f64>,
        reference: &Reference<f64>,
        now: &Moment<'_>,
    ) -> [f64; 4] {
        self.update(&quadrotor.flight(), reference, now.step_s)
    }

    fn fly(
        &mut self,
        quadrotor: &mut AnyQuadrotor<f64>,
        reference: &Reference<f64>,
        wind: &Vector3<f64>,
        now: &Moment<'_>,
        _: Hook,
    ) -> [f64; 4] {
        AnyController::fly(self, quadrotor, reference, wind, now.step_s)
    }

    fn level_changed(&mut self, before: &Flight<f64>) {
        self.resume(before);
    }

    fn memory(&self) -> Vec<f64> {
        let mut memory = vec![0.0; self.memory_len()];
        self.write_memory(&mut memory);
        memory
    }

    fn restore(&mut self, memory: &[f64]) -> Result<(), MemoryError> {
        MemoryError::check_length("the controller's memory", self.memory_len(), memory.len())?;
        self.read_memory(memory);
        Ok(())
    }
}

/// Commands from a list, whatever the flight does: the open loop.
///
/// Commands u, each from its time on; zero before the first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OpenLoop(pub Schedule<[f64; 4]>);

impl Pilot for OpenLoop {
    fn level(&self) -> Level {
        Level::LOWEST
    }

    fn commands(
        &mut self,
        _quadrotor: &AnyQuadrotor<f64>,
        _reference: &Reference<f64>,
        now: &Moment<'_>,
    ) -> [f64; 4] {
        self.0.at(now.time_ns).copied().unwrap_or_default()
    }

    fn memory(&self) -> Vec<f64> {
        Vec::new()
    }

    fn restore(&mut self, memory: &[f64]) -> Result<(), MemoryError> {
        MemoryError::check_length("the memory of an open loop", 0, memory.len())
    }
}
