//! Levels 2 to 5: one rigid body, four rotors of some model, and parts that switch on and off.
//!
//! One implementation serves four levels and the mechanistic vehicle, since they differ in their rotor model:
//!
//! ```text
//! voltage       V_b = supply(charge, Σ current)
//! rotors        ẋ_i = rotor(x_i, u_i, V_b) → T_i, Q_i
//! ground, arms  T_i → g(z_i) T_i − D_i
//! wrench        F = −Σ T_i e_z + drag,  M = Σ r_i × T_i + Σ −s_i Q_i e_z + damping + gyroscopic + spin-up
//! rigid body    Newton-Euler
//! ```
//!
//! Source: thesis chapters 3.3 to 3.6 and 5.3.

use crate::family::{FamilyRotor, FamilySupply};
use crate::forces::sum_of_four;
use crate::model::RotorSnapshot;
use crate::trim::Trim;
use crate::{
    Blockage, BuildError, Capabilities, Drag, Flight, GroundEffect, Hover, Input, Kick, PhenomenonSet,
    QuadrotorModel, QuadrotorRate, QuadrotorState, RigidBody, RigidBodyState, RotorGeometry, Snapshot,
    Vehicle, gyroscopic_torque,
};
use nalgebra::Vector3;
use quad_math::{RateOf, Real, System};
use quad_rotor::{Battery, MechanisticRotor, Propeller, RotorInput, RotorModel, RotorOutput, SpinUp, Supply};

/// The mechanistic vehicle: motors and propellers from first principles, on a battery.
pub type MechanisticQuadrotor<R> = Quadrotor<R, MechanisticRotor<R>, Battery<R>>;

/// Limits on the commands u.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CommandLimits<R: Real> {
    /// `ū_min − ū_0`.
    pub minimum: R,
    /// `ū_max − ū_0`.
    pub maximum: R,
}

/// How much current a motor draws, from its torque and its duty: `I = d (K_v Q + I_0)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurrentDraw<R: Real> {
    /// Speed constant `K_v`, rad/(s V).
    pub velocity_constant: R,
    /// No-load current `I_0`, A.
    pub no_load_current: R,
    /// Duty for full voltage.
    pub full_voltage_duty: R,
    /// `ū_0 − ū_min`.
    pub zero_thrust_offset: R,
}

/// What the spinning rotors do to the airframe beside their torque.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpinningRotors<R: Real> {
    /// The propeller's static law, for speeds that the rotor model has no state for.
    pub propeller: Propeller<R>,
    /// Inertia `I_R` of one rotor about its axis, kg m².
    pub inertia: R,
    /// Whether the gyroscopic torque acts.
    pub gyroscopic_torque: bool,
    /// Whether the reaction to spin acceleration acts.
    pub spin_up_reaction: bool,
}

/// Four rotors, where they sit, and what feeds and limits them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotorSet<R: Real, M, S> {
    /// The rotors.
    pub rotors: [M; 4],
    /// Where they act.
    pub geometry: RotorGeometry<R>,
    /// What feeds them.
    pub supply: S,
    /// Limits on the commands; `None` is off.
    pub limits: Option<CommandLimits<R>>,
    /// The current they draw; `None` is off.
    pub current_draw: Option<CurrentDraw<R>>,
}

/// A quadrotor with rotor model `M` on supply `S`.
#[derive(Clone, Debug, PartialEq)]
pub struct Quadrotor<R: Real, M, S> {
    /// Mass properties and gravity.
    pub body: RigidBody<R>,
    /// The rotors.
    pub rotor_set: RotorSet<R, M, S>,
    /// Drag; `None` is off.
    pub drag: Option<Drag<R>>,
    /// Gyroscopic torque and spin-up reaction; `None` is off.
    pub spinning: Option<SpinningRotors<R>>,
    /// Ground effect; `None` is off.
    pub ground_effect: Option<GroundEffect<R>>,
    /// Blockage of the slipstream; `None` is off.
    pub blockage: Option<Blockage<R>>,
    pub(crate) phenomena: PhenomenonSet,
    pub(crate) hover_commands: [R; 4],
}

