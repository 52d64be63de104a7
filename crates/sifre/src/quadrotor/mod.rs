//! The quadrotor as an agent: a model of any level, a pilot, guidance, and a script of what happens to it.
//!
//! ```text
//! estimate at t_k  from sensors that look at x_k, where there is an estimator
//! decide at t_k    reference = guidance(t_k, others),  u_k = pilot(flight_k, reference) + disturbance
//! advance          x_k+1 = Φ_h(x_k, u_k, wind)          RK4, commands and wind held
//! ```
//!
//! The same operations in the same order as [`quad_ndi::ClosedLoop::step`], so that engine and rollout agree bit for
//! bit. The level may change at any of the agent's instants, before it decides: the new model adopts the flight
//! (lift or restrict, [`quad_dynamics::Snapshot`]), so position, velocity, attitude and rates continue without a
//! jump, and thrust and torque where the new level has states for them.
//!
//! With an [`Estimation`] in the loop `flight_k` is what a Kalman filter makes of sensors; its file states how.

mod air;
mod cause;
mod estimation;
mod gusts;
mod hover;
mod initial_error;
mod memory;
mod pilot;
mod record;
mod recorded;
mod rule;
mod setup;

pub use air::{AirError, Gusts, ProcessNoiseSource, STRONGEST_WIND_M_S, Turbulence, Wind};
pub use estimation::{EstimateUse, Estimation, EstimationSetupError, FilterKind};
pub use initial_error::{InitialError, InitialErrorFault, VectorError};
pub use pilot::{OpenLoop, Pilot};
pub use recorded::{Pose, RecordedFlightError, RecordedQuadrotor};
pub use rule::{LevelRule, RuleError};
pub use setup::{LevelChoice, QuadrotorError, Script, Setup, Start};

use crate::agent::{Agent, AgentId, Directory, Invalid, MemoryError, Moment, Published};
use crate::black_box::Channel;
use crate::clock::StepSize;
use crate::error::BindError;
use crate::event::AgentEvent;
use crate::exact::plain;
use crate::speed::Hook;
use estimation::Estimating;
use gusts::{Air, Met};
use hover::{hover_draw, model, set_moving};
use memory::Restored;
use nalgebra::Vector3;
use quad_dynamics::{AnyQuadrotor, Flight, Input, Level, Phenomenon, Snapshot};
use quad_math::FixedStep;
use quad_ndi::{Reference, check_pairing};
use rule::Side;

/// A quadrotor: an agent that flies, whatever moves it.
pub trait Quadrotor: Agent {
    /// The flight at its latest instant.
    fn flight(&self) -> Flight<f64>;

    /// The level of the model that moves it; `None` if none does, as with a recorded flight.
    fn model_level(&self) -> Option<Level>;
}

/// A quadrotor at any level, under any pilot, with any guidance.
#[derive(Debug)]
pub struct ModelQuadrotor {
    setup: Setup,
    quadrotor: AnyQuadrotor<f64>,
    reference: Reference<f64>,
    /// Commands at the rotors, disturbance included, and the air.
    input: Input<f64>,
    /// Gusts about it.
    air: Air,
    /// Sensors and filter.
    estimating: Option<Box<Estimating>>,
    /// Charge drawn, A h, while it flies at a level without a battery.
    charge_drawn: f64,
    /// What hover draws at the levels of the script that have a battery, A h/s.
    hover_draw: f64,
    /// The models that the script will ask for, in its order; a rule's fine and coarse ones.
    scripted: Vec<AnyQuadrotor<f64>>,
    /// The entry of the script's levels, or the side of its rule, in force.
    entry: Option<usize>,
    /// The agent whose distance the rule looks at.
    near: Option<AgentId>,
    /// One RK4 step per step, no disturbance of commands or state and no estimator: model and controller may fly as one.
    is_plain: bool,
    /// Whether the script has no wind at any time, so that none need be looked up.
    is_still: bool,
}

