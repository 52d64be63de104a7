//! Hover trim: the commands that hold the weight without a moment, with the voltage that they leave.
//!
//! ```text
//! [ 1   1   1   1  ]         [ lift ]
//! [−y₁ −y₂ −y₃ −y₄ ]  T_i =  [  0   ]      Σ s_i Q_i(T_i) = 0 fixes the free part n of the thrusts
//! [ x₁  x₂  x₃  x₄ ]         [  0   ]
//! [−s₁ −s₂ −s₃ −s₄ ]         [  n   ]
//! ```
//!
//! (x_i, y_i): the rotors' places forward and right of the centre of mass, s_i their spins. Thrusts give commands by the rotors' own inverse,
//! at a voltage that depends on the current and so on the commands: a fixed point. Assumes still air out of ground effect, a full battery.

use crate::quadrotor::RotorSet;
use crate::vehicle::Vehicle;
use crate::{BuildError, Input, QuadrotorState, RigidBodyState};
use nalgebra::{Matrix4, Vector3, Vector4};
use quad_math::Real;
use quad_rotor::{RotorInput, RotorModel, Supply};

/// The commands that hold a vehicle in level hover, in still air out of ground effect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trim {
    /// Zeroed rotor commands, dimensionless duty, in the order of the vehicle's rotors.
    pub commands: [f64; 4],
}

/// Rounds of `voltage → torque → current → voltage`. Internal resistance times the slope of the current
/// contracts the error at least fivefold a round, so thirty leave rounding only.
const VOLTAGE_ROUNDS: usize = 30;

/// Secant steps for the yaw balance of hover; the torque is a smooth, nearly linear function of thrust.
const YAW_ROUNDS: usize = 30;

impl<R: Real, M: RotorModel<R>, S: Supply<R>> RotorSet<R, M, S> {
    /// Everything at rest under a constant input, with a full supply.
    pub(crate) fn at_rest(&self, input: &Input<R>) -> QuadrotorState<R, M::State, S::State> {
        let supply = self.supply.full();
        let commands = self.limited(&input.commands);
        let settled = |voltage: R| -> [M::State; 4] {
            std::array::from_fn(|i| {
                self.rotors[i].equilibrium(&RotorInput {
                    command: commands[i],
                    voltage,
                })
            })
        };
        let mut rotors = settled(self.supply.voltage(&supply, R::zero()));
        if self.current_draw.is_some() {
            for _ in 0..VOLTAGE_ROUNDS {
                rotors = settled(self.rotor_inputs(&rotors, &supply, input).1[0].voltage);
            }
        }
        QuadrotorState {
            body: RigidBodyState::at_rest(Vector3::zeros(), R::zero()),
            rotors,
            supply,
        }
    }
}

impl<M: RotorModel<f64>, S: Supply<f64>> RotorSet<f64, M, S> {
    /// The trim of hover: this lift, N, of the four rotors, and no moment about any axis.
    pub(crate) fn trim(
        &self,
        vehicle: &Vehicle,
        model: &'static str,
        within_limits: bool,
        lift: f64,
    ) -> Result<Trim, BuildError> {
        let g = &self.geometry;
        let rows = Matrix4::from_fn(|row, i| match row {
            0 => 1.0,
            1 => -g.right[i],
            2 => g.forward[i],
            _ => -g.spin[i],
        });
        // Thrusts that carry the weight without roll and pitch, with a free part `yaw` that only twists.
        let inverse = rows.try_inverse().unwrap_or_else(|| rows.map(|_| f64::NAN));
        let commands_for = |yaw: f64| {
            let thrusts = inverse * Vector4::new(lift, 0.0, 0.0, yaw);
            self.settled_commands(&thrusts)
        };
        let yaw_moment = |yaw: f64| {
            let commands = commands_for(yaw);
            let state = self.at_rest(&Input::still_air(commands));
            let (_, inputs) = self.rotor_inputs(&state.rotors, &state.supply, &Input::still_air(commands));
            crate::forces::sum_of_four(|i| {
                -g.spin[i] * self.rotors[i].output(&state.rotors[i], &inputs[i]).torque
            })
        };
        let commands = commands_for(root_by_secant(yaw_moment, vehicle.weight()));
        check_hover(vehicle, model, within_limits, commands)
    }

    /// Commands u that give these steady thrusts, N, with the voltage that they leave.
    fn settled_commands(&self, thrusts: &Vector4<f64>) -> [f64; 4] {
        let supply = self.supply.full();
        let mut voltage = self.supply.voltage(&supply, 0.0);
        let commands_at =
            |voltage| std::array::from_fn(|i| self.rotors[i].command_for_thrust(thrusts[i], voltage));
        for _ in 0..VOLTAGE_ROUNDS {
            let commands: [f64; 4] = commands_at(voltage);
            let rotors: [M::State; 4] = std::array::from_fn(|i| {
                self.rotors[i].equilibrium(&RotorInput {
                    command: commands[i],
                    voltage,
                })
            });
            let current = self
                .current_draw
                .as_ref()
                .map_or(0.0, |d| self.current(d, &rotors, &commands));
            voltage = self.supply.voltage(&supply, current);
        }
        commands_at(voltage)
    }
}

/// The root of a nearly linear function near zero, by the secant method; `scale` is the size of a step
/// worth taking.
fn root_by_secant(f: impl Fn(f64) -> f64, scale: f64) -> f64 {
    let (mut a, mut b) = (0.0, 1e-3 * scale);
    let (mut f_a, mut f_b) = (f(a), f(b));
    if f_a == 0.0 {
        return a;
    }
    for _ in 0..YAW_ROUNDS {
        if f_b == f_a {
            break;
        }
        let c = b - f_b * (b - a) / (f_b - f_a);
        (a, f_a) = (b, f_b);
        (b, f_b) = (c, f(c));
    }
    b
}

fn check_hover(
    vehicle: &Vehicle,
    model: &'static str,
    within_limits: bool,
    commands: [f64; 4],
) -> Result<Trim, BuildError> {
    let range = vehicle.zeroed_range();
    for (i, &command) in commands.iter().enumerate() {
        if !command.is_finite() || (within_limits && !range.contains(&command)) {
            return Err(BuildError::HoverOutOfRange {
                vehicle: vehicle.name.clone(),
                model,
                rotor: i + 1,
                command: command + vehicle.pwm.zero_thrust,
                minimum: vehicle.pwm.minimum,
                maximum: vehicle.pwm.maximum,
            });
        }
    }
    Ok(Trim { commands })
}
