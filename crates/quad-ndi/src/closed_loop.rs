//! Vehicle and controller together: the step of a closed loop, and a flight on an exact time grid.
//!
//! ```text
//! look       seen = flight(x_k)
//! decide     u, memory = controller(memory, seen, reference)
//! advance    x_{k+1} = RK4(x_k, u + what acts beside the controller), held over h
//! ```
//!
//! The controller samples the flight at the start of each step and its commands are held over it, as a
//! flight computer does. [`ClosedLoop::step`] is that step over any scalar, for types or values known at run time;
//! [`Flyer::fly`] repeats it on `f64`, records, and stops at the first non-finite number.

use crate::any::InCharge;
use crate::controller::{Controller, ControllerError, check_pairing};
use crate::law::AnyController;
use crate::{Allocation, Reference};
use quad_dynamics::{AnyQuadrotor, Flight, InFlight, Input, QuadrotorModel, StateOf, Vehicle};
use quad_math::{FixedStep, Real, TimeGrid};
use std::num::NonZeroU64;

/// What a controller flies: something that can be looked at and advanced.
pub trait Plant<R: Real> {
    /// What can be seen of it.
    fn flight(&self) -> Flight<R>;

    /// Flies one RK4 step of `h` seconds with the input held.
    fn advance(&mut self, input: &Input<R>, h: R);
}

/// What closes a loop: a controller together with what it remembers.
pub trait Feedback<R: Real> {
    /// Zeroed rotor commands for the next `h` seconds.
    fn commands(&mut self, seen: &Flight<R>, reference: &Reference<R>, h: R) -> [R; 4];
}

/// A vehicle and what commands it.
#[derive(Clone, Copy, Debug)]
pub struct ClosedLoop<P, F> {
    /// The vehicle.
    pub plant: P,
    /// The controller.
    pub feedback: F,
}

impl<P, F> ClosedLoop<P, F> {
    /// One step of `h` seconds; gives the controller's commands.
    ///
    /// `beside` is what acts beside the controller: the air, and offsets that are added to its commands.
    #[inline(always)]
    pub fn step<R: Real>(&mut self, reference: &Reference<R>, beside: &Input<R>, h: R) -> [R; 4]
    where
        P: Plant<R>,
        F: Feedback<R>,
    {
        let seen = self.plant.flight();
        self.step_as_seen(&seen, reference, beside, h)
    }

    /// The same where what the controller sees is known already, or is not the truth.
    #[inline(always)]
    pub fn step_as_seen<R: Real>(
        &mut self,
        seen: &Flight<R>,
        reference: &Reference<R>,
        beside: &Input<R>,
        h: R,
    ) -> [R; 4]
    where
        P: Plant<R>,
        F: Feedback<R>,
    {
        let commands = self.feedback.commands(seen, reference, h);
        let input = Input {
            commands: std::array::from_fn(|i| commands[i] + beside.commands[i]),
            ..*beside
        };
        self.plant.advance(&input, h);
        commands
    }
}

/// A vehicle in flight whose model is borrowed.
#[derive(Debug)]
pub struct Airborne<'a, R: Real, M: QuadrotorModel<R>> {
    /// The model.
    pub model: &'a M,
    /// Its state.
    pub state: StateOf<R, M>,
}

/// Written out, since a derived copy would ask the same of the model.
impl<R: Real, M: QuadrotorModel<R>> Clone for Airborne<'_, R, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<R: Real, M: QuadrotorModel<R>> Copy for Airborne<'_, R, M> {}

impl<R: Real, M: QuadrotorModel<R>> Plant<R> for Airborne<'_, R, M> {
    #[inline(always)]
    fn flight(&self) -> Flight<R> {
        self.model.flight(&self.state)
    }

    #[inline(always)]
    fn advance(&mut self, input: &Input<R>, h: R) {
        self.state = FixedStep::Rk4.step(self.model, &self.state, input, h);
    }
}

impl<R: Real, M: QuadrotorModel<R>> Plant<R> for &mut InFlight<R, M> {
    #[inline(always)]
    fn flight(&self) -> Flight<R> {
        self.model.flight(&self.state)
    }

    #[inline(always)]
    fn advance(&mut self, input: &Input<R>, h: R) {
        self.state = FixedStep::Rk4.step(&self.model, &self.state, input, h);
    }
}

impl<R: Real> Plant<R> for AnyQuadrotor<R> {
    fn flight(&self) -> Flight<R> {
        AnyQuadrotor::flight(self)
    }

    fn advance(&mut self, input: &Input<R>, h: R) {
        self.step(FixedStep::Rk4, input, h);
    }
}