impl ModelQuadrotor {
    /// A quadrotor in hover, ready to fly.
    ///
    /// # Errors
    /// A model that can't be built, now or at a scripted level; a pilot above a model's level; numbers that are not
    /// finite; an estimator that can't be.
    pub fn new(setup: Setup) -> Result<Self, QuadrotorError> {
        setup.check_numbers()?;
        let build = |choice: &LevelChoice| {
            let name = || setup.name.clone();
            check_pairing(setup.pilot.level(), choice.level)
                .map_err(|error| QuadrotorError::controller(name(), error))?;
            let phenomena = setup.script.phenomena(choice);
            let (at, yaw) = (setup.position(), setup.start.yaw_rad);
            model(&setup.vehicle, choice.level, &phenomena, at, yaw)
                .map_err(|error| QuadrotorError::build(name(), error))
        };
        let mut quadrotor = build(&setup.level)?;
        if setup.velocity_m_s != [0.0; 3] {
            set_moving(&mut quadrotor, setup.velocity_m_s.into());
        }
        let scripted = setup.script.choices().map(build).collect::<Result<Vec<_>, _>>()?;
        let estimating = setup.estimation.as_ref().map(|estimation| {
            Estimating::new(estimation, setup.pilot.level(), &setup.vehicle, &quadrotor)
                .map(Box::new)
                .map_err(|error| QuadrotorError::estimation(setup.name.clone(), error))
        });
        let models = std::iter::once(&quadrotor).chain(&scripted);
        let hover_draw = models.map(hover_draw).fold(0.0, f64::max);
        Ok(Self {
            reference: Reference::hold(setup.position(), setup.start.yaw_rad),
            input: quadrotor.hover_input(),
            quadrotor,
            air: Air::new(&setup.script.wind, &setup.vehicle, -setup.start.position_m[2]),
            estimating: estimating.transpose()?,
            charge_drawn: 0.0,
            hover_draw,
            scripted,
            entry: None,
            near: None,
            is_plain: setup.method == FixedStep::Rk4
                && setup.substeps.get() == 1
                && setup.script.command_offset.values().next().is_none()
                && setup.script.wind.turbulence.is_none()
                && setup.script.process_noise.is_none()
                && setup.estimation.is_none(),
            is_still: setup.script.is_still(),
            setup,
        })
    }

    /// The level it flies at.
    pub fn level(&self) -> Level {
        self.quadrotor.level()
    }

    /// The flight at its latest instant.
    pub fn flight(&self) -> Flight<f64> {
        self.quadrotor.flight()
    }

    /// The model and its state at its latest instant.
    pub fn model(&self) -> &AnyQuadrotor<f64> {
        &self.quadrotor
    }

    /// Commands at the rotors and the air, from its latest instant on.
    pub fn input(&self) -> &Input<f64> {
        &self.input
    }

    /// Puts it in the middle of a flight: from now on it flies as if it had flown like this so far, under its present
    /// input. Its memory of the flight is forgotten; for starts in motion. An estimator is informed.
    pub fn put_in_flight(&mut self, flight: &Snapshot<f64>) {
        self.quadrotor.adopt(flight, &self.input);
        if let Some(estimating) = &mut self.estimating {
            // It rejects a flight with a non-finite state, with which the run ends at once.
            let _ = estimating.put_in_flight(&self.quadrotor, &self.input);
        }
    }

    /// The same flight continues at another level.
    ///
    /// # Errors
    /// A model that can't be built, or a pilot above its level; the flight then continues unchanged.
    pub fn change_level(&mut self, choice: &LevelChoice) -> Result<AgentEvent, QuadrotorError> {
        let name = || self.setup.name.clone();
        check_pairing(self.setup.pilot.level(), choice.level)
            .map_err(|error| QuadrotorError::controller(name(), error))?;
        let phenomena = self.setup.script.phenomena(choice);
        let next = model(
            &self.setup.vehicle,
            choice.level,
            &phenomena,
            Vector3::zeros(),
            0.0,
        )
        .map_err(|error| QuadrotorError::build(name(), error))?;
        Ok(self.go_on_as(next))
    }

    /// The flight continues with this model.
    fn go_on_as(&mut self, mut next: AnyQuadrotor<f64>) -> AgentEvent {
        let mut snapshot = self.quadrotor.snapshot(&self.input);
        self.charge_drawn = snapshot.charge_drawn.unwrap_or(self.charge_drawn);
        snapshot.charge_drawn = Some(self.charge_drawn);
        next.adopt(&snapshot, &self.input);
        let (from, to) = (self.quadrotor.level(), next.level());
        // A pilot that sees estimates sees those of the same model as before.
        if !self.estimating.as_ref().is_some_and(|e| e.is_in_loop()) {
            self.setup.pilot.level_changed(&self.quadrotor.flight());
        }
        self.quadrotor = next;
        AgentEvent::LevelChanged { from, to }
    }

