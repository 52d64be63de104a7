//! The pure batch rollout: many flights that don't see each other, without a clock or agents.
//!
//! ```text
//! u_k = c(m_k, flight(x_k), r(t_k)),   x_k+1 = Φ_h(x_k, u_k)     for each flight, RK4, commands held
//! ```
//!
//! The closed loop of [`quad_ndi::ClosedLoop`], so a flight here is that of a
//! [`ModelQuadrotor`](crate::ModelQuadrotor) in still air, bit for bit. Between two records or reports of progress the flights
//! advance independently, on all cores if asked. Use it for sweeps over references or starts;
//! use the [`Engine`](crate::Engine) when agents see each other, change their level or have different steps.

use crate::agent::{Invalid, Published};
use crate::black_box::{BlackBox, BlackBoxError, Channel, Frame, Role};
use crate::clock::{StepSize, instant_ns, seconds};
use crate::engine::{
    Execution, LastSeen, Observer, PROGRESS_EVERY, Progress, RecorderId, RunReport, RunStatus,
};
use crate::error::SimulationError;
use crate::names::Names;
use crate::simulation::Simulation;
use nalgebra::Vector3;
use quad_dynamics::{Flight, Input, LevelModel, QuadrotorModel, StateOf};
use quad_ndi::{
    Airborne, ClosedLoop, Controller, ControllerError, Feedback, InCharge, Reference, check_pairing,
};
use rayon::prelude::*;
use std::fmt;

/// What a flight follows: the reference at a time, s.
pub type Course = Box<dyn Fn(f64) -> Reference<f64> + Send + Sync>;

/// A flight of the batch.
#[derive(Clone, Debug)]
struct Flying<X, F> {
    state: X,
    feedback: F,
}

/// A flight of this model under this controller.
type FlyingOf<M, C> = Flying<StateOf<f64, M>, InCharge<f64, C>>;

/// A batch of flights of one model under one controller.
pub struct Rollout<M: QuadrotorModel<f64>, C: Controller<f64>> {
    model: M,
    controller: C,
    step: StepSize,
    names: Names,
    courses: Vec<Course>,
    flights: Vec<FlyingOf<M, C>>,
    scene: Vec<Published>,
    recorders: Vec<Recorder>,
    recorders_ever: usize,
    execution: Execution,
    /// Steps taken; the present is the end of the last run.
    k: u64,
    now_ns: u64,
    begun: bool,
    diverged: Option<(usize, Invalid, Option<LastSeen>)>,
}

struct Recorder {
    id: RecorderId,
    step: StepSize,
    next_ns: u64,
    black_box: Box<dyn BlackBox>,
}

impl<M: QuadrotorModel<f64>, C: Controller<f64>> fmt::Debug for Rollout<M, C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "Rollout {{ names: {:?}, now_ns: {} }}",
            &self.names[..],
            self.now_ns
        )
    }
}

