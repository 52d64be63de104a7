//! Level 1: the rigid body linearised about hover at the present heading, with ideal rotors.
//!
//! ```text
//! ẍ = −g (θ cos ψ + φ sin ψ)      φ̈ = (I⁻¹ M)_x
//! ÿ = −g (θ sin ψ − φ cos ψ)      θ̈ = (I⁻¹ M)_y
//! z̈ = g − K_T u_col / m           ψ̈ = (I⁻¹ M)_z
//! M = [L K_T u_lat, L K_T u_long, K_Q u_yaw]
//! ```
//!
//! Linear at a fixed heading; the heading itself may turn (this project's choice, so that the level can
//! fly a mission that turns), while its rate is not coupled into the tilt. Valid for small roll and
//! pitch, thrust near weight and slow turns. Source: thesis chapters 3.3.3 and 5.3.1.

use crate::model::RotorSnapshot;
use crate::quadrotor::{CommandLimits, RotorSet};
use crate::trim::Trim;
use crate::{
    BuildError, Capabilities, Flight, Hover, Input, Kick, Phenomenon, PhenomenonSet, QuadrotorModel,
    RigidBody, RigidBodyState, Snapshot, Vehicle,
};
use nalgebra::Vector3;
use quad_kinematics::{EulerAngles, EulerRates};
use quad_math::{Flat, Rate, RateOf, Real, State, System};
use quad_rotor::{ConstantVoltage, IdealRotor, RotorInput, RotorModel, RotorOutput};

/// The level 1 model.
#[derive(Clone, Debug, PartialEq)]
pub struct Level1<R: Real> {
    /// Mass properties and gravity.
    pub body: RigidBody<R>,
    /// The rotors.
    pub rotor_set: RotorSet<R, IdealRotor<R>, ConstantVoltage<R>>,
    phenomena: PhenomenonSet,
    hover_commands: [R; 4],
}

/// State of level 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearState<R: Real> {
    /// Position in W, m.
    pub position: Vector3<R>,
    /// Velocity in W, m/s.
    pub velocity: Vector3<R>,
    /// Attitude, rad.
    pub attitude: EulerAngles<R>,
    /// Rates of the Euler angles, rad/s; to first order the body rates.
    pub attitude_rates: EulerRates<R>,
}

/// Rate of [`LinearState`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearRate<R: Real> {
    /// ṙ in W, m/s.
    pub position: Vector3<R>,
    /// v̇ in W, m/s².
    pub velocity: Vector3<R>,
    /// η̇, rad/s.
    pub attitude: EulerRates<R>,
    /// η̈ = `[φ̈, θ̈, ψ̈]`, rad/s².
    pub attitude_rates: Vector3<R>,
}

impl<R: Real> Level1<R> {
    fn rotor_outputs(&self, input: &Input<R>) -> [RotorOutput<R>; 4] {
        let set = &self.rotor_set;
        let commands = set.limited(&input.commands);
        std::array::from_fn(|i| {
            set.rotors[i].output(
                &(),
                &RotorInput {
                    command: commands[i],
                    voltage: set.supply.voltage,
                },
            )
        })
    }
}

impl<R: Real> Level1<R> {
    /// Specific force at the centre of mass, `f = R_BW (v̇_W − g e_z)` along B, m/s², with the level's own acceleration:
    /// what an ideal accelerometer there reads, `[0, 0, −g]` in hover. To first order in the tilt it lies along z_B.
    pub fn specific_force(&self, state: &LinearState<R>, input: &Input<R>) -> Vector3<R> {
        let mut felt = self.derivative(state, input).velocity;
        felt.z -= self.body.gravity;
        state.attitude.rotation().matrix.transpose() * felt
    }
}

impl<R: Real> System<R> for Level1<R> {
    type State = LinearState<R>;
    type Input = Input<R>;

    #[inline(always)]
    fn derivative(&self, state: &LinearState<R>, input: &Input<R>) -> RateOf<R, Self> {
        let wrench = self.rotor_set.geometry.wrench(&self.rotor_outputs(input));
        let EulerAngles {
            roll: phi,
            pitch: theta,
            yaw: psi,
        } = state.attitude;
        let (s_psi, c_psi) = psi.simd_sin_cos();
        let g = self.body.gravity;
        LinearRate {
            position: state.velocity,
            velocity: Vector3::new(
                -g * (theta * c_psi + phi * s_psi),
                -g * (theta * s_psi - phi * c_psi),
                g + wrench.force.z / self.body.mass,
            ),
            attitude: state.attitude_rates,
            attitude_rates: self.body.inertia_inverse * wrench.moment,
        }
    }
}

impl<R: Real> QuadrotorModel<R> for Level1<R> {
    const NAME: &'static str = "level 1";

    const CAPABILITIES: Capabilities = Capabilities {
        non_linear_rigid_body: false,
        separate_spin_up: false,
        feels_voltage: false,
        has_battery: false,
    };

    fn trim(vehicle: &Vehicle, phenomena: &PhenomenonSet) -> Result<Trim, BuildError> {
        BuildError::check_phenomena(Self::NAME, phenomena, Self::CAPABILITIES)?;
        let is_limited = phenomena.contains(Phenomenon::InputLimits);
        RotorSet::<f64, IdealRotor<f64>, ConstantVoltage<f64>>::linear(vehicle, None).trim(
            vehicle,
            Self::NAME,
            is_limited,
            vehicle.weight(),
        )
    }