    /// Charge drawn from its battery, A h; as in hover while it flies at a level without one.
    pub fn charge_drawn(&self) -> f64 {
        let of_battery = self.quadrotor.snapshot(&self.input).charge_drawn;
        of_battery.unwrap_or(self.charge_drawn)
    }

    /// The air that its model meets.
    #[inline(always)]
    fn met(&self, now: &Moment<'_>) -> Met {
        if self.is_still {
            return Met::steady(Vector3::zeros());
        }
        self.moving_air(now)
    }

    fn moving_air(&self, now: &Moment<'_>) -> Met {
        let (mean, wind) = (self.mean_wind(now), &self.setup.script.wind);
        if wind.shear.is_none() && wind.turbulence.is_none() {
            return Met::steady(mean);
        }
        let on = self.quadrotor.phenomena();
        self.air.met(wind, mean, &self.quadrotor.flight(), on)
    }

    /// Whether its gusts turn the air.
    fn air_turns(&self) -> bool {
        let turbulence = self.setup.script.wind.turbulence;
        turbulence.is_some_and(|t| t.gusts == Gusts::All)
    }

    /// Mean wind at the reference height in W, m/s.
    fn mean_wind(&self, now: &Moment<'_>) -> Vector3<f64> {
        let script = &self.setup.script;
        let scheduled = script.wind_m_s.at(now.time_ns).copied().unwrap_or_default();
        Vector3::from(scheduled) + script.wind.mean(now.time_ns)
    }

    /// The battery discharges as in hover at levels that don't have one, so that it is not fresh when the vehicle returns to a level that does.
    #[inline(always)]
    fn draw_charge(&mut self, now: &Moment<'_>) {
        if self.hover_draw > 0.0 && !self.quadrotor.level().capabilities().has_battery {
            self.charge_drawn += self.hover_draw * now.step_s;
        }
    }

    /// Gusts continue, and noise acts on the vehicle at the end of its step.
    fn disturb(&mut self, now: &Moment<'_>, before: &Flight<f64>) {
        let mean = self.mean_wind(now);
        let script = &self.setup.script;
        let on = self.quadrotor.phenomena();
        self.air.advance(&script.wind, mean, before, on, now);
        if let Some(noise) = script.process_noise
            && on.contains(Phenomenon::ProcessNoise)
        {
            self.quadrotor.kick(&noise.kick(now));
        }
    }

    /// Changes the level if the script says so at this instant.
    #[inline(always)]
    fn follow_script(&mut self, now: &Moment<'_>) -> Option<AgentEvent> {
        if self.scripted.is_empty() {
            return None;
        }
        self.change_if_due(now)
    }

    fn change_if_due(&mut self, now: &Moment<'_>) -> Option<AgentEvent> {
        let entry = match (&self.setup.script.rule, self.near) {
            (Some(rule), Some(near)) => {
                let distance = (now.published(near).position - now.own().position).norm();
                rule.side(distance, self.entry.map(Side::at)).place()
            }
            _ => self.setup.script.level.place_at(now.time_ns)?,
        };
        if self.entry == Some(entry) {
            return None;
        }
        self.entry = Some(entry);
        let next = &self.scripted[entry];
        if (next.level(), next.phenomena()) == (self.quadrotor.level(), self.quadrotor.phenomena()) {
            return None;
        }
        let next = next.clone();
        Some(self.go_on_as(next))
    }

    /// Sensors and filter at this instant; tells if the filter failed.
    fn estimate(&mut self, now: &Moment<'_>) -> Option<AgentEvent> {
        let estimating = self.estimating.as_mut()?;
        let error = estimating.live(&self.quadrotor, &self.input, now).err()?;
        let reason = error.to_string();
        Some(AgentEvent::EstimatorFailed { reason })
    }

    /// The pilot's commands, by what it may see.
    fn piloted(&mut self, now: &Moment<'_>) -> [f64; 4] {
        let Some(estimating) = &mut self.estimating else {
            return self.setup.pilot.commands(&self.quadrotor, &self.reference, now);
        };
        let seen = if estimating.is_in_loop() {
            estimating.believed()
        } else {
            &self.quadrotor
        };
        let commands = self.setup.pilot.commands(seen, &self.reference, now);
        estimating.send(commands);
        commands
    }
}