impl<M, C> Rollout<M, C>
where
    M: LevelModel<f64, State: Copy + Send> + Sync,
    C: Controller<f64, Memory: Send> + Clone + Send + Sync,
{
    /// An empty batch.
    ///
    /// # Errors
    /// A model below the controller's level.
    pub fn new(model: M, controller: C, step: StepSize) -> Result<Self, ControllerError> {
        check_pairing(C::LEVEL, M::LEVEL)?;
        Ok(Self {
            model,
            controller,
            step,
            names: Names::default(),
            courses: Vec::new(),
            flights: Vec::new(),
            scene: Vec::new(),
            recorders: Vec::new(),
            recorders_ever: 0,
            execution: Execution::default(),
            k: 0,
            now_ns: 0,
            begun: false,
            diverged: None,
        })
    }

    /// Adds a flight that starts in hover at a position in W, m, with heading ψ, rad. Before the first run only.
    ///
    /// # Errors
    /// A name that the batch already has; a batch that has begun.
    pub fn add(
        &mut self,
        name: impl Into<String>,
        (position, yaw): (Vector3<f64>, f64),
        course: impl Fn(f64) -> Reference<f64> + Send + Sync + 'static,
    ) -> Result<(), SimulationError> {
        let name = name.into();
        if self.begun || !self.recorders.is_empty() {
            return Err(SimulationError::AlreadyBegun { name });
        }
        (self.names.add(name)).map_err(|name| SimulationError::DuplicateName { name })?;
        let hover = self.model.hover(position, yaw);
        self.scene.push(published(&self.model.flight(&hover.state)));
        self.flights.push(Flying {
            state: hover.state,
            feedback: self.controller.clone().into(),
        });
        self.courses.push(Box::new(course));
        Ok(())
    }

    /// Advances flights on all cores, or on one (the default).
    pub fn execute(&mut self, execution: Execution) {
        self.execution = execution;
    }

    /// Every flight takes steps up to number `k`.
    fn advance(&mut self, k: u64) {
        let (model, step, from) = (&self.model, self.step, self.k);
        let (air, h) = (Input::still_air([0.0; 4]), step.seconds());
        let one = |(flight, course): (&mut FlyingOf<M, C>, &Course)| {
            let mut closed_loop = ClosedLoop {
                plant: Airborne {
                    model,
                    state: flight.state,
                },
                feedback: &mut flight.feedback,
            };
            for n in from..k {
                closed_loop.step(&course(seconds(n * step.ns())), &air, h);
            }
            flight.state = closed_loop.plant.state;
        };
        match self.execution {
            Execution::OneThread => self.flights.iter_mut().zip(&self.courses).for_each(one),
            Execution::Parallel => self.flights.par_iter_mut().zip(&self.courses).for_each(one),
        }
        self.k = k;
    }

    /// Steps up to number `k`, or to the first instant at which a flight is not finite.
    fn advance_finite(&mut self, k: u64) {
        let (start, before) = (self.k, self.flights.clone());
        self.advance(k);
        let is_bad = |of: &Self, id: usize| {
            published(&of.model.flight(&of.flights[id].state))
                .check_flight()
                .err()
        };
        // A state that is not finite stays so, and one that is too fast for its model does not often return: one look at the end is enough.
        if (0..self.flights.len()).any(|id| is_bad(self, id).is_some()) {
            (self.k, self.flights) = (start, before);
            for n in start + 1..=k {
                let last = self.flights.clone();
                self.advance(n);
                let bad = (0..self.flights.len()).filter_map(|id| Some((id, is_bad(self, id)?)));
                if let Some((id, why)) = bad.min_by_key(|&(id, _)| &self.names[id]) {
                    let seen = LastSeen {
                        time_s: seconds((n - 1) * self.step.ns()),
                        published: published(&self.model.flight(&last[id].state)),
                    };
                    self.diverged = Some((id, why, Some(seen)));
                    break;
                }
            }
        }
        for (seen, flight) in self.scene.iter_mut().zip(&self.flights) {
            let now = published(&self.model.flight(&flight.state));
            if now.check_flight().is_ok() {
                *seen = now;
            }
        }
    }

    /// Records the present where a black box is due; all of them, even if one fails.
    fn record(&mut self) -> Result<(), BlackBoxError> {
        if self
            .recorders
            .iter()
            .all(|recorder| recorder.next_ns != self.now_ns)
        {
            return Ok(());
        }
        let mut row = Vec::with_capacity(self.flights.len() * WIDTH);
        for (flight, course) in self.flights.iter().zip(&self.courses) {
            let reference = course(seconds(self.k * self.step.ns()));
            let seen = self.model.flight(&flight.state);
            // A copy decides, so that the memory is as before.
            let commands = flight
                .feedback
                .clone()
                .commands(&seen, &reference, self.step.seconds());
            write(&seen, &commands, &reference, &mut row);
        }
        let mut first = Ok(());
        for recorder in &mut self.recorders {
            if recorder.next_ns == self.now_ns {
                first = first.and(recorder.black_box.record(self.now_ns, &row));
                recorder.next_ns += recorder.step.ns();
            }
        }
        first
    }

    fn diverged(&self) -> Option<RunStatus> {
        let (id, why, last) = self.diverged?;
        Some(RunStatus::Diverged {
            agent: self.names[id].clone(),
            why,
            likely_cause: None,
            last: last.map(Box::new),
        })
    }
}

