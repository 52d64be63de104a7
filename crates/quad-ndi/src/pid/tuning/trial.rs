//! One flight of a tuning and its cost.

use super::{LoopTarget, TunedLoop, TuningError, TuningOptions};
use crate::closed_loop::{ClosedLoop, Feedback};
use crate::controller::{Controller, Demand};
use crate::pid::{Pid, PidSettings};
use crate::settling::SETTLING_BAND;
use crate::{InCharge, Reference};
use nalgebra::Vector3;
use quad_dynamics::{AnyQuadrotor, CommandLimits, Flight, Input, Phenomenon, Vehicle};

/// Length of a flight, in settling times; the load comes half-way.
pub(super) const FLIGHT: f64 = 4.0;

/// The load as a fraction of `ω² A`, against the step: what saturation left in the integrals after the step must
/// not pass for an answer to the load.
const LOAD: f64 = 0.1;

/// Weight of the total variation of the commands.
const ACTIVITY_WEIGHT: f64 = 0.005;

/// Overshoot that costs nothing, and the price of the rest, squared. An integral leaves its overshoot slowly, so half the band that counts as settled is all there is to give.
const FREE_OVERSHOOT: f64 = 0.5 * SETTLING_BAND;
const OVERSHOOT_WEIGHT: f64 = 300.0;

/// Least cost of a flight that stops being finite.
const PENALTY: f64 = 1e6;

/// A vehicle in hover, a loop to excite, and what to judge it by.
pub(super) struct Bench {
    hovering: AnyQuadrotor<f64>,
    hover_commands: [f64; 4],
    tuned: TunedLoop,
    target: LoopTarget,
    omega: f64,
    step_s: f64,
    /// A controller of this vehicle; each flight has its own gains.
    pid: Pid<f64>,
    /// Commands that make the load.
    load: [f64; 4],
    /// Error of the measured pitch that makes the load, rad.
    horizon: f64,
}

/// The cascade, or its inner loops alone.
struct Excited {
    pid: InCharge<f64, Pid<f64>>,
    /// What the inner loops alone are asked for, rad.
    tilt: Option<[f64; 2]>,
}

impl Feedback<f64> for Excited {
    fn commands(&mut self, seen: &Flight<f64>, reference: &Reference<f64>, h: f64) -> [f64; 4] {
        let InCharge { controller, memory } = &mut self.pid;
        let answer = match self.tilt {
            Some(tilt) => controller.hold_tilt(memory, seen, reference, tilt, h),
            None => controller.control(memory, seen, reference, h),
        };
        *memory = answer.memory;
        answer.commands
    }
}

/// What a flight sums up.
struct Account {
    step_error: f64,
    load_error: f64,
    variation: f64,
    overshoot: f64,
}

impl Bench {
    pub(super) fn new(
        vehicle: &Vehicle,
        options: &TuningOptions,
        tuned: TunedLoop,
        settings: &PidSettings,
    ) -> Result<Self, TuningError> {
        let hovering =
            AnyQuadrotor::hovering(options.level, vehicle, &options.phenomena, Vector3::zeros(), 0.0)?;
        let mut pid = Pid::new(vehicle, settings)?;
        let limits = options.phenomena.contains(Phenomenon::InputLimits);
        pid.limits = limits.then(|| CommandLimits::of(vehicle));
        let (target, omega) = (options.target(tuned), options.frequency(tuned)?);
        let acceleration = -LOAD * omega * omega * target.step;
        let about = |axis: Vector3<f64>| Demand {
            thrust: 0.0,
            moment: pid.body.inertia * axis * acceleration,
        };
        let none = about(Vector3::zeros());
        let load = match tuned {
            TunedLoop::Attitude => about(Vector3::x()),
            TunedLoop::Yaw => about(Vector3::z()),
            // Height and thrust both count upwards.
            TunedLoop::Height => Demand {
                thrust: pid.body.mass * acceleration,
                ..none
            },
            TunedLoop::Position => none,
        };
        let horizon = if tuned == TunedLoop::Position {
            acceleration / pid.body.gravity
        } else {
            0.0
        };
        Ok(Self {
            hover_commands: hovering.hover_input().commands,
            hovering,
            tuned,
            target,
            omega,
            step_s: options.step_s,
            load: pid.allocation.commands(&load),
            pid,
            horizon,
        })
    }

