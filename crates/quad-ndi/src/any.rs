//! A controller chosen at run time, with its memory.

use crate::Reference;
use crate::closed_loop::{ClosedLoop, Feedback};
use crate::controller::{Controller, ControllerError};
use crate::law::{AnyController, ControlLaw};
use nalgebra::Vector3;
use quad_dynamics::{AnyQuadrotor, CommandLimits, Flight, InFlight, Input, Level, LevelModel, WithQuadrotor};
use quad_math::{Flat, Real};

/// A controller together with what it remembers.
#[derive(Clone, Copy, Debug)]
pub struct InCharge<R: Real, C: Controller<R>> {
    /// The controller.
    pub controller: C,
    /// Its memory.
    pub memory: C::Memory,
}

impl<R: Real, C: Controller<R>> From<C> for InCharge<R, C> {
    fn from(controller: C) -> Self {
        let memory = controller.initial_memory();
        Self { controller, memory }
    }
}

/// A closed-loop step of one controller with a quadrotor of any level.
struct Together<'a, R: Real, C: Controller<R>> {
    in_charge: &'a mut InCharge<R, C>,
    reference: &'a Reference<R>,
    wind: &'a Vector3<R>,
    h: R,
}

impl<R: Real, C: Controller<R>> WithQuadrotor<R> for Together<'_, R, C> {
    type Out = [R; 4];

    /// A function per pair: all in one body cost 30 ns a step more, in registers that don't suffice.
    #[inline(never)]
    fn with<M: LevelModel<R>>(self, quadrotor: &mut InFlight<R, M>) -> [R; 4] {
        let mut both = ClosedLoop {
            plant: quadrotor,
            feedback: self.in_charge,
        };
        let air = Input::in_wind([R::zero(); 4], *self.wind);
        both.step(self.reference, &air, self.h)
    }
}

impl<R: Real> AnyController<R> {
    /// Commands for the next `dt` seconds.
    #[inline]
    pub fn update(&mut self, flight: &Flight<R>, reference: &Reference<R>, dt: R) -> [R; 4] {
        each_controller!(self, c => {
            c.commands(flight, reference, dt)
        })
    }

    /// One closed-loop step of `h` seconds with a quadrotor of any level: [`ClosedLoop::step`] by value. Gives the
    /// commands that were held over the step.
    ///
    /// Controller and model are compiled into one step for every pair, which is faster than
    /// [`Self::update`] and [`AnyQuadrotor::step`] one after the other, and the same bit for bit.
    pub fn fly(
        &mut self,
        quadrotor: &mut AnyQuadrotor<R>,
        reference: &Reference<R>,
        wind: &Vector3<R>,
        h: R,
    ) -> [R; 4] {
        each_controller!(self, in_charge => quadrotor.visit(Together {
            in_charge,
            reference,
            wind,
            h,
        }))
    }

    /// Continues when the model changes its level; `before` is what was last seen of the flight at the level before.
    pub fn resume(&mut self, before: &Flight<R>) {
        each_controller!(self, c => c.memory = c.controller.resumed(&c.memory, before));
    }

    /// The same controller with limits on its commands.
    #[must_use]
    pub fn with_limits(mut self, limits: Option<CommandLimits<R>>) -> Self {
        each_controller!(&mut self, c => c.controller = c.controller.with_limits(limits));
        self
    }

    /// The lowest level of model that the controller makes sense on.
    pub fn level(&self) -> Level {
        fn level<R: Real, C: Controller<R>>(_: &InCharge<R, C>) -> Level {
            C::LEVEL
        }
        each_controller!(self, c => level(c))
    }

    /// How many numbers its memory has.
    pub fn memory_len(&self) -> usize {
        fn len<R: Real, C: Controller<R>>(_: &InCharge<R, C>) -> usize {
            <C::Memory as Flat<R>>::LEN
        }
        each_controller!(self, c => len(c))
    }

    /// The memory as numbers, in the order of its [`Flat`] implementation.
    ///
    /// # Panics
    /// If `out` is shorter than [`Self::memory_len`]: a programming error, not an input error.
    pub fn write_memory(&self, out: &mut [R]) {
        each_controller!(self, c => Flat::<R>::write(&c.memory, out));
    }

    /// Takes the memory from numbers: the reverse of [`Self::write_memory`].
    ///
    /// # Panics
    /// If there are fewer than [`Self::memory_len`] numbers: a programming error, not an input error.
    pub fn read_memory(&mut self, values: &[R]) {
        each_controller!(self, c => c.memory = Flat::<R>::read(values));
    }

    /// Checks that the controller may fly a model of the level.
    ///
    /// # Errors
    /// [`ControllerError::ModelBelowController`].
    pub fn check(&self, model: Level) -> Result<(), ControllerError> {
        crate::controller::check_pairing(self.level(), model)
    }
}
