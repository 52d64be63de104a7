//! What every rotor model offers to the airframe that carries it.

use crate::Propeller;
use quad_math::{Flat, Real, State};

/// What drives a rotor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotorInput<R: Real> {
    /// Command `u = ū − ū_0`: offset of the duty from zero thrust.
    pub command: R,
    /// Battery voltage `V_b`, V; the models of levels 1 to 4 do not look at it.
    pub voltage: R,
}

/// What a rotor gives to the airframe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotorOutput<R: Real> {
    /// Thrust T of one rotor, N, along `−z_B`, positive up.
    pub thrust: R,
    /// Reaction torque Q of one rotor, N m, positive against its spin.
    pub torque: R,
}

/// How a rotor model stands to the reaction of spinning up, `I_R Ω̇`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpinUp {
    /// The model has no rotor dynamics, so no spin acceleration is defined.
    Undefined,
    /// The torque is aerodynamic only: the reaction may be added to it.
    Separate,
    /// The torque is the reaction that a bench measures: adding it again would count it twice.
    InTorque,
}

/// A model of one rotor: how thrust and torque follow the command.
pub trait RotorModel<R: Real>: Copy {
    /// The rotor's state; `()` if it has none.
    type State: State<R, Rate: Flat<R>> + Flat<R>;

    /// What the torque of this model contains.
    const SPIN_UP: SpinUp;

    /// Thrust and torque.
    fn output(&self, state: &Self::State, input: &RotorInput<R>) -> RotorOutput<R>;

    /// Rate of the rotor's state.
    fn derivative(&self, state: &Self::State, input: &RotorInput<R>) -> <Self::State as State<R>>::Rate;

    /// The state at rest under a constant input.
    fn equilibrium(&self, input: &RotorInput<R>) -> Self::State;

    /// The command u that gives a steady thrust, N, at battery voltage, V.
    fn command_for_thrust(&self, thrust: R, voltage: R) -> R;

    /// Rotor speed Ω, rad/s; by the static propeller law where the model has no speed of its own.
    #[inline(always)]
    fn speed(&self, _state: &Self::State, thrust: R, propeller: &Propeller<R>) -> R {
        propeller.speed_for_thrust(thrust)
    }

    /// Rates of thrust Ṫ, N/s, and torque Q̇, N m/s; zero where the model has no rotor dynamics.
    fn output_rate(&self, state: &Self::State, input: &RotorInput<R>) -> RotorOutput<R>;

    /// The state that gives this thrust and torque, changing at these rates (N/s, N m/s).
    ///
    /// Used to change the level of a flying vehicle without a jump in what acts on the airframe. A model
    /// with fewer states honours what it can, thrust first.
    fn state_for_output(
        &self,
        output: &RotorOutput<R>,
        rate: &RotorOutput<R>,
        input: &RotorInput<R>,
    ) -> Self::State;
}