impl<R: Real, M: RotorModel<R>, S: Supply<R>> RotorSet<R, M, S> {
    /// The commands within the limits; unchanged where limits are off.
    #[inline(always)]
    pub fn limited(&self, commands: &[R; 4]) -> [R; 4] {
        match &self.limits {
            Some(l) => commands.map(|u| u.simd_clamp(l.minimum, l.maximum)),
            None => *commands,
        }
    }

    /// Battery current, A: `Σ d_i (K_v Q_i + I_0)`, with duty and current not below zero (kinks there).
    #[inline(always)]
    pub(crate) fn current(&self, draw: &CurrentDraw<R>, rotors: &[M::State; 4], commands: &[R; 4]) -> R {
        sum_of_four(|i| {
            let input = RotorInput {
                command: commands[i],
                voltage: R::zero(),
            };
            let torque = self.rotors[i].output(&rotors[i], &input).torque;
            let current = torque * draw.velocity_constant + draw.no_load_current;
            let duty = (commands[i] + draw.zero_thrust_offset) / draw.full_voltage_duty;
            current.simd_max(R::zero()) * duty.simd_max(R::zero())
        })
    }

    /// Supply current, A, and the inputs of the four rotors, limits and voltage applied.
    #[inline(always)]
    pub fn rotor_inputs(
        &self,
        rotors: &[M::State; 4],
        supply: &S::State,
        input: &Input<R>,
    ) -> (R, [RotorInput<R>; 4]) {
        let commands = self.limited(&input.commands);
        let current = match &self.current_draw {
            Some(draw) => self.current(draw, rotors, &commands),
            None => R::zero(),
        };
        let voltage = self.supply.voltage(supply, current);
        (current, commands.map(|command| RotorInput { command, voltage }))
    }
}

impl<R: Real, M: RotorModel<R>, S: Supply<R>> Quadrotor<R, M, S> {
    /// Force and moment of everything but gravity, along B, at a state with these rotor inputs in the input's air.
    #[inline(always)]
    pub fn wrench(
        &self,
        state: &QuadrotorState<R, M::State, S::State>,
        inputs: &[RotorInput<R>; 4],
        input: &Input<R>,
    ) -> crate::Wrench<R> {
        let set = &self.rotor_set;
        let outputs: [RotorOutput<R>; 4] =
            std::array::from_fn(|i| set.rotors[i].output(&state.rotors[i], &inputs[i]));
        let air_velocity = match (&self.drag, &self.blockage) {
            (None, None) => state.body.velocity,
            _ => state.body.velocity - state.body.attitude.conjugate().rotate(&input.wind),
        };
        let mut wrench = set
            .geometry
            .wrench(&self.acting(&outputs, &state.body, air_velocity.z));
        if let Some(drag) = &self.drag {
            let turning = state.body.attitude.conjugate().rotate(&input.air_rates);
            let extra = drag.wrench(&air_velocity, &(state.body.body_rates - turning));
            wrench.force += extra.force;
            wrench.moment += extra.moment;
        }
        if let Some(spinning) = &self.spinning {
            wrench.moment += self.spin_moment(spinning, state, inputs, &outputs);
        }
        wrench
    }

    /// What the rotors do to the airframe once ground and arms have had their say: torque as in free air.
    #[inline(always)]
    fn acting(
        &self,
        free: &[RotorOutput<R>; 4],
        body: &RigidBodyState<R>,
        air_velocity_down: R,
    ) -> [RotorOutput<R>; 4] {
        let mut acting = *free;
        if let Some(ground) = &self.ground_effect {
            let gains = ground.gains(body);
            for (rotor, gain) in acting.iter_mut().zip(gains) {
                rotor.thrust *= gain;
            }
        }
        if let Some(blockage) = &self.blockage {
            for (rotor, free) in acting.iter_mut().zip(free) {
                rotor.thrust -= blockage.download(free.thrust, -air_velocity_down);
            }
        }
        acting
    }

    /// Specific force at the centre of mass, `f = F/m` along B with F everything but gravity, m/s²: what an ideal
    /// accelerometer there reads, `[0, 0, −g]` in hover.
    pub fn specific_force(
        &self,
        state: &QuadrotorState<R, M::State, S::State>,
        input: &Input<R>,
    ) -> Vector3<R> {
        let (_, inputs) = self.rotor_set.rotor_inputs(&state.rotors, &state.supply, input);
        self.wrench(state, &inputs, input).force / self.body.mass
    }

