//! What a rotor and a supply need beyond their physics to make a model of the family.

use crate::BuildError;
use crate::vehicle::Vehicle;
use quad_math::Real;
use quad_rotor::{RotorModel, RotorOutput, Supply};

/// A rotor model with a place in the family.
pub trait FamilyRotor<R: Real>: RotorModel<R> + std::fmt::Debug + Send + Sync + 'static {
    /// The supply that goes with it.
    type Supply: FamilySupply<R>;

    /// The same rotor over `f64`, in which trims are solved.
    type OverF64: FamilyRotor<f64>;

    /// How messages name the quadrotor that has it.
    const NAME: &'static str;

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

    /// Natural sizes of the state's numbers, in their order and units, from the state and the output in hover.
    fn state_scales(hover: &Self::State, output: &RotorOutput<R>) -> Vec<R>;

    /// An upper bound of the rotor's fastest pole about hover, rad/s; zero without states.
    fn fastest_pole(&self, hover: &Self::State) -> R;
}

/// A supply whose charge can be carried over to another level.
pub trait FamilySupply<R: Real>: Supply<R> + Copy + std::fmt::Debug + Send + Sync + 'static {
    /// Whether it is a battery, which remembers the charge drawn from it.
    const IS_BATTERY: bool;

    /// Charge drawn, Ah; `None` if it remembers none.
    fn charge_drawn(state: &Self::State) -> Option<R>;

    /// The state with this charge drawn, Ah; full without a number.
    fn with_charge_drawn(charge_drawn: Option<R>) -> Self::State;

    /// Natural sizes of the state's numbers, in their order and units.
    fn state_scales() -> Vec<R>;
}