    /// The cost J of one flight with these settings: finite for any gains.
    pub(super) fn cost(&self, settings: &PidSettings) -> f64 {
        let mut pid = self.pid;
        pid.proportional = settings.per_loop(|g| g.proportional);
        pid.integral = settings.per_loop(|g| g.integral);
        pid.derivative = settings.per_loop(|g| g.derivative);
        let steps = (FLIGHT * self.target.settling_time_s / self.step_s).round() as u32;
        let reference = self.reference();
        let mut flying = ClosedLoop {
            plant: self.hovering.clone(),
            feedback: Excited {
                pid: pid.into(),
                tilt: self.tilt(),
            },
        };
        let mut before = self.hover_commands;
        let mut account = Account::new();
        for k in 0..steps {
            let loaded = k >= steps / 2;
            let mut seen = flying.plant.flight();
            let y = self.response(&seen);
            let mut load = [0.0; 4];
            if loaded {
                seen.attitude.pitch += self.horizon;
                load = self.load;
            }
            let commands = flying.step_as_seen(&seen, &reference, &Input::still_air(load), self.step_s);
            if !(y.is_finite() && commands.iter().all(|u| u.is_finite())) {
                return PENALTY * (2.0 - f64::from(k) / f64::from(steps));
            }
            self.add(&mut account, f64::from(k), f64::from(steps / 2), y);
            account.variation += commands
                .iter()
                .zip(&before)
                .map(|(u, v)| (u - v).abs())
                .sum::<f64>();
            before = commands;
        }
        account.total(self.hover_commands.iter().sum())
    }

    /// What steps the loop, but for the tilt of the attitude loop.
    fn reference(&self) -> Reference<f64> {
        let (step, o) = (self.target.step, Vector3::zeros());
        match self.tuned {
            TunedLoop::Attitude => Reference::hold(o, 0.0),
            TunedLoop::Yaw => Reference::hold(o, step),
            TunedLoop::Height => Reference::hold(Vector3::new(0.0, 0.0, -step), 0.0),
            TunedLoop::Position => Reference::hold(Vector3::new(step, 0.0, 0.0), 0.0),
        }
    }

    /// The tilt `[φ, θ]`, rad, that the inner loops are asked for; `None` where the position loops ask.
    fn tilt(&self) -> Option<[f64; 2]> {
        match self.tuned {
            TunedLoop::Attitude => Some([self.target.step, 0.0]),
            TunedLoop::Yaw | TunedLoop::Height => Some([0.0; 2]),
            TunedLoop::Position => None,
        }
    }

    /// The response as a fraction of the step.
    fn response(&self, flight: &Flight<f64>) -> f64 {
        let y = match self.tuned {
            TunedLoop::Attitude => flight.attitude.roll,
            TunedLoop::Yaw => flight.attitude.yaw,
            TunedLoop::Height => -flight.position.z,
            TunedLoop::Position => flight.position.x,
        };
        y / self.target.step
    }

    /// Adds sample `k` of the response, the load coming at sample `half`, by the rectangle rule.
    fn add(&self, account: &mut Account, k: f64, half: f64, y: f64) {
        let tau = self.target.settling_time_s;
        let ds = self.step_s / tau;
        if k < half {
            // Critically damped second-order step response.
            let x = self.omega * k * self.step_s;
            let model = 1.0 - (1.0 + x) * (-x).exp();
            account.step_error += k * ds * (model - y).abs() * ds;
            account.overshoot = account.overshoot.max(y - 1.0);
        } else {
            account.load_error += (k - half) * ds * (1.0 - y).abs() * ds;
        }
    }
}

impl Account {
    fn new() -> Self {
        Self {
            step_error: 0.0,
            load_error: 0.0,
            variation: 0.0,
            overshoot: 0.0,
        }
    }

    /// The cost, given the sum of the four hover commands.
    fn total(&self, hover: f64) -> f64 {
        let cost = self.step_error
            + self.load_error
            + ACTIVITY_WEIGHT * self.variation / hover
            + OVERSHOOT_WEIGHT * (self.overshoot - FREE_OVERSHOOT).max(0.0).powi(2);
        // A flight to far away may be finite and still dearer than one that broke off.
        cost.min(PENALTY)
    }
}