impl<M, C> Simulation for Rollout<M, C>
where
    M: LevelModel<f64, State: Copy + Send> + Sync,
    C: Controller<f64, Memory: Send> + Clone + Send + Sync,
{
    fn names(&self) -> &[String] {
        &self.names
    }

    fn now_ns(&self) -> u64 {
        self.now_ns
    }

    fn published(&self, name: &str) -> Option<&Published> {
        let id = self.names.find(name)?;
        Some(&self.scene[id])
    }

    fn channels(&self) -> Vec<Channel> {
        self.names
            .iter()
            .flat_map(|name| channels().into_iter().map(move |channel| channel.of(name)))
            .collect()
    }

    fn attach_box(
        &mut self,
        step: StepSize,
        mut black_box: Box<dyn BlackBox>,
    ) -> Result<RecorderId, SimulationError> {
        black_box.begin(&self.channels())?;
        let id = RecorderId(self.recorders_ever);
        self.recorders_ever += 1;
        let from_ns = self.now_ns + u64::from(self.begun);
        self.recorders.push(Recorder {
            id,
            step,
            next_ns: from_ns.div_ceil(step.ns()) * step.ns(),
            black_box,
        });
        Ok(id)
    }

    fn detach_box(&mut self, id: RecorderId) -> Option<Result<Box<dyn BlackBox>, BlackBoxError>> {
        let place = self.recorders.iter().position(|recorder| recorder.id == id)?;
        let mut black_box = self.recorders.swap_remove(place).black_box;
        Some(black_box.finish().map(|()| black_box))
    }

    fn run(&mut self, end_s: f64, observer: &mut dyn Observer) -> Result<RunReport, SimulationError> {
        let end_ns = instant_ns(end_s)?;
        if end_ns < self.now_ns {
            let now_s = self.now_s();
            return Err(SimulationError::EndBeforeNow { end_s, now_s });
        }
        if self.flights.is_empty() {
            return Err(SimulationError::Empty);
        }
        if !self.begun
            && let Some((id, why)) =
                (0..self.scene.len()).find_map(|id| Some((id, self.scene[id].check_flight().err()?)))
        {
            self.diverged = Some((id, why, None));
        }
        self.begun = true;
        let first = self.k;
        let status = loop {
            if let Some(status) = self.diverged() {
                break status;
            }
            if let Err(source) = self.record() {
                break RunStatus::RecordingFailed { source };
            }
            if self.now_ns >= end_ns {
                break RunStatus::Completed;
            }
            let samples = self.recorders.iter().map(|recorder| recorder.next_ns);
            let report_ns = (self.k + PROGRESS_EVERY).saturating_mul(self.step.ns());
            let next_ns = samples.chain([end_ns, report_ns]).min().unwrap_or(end_ns);
            self.advance_finite(next_ns / self.step.ns());
            self.now_ns = match self.diverged {
                Some(_) => self.k * self.step.ns(),
                None => next_ns,
            };
            if next_ns == report_ns {
                let progress = Progress {
                    time_s: self.now_s(),
                    end_s,
                    agent_steps: (self.k - first) * self.flights.len() as u64,
                };
                if observer.progress(&progress).is_break() {
                    break RunStatus::Interrupted;
                }
            }
        };
        Ok(RunReport {
            status,
            time_s: self.now_s(),
            agent_steps: (self.k - first) * self.flights.len() as u64,
        })
    }
}

impl<M: QuadrotorModel<f64>, C: Controller<f64>> Drop for Rollout<M, C> {
    /// Files of a rollout that is dropped are completed as far as possible.
    fn drop(&mut self) {
        for recorder in &mut self.recorders {
            let _ = recorder.black_box.finish();
        }
    }
}

fn published(flight: &Flight<f64>) -> Published {
    Published {
        position: flight.position,
        velocity: flight.velocity,
        rotation: flight.rotation,
        body_rates: flight.body_rates,
    }
}

/// Numbers in a row of one flight.
const WIDTH: usize = 23;

/// Channels of a flight, in the order of [`write`]: those of a [`ModelQuadrotor`](crate::ModelQuadrotor) that a pure loop has.
fn channels() -> Vec<Channel> {
    let (xyz, rotors) = (["x", "y", "z"], ["1", "2", "3", "4"]);
    let angles = ["roll", "pitch", "yaw"];
    let mut all = Vec::with_capacity(WIDTH);
    all.extend(Channel::group("position", xyz, Role::State, "m", Frame::World));
    all.extend(Channel::group("velocity", xyz, Role::State, "m/s", Frame::World));
    all.extend(Channel::group(
        "attitude",
        angles,
        Role::State,
        "rad",
        Frame::Scalar,
    ));
    let rates = ["p", "q", "r"];
    all.extend(Channel::group(
        "body_rate",
        rates,
        Role::State,
        "rad/s",
        Frame::Body,
    ));
    all.extend(Channel::group("command", rotors, Role::Input, "1", Frame::Scalar));
    for (name, unit) in [("reference.position", "m"), ("reference.velocity", "m/s")] {
        all.extend(Channel::group(name, xyz, Role::Reference, unit, Frame::World));
    }
    all.push(Channel::new(
        "reference.yaw",
        Role::Reference,
        "rad",
        Frame::Scalar,
    ));
    all
}

fn write(seen: &Flight<f64>, commands: &[f64; 4], reference: &Reference<f64>, row: &mut Vec<f64>) {
    row.extend_from_slice(seen.position.as_slice());
    row.extend_from_slice(seen.velocity.as_slice());
    row.extend_from_slice(seen.attitude.vector().as_slice());
    row.extend_from_slice(seen.body_rates.as_slice());
    row.extend_from_slice(commands);
    row.extend_from_slice(reference.flat.position.as_slice());
    row.extend_from_slice(reference.flat.velocity.as_slice());
    row.push(reference.flat.yaw);
}
