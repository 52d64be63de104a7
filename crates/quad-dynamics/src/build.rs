//! From a vehicle's parameters to the models of levels 2 to 5 and the mechanistic vehicle.

mod rotors;

use crate::quadrotor::{CommandLimits, CurrentDraw, Quadrotor, RotorSet, SpinningRotors};
use crate::vehicle::Vehicle;
use crate::{
    Blockage, BuildError, Capabilities, Drag, GroundEffect, Input, Level, ModelName, Phenomenon,
    PhenomenonSet, QuadrotorState, RigidBody, RigidBodyState, RotorGeometry,
};
use nalgebra::{Matrix3, Matrix4, Vector3, Vector4};
use quad_math::{Real, constant};
use quad_rotor::{
    Battery, BatteryState, ConstantVoltage, IdealRotor, RotorInput, RotorModel, SpinUp, Supply,
};
use rotors::{ideal, propeller, stiff, zero_thrust_offset};

/// Rounds of `voltage → torque → current → voltage`. Internal resistance times the slope of the current
/// contracts the error at least fivefold a round, so thirty leave rounding only.
const VOLTAGE_ROUNDS: usize = 30;

/// Secant steps for the yaw balance of hover; the torque is a smooth, nearly linear function of thrust.
const YAW_ROUNDS: usize = 30;

/// A rotor model with a place in the family.
pub trait FamilyRotor<R: Real>: RotorModel<R> {
    /// The supply that goes with it.
    type Supply: FamilySupply<R>;

    /// The level it makes; `None` for the mechanistic vehicle.
    const LEVEL: Option<Level>;

    /// The same rotor over `f64`, in which trims are solved.
    type OverF64: FamilyRotor<f64>;

    /// Whether its thrust depends on the battery voltage.
    const FEELS_VOLTAGE: bool;

    /// The rotor of a vehicle.
    ///
    /// # Errors
    /// If the vehicle lacks a group of parameters.
    fn of(vehicle: &Vehicle<R>) -> Result<Self, BuildError>;

    /// The supply of a vehicle, with or without voltage sag.
    ///
    /// # Errors
    /// If the vehicle lacks a group of parameters.
    fn supply(vehicle: &Vehicle<R>, sag: bool) -> Result<Self::Supply, BuildError>;

    /// The rotor thrusts, N, where the model has them as its only states.
    #[inline(always)]
    fn measured_thrusts(_rotors: &[Self::State; 4]) -> Option<[R; 4]> {
        None
    }
}

/// A supply whose charge can be carried over to another level.
pub trait FamilySupply<R: Real>: Supply<R> {
    /// Charge drawn, Ah; zero for a stiff supply.
    fn charge_drawn(state: &Self::State) -> R;

    /// The state with this charge drawn, Ah.
    fn with_charge_drawn(charge_drawn: R) -> Self::State;
}

/// The charge drawn lives in the battery's state.
impl<R: Real> FamilySupply<R> for Battery<R> {
    fn charge_drawn(state: &BatteryState<R>) -> R {
        state.charge_drawn
    }

    fn with_charge_drawn(charge_drawn: R) -> BatteryState<R> {
        BatteryState { charge_drawn }
    }
}

/// A stiff supply has no charge to remember.
impl<R: Real> FamilySupply<R> for ConstantVoltage<R> {
    fn charge_drawn((): &()) -> R {
        R::zero()
    }

    fn with_charge_drawn(_charge_drawn: R) {}
}

impl<R: Real> RigidBody<R> {
    /// The rigid body of a vehicle.
    pub fn of(vehicle: &Vehicle) -> Self {
        Self::with(vehicle, &vehicle.map(constant))
    }

    /// The rigid body of a vehicle, its numbers given over this scalar too.
    pub(crate) fn with(vehicle: &Vehicle, parameters: &Vehicle<R>) -> Self {
        let nominal = vehicle.airframe.inertia;
        // A validated vehicle has a positive definite inertia; an unvalidated one gets NaN, not a panic.
        let inverse = nominal.try_inverse().unwrap_or_else(|| nominal.map(|_| f64::NAN));
        let inverse: Matrix3<R> = inverse.map(constant);
        let airframe = &parameters.airframe;
        // d(I⁻¹) = −I⁻¹ dI I⁻¹: the difference has the value zero, and the derivatives of the inertia.
        let difference = airframe.inertia - nominal.map(constant::<R>);
        Self {
            mass: airframe.mass,
            inertia: airframe.inertia,
            inertia_inverse: inverse - inverse * difference * inverse,
            gravity: parameters.environment.gravity,
        }
    }
}

impl<R: Real> RotorGeometry<R> {
    /// Where the rotors of a vehicle sit, relative to its centre of mass.
    pub fn of(vehicle: &Vehicle) -> Self {
        Self::with(&vehicle.map(constant))
    }

    pub(crate) fn with(vehicle: &Vehicle<R>) -> Self {
        let rotor =
            |f: fn(&crate::vehicle::RotorMount<R>) -> R| std::array::from_fn(|i| f(&vehicle.rotors[i]));
        Self {
            forward: rotor(|r| r.position.x),
            right: rotor(|r| r.position.y),
            spin: rotor(|r| constant(r.spin.sign())),
        }
    }
}

impl<R: Real> CommandLimits<R> {
    /// The limits of a vehicle's zeroed commands.
    pub fn of(vehicle: &Vehicle) -> Self {
        Self::with(&vehicle.map(constant))
    }

