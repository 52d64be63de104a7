//! From a vehicle's parameters to the models of levels 2 to 5 and the mechanistic vehicle.

mod rotors;

use crate::quadrotor::{CommandLimits, CurrentDraw, Quadrotor, RotorSet, SpinningRotors};
use crate::vehicle::Vehicle;
use crate::{
    Blockage, BuildError, Capabilities, Drag, GroundEffect, Level, ModelName, Phenomenon, PhenomenonSet,
    RigidBody, RotorGeometry,
};
use nalgebra::Matrix3;
use quad_math::{Real, constant};
use quad_rotor::{Battery, BatteryState, ConstantVoltage, IdealRotor, RotorModel, SpinUp, Supply};
use rotors::{ideal, propeller, stiff, zero_thrust_offset};

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
