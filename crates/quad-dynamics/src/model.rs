//! What every model of the family offers: the trait, its inputs, its outputs, its levels.

use crate::{BuildError, Kick, PhenomenonSet, RigidBodyState, Vehicle};
use nalgebra::Vector3;
use quad_kinematics::{Body, EulerAngles, Rotation, World};
use quad_math::{Flat, Real, State, System};
use quad_rotor::RotorOutput;
use serde::{Deserialize, Serialize};
use std::fmt;

/// A level of resolution of the family. In files: the number 1 to 5.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(try_from = "u8", into = "u8")]
pub enum Level {
    /// Linear: the rigid body linearised about hover at the present heading, ideal rotors.
    One,
    /// Non-linear rigid body, ideal rotors.
    Two,
    /// As 2 with first-order rotors.
    Three,
    /// As 2 with identified linear rotors, drag and gyroscopic torque.
    Four,
    /// As 4 with identified non-linear rotors, limits and battery voltage.
    Five,
}

impl Level {
    /// All levels, lowest first.
    pub const ALL: [Self; 5] = [Self::One, Self::Two, Self::Three, Self::Four, Self::Five];

    /// The number, 1 to 5.
    pub const fn number(self) -> u8 {
        match self {
            Self::One => 1,
            Self::Two => 2,
            Self::Three => 3,
            Self::Four => 4,
            Self::Five => 5,
        }
    }

    /// The phenomena that belong to the level unless told otherwise.
    pub fn phenomena(self) -> PhenomenonSet {
        use crate::Phenomenon::{Drag, GyroscopicTorque, InputLimits, VoltageSag};
        match self {
            Self::One | Self::Two | Self::Three => PhenomenonSet::none(),
            Self::Four => [Drag, GyroscopicTorque].into_iter().collect(),
            Self::Five => [Drag, GyroscopicTorque, InputLimits, VoltageSag]
                .into_iter()
                .collect(),
        }
    }
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "level {}", self.number())
    }
}

/// A level that is not 1 to 5.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no level {number}: the family has levels 1 to 5")]
pub struct NoSuchLevel {
    /// The number asked for.
    pub number: u8,
}

impl TryFrom<u8> for Level {
    type Error = NoSuchLevel;

    fn try_from(number: u8) -> Result<Self, NoSuchLevel> {
        Self::ALL
            .into_iter()
            .find(|l| l.number() == number)
            .ok_or(NoSuchLevel { number })
    }
}

impl From<Level> for u8 {
    fn from(level: Level) -> Self {
        level.number()
    }
}

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
    /// Charge drawn from the battery, Ah; zero for levels without a battery.
    pub charge_drawn: R,
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
    /// The level; `None` for the mechanistic vehicle, which stands outside the family as its 'truth'.
    const LEVEL: Option<Level>;

    /// The model of a vehicle with these phenomena switched on.
    ///
    /// # Errors
    /// If the vehicle lacks a group of parameters that the model needs, if a phenomenon's prerequisite
    /// is not met, or if the vehicle can't hover.
    fn build(vehicle: &Vehicle, phenomena: &PhenomenonSet) -> Result<Self, BuildError> {
        Self::build_with(vehicle, &vehicle.map(quad_math::constant), phenomena)
    }

    /// As [`QuadrotorModel::build`], with the vehicle's numbers over the model's scalar: the same ones, with derivatives.
    /// The commands of hover are those of `vehicle`, constants.
    ///
    /// # Errors
    /// As [`QuadrotorModel::build`].
    fn build_with(
        vehicle: &Vehicle,
        parameters: &Vehicle<R>,
        phenomena: &PhenomenonSet,
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
}
