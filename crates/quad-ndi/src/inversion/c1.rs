//! c1: the inversion of level 1.

use super::{Heading, horizontal_demand};
use crate::controller::{Allocation, Control, Controller, ControllerError, Demand, limited, wrapped};
use crate::law::{AnyController, ControlLaw, LoopDesign};
use crate::{Gains, InCharge, Reference, Settings, TiltLaw};
use nalgebra::Vector3;
use quad_dynamics::{CommandLimits, Flight, Level, RigidBody, Vehicle};
use quad_math::Real;

/// Controller c1: small angles, decoupled channels, ideal rotors.
///
/// ```text
/// u_col  = m (g − v_z) / K_T                       v_z, v_ψ: height and yaw loops
/// θ_des  = −(v_x cos ψ + v_y sin ψ) / g            v_x, v_y: position loop
/// φ_des  = −(v_x sin ψ − v_y cos ψ) / g
/// M      = I [v_φ, v_θ, v_ψ]                       v_φ, v_θ: attitude loop
/// ```
///
/// Relative degree 2 in z and ψ, 4 in x and y. Exact on level 1 to first order in tilt at a steady heading: it takes
/// body rates for rates of the Euler angles, and while a tilted vehicle turns they differ by `ψ̇ θ` and `ψ̇ φ`.
/// The demanded tilt is not limited.
/// Source: thesis chapter 6.3.1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct C1<R: Real> {
    /// Loop gains.
    pub gains: Gains<R>,
    /// What it believes of the rigid body.
    pub body: RigidBody<R>,
    /// What it believes of the rotors.
    pub allocation: Allocation<R>,
    /// Limits on its commands; `None` is off.
    pub limits: Option<CommandLimits<R>>,
}

impl<R: Real> C1<R> {
    /// The controller of a vehicle, without limits on its commands.
    ///
    /// # Errors
    /// A wrong setting; a singular control matrix.
    pub fn new(vehicle: &Vehicle, settings: &Settings) -> Result<Self, ControllerError> {
        Ok(Self {
            gains: settings.gains()?,
            body: RigidBody::of(vehicle),
            allocation: Allocation::of(vehicle)?,
            limits: None,
        })
    }

    /// Thrust and moments that give `z̈ = v_z`, m/s², and `η̈ = v_η`, rad/s², on level 1.
    #[inline(always)]
    pub fn invert(&self, v_z: R, v_eta: &Vector3<R>) -> Demand<R> {
        Demand {
            thrust: self.body.mass * (self.body.gravity - v_z),
            moment: self.body.inertia * v_eta,
        }
    }

    /// Thrust and moments that the controller demands.
    #[inline(always)]
    pub fn demand(&self, flight: &Flight<R>, reference: &Reference<R>) -> Demand<R> {
        let (flat, ff, g) = (&reference.flat, &reference.attitude, self.body.gravity);
        let v_z = self.gains.height.second_order(
            flat.position.z - flight.position.z,
            flat.velocity.z - flight.velocity.z,
            flat.acceleration.z,
        );
        let [v_x, v_y] = horizontal_demand(&self.gains, flight, reference);
        let heading = Heading::of(flight);
        let pitch = -(v_x * heading.cos + v_y * heading.sin) / g;
        let roll = -(v_x * heading.sin - v_y * heading.cos) / g;
        // To first order the body rates are the rates of the Euler angles.
        let (eta, rates) = (&flight.attitude, &flight.body_rates);
        let tilt_loop = &self.gains.attitude;
        let v_eta = Vector3::new(
            tilt_loop.second_order(roll - eta.roll, ff.rates.x - rates.x, ff.accelerations.x),
            tilt_loop.second_order(pitch - eta.pitch, ff.rates.y - rates.y, ff.accelerations.y),
            self.gains.yaw.second_order(
                wrapped(flat.yaw - eta.yaw),
                flat.yaw_rate - rates.z,
                flat.yaw_acceleration,
            ),
        );
        self.invert(v_z, &v_eta)
    }
}

impl<R: Real> Controller<R> for C1<R> {
    type Memory = ();
    const LEVEL: Level = Level::One;

    fn initial_memory(&self) {}

    #[inline(always)]
    fn control(&self, (): &(), flight: &Flight<R>, reference: &Reference<R>, _dt: R) -> Control<R, ()> {
        let commands = self.allocation.commands(&self.demand(flight, reference));
        Control {
            commands: limited(self.limits.as_ref(), commands),
            memory: (),
        }
    }
}

impl<R: Real> ControlLaw<R> for C1<R> {
    const TILT_LAW: TiltLaw = TiltLaw::SmallAngle;
    const INVERTS: bool = true;

    fn design(vehicle: &Vehicle, design: &LoopDesign) -> Result<Self, ControllerError> {
        Self::new(vehicle, &design.inversion)
    }

    fn with_limits(self, limits: Option<CommandLimits<R>>) -> Self {
        Self { limits, ..self }
    }

    fn any(in_charge: InCharge<R, Self>) -> AnyController<R> {
        AnyController::C1(in_charge)
    }
}
