//! Model and controller together: the pure step, and a flight on an exact time grid.
//!
//! The controller samples the flight at the start of each step and its commands are held over it, as a
//! flight computer does. [`closed_loop_step`] is that step as a pure function over any scalar;
//! [`Flyer::fly`] repeats it on `f64`, records, and stops where the numbers stop being numbers.

use crate::controller::{Controller, ControllerError, check_pairing};
use crate::law::AnyController;
use crate::{Allocation, Reference};
use nalgebra::Vector3;
use quad_dynamics::{AnyQuadrotor, Flight, Input, QuadrotorModel, StateOf, Vehicle};
use quad_math::{FixedStep, Real, TimeGrid};
use std::num::NonZeroU64;

/// Model state, controller memory and the commands in force after one closed-loop step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopState<R: Real, X, Memory> {
    /// State of the model.
    pub state: X,
    /// Memory of the controller.
    pub memory: Memory,
    /// Zeroed commands that were held over the step.
    pub commands: [R; 4],
}

/// One step of `h` seconds: the controller looks once, the model flies with its commands held (RK4).
#[inline(always)]
pub fn closed_loop_step<R: Real, M: QuadrotorModel<R>, C: Controller<R>>(
    model: &M,
    controller: &C,
    now: &LoopState<R, StateOf<R, M>, C::Memory>,
    reference: &Reference<R>,
    wind: &Vector3<R>,
    h: R,
) -> LoopState<R, StateOf<R, M>, C::Memory> {
    step_from(model, controller, (&now.state, &now.memory), reference, wind, h)
}

/// The same from a state and a memory, wherever they are.
#[inline(always)]
pub(crate) fn step_from<R: Real, M: QuadrotorModel<R>, C: Controller<R>>(
    model: &M,
    controller: &C,
    (state, memory): (&StateOf<R, M>, &C::Memory),
    reference: &Reference<R>,
    wind: &Vector3<R>,
    h: R,
) -> LoopState<R, StateOf<R, M>, C::Memory> {
    let answer = controller.control(memory, &model.flight(state), reference, h);
    let input = Input::in_wind(answer.commands, *wind);
    LoopState {
        state: FixedStep::Rk4.step(model, state, &input, h),
        memory: answer.memory,
        commands: answer.commands,
    }
}

/// One instant of a recorded flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Record {
    /// Time, s.
    pub time_s: f64,
    /// What was seen of the flight.
    pub flight: Flight<f64>,
    /// What was asked for.
    pub reference: Reference<f64>,
    /// Zeroed commands `u_i` from this instant on.
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
    pub fn fly(mut self, plan: &FlightPlan, reference: impl Fn(f64) -> Reference<f64>) -> FlightLog {
        let (grid, every) = (&plan.grid, plan.record_every.get());
        let h = grid.step_s();
        let mut records = Vec::with_capacity(usize::try_from(grid.steps() / every).unwrap_or(0) + 2);
        let mut state = vec![0.0; self.quadrotor.state_len()];
        for k in 0..=grid.steps() {
            let time_s = grid.time_s(k);
            let flight = self.quadrotor.flight();
            let reference = reference(time_s);
            let commands = self.controller.update(&flight, &reference, h);
            if !commands.iter().all(|u| u.is_finite()) {
                let status = FlightStatus::Diverged {
                    time_s,
                    last: Box::new(flight),
                };
                return FlightLog { records, status };
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
            if k == grid.steps() {
                break;
            }
            self.quadrotor
                .step(FixedStep::Rk4, &Input::still_air(commands), h);
            self.quadrotor.write_state(&mut state);
            if !state.iter().all(|x| x.is_finite()) {
                let status = FlightStatus::Diverged {
                    time_s: grid.time_s(k + 1),
                    last: Box::new(flight),
                };
                return FlightLog { records, status };
            }
        }
        FlightLog {
            records,
            status: FlightStatus::Completed,
        }
    }
}