    fn build_trimmed(
        parameters: &Vehicle<R>,
        phenomena: &PhenomenonSet,
        trim: &Trim,
    ) -> Result<Self, BuildError> {
        BuildError::check_phenomena(Self::NAME, phenomena, Self::CAPABILITIES)?;
        let limits = phenomena
            .contains(Phenomenon::InputLimits)
            .then(|| CommandLimits::with(parameters));
        Ok(Self {
            body: RigidBody::with(parameters),
            rotor_set: RotorSet::<R, IdealRotor<R>, ConstantVoltage<R>>::linear(parameters, limits),
            phenomena: phenomena.clone(),
            hover_commands: trim.commands.map(quad_math::constant),
        })
    }

    fn flight(&self, state: &LinearState<R>) -> Flight<R> {
        Flight {
            position: state.position,
            velocity: state.velocity,
            rotation: state.attitude.rotation(),
            attitude: state.attitude,
            body_rates: state.attitude.body_rates(&state.attitude_rates),
            thrusts: None,
        }
    }

    fn snapshot(&self, state: &LinearState<R>, input: &Input<R>) -> Snapshot<R> {
        let still = RotorOutput {
            thrust: R::zero(),
            torque: R::zero(),
        };
        Snapshot {
            body: RigidBodyState {
                position: state.position,
                velocity: state.attitude.rotation().matrix.transpose() * state.velocity,
                attitude: state.attitude.quaternion(),
                body_rates: state.attitude.body_rates(&state.attitude_rates),
            },
            rotors: self
                .rotor_outputs(input)
                .map(|output| RotorSnapshot { output, rate: still }),
            charge_drawn: None,
        }
    }

    fn adopt(&self, snapshot: &Snapshot<R>, _input: &Input<R>) -> LinearState<R> {
        let body = &snapshot.body;
        let attitude = body.attitude.euler_angles();
        LinearState {
            position: body.position,
            velocity: body.attitude.rotate(&body.velocity),
            attitude,
            attitude_rates: attitude.rates(&body.body_rates),
        }
    }

    fn kicked(&self, state: &LinearState<R>, kick: &Kick<R>) -> LinearState<R> {
        LinearState {
            velocity: state.velocity + kick.velocity,
            attitude_rates: state
                .attitude_rates
                .add_scaled(R::one(), &state.attitude.rates(&kick.body_rates)),
            ..*state
        }
    }

    fn hover(&self, position: Vector3<R>, yaw: R) -> Hover<LinearState<R>, R> {
        let state = LinearState {
            position,
            velocity: Vector3::zeros(),
            attitude: EulerAngles::level(yaw),
            attitude_rates: EulerRates::zero(),
        };
        Hover {
            state,
            input: Input::still_air(self.hover_commands),
        }
    }

    fn phenomena(&self) -> &PhenomenonSet {
        &self.phenomena
    }

    fn rigid_body(_state: &mut LinearState<R>) -> Option<&mut RigidBodyState<R>> {
        None
    }

    fn own_scales(&self) -> Vec<R> {
        Vec::new()
    }

    fn fastest_pole(&self) -> R {
        R::zero()
    }
}

impl<R: Real> State<R> for LinearState<R> {
    type Rate = LinearRate<R>;

    #[inline(always)]
    fn advanced(&self, h: R, rate: &LinearRate<R>) -> Self {
        Self {
            position: self.position + rate.position * h,
            velocity: self.velocity + rate.velocity * h,
            attitude: self.attitude.advanced(h, &rate.attitude),
            attitude_rates: self
                .attitude_rates
                .add_scaled(h, &EulerRates::from_vector(&rate.attitude_rates)),
        }
    }
}

impl<R: Real> Rate<R> for LinearRate<R> {
    #[inline(always)]
    fn zero() -> Self {
        let o = Vector3::zeros();
        Self {
            position: o,
            velocity: o,
            attitude: EulerRates::zero(),
            attitude_rates: o,
        }
    }

    #[inline(always)]
    fn add_scaled(&self, h: R, other: &Self) -> Self {
        Self {
            position: self.position + other.position * h,
            velocity: self.velocity + other.velocity * h,
            attitude: self.attitude.add_scaled(h, &other.attitude),
            attitude_rates: self.attitude_rates + other.attitude_rates * h,
        }
    }
}

impl<R: Real> Flat<R> for LinearState<R> {
    const LEN: usize = 12;

    #[inline(always)]
    fn write(&self, out: &mut [R]) {
        self.position.write(out);
        self.velocity.write(&mut out[3..]);
        self.attitude.write(&mut out[6..]);
        self.attitude_rates.write(&mut out[9..]);
    }

    #[inline(always)]
    fn read(values: &[R]) -> Self {
        Self {
            position: Vector3::read(values),
            velocity: Vector3::read(&values[3..]),
            attitude: EulerAngles::read(&values[6..]),
            attitude_rates: EulerRates::read(&values[9..]),
        }
    }
}

impl<R: Real> Flat<R> for LinearRate<R> {
    const LEN: usize = 12;

    #[inline(always)]
    fn write(&self, out: &mut [R]) {
        self.position.write(out);
        self.velocity.write(&mut out[3..]);
        self.attitude.write(&mut out[6..]);
        self.attitude_rates.write(&mut out[9..]);
    }

    #[inline(always)]
    fn read(values: &[R]) -> Self {
        Self {
            position: Vector3::read(values),
            velocity: Vector3::read(&values[3..]),
            attitude: EulerRates::read(&values[6..]),
            attitude_rates: Vector3::read(&values[9..]),
        }
    }
}
