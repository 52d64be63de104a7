//! A quadrotor with a non-linear rigid body under recorded commands, whose body can be put back to where it was measured.

use super::replay::{ReplayError, ReplayVehicle};
use crate::recorded::MotionCaptureFlight;
use nalgebra::Vector3;
use quad_dynamics::{AnyQuadrotor, Input, Level, Phenomenon, RigidBodyState};
use quad_math::FixedStep;

/// Step of the integration at most, s: a fifth of what the fastest pole of the rotors (500 1/s) would allow to RK4.
const STEP_S: f64 = 1e-3;
/// Rates, rad/s, beyond which a whole-flight prediction has tumbled: twice the range of a gyroscope. It ends there.
const TUMBLED: f64 = 70.0;

/// Velocity along W and body rates.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Motion {
    pub(super) velocity: Vector3<f64>,
    pub(super) body_rates: Vector3<f64>,
}

#[derive(Default)]
pub(super) struct Growth(pub(super) Motion);

impl Growth {
    pub(super) fn add(&mut self, before: &Motion, after: &Motion) {
        self.0.velocity += after.velocity - before.velocity;
        self.0.body_rates += after.body_rates - before.body_rates;
    }
}

/// A quadrotor under way.
pub(super) struct Run<'a> {
    flight: &'a MotionCaptureFlight,
    quadrotor: AnyQuadrotor<f64>,
    replayed: &'a ReplayVehicle,
    /// `V_nominal` where the level feels the voltage.
    nominal_voltage: Option<f64>,
}

impl<'a> Run<'a> {
    pub(super) fn new(
        flight: &'a MotionCaptureFlight,
        level: Level,
        replayed: &'a ReplayVehicle,
    ) -> Result<Self, ReplayError> {
        let capabilities = level.capabilities();
        if !capabilities.non_linear_rigid_body {
            return Err(ReplayError::Level { level });
        }
        let phenomena = level
            .phenomena()
            .without(Phenomenon::InputLimits)
            .without(Phenomenon::VoltageSag);
        let vehicle = &replayed.vehicle;
        let nominal_voltage = if capabilities.feels_voltage {
            let needed_by = "a replay at a level that feels the voltage";
            Some(vehicle.require_battery(needed_by)?.nominal_voltage)
        } else {
            None
        };
        let quadrotor = AnyQuadrotor::hovering(level, vehicle, &phenomena, Vector3::zeros(), 0.0)?;
        Ok(Self {
            flight,
            quadrotor,
            replayed,
            nominal_voltage,
        })
    }

    /// Puts the body where it was measured to be.
    pub(super) fn start_anew(&mut self, k: usize) {
        let attitude = self.flight.attitude[k];
        let measured = RigidBodyState {
            position: self.flight.position[k],
            velocity: attitude.conjugate().rotate(&self.flight.velocity[k]),
            attitude,
            body_rates: self.flight.inertial.body_rates[k],
        };
        // A level without one was refused when the run was made.
        if let Some(body) = self.quadrotor.rigid_body() {
            *body = measured;
        }
    }

    /// Flies from sample k to the next with the commands of δ ago held.
    pub(super) fn advance(&mut self, k: usize) {
        let time = &self.flight.inertial.time;
        let span = time[k + 1] - time[k];
        let input = self.input(time[k] - self.replayed.delay_s);
        let steps = (span / STEP_S).ceil().max(1.0);
        for _ in 0..steps as usize {
            self.quadrotor.step(FixedStep::Rk4, &input, span / steps);
        }
    }

    /// The commands u at a time, s.
    fn input(&self, time: f64) -> Input<f64> {
        let all = &self.flight.inertial.time;
        let next = all.partition_point(|&t| t <= time).clamp(1, all.len() - 1);
        let share = ((time - all[next - 1]) / (all[next] - all[next - 1])).clamp(0.0, 1.0);
        let between = |a: f64, b: f64| a + share * (b - a);
        let voltage = between(self.flight.voltage[next - 1], self.flight.voltage[next]);
        let commands = &self.flight.inertial.commands;
        let zero = self.replayed.vehicle.pwm.zero_thrust;
        Input::still_air(std::array::from_fn(|i| {
            let raw = between(commands[next - 1][i], commands[next][i]) + self.replayed.trim[i];
            raw * self.nominal_voltage.map_or(1.0, |nominal| voltage / nominal) - zero
        }))
    }

    pub(super) fn motion(&self) -> Motion {
        let flight = self.quadrotor.flight();
        Motion {
            velocity: flight.velocity,
            body_rates: flight.body_rates,
        }
    }

    pub(super) fn is_upright(&self) -> bool {
        let motion = self.motion();
        // NaN is not below the limit either.
        motion.body_rates.amax() < TUMBLED && motion.velocity.iter().all(|v| v.is_finite())
    }
}
