//! c3: the inversion of level 3.

use super::{EulerKinematics, horizontal_demand, tilt_cosine, tilt_errors};
use crate::controller::{Allocation, Control, Controller, ControllerError, Demand, limited, wrapped};
use crate::law::{AnyController, ControlLaw, LoopDesign};
use crate::{Gains, InCharge, Reference, Settings, TiltLaw};
use nalgebra::Vector3;
use quad_dynamics::{CommandLimits, Flight, Level, RigidBody, Vehicle};
use quad_math::{Flat, Real, constant};

/// Controller c3: the non-linear rigid body and the rotors' first-order lag inverted.
///
/// ```text
/// z⃛  = v_z:  Ṫ = −(m v_z + T ċ) / c,  c = cos φ cos θ, ċ = R_31 q − R_32 p
/// η⃛  = v_η:  ω̈ = W v_η + 2 Ẇ η̈ + Ẅ η̇,  Ṁ = I ω̈ + ω̇ × I ω + ω × I ω̇
/// u_i = (T_i + Ṫ_i / ω_R) / K_T
/// ```
///
/// Relative degree 3 in z, φ, θ, ψ: a third-order loop each. The thrusts `T_i` are the model's where it
/// offers them (level 3); elsewhere the controller runs its own first-order rotor, driven by its own
/// commands, as an observer. Saturates where the inversion is singular, as [`super::C2`].
/// Source: thesis chapter 6.3.3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct C3<R: Real> {
    /// Loop gains.
    pub gains: Gains<R>,
    /// What it believes of the rigid body.
    pub body: RigidBody<R>,
    /// What it believes of the rotors.
    pub allocation: Allocation<R>,
    /// What it believes of the rotors' bandwidth ω_R, rad/s.
    pub bandwidth: R,
    /// Limits on its commands; `None` is off.
    pub limits: Option<CommandLimits<R>>,
}

/// The thrusts that c3 believes in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObserverState<R: Real> {
    /// Thrust of each rotor, N.
    pub thrusts: [R; 4],
}

/// What c3 knows of the motion beyond what it is shown.
struct Motion<R: Real> {
    kinematics: EulerKinematics<R>,
    /// Thrust and moments now.
    now: Demand<R>,
    /// ω̇, rad/s².
    angular_acceleration: Vector3<R>,
    /// η̈, rad/s².
    euler_accelerations: Vector3<R>,
    /// z̈, m/s².
    vertical_acceleration: R,
}

impl<R: Real> C3<R> {
    /// The controller of a vehicle, without limits on its commands.
    ///
    /// # Errors
    /// A wrong setting; a singular control matrix.
    pub fn new(vehicle: &Vehicle, settings: &Settings) -> Result<Self, ControllerError> {
        Ok(Self {
            gains: settings.gains()?,
            body: RigidBody::of(vehicle),
            allocation: Allocation::of(vehicle)?,
            bandwidth: constant(vehicle.linear_rotor.bandwidth),
            limits: None,
        })
    }

    /// Commands u that give `z⃛ = v_z`, m/s³, and `η⃛ = v_η`, rad/s³, on level 3 with these thrusts, N.
    pub fn invert(&self, flight: &Flight<R>, thrusts: &[R; 4], v_z: R, v_eta: &Vector3<R>) -> [R; 4] {
        self.commands(&self.motion(flight, thrusts), flight, thrusts, v_z, v_eta)
    }

    #[inline(always)]
    fn motion(&self, flight: &Flight<R>, thrusts: &[R; 4]) -> Motion<R> {
        let kinematics = EulerKinematics::of(flight);
        let now = self.allocation.demand(thrusts);
        let angular_acceleration = self.body.angular_acceleration(&flight.body_rates, &now.moment);
        let bias = kinematics.first_derivative() * kinematics.rates;
        Motion {
            euler_accelerations: kinematics.euler_rates(&(angular_acceleration - bias)),
            vertical_acceleration: self.body.gravity
                - now.thrust * flight.rotation.matrix.m33 / self.body.mass,
            kinematics,
            now,
            angular_acceleration,
        }
    }