    /// Gyroscopic torque and spin-up reaction `−Σ s_i I_R Ω̇_i e_z`, N m along B.
    #[inline(always)]
    fn spin_moment(
        &self,
        spinning: &SpinningRotors<R>,
        state: &QuadrotorState<R, M::State, S::State>,
        inputs: &[RotorInput<R>; 4],
        outputs: &[RotorOutput<R>; 4],
    ) -> Vector3<R> {
        let set = &self.rotor_set;
        let speeds: [R; 4] = std::array::from_fn(|i| {
            set.rotors[i].speed(&state.rotors[i], outputs[i].thrust, &spinning.propeller)
        });
        let mut moment = Vector3::zeros();
        if spinning.gyroscopic_torque {
            let momentum = sum_of_four(|i| set.geometry.spin[i] * speeds[i]) * spinning.inertia;
            moment += gyroscopic_torque(&state.body.body_rates, momentum);
        }
        if spinning.spin_up_reaction {
            moment.z -= spinning.inertia
                * sum_of_four(|i| {
                    let thrust_rate = set.rotors[i].output_rate(&state.rotors[i], &inputs[i]).thrust;
                    set.geometry.spin[i]
                        * spinning
                            .propeller
                            .speed_rate_for_thrust_rate(speeds[i], thrust_rate)
                });
        }
        moment
    }
}

impl<R: Real, M: RotorModel<R>, S: Supply<R>> System<R> for Quadrotor<R, M, S> {
    type State = QuadrotorState<R, M::State, S::State>;
    type Input = Input<R>;

    #[inline(always)]
    fn derivative(&self, state: &Self::State, input: &Input<R>) -> RateOf<R, Self> {
        let set = &self.rotor_set;
        let (current, inputs) = set.rotor_inputs(&state.rotors, &state.supply, input);
        QuadrotorRate {
            body: self
                .body
                .derivative(&state.body, &self.wrench(state, &inputs, input)),
            rotors: std::array::from_fn(|i| set.rotors[i].derivative(&state.rotors[i], &inputs[i])),
            supply: set.supply.derivative(&state.supply, current),
        }
    }
}

/// A quadrotor whose switchable parts are all off, resolved before the loop rather than in it.
///
/// The same code without switches; [`quad_math::Batch`] needs it, since a switch inside a loop over
/// vehicles keeps the loop scalar. Made by [`Quadrotor::bare`].
#[derive(Debug)]
pub struct Bare<'a, R: Real, M, S>(&'a Quadrotor<R, M, S>);

impl<R: Real, M, S> Quadrotor<R, M, S> {
    /// The model without its switches, if they are all off.
    pub fn bare(&self) -> Option<Bare<'_, R, M, S>> {
        let set = &self.rotor_set;
        let parts = self.drag.is_some()
            || self.spinning.is_some()
            || self.ground_effect.is_some()
            || self.blockage.is_some()
            || set.limits.is_some()
            || set.current_draw.is_some();
        (!parts).then_some(Bare(self))
    }
}

impl<R: Real, M: RotorModel<R>, S: Supply<R>> System<R> for Bare<'_, R, M, S> {
    type State = QuadrotorState<R, M::State, S::State>;
    type Input = Input<R>;

    #[inline(always)]
    fn derivative(&self, state: &Self::State, input: &Input<R>) -> RateOf<R, Self> {
        let set = &self.0.rotor_set;
        let voltage = set.supply.voltage(&state.supply, R::zero());
        let input = |i: usize| RotorInput {
            command: input.commands[i],
            voltage,
        };
        let outputs = std::array::from_fn(
            #[inline(always)]
            |i| set.rotors[i].output(&state.rotors[i], &input(i)),
        );
        QuadrotorRate {
            body: self
                .0
                .body
                .derivative(&state.body, &set.geometry.wrench(&outputs)),
            rotors: std::array::from_fn(
                #[inline(always)]
                |i| set.rotors[i].derivative(&state.rotors[i], &input(i)),
            ),
            supply: set.supply.derivative(&state.supply, R::zero()),
        }
    }
}