    pub(crate) fn with(vehicle: &Vehicle<R>) -> Self {
        let pwm = &vehicle.pwm;
        Self {
            minimum: pwm.minimum - pwm.zero_thrust,
            maximum: pwm.maximum - pwm.zero_thrust,
        }
    }
}

impl<R: Real> RotorSet<R, IdealRotor<R>, ConstantVoltage<R>> {
    /// Ideal rotors, as levels 1 and 2 have them.
    pub(crate) fn linear(vehicle: &Vehicle<R>, limits: Option<CommandLimits<R>>) -> Self {
        Self {
            rotors: [ideal(vehicle); 4],
            geometry: RotorGeometry::with(vehicle),
            supply: stiff(vehicle),
            limits,
            current_draw: None,
        }
    }
}

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
    /// Zeroed commands that hold hover: this lift, N, of the four rotors, and no moment about any axis.
    pub(crate) fn hover_commands(
        &self,
        vehicle: &Vehicle,
        model: ModelName,
        within_limits: bool,
        lift: f64,
    ) -> Result<[f64; 4], BuildError> {
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

    /// Zeroed commands that give these steady thrusts, N, with the voltage that they leave.
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
    model: ModelName,
    within_limits: bool,
    commands: [f64; 4],
) -> Result<[f64; 4], BuildError> {
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
    Ok(commands)
}

/// What a rotor model brings along for phenomena (the rigid body is non-linear here).
fn capabilities<R: Real, M: FamilyRotor<R>>() -> Capabilities {
    Capabilities {
        non_linear_rigid_body: true,
        separate_spin_up: M::SPIN_UP == SpinUp::Separate,
        feels_voltage: M::FEELS_VOLTAGE,
    }
}

pub(crate) fn quadrotor<R, M, S>(
    vehicle: &Vehicle,
    parameters: &Vehicle<R>,
    phenomena: &PhenomenonSet,
) -> Result<Quadrotor<R, M, S>, BuildError>
where
    R: Real,
    M: FamilyRotor<R, Supply = S>,
    S: FamilySupply<R>,
{
    let model = ModelName(M::LEVEL);
    BuildError::check_phenomena(model, phenomena, capabilities::<R, M>())?;
    let has = |phenomenon| phenomena.contains(phenomenon);
    let trimmed = rotor_set::<f64, M::OverF64>(vehicle, phenomena)?;
    let blockage = has(Phenomenon::Blockage)
        .then(|| Blockage::<f64>::of(vehicle))
        .transpose()?;
    let lift = vehicle.weight() / (1.0 - blockage.map_or(0.0, |b| b.share_in_hover()));
    let hover = trimmed.hover_commands(vehicle, model, has(Phenomenon::InputLimits), lift)?;
    Ok(Quadrotor {
        body: RigidBody::with(vehicle, parameters),
        rotor_set: rotor_set::<R, M>(parameters, phenomena)?,
        drag: has(Phenomenon::Drag).then(|| drag(parameters)).transpose()?,
        spinning: spinning(parameters, phenomena)?,
        ground_effect: has(Phenomenon::GroundEffect)
            .then(|| GroundEffect::with(parameters))
            .transpose()?,
        blockage: has(Phenomenon::Blockage)
            .then(|| Blockage::with(parameters))
            .transpose()?,
        phenomena: phenomena.clone(),
        hover_commands: hover.map(constant),
    })
}

fn rotor_set<R: Real, M: FamilyRotor<R>>(
    vehicle: &Vehicle<R>,
    phenomena: &PhenomenonSet,
) -> Result<RotorSet<R, M, M::Supply>, BuildError> {
    let sag = phenomena.contains(Phenomenon::VoltageSag);
    Ok(RotorSet {
        rotors: [M::of(vehicle)?; 4],
        geometry: RotorGeometry::with(vehicle),
        supply: M::supply(vehicle, sag)?,
        limits: phenomena
            .contains(Phenomenon::InputLimits)
            .then(|| CommandLimits::with(vehicle)),
        current_draw: sag.then(|| current_draw(vehicle)).transpose()?,
    })
}

fn drag<R: Real>(vehicle: &Vehicle<R>) -> Result<Drag<R>, BuildError> {
    let drag = vehicle.require_drag("the phenomenon drag")?;
    Ok(Drag {
        quadratic: drag.quadratic,
        rate_damping: drag.rate_damping,
    })
}

fn spinning<R: Real>(
    vehicle: &Vehicle<R>,
    phenomena: &PhenomenonSet,
) -> Result<Option<SpinningRotors<R>>, BuildError> {
    let gyroscopic_torque = phenomena.contains(Phenomenon::GyroscopicTorque);
    let spin_up_reaction = phenomena.contains(Phenomenon::SpinUpReaction);
    if !gyroscopic_torque && !spin_up_reaction {
        return Ok(None);
    }
    let needed_by = "gyroscopic torque or spin-up reaction";
    Ok(Some(SpinningRotors {
        propeller: propeller(vehicle, needed_by)?,
        inertia: vehicle.require_motor(needed_by)?.rotor_inertia,
        gyroscopic_torque,
        spin_up_reaction,
    }))
}

fn current_draw<R: Real>(vehicle: &Vehicle<R>) -> Result<CurrentDraw<R>, BuildError> {
    let motor = vehicle.require_motor("the phenomenon voltage-sag")?;
    Ok(CurrentDraw {
        velocity_constant: motor.velocity_constant,
        no_load_current: motor.no_load_current,
        full_voltage_duty: motor.full_voltage_duty,
        zero_thrust_offset: zero_thrust_offset(vehicle),
    })
}