    #[inline(always)]
    fn commands(
        &self,
        motion: &Motion<R>,
        flight: &Flight<R>,
        thrusts: &[R; 4],
        v_z: R,
        v_eta: &Vector3<R>,
    ) -> [R; 4] {
        let (w, w_dot) = (&flight.body_rates, &motion.angular_acceleration);
        let (r, k, inertia) = (&flight.rotation.matrix, &motion.kinematics, &self.body.inertia);
        let tilt_rate = r.m31 * w.y - r.m32 * w.x;
        let w_ddot = k.body_rates(v_eta)
            + k.first_derivative() * motion.euler_accelerations * constant::<R>(2.0)
            + k.second_derivative(&motion.euler_accelerations) * k.rates;
        let rate = Demand {
            thrust: -(self.body.mass * v_z + motion.now.thrust * tilt_rate) / tilt_cosine(flight),
            moment: inertia * w_ddot + w_dot.cross(&(inertia * w)) + w.cross(&(inertia * w_dot)),
        };
        let thrust_rates = self.allocation.thrusts(&rate);
        let (lead, per_thrust) = (R::one() / self.bandwidth, R::one() / self.allocation.thrust_gain);
        std::array::from_fn(|i| (thrusts[i] + thrust_rates[i] * lead) * per_thrust)
    }

    /// Commands u, before limits, for the thrusts that the controller believes in.
    #[inline(always)]
    fn demand(&self, flight: &Flight<R>, reference: &Reference<R>, thrusts: &[R; 4]) -> [R; 4] {
        let (flat, ff, g) = (&reference.flat, &reference.attitude, self.body.gravity);
        let motion = self.motion(flight, thrusts);
        let v_z = self.gains.height.third_order(
            flat.position.z - flight.position.z,
            flat.velocity.z - flight.velocity.z,
            flat.acceleration.z - motion.vertical_acceleration,
            flat.jerk.z,
        );
        let horizontal = horizontal_demand(&self.gains, flight, reference);
        let [roll_error, pitch_error] = tilt_errors(horizontal, g - motion.vertical_acceleration, flight, g);
        let rates = &motion.kinematics.rates;
        let errors = Vector3::new(roll_error, pitch_error, wrapped(flat.yaw - flight.attitude.yaw));
        let gains = [&self.gains.attitude, &self.gains.attitude, &self.gains.yaw];
        let v_eta = Vector3::from_fn(|i, _| {
            gains[i].third_order(
                errors[i],
                ff.rates[i] - rates[i],
                ff.accelerations[i] - motion.euler_accelerations[i],
                ff.jerks[i],
            )
        });
        self.commands(&motion, flight, thrusts, v_z, &v_eta)
    }
}

impl<R: Real> Controller<R> for C3<R> {
    type Memory = ObserverState<R>;
    const LEVEL: Level = Level::Three;

    /// With the thrusts that the flight really had, not with those of the last call.
    fn resumed(&self, memory: &ObserverState<R>, before: &Flight<R>) -> ObserverState<R> {
        ObserverState {
            thrusts: before.thrusts.unwrap_or(memory.thrusts),
        }
    }

    fn initial_memory(&self) -> ObserverState<R> {
        let weight = self.body.mass * self.body.gravity;
        let hover = Demand {
            thrust: weight,
            moment: Vector3::zeros(),
        };
        ObserverState {
            thrusts: self.allocation.thrusts(&hover),
        }
    }

    #[inline(always)]
    fn control(
        &self,
        memory: &ObserverState<R>,
        flight: &Flight<R>,
        reference: &Reference<R>,
        dt: R,
    ) -> Control<R, ObserverState<R>> {
        let thrusts = flight.thrusts.unwrap_or(memory.thrusts);
        let commands = limited(self.limits.as_ref(), self.demand(flight, reference, &thrusts));
        if flight.thrusts.is_some() {
            // Nothing to observe: the next call is shown the thrusts again.
            return Control {
                commands,
                memory: ObserverState { thrusts },
            };
        }
        // The first-order rotor under a held command, solved exactly over the step.
        let keep = (-self.bandwidth * dt).simd_exp();
        let thrusts = std::array::from_fn(|i| {
            let steady = self.allocation.thrust_gain * commands[i];
            steady + (thrusts[i] - steady) * keep
        });
        Control {
            commands,
            memory: ObserverState { thrusts },
        }
    }
}

impl<R: Real> ControlLaw<R> for C3<R> {
    const TILT_LAW: TiltLaw = TiltLaw::Exact;
    const INVERTS: bool = true;

    fn design(vehicle: &Vehicle, design: &LoopDesign) -> Result<Self, ControllerError> {
        Self::new(vehicle, &design.inversion)
    }

    fn with_limits(self, limits: Option<CommandLimits<R>>) -> Self {
        Self { limits, ..self }
    }

    fn any(in_charge: InCharge<R, Self>) -> AnyController<R> {
        AnyController::C3(in_charge)
    }
}

impl<R: Real> Flat<R> for ObserverState<R> {
    const LEN: usize = 4;

    fn write(&self, out: &mut [R]) {
        out[..4].copy_from_slice(&self.thrusts);
    }

    fn read(values: &[R]) -> Self {
        Self {
            thrusts: [values[0], values[1], values[2], values[3]],
        }
    }
}