impl<R, M, S> QuadrotorModel<R> for Quadrotor<R, M, S>
where
    R: Real,
    M: FamilyRotor<R, Supply = S>,
    S: FamilySupply<R>,
{
    const NAME: &'static str = M::NAME;

    const CAPABILITIES: Capabilities = Capabilities {
        non_linear_rigid_body: true,
        separate_spin_up: matches!(M::SPIN_UP, SpinUp::Separate),
        feels_voltage: M::FEELS_VOLTAGE,
        has_battery: S::IS_BATTERY,
    };

    fn trim(vehicle: &Vehicle, phenomena: &PhenomenonSet) -> Result<Trim, BuildError> {
        crate::assemble::trim::<R, M>(vehicle, phenomena)
    }

    fn build_trimmed(
        parameters: &Vehicle<R>,
        phenomena: &PhenomenonSet,
        trim: &Trim,
    ) -> Result<Self, BuildError> {
        crate::assemble::quadrotor(parameters, phenomena, trim)
    }

    #[inline(always)]
    fn flight(&self, state: &Self::State) -> Flight<R> {
        let body = &state.body;
        let rotation = body.attitude.rotation();
        Flight {
            position: body.position,
            velocity: rotation.matrix * body.velocity,
            attitude: rotation.euler_angles(),
            rotation,
            body_rates: body.body_rates,
            thrusts: M::measured_thrusts(&state.rotors),
        }
    }

    fn snapshot(&self, state: &Self::State, input: &Input<R>) -> Snapshot<R> {
        let set = &self.rotor_set;
        let (_, inputs) = set.rotor_inputs(&state.rotors, &state.supply, input);
        Snapshot {
            body: state.body,
            rotors: std::array::from_fn(|i| RotorSnapshot {
                output: set.rotors[i].output(&state.rotors[i], &inputs[i]),
                rate: set.rotors[i].output_rate(&state.rotors[i], &inputs[i]),
            }),
            charge_drawn: S::charge_drawn(&state.supply),
        }
    }

    fn adopt(&self, snapshot: &Snapshot<R>, input: &Input<R>) -> Self::State {
        let set = &self.rotor_set;
        let supply = S::with_charge_drawn(snapshot.charge_drawn);
        let adopted = |inputs: &[RotorInput<R>; 4]| {
            std::array::from_fn(|i| {
                let rotor = &snapshot.rotors[i];
                set.rotors[i].state_for_output(&rotor.output, &rotor.rate, &inputs[i])
            })
        };
        // The voltage needs the torque, which every adopted state keeps whatever the voltage.
        let commands = set.limited(&input.commands);
        let rotors = adopted(&commands.map(|command| RotorInput {
            command,
            voltage: R::one(),
        }));
        let (_, inputs) = set.rotor_inputs(&rotors, &supply, input);
        QuadrotorState {
            body: snapshot.body,
            rotors: adopted(&inputs),
            supply,
        }
    }

    fn kicked(&self, state: &Self::State, kick: &Kick<R>) -> Self::State {
        let mut kicked = *state;
        kicked.body.velocity += state.body.attitude.conjugate().rotate(&kick.velocity);
        kicked.body.body_rates += kick.body_rates;
        kicked
    }

    fn hover(&self, position: Vector3<R>, yaw: R) -> Hover<Self::State, R> {
        let input = Input::still_air(self.hover_commands);
        let state = self.rotor_set.at_rest(&input);
        Hover {
            state: QuadrotorState {
                body: RigidBodyState::at_rest(position, yaw),
                ..state
            },
            input,
        }
    }

    fn phenomena(&self) -> &PhenomenonSet {
        &self.phenomena
    }

    fn rigid_body(state: &mut Self::State) -> Option<&mut RigidBodyState<R>> {
        Some(&mut state.body)
    }

    fn own_scales(&self) -> Vec<R> {
        let Hover { state, input } = self.hover(Vector3::zeros(), R::zero());
        let (_, inputs) = self.rotor_set.rotor_inputs(&state.rotors, &state.supply, &input);
        let output = self.rotor_set.rotors[0].output(&state.rotors[0], &inputs[0]);
        let mut scales = M::state_scales(&state.rotors[0], &output).repeat(4);
        scales.extend(S::state_scales());
        scales
    }

    fn fastest_pole(&self) -> R {
        let hover = self.hover(Vector3::zeros(), R::zero()).state;
        self.rotor_set.rotors[0].fastest_pole(&hover.rotors[0])
    }
}