impl<R: Real, C: Controller<R>> Feedback<R> for InCharge<R, C> {
    #[inline(always)]
    fn commands(&mut self, seen: &Flight<R>, reference: &Reference<R>, h: R) -> [R; 4] {
        let answer = self.controller.control(&self.memory, seen, reference, h);
        self.memory = answer.memory;
        answer.commands
    }
}

impl<R: Real> Feedback<R> for AnyController<R> {
    fn commands(&mut self, seen: &Flight<R>, reference: &Reference<R>, h: R) -> [R; 4] {
        self.update(seen, reference, h)
    }
}

impl<R: Real, F: Feedback<R>> Feedback<R> for &mut F {
    #[inline(always)]
    fn commands(&mut self, seen: &Flight<R>, reference: &Reference<R>, h: R) -> [R; 4] {
        (**self).commands(seen, reference, h)
    }
}

/// One instant of a recorded flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Record {
    /// Time, s.
    pub time_s: f64,
    /// What was seen of the flight.
    pub flight: Flight<f64>,
    /// The reference.
    pub reference: Reference<f64>,
    /// Commands `u_i` from this instant on.
    pub commands: [f64; 4],
    /// Pseudo-inputs `u* = C u`: collective, lateral, longitudinal, yaw.
    pub pseudo_inputs: [f64; 4],
}

/// How a flight ended.
#[derive(Clone, Debug, PartialEq)]
pub enum FlightStatus {
    /// At the end of its time.
    Completed,
    /// A number of the state or a command became NaN or infinite.
    Diverged {
        /// The first instant without finite state and commands, s.
        time_s: f64,
        /// The last flight with a finite state.
        last: Box<Flight<f64>>,
    },
}

/// A recorded flight: all that was computed, whether it was completed or not.
#[derive(Clone, Debug, PartialEq)]
pub struct FlightLog {
    /// The records in order of time.
    pub records: Vec<Record>,
    /// How it ended.
    pub status: FlightStatus,
}

/// A vehicle and its controller, ready to fly.
#[derive(Clone, Debug)]
pub struct Flyer {
    /// The vehicle at some level.
    pub quadrotor: AnyQuadrotor<f64>,
    /// Its controller.
    pub controller: AnyController<f64>,
    allocation: Allocation<f64>,
}

/// What a flight is to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FlightPlan {
    /// The instants at which the controller acts; the model takes one RK4 step between two.
    pub grid: TimeGrid,
    /// Every how many steps a record is kept.
    pub record_every: NonZeroU64,
}

impl Flyer {
    /// A controller in charge of a flying vehicle.
    ///
    /// # Errors
    /// If the model's level is below the controller's, or the control matrix is singular.
    pub fn new(
        vehicle: &Vehicle,
        quadrotor: AnyQuadrotor<f64>,
        controller: AnyController<f64>,
    ) -> Result<Self, ControllerError> {
        check_pairing(controller.level(), quadrotor.level())?;
        Ok(Self {
            quadrotor,
            controller,
            allocation: Allocation::of(vehicle)?,
        })
    }

    /// Flies the plan in still air and records it.
    pub fn fly(self, plan: &FlightPlan, reference: impl Fn(f64) -> Reference<f64>) -> FlightLog {
        let (grid, every) = (&plan.grid, plan.record_every.get());
        let (h, still) = (grid.step_s(), Input::still_air([0.0; 4]));
        let mut records = Vec::with_capacity(usize::try_from(grid.steps() / every).unwrap_or(0) + 2);
        let mut state = vec![0.0; self.quadrotor.state_len()];
        let mut flying = ClosedLoop {
            plant: self.quadrotor,
            feedback: self.controller,
        };
        let diverged = |records, time_s, last| FlightLog {
            records,
            status: FlightStatus::Diverged {
                time_s,
                last: Box::new(last),
            },
        };
        for k in 0..=grid.steps() {
            let time_s = grid.time_s(k);
            let flight = flying.plant.flight();
            let reference = reference(time_s);
            // At the end one step more than is recorded, for the commands there.
            let commands = flying.step_as_seen(&flight, &reference, &still, h);
            if !commands.iter().all(|u| u.is_finite()) {
                return diverged(records, time_s, flight);
            }
            if k % every == 0 || k == grid.steps() {
                let pseudo_inputs = self.allocation.pseudo_inputs(&commands);
                records.push(Record {
                    time_s,
                    flight,
                    reference,
                    commands,
                    pseudo_inputs,
                });
            }
            flying.plant.write_state(&mut state);
            if k < grid.steps() && !state.iter().all(|x| x.is_finite()) {
                return diverged(records, grid.time_s(k + 1), flight);
            }
        }
        FlightLog {
            records,
            status: FlightStatus::Completed,
        }
    }
}
