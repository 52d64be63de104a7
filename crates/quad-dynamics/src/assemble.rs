//! From a vehicle's parameters to the models of levels 2 to 5 and the mechanistic vehicle.

mod rotors;

use crate::family::{FamilyRotor, FamilySupply};
use crate::quadrotor::{CommandLimits, CurrentDraw, Quadrotor, RotorSet, SpinningRotors};
use crate::trim::Trim;
use crate::vehicle::Vehicle;
use crate::{
    Blockage, BuildError, Drag, GroundEffect, Phenomenon, PhenomenonSet, QuadrotorModel, RigidBody,
    RotorGeometry,
};
use nalgebra::Matrix3;
use quad_math::{Real, constant};
use quad_rotor::{ConstantVoltage, IdealRotor};
use rotors::{ideal, propeller, stiff, zero_thrust_offset};

impl<R: Real> RigidBody<R> {
    /// The rigid body of a vehicle.
    pub fn of(vehicle: &Vehicle) -> Self {
        Self::with(&vehicle.map(constant))
    }

    /// The rigid body of a vehicle whose numbers are over this scalar.
    pub(crate) fn with(vehicle: &Vehicle<R>) -> Self {
        let airframe = &vehicle.airframe;
        Self {
            mass: airframe.mass,
            inertia: airframe.inertia,
            inertia_inverse: inverse(&airframe.inertia),
            gravity: vehicle.environment.gravity,
        }
    }
}

/// The inverse by cofactors, over any scalar. Not finite where the matrix is singular, which a validated inertia is not.
fn inverse<R: Real>(m: &Matrix3<R>) -> Matrix3<R> {
    let minor = |a: [usize; 2], b: [usize; 2]| m[(a[0], a[1])] * m[(b[0], b[1])];
    let cofactors = Matrix3::new(
        minor([1, 1], [2, 2]) - minor([2, 1], [1, 2]),
        minor([0, 2], [2, 1]) - minor([2, 2], [0, 1]),
        minor([0, 1], [1, 2]) - minor([1, 1], [0, 2]),
        -(minor([1, 0], [2, 2]) - minor([2, 0], [1, 2])),
        minor([0, 0], [2, 2]) - minor([2, 0], [0, 2]),
        minor([0, 2], [1, 0]) - minor([1, 2], [0, 0]),
        minor([1, 0], [2, 1]) - minor([2, 0], [1, 1]),
        minor([0, 1], [2, 0]) - minor([2, 1], [0, 0]),
        minor([0, 0], [1, 1]) - minor([1, 0], [0, 1]),
    );
    let determinant = m.m11 * cofactors.m11 + m.m12 * cofactors.m21 + m.m13 * cofactors.m31;
    cofactors.map(|cofactor| cofactor / determinant)
}

impl<R: Real> RotorGeometry<R> {
    /// Where the rotors of a vehicle sit, relative to its centre of mass.
    pub fn of(vehicle: &Vehicle) -> Self {
        Self::with(&vehicle.map(constant))
    }

    pub(crate) fn with(vehicle: &Vehicle<R>) -> Self {
        let hubs = vehicle.hubs();
        Self {
            forward: hubs.map(|hub| hub.x),
            right: hubs.map(|hub| hub.y),
            spin: vehicle.rotors.each_ref().map(|rotor| constant(rotor.spin.sign())),
        }
    }
}

impl<R: Real> CommandLimits<R> {
    /// The limits of a vehicle's commands u.
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

/// The trim of a quadrotor with this rotor.
pub(crate) fn trim<R: Real, M: FamilyRotor<R>>(
    vehicle: &Vehicle,
    phenomena: &PhenomenonSet,
) -> Result<Trim, BuildError> {
    let has = |phenomenon| phenomena.contains(phenomenon);
    BuildError::check_phenomena(M::NAME, phenomena, Quadrotor::<R, M, M::Supply>::CAPABILITIES)?;
    let rotors = rotor_set::<f64, M::OverF64>(vehicle, phenomena)?;
    let blockage = has(Phenomenon::Blockage)
        .then(|| Blockage::<f64>::of(vehicle))
        .transpose()?;
    let lift = vehicle.weight() / (1.0 - blockage.map_or(0.0, |b| b.share_in_hover()));
    rotors.trim(vehicle, M::NAME, has(Phenomenon::InputLimits), lift)
}

/// The model of a vehicle with this rotor.
pub(crate) fn quadrotor<R, M, S>(
    parameters: &Vehicle<R>,
    phenomena: &PhenomenonSet,
    trim: &Trim,
) -> Result<Quadrotor<R, M, S>, BuildError>
where
    R: Real,
    M: FamilyRotor<R, Supply = S>,
    S: FamilySupply<R>,
{
    let has = |phenomenon| phenomena.contains(phenomenon);
    BuildError::check_phenomena(M::NAME, phenomena, Quadrotor::<R, M, S>::CAPABILITIES)?;
    Ok(Quadrotor {
        body: RigidBody::with(parameters),
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
        hover_commands: trim.commands.map(constant),
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
    Ok(*vehicle.require_drag("the phenomenon drag")?)
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