impl Quadrotor for ModelQuadrotor {
    fn flight(&self) -> Flight<f64> {
        self.quadrotor.flight()
    }

    fn model_level(&self) -> Option<Level> {
        Some(self.quadrotor.level())
    }
}

impl Agent for ModelQuadrotor {
    fn name(&self) -> &str {
        &self.setup.name
    }

    fn kind(&self) -> &'static str {
        "quadrotor"
    }

    fn bind(&mut self, directory: &Directory<'_>) -> Result<(), BindError> {
        if let Some(rule) = &self.setup.script.rule {
            self.near = Some(directory.find(&rule.near)?);
        }
        if let Some(estimating) = &mut self.estimating {
            estimating.bind(directory.step.ns());
        }
        Ok(self.setup.guidance.bind(directory)?)
    }

    #[inline(always)]
    fn published(&self) -> Published {
        self.quadrotor.see(
            #[inline(always)]
            |flight| Published {
                position: flight.position,
                velocity: flight.velocity,
                rotation: flight.rotation,
                body_rates: flight.body_rates,
            },
        )
    }

    fn publish(&self, to: &mut Published, _: Hook) -> Result<(), Invalid> {
        let published = self.published();
        published.check_flight()?;
        *to = published;
        Ok(())
    }

    fn likely_cause(&self, step: StepSize) -> Option<String> {
        cause::of(self, step)
    }

    fn decide(&mut self, now: &Moment<'_>) -> Option<AgentEvent> {
        let event = self.follow_script(now);
        // There is room for one event; that which ends the run goes first.
        let event = self.estimate(now).or(event);
        self.reference = self.setup.guidance.reference(now);
        let met = self.met(now);
        (self.input.wind, self.input.air_rates) = (met.velocity, met.rates);
        self.input.commands = self.piloted(now);
        if let Some(offset) = self.setup.script.command_offset.at(now.time_ns) {
            self.input.commands = std::array::from_fn(|i| self.input.commands[i] + offset[i]);
        }
        event
    }

    fn advance(&mut self, now: &Moment<'_>) {
        let substeps = self.setup.substeps.get();
        let h = now.step_s / f64::from(substeps);
        let script = &self.setup.script;
        let is_disturbed = script.wind.turbulence.is_some() || script.process_noise.is_some();
        let before = is_disturbed.then(|| self.quadrotor.flight());
        for _ in 0..substeps {
            self.quadrotor.step(self.setup.method, &self.input, h);
        }
        if let Some(before) = before {
            self.disturb(now, &before);
        }
        self.draw_charge(now);
    }

    fn decide_and_advance(&mut self, now: &Moment<'_>, hook: Hook) -> Option<AgentEvent> {
        if !self.is_plain {
            let event = self.decide(now);
            self.advance(now);
            return event;
        }
        let event = self.follow_script(now);
        self.input.wind = self.met(now).velocity;
        let Setup { guidance, pilot, .. } = &mut self.setup;
        let reference = guidance.show(now, &mut self.reference, hook);
        self.input.commands = pilot.fly(&mut self.quadrotor, reference, &self.input.wind, now, hook);
        self.draw_charge(now);
        event
    }

    fn channels(&self) -> Vec<Channel> {
        record::channels(self.air_turns(), self.estimating.is_some())
    }

    fn record(&self, row: &mut [f64]) {
        record::write(self, row);
    }

    fn save(&self) -> Result<serde_json::Value, serde_json::Error> {
        serde_json::to_value(self.memory())
    }

    fn restore(&mut self, memory: &serde_json::Value) -> Result<(), MemoryError> {
        let Restored {
            memory,
            quadrotor,
            estimating,
        } = self.read(memory)?;
        self.setup.pilot.restore(&plain(&memory.pilot))?;
        self.estimating = estimating;
        self.quadrotor = quadrotor;
        self.entry = memory.entry;
        self.air.recall(memory.air.map(|x| x.0));
        self.charge_drawn = memory.charge_drawn.0;
        self.input.commands = memory.commands.map(|u| u.0);
        self.input.wind = Vector3::from(memory.wind.map(|w| w.0));
        self.input.air_rates = Vector3::from(memory.air_rates.map(|w| w.0));
        Ok(())
    }
}
