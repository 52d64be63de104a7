//! What every model of the family offers: the trait, its inputs and its outputs.

use crate::trim::Trim;
use crate::{BuildError, Capabilities, Kick, PhenomenonSet, RigidBodyState, Vehicle};
use nalgebra::Vector3;
use quad_kinematics::{Body, EulerAngles, Rotation, World};
use quad_math::{Flat, Real, State, System};
use quad_rotor::RotorOutput;

/// What drives a quadrotor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Input<R: Real> {
    /// Zeroed rotor commands `u_i = ū_i − ū_0`, dimensionless duty, in the order of the vehicle's rotors.
    pub commands: [R; 4],
    /// Velocity of the air in W, m/s. Felt through drag; models without it don't look.
    pub wind: Vector3<R>,
    /// Rotation of the air about the axes of W, rad/s: the vehicle's rates count from it. Felt through the damping of
    /// the rates; models without drag don't look.
    pub air_rates: Vector3<R>,
}

impl<R: Real> Input<R> {
    /// Commands in still air.
    #[inline(always)]
    pub fn still_air(commands: [R; 4]) -> Self {
        Self::in_wind(commands, Vector3::zeros())
    }

    /// Commands in a wind that does not turn, m/s in W.
    #[inline(always)]
    pub fn in_wind(commands: [R; 4], wind: Vector3<R>) -> Self {
        Self {
            commands,
            wind,
            air_rates: Vector3::zeros(),
        }
    }
}

/// What a controller, an estimator or another agent may see of a flying quadrotor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flight<R: Real> {
    /// Position of the centre of mass in W, m; height is `−z`.
    pub position: Vector3<R>,
    /// Velocity in W, m/s.
    pub velocity: Vector3<R>,
    /// The rotation matrix `R_WB`.
    pub rotation: Rotation<R, Body, World>,
    /// The same attitude as Euler angles, rad.
    pub attitude: EulerAngles<R>,
    /// Body rates `ω`, rad/s.
    pub body_rates: Vector3<R>,
    /// Thrust of each rotor, N, where the rotor model has it as its only state (level 3).
    pub thrusts: Option<[R; 4]>,
}

/// A rotor's output and its rate, for handing a flight from one level to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotorSnapshot<R: Real> {
    /// Thrust, N, and torque, N m.
    pub output: RotorOutput<R>,
    /// Their rates, N/s and N m/s.
    pub rate: RotorOutput<R>,
}

/// All that any level of the family can know of a flight: the common ground for changing the level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Snapshot<R: Real> {
    /// The rigid body.
    pub body: RigidBodyState<R>,
    /// The rotors.
    pub rotors: [RotorSnapshot<R>; 4],
    /// Charge drawn from the battery, Ah; `None` for levels without a battery, which adopt any.
    pub charge_drawn: Option<R>,
}

/// A state and an input at rest in the air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hover<X, R: Real> {
    /// The state.
    pub state: X,
    /// The input that holds it.
    pub input: Input<R>,
}

/// The state of a model.
pub type StateOf<R, M> = <M as System<R>>::State;

/// A quadrotor at some level of resolution.
///
/// Controllers, estimators and engines take any; choose the level by type with this trait or by value
/// with [`crate::AnyQuadrotor`]. A flight changes its level through a [`Snapshot`]:
/// *lift* is `upper.adopt(&lower.snapshot(x, u), u)`, *restrict* the same the other way round, and
/// `restrict(lift(x)) = x` between neighbours.
pub trait QuadrotorModel<R: Real>:
    System<R, Input = Input<R>, State: Flat<R> + State<R, Rate: Flat<R>>> + Sized
{
    /// How messages name the model: by its level, but for the mechanistic vehicle, which is outside the family as its 'truth'.
    const NAME: &'static str;

    /// What it brings along that phenomena may need.
    const CAPABILITIES: Capabilities;

    /// The model of a vehicle with these phenomena switched on.
    ///
    /// # Errors
    /// If the vehicle lacks a group of parameters that the model needs, if a phenomenon's prerequisite
    /// is not met, or if the vehicle can't hover.
    fn build(vehicle: &Vehicle, phenomena: &PhenomenonSet) -> Result<Self, BuildError> {
        let trim = Self::trim(vehicle, phenomena)?;
        Self::build_trimmed(&vehicle.map(quad_math::constant), phenomena, &trim)
    }

    /// The commands that hold a vehicle of this model in hover.
    ///
    /// # Errors
    /// As [`QuadrotorModel::build`].
    fn trim(vehicle: &Vehicle, phenomena: &PhenomenonSet) -> Result<Trim, BuildError>;

    /// The model of a vehicle whose numbers are over the model's scalar, with derivatives for instance. Its hover is held by
    /// the commands of the trim, which are constants.
    ///
    /// # Errors
    /// If the vehicle lacks a group of parameters that the model needs, or if a phenomenon's prerequisite is not met.
    fn build_trimmed(
        parameters: &Vehicle<R>,
        phenomena: &PhenomenonSet,
        trim: &Trim,
    ) -> Result<Self, BuildError>;

    /// What can be seen of the flight.
    fn flight(&self, state: &Self::State) -> Flight<R>;

    /// The flight in terms that every level understands.
    fn snapshot(&self, state: &Self::State, input: &Input<R>) -> Snapshot<R>;

    /// This level's state for a flight that another level flew until now.
    fn adopt(&self, snapshot: &Snapshot<R>, input: &Input<R>) -> Self::State;

    /// The state after a sudden change of velocity and body rates.
    fn kicked(&self, state: &Self::State, kick: &Kick<R>) -> Self::State;

    /// Level hover in still air at a position in W, m, heading ψ, rad; a battery is full.
    ///
    /// Trimmed out of ground effect: near the ground a model with [`crate::GroundEffect`] rises from it.
    fn hover(&self, position: Vector3<R>, yaw: R) -> Hover<Self::State, R>;

    /// The phenomena switched on.
    fn phenomena(&self) -> &PhenomenonSet;

    /// The rigid body in a state, where the state has one in body axes; `None` at level 1.
    fn rigid_body(state: &mut Self::State) -> Option<&mut RigidBodyState<R>>;

    /// Natural sizes of the states of rotors and supply, in their order and units: what they are in hover, or move by.
    fn own_scales(&self) -> Vec<R>;

    /// An upper bound of the fastest pole of its rotors about hover, rad/s; zero where they have no states.
    fn fastest_pole(&self) -> R;
}

/// A model together with the state it is in.
#[derive(Clone, Debug)]
pub struct InFlight<R: Real, M: QuadrotorModel<R>> {
    /// The model.
    pub model: M,
    /// Its state.
    pub state: StateOf<R, M>,
}

impl<R: Real, M: QuadrotorModel<R>> InFlight<R, M> {
    /// A vehicle in level hover at a position in W, m, heading ψ, rad.
    ///
    /// # Errors
    /// As [`QuadrotorModel::build`].
    pub fn hovering(
        vehicle: &Vehicle,
        phenomena: &PhenomenonSet,
        position: Vector3<R>,
        yaw: R,
    ) -> Result<Self, BuildError> {
        let model = M::build(vehicle, phenomena)?;
        let state = model.hover(position, yaw).state;
        Ok(Self { model, state })
    }
}
