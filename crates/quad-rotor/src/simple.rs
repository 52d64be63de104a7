//! The ideal rotor (levels 1 and 2) and the first-order rotor (level 3).
//!
//! Ideal: `T = K_T u`, `Q = K_Q u`, at once. First order: `Ṫ = ω_R (K_T u − T)` and `Q = (K_Q/K_T) T`,
//! so thrust and torque share the bandwidth `ω_R` and one state is enough. Assumes a line through the
//! zero-thrust command; good near the operating range it was fitted on. Source: thesis chapters 3.5 and
//! 5.3 (the form), Quanser's model of the Qball-X4 (the first-order actuator).

use crate::{RotorInput, RotorModel, RotorOutput, SpinUp};
use quad_math::{Flat, Rate, Real, State};

/// The ideal rotor: `T = K_T u`, `Q = K_Q u`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IdealRotor<R: Real> {
    /// Thrust gain `K_T`, N per unit of command u.
    pub thrust_gain: R,
    /// Torque gain `K_Q`, N m per unit of command u.
    pub torque_gain: R,
}

impl<R: Real> RotorModel<R> for IdealRotor<R> {
    type State = ();
    const SPIN_UP: SpinUp = SpinUp::Undefined;

    #[inline(always)]
    fn output(&self, (): &(), input: &RotorInput<R>) -> RotorOutput<R> {
        RotorOutput {
            thrust: self.thrust_gain * input.command,
            torque: self.torque_gain * input.command,
        }
    }

    #[inline(always)]
    fn derivative(&self, (): &(), _input: &RotorInput<R>) {}

    fn equilibrium(&self, _input: &RotorInput<R>) {}

    #[inline(always)]
    fn command_for_thrust(&self, thrust: R, _voltage: R) -> R {
        thrust / self.thrust_gain
    }

    fn output_rate(&self, (): &(), _input: &RotorInput<R>) -> RotorOutput<R> {
        RotorOutput {
            thrust: R::zero(),
            torque: R::zero(),
        }
    }

    fn state_for_output(&self, _output: &RotorOutput<R>, _rate: &RotorOutput<R>, _input: &RotorInput<R>) {}
}

/// The first-order rotor: `Ṫ = ω_R (K_T u − T)`, `Q = (K_Q/K_T) T`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstOrderRotor<R: Real> {
    /// Thrust gain `K_T`, N per unit of command u.
    pub thrust_gain: R,
    /// Torque per thrust `K_Q / K_T`, m.
    pub torque_per_thrust: R,
    /// Bandwidth `ω_R`, rad/s.
    pub bandwidth: R,
}

/// State of the first-order rotor: its thrust.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThrustState<R: Real> {
    /// Thrust T, N, along `−z_B`.
    pub thrust: R,
}

/// Rate of [`ThrustState`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThrustRate<R: Real> {
    /// Ṫ, N/s.
    pub thrust: R,
}

impl<R: Real> RotorModel<R> for FirstOrderRotor<R> {
    type State = ThrustState<R>;
    const SPIN_UP: SpinUp = SpinUp::Separate;

    #[inline(always)]
    fn output(&self, state: &ThrustState<R>, _input: &RotorInput<R>) -> RotorOutput<R> {
        RotorOutput {
            thrust: state.thrust,
            torque: self.torque_per_thrust * state.thrust,
        }
    }

    #[inline(always)]
    fn derivative(&self, state: &ThrustState<R>, input: &RotorInput<R>) -> ThrustRate<R> {
        ThrustRate {
            thrust: self.bandwidth * (self.thrust_gain * input.command - state.thrust),
        }
    }

    fn equilibrium(&self, input: &RotorInput<R>) -> ThrustState<R> {
        ThrustState {
            thrust: self.thrust_gain * input.command,
        }
    }

    #[inline(always)]
    fn command_for_thrust(&self, thrust: R, _voltage: R) -> R {
        thrust / self.thrust_gain
    }

    #[inline(always)]
    fn output_rate(&self, state: &ThrustState<R>, input: &RotorInput<R>) -> RotorOutput<R> {
        let thrust = self.derivative(state, input).thrust;
        RotorOutput {
            thrust,
            torque: self.torque_per_thrust * thrust,
        }
    }

    fn state_for_output(
        &self,
        output: &RotorOutput<R>,
        _rate: &RotorOutput<R>,
        _input: &RotorInput<R>,
    ) -> ThrustState<R> {
        ThrustState {
            thrust: output.thrust,
        }
    }
}

impl<R: Real> State<R> for ThrustState<R> {
    type Rate = ThrustRate<R>;

    #[inline(always)]
    fn advanced(&self, h: R, rate: &ThrustRate<R>) -> Self {
        Self {
            thrust: self.thrust + rate.thrust * h,
        }
    }
}

impl<R: Real> Rate<R> for ThrustRate<R> {
    #[inline(always)]
    fn zero() -> Self {
        Self { thrust: R::zero() }
    }

    #[inline(always)]
    fn add_scaled(&self, h: R, other: &Self) -> Self {
        Self {
            thrust: self.thrust + other.thrust * h,
        }
    }
}

impl<R: Real> Flat<R> for ThrustState<R> {
    const LEN: usize = 1;

    #[inline(always)]
    fn write(&self, out: &mut [R]) {
        out[0] = self.thrust;
    }

    #[inline(always)]
    fn read(values: &[R]) -> Self {
        Self { thrust: values[0] }
    }
}

impl<R: Real> Flat<R> for ThrustRate<R> {
    const LEN: usize = 1;

    #[inline(always)]
    fn write(&self, out: &mut [R]) {
        out[0] = self.thrust;
    }

    #[inline(always)]
    fn read(values: &[R]) -> Self {
        Self { thrust: values[0] }
    }
}
