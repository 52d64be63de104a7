//! What every controller offers, and what they share: allocation, limits, tilt demands.

use crate::{Reference, SettingsError};
use nalgebra::{Matrix4, Vector4};
use quad_dynamics::{CommandLimits, Flight, Level, Vehicle};
pub(crate) use quad_math::wrapped;
use quad_math::{Flat, Real, constant};

/// A controller's answer: commands, and its memory for the next call.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Control<R: Real, Memory> {
    /// Zeroed rotor commands `u_i`, within the controller's limits if it has them.
    pub commands: [R; 4],
    /// The controller's memory after this call.
    pub memory: Memory,
}

/// A controller as a pure function: what it remembers goes in and comes out.
pub trait Controller<R: Real> {
    /// What it remembers from call to call; `()` for none.
    type Memory: Copy + std::fmt::Debug + Flat<R>;

    /// The lowest level of model that the controller makes sense on.
    const LEVEL: Level;

    /// The memory of a controller switched on in flight: at rest, carrying the vehicle's weight.
    fn initial_memory(&self) -> Self::Memory;

    /// The memory with which it continues when the model changes its level, from what was last seen of the flight before.
    fn resumed(&self, memory: &Self::Memory, _before: &Flight<R>) -> Self::Memory {
        *memory
    }

    /// Commands for the next `dt` seconds.
    fn control(
        &self,
        memory: &Self::Memory,
        flight: &Flight<R>,
        reference: &Reference<R>,
        dt: R,
    ) -> Control<R, Self::Memory>;
}

/// Why a controller can't be built or used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ControllerError {
    /// A setting is wrong.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// The rotors don't give thrust and three moments independently.
    #[error(
        "the allocation (control) matrix of {vehicle} is singular: its rotors can't produce thrust and three moments"
    )]
    SingularControlMatrix {
        /// The vehicle's name.
        vehicle: String,
    },
    /// The controller needs more than the model has.
    #[error(
        "a controller for {controller} can't fly a model of {model}: use a model of {controller} or higher, or a \
         controller of {model} or lower"
    )]
    ModelBelowController {
        /// The controller's level.
        controller: Level,
        /// The model's level.
        model: Level,
    },
}

/// Checks that a controller may fly a model: the model's level must not be below the controller's.
///
/// # Errors
/// [`ControllerError::ModelBelowController`].
pub fn check_pairing(controller: Level, model: Level) -> Result<(), ControllerError> {
    if model < controller {
        return Err(ControllerError::ModelBelowController { controller, model });
    }
    Ok(())
}

/// Total thrust and moments as a controller demands them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Demand<R: Real> {
    /// Total thrust, N, along `−z_B`.
    pub thrust: R,
    /// Moments about the body axes, N m.
    pub moment: nalgebra::Vector3<R>,
}

/// The map between rotor thrusts and `[T, M_x, M_y, M_z]`, with torque proportional to thrust.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Allocation<R: Real> {
    /// From the four thrusts, N, to `[T, M_x, M_y, M_z]`, N and N m: `diag(1, L, L, K_Q/K_T) C`.
    pub demand_from_thrusts: Matrix4<R>,
    /// Its inverse.
    pub thrusts_from_demand: Matrix4<R>,
    /// The control matrix C: pseudo-inputs `[u_col, u_lat, u_long, u_yaw]` from commands u.
    pub control_matrix: Matrix4<R>,
    /// Thrust gain `K_T`, N per unit of command u.
    pub thrust_gain: R,
}

impl<R: Real> Allocation<R> {
    /// The allocation of a vehicle.
    ///
    /// # Errors
    /// If its control matrix is singular.
    pub fn of(vehicle: &Vehicle) -> Result<Self, ControllerError> {
        let gains = &vehicle.linear_rotor;
        let arm = vehicle.airframe.arm_length;
        let scale = Vector4::new(1.0, arm, arm, gains.torque_gain / gains.thrust_gain);
        let matrix = Matrix4::from_diagonal(&scale) * vehicle.control_matrix();
        let inverse = matrix
            .try_inverse()
            .filter(|inverse| inverse.iter().all(|x| x.is_finite()))
            .ok_or_else(|| ControllerError::SingularControlMatrix {
                vehicle: vehicle.name.clone(),
            })?;
        Ok(Self {
            demand_from_thrusts: matrix.map(constant),
            thrusts_from_demand: inverse.map(constant),
            control_matrix: vehicle.control_matrix().map(constant),
            thrust_gain: constant(gains.thrust_gain),
        })
    }

    /// Rotor thrusts, N, that give the demand.
    #[inline(always)]
    pub fn thrusts(&self, demand: &Demand<R>) -> [R; 4] {
        let m = &demand.moment;
        (self.thrusts_from_demand * Vector4::new(demand.thrust, m.x, m.y, m.z)).into()
    }

    /// The demand that rotor thrusts, N, give.
    #[inline(always)]
    pub fn demand(&self, thrusts: &[R; 4]) -> Demand<R> {
        let d = self.demand_from_thrusts * Vector4::from(*thrusts);
        Demand {
            thrust: d.x,
            moment: nalgebra::Vector3::new(d.y, d.z, d.w),
        }
    }

    /// Commands u of ideal rotors that give the demand: `u_i = T_i / K_T`.
    #[inline(always)]
    pub fn commands(&self, demand: &Demand<R>) -> [R; 4] {
        let per_thrust = R::one() / self.thrust_gain;
        self.thrusts(demand).map(|thrust| thrust * per_thrust)
    }

    /// Pseudo-inputs `u* = C u = [u_col, u_lat, u_long, u_yaw]`.
    #[inline(always)]
    pub fn pseudo_inputs(&self, commands: &[R; 4]) -> [R; 4] {
        (self.control_matrix * Vector4::from(*commands)).into()
    }
}

/// The commands within the limits, if there are limits.
#[inline(always)]
pub(crate) fn limited<R: Real>(limits: Option<&CommandLimits<R>>, commands: [R; 4]) -> [R; 4] {
    match limits {
        Some(l) => commands.map(|u| u.simd_clamp(l.minimum, l.maximum)),
        None => commands,
    }
}
