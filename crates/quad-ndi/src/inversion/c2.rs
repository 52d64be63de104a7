//! c2: the inversion of level 2.

use super::{EulerKinematics, horizontal_demand, moment_for, tilt_cosine, tilt_errors};
use crate::controller::{Allocation, Control, Controller, ControllerError, Demand, limited, wrapped};
use crate::law::{AnyController, ControlLaw, LoopDesign};
use crate::{Gains, InCharge, Reference, Settings, TiltLaw};
use nalgebra::Vector3;
use quad_dynamics::{CommandLimits, Flight, Level, RigidBody, Vehicle};
use quad_math::Real;

/// Controller c2: exact inversion of the non-linear rigid body with ideal rotors.
///
/// ```text
/// T      = m (g − v_z) / (cos φ cos θ)              height, exact at any tilt
/// θ_des, φ_des: the tilt whose thrust makes v_x, v_y at that height demand
/// ω̇      = W v_η + Ẇ η̇                              attitude and yaw loops, ω = W(η) η̇
/// M      = I ω̇ + ω × I ω                            gyroscopic coupling of the body cancelled
/// ```
///
/// Relative degree 2 in z, φ, θ, ψ. Saturates, documented, where the inversion is singular: the cosine of
/// tilt or pitch is held at 0.1 (84°), the upward specific force of the tilt demand at 0.1 g.
/// Source: thesis chapter 6.3.2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct C2<R: Real> {
    /// Loop gains.
    pub gains: Gains<R>,
    /// What it believes of the rigid body.
    pub body: RigidBody<R>,
    /// What it believes of the rotors.
    pub allocation: Allocation<R>,
    /// Limits on its commands; `None` is off.
    pub limits: Option<CommandLimits<R>>,
}

impl<R: Real> C2<R> {
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

    /// Thrust and moments that give `z̈ = v_z`, m/s², and `η̈ = v_η`, rad/s², on level 2.
    #[inline(always)]
    pub fn invert(&self, flight: &Flight<R>, v_z: R, v_eta: &Vector3<R>) -> Demand<R> {
        let kinematics = EulerKinematics::of(flight);
        self.invert_with(&kinematics, flight, v_z, v_eta)
    }

    #[inline(always)]
    fn invert_with(
        &self,
        kinematics: &EulerKinematics<R>,
        flight: &Flight<R>,
        v_z: R,
        v_eta: &Vector3<R>,
    ) -> Demand<R> {
        let acceleration = kinematics.body_rates(v_eta) + kinematics.first_derivative() * kinematics.rates;
        Demand {
            thrust: self.body.mass * (self.body.gravity - v_z) / tilt_cosine(flight),
            moment: moment_for(&self.body, &flight.body_rates, &acceleration),
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
        let horizontal = horizontal_demand(&self.gains, flight, reference);
        let [roll_error, pitch_error] = tilt_errors(horizontal, g - v_z, flight, g);
        let kinematics = EulerKinematics::of(flight);
        let rates = &kinematics.rates;
        let tilt_loop = &self.gains.attitude;
        let v_eta = Vector3::new(
            tilt_loop.second_order(roll_error, ff.rates.x - rates.x, ff.accelerations.x),
            tilt_loop.second_order(pitch_error, ff.rates.y - rates.y, ff.accelerations.y),
            self.gains.yaw.second_order(
                wrapped(flat.yaw - flight.attitude.yaw),
                flat.yaw_rate - rates.z,
                flat.yaw_acceleration,
            ),
        );
        self.invert_with(&kinematics, flight, v_z, &v_eta)
    }
}

impl<R: Real> Controller<R> for C2<R> {
    type Memory = ();
    const LEVEL: Level = Level::Two;

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

impl<R: Real> ControlLaw<R> for C2<R> {
    const TILT_LAW: TiltLaw = TiltLaw::Exact;
    const INVERTS: bool = true;

    fn design(vehicle: &Vehicle, design: &LoopDesign) -> Result<Self, ControllerError> {
        Self::new(vehicle, &design.inversion)
    }

    fn with_limits(self, limits: Option<CommandLimits<R>>) -> Self {
        Self { limits, ..self }
    }

    fn any(in_charge: InCharge<R, Self>) -> AnyController<R> {
        AnyController::C2(in_charge)
    }
}
