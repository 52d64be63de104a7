//! The empirical rotors of levels 4 and 5: a static map behind identified transfer functions.
//!
//! ```text
//! T(s) = c_T2 / (s² + c_T1 s + c_T2) · T_∞(s)
//! Q(s) = (c_Q1 s + c_Q2) / (s² + c_Q3 s + c_Q4) · Q_∞(s),  c_Q2 = c_Q4
//! ```
//!
//! Both have unit gain at rest; the steady values come from the gains of the linear model (level 4,
//! `T_∞ = K_T u`) or from polynomials in `x = (ū − ū_min) V_b` (level 5, `T_∞ = k_1 x + k_2 x² + k_3 x³`;
//! `x` is proportional to the effective motor voltage). The torque is the reaction that a bench
//! measures: aerodynamic torque and spin-up together, which is where its zero comes from. Source: thesis
//! chapter 4.5.3 and tables 4.4 to 4.6 for the numbers of coefficients; the forms are this project's
//! choice. Valid over the range of commands and voltages that the coefficients were fitted on; beyond
//! its ends the polynomials continue as their tangents (kinks of the second derivative there), since a cubic soon
//! turns round and would make a rotor pull down.

use crate::{RotorInput, RotorModel, RotorOutput, SpinUp};
use quad_math::{Flat, Rate, Real, State, constant};

/// Denominators and zero of the thrust and torque responses.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RotorDynamics<R> {
    /// `c_T1`, 1/s.
    pub thrust_c1: R,
    /// `c_T2`, 1/s².
    pub thrust_c2: R,
    /// `c_Q1`, 1/s.
    pub torque_c1: R,
    /// `c_Q2`, 1/s²; equal to `c_Q4` for unit gain at rest.
    pub torque_c2: R,
    /// `c_Q3`, 1/s.
    pub torque_c3: R,
    /// `c_Q4`, 1/s².
    pub torque_c4: R,
}

/// State of an empirical rotor: thrust and torque with one memory each (observer canonical form).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ResponseState<R: Real> {
    /// Thrust T, N, along `−z_B`.
    pub thrust: R,
    /// Rate of thrust Ṫ, N/s.
    pub thrust_rate: R,
    /// Reaction torque Q, N m, against the spin.
    pub torque: R,
    /// The torque response's second state `b`, N m/s, with `Q̇ = −c_Q3 Q + b + c_Q1 Q_∞`.
    pub torque_memory: R,
}

/// Rate of [`ResponseState`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ResponseRate<R: Real> {
    /// Ṫ, N/s.
    pub thrust: R,
    /// T̈, N/s².
    pub thrust_rate: R,
    /// Q̇, N m/s.
    pub torque: R,
    /// ḃ, N m/s².
    pub torque_memory: R,
}

impl<R: Real> RotorDynamics<R> {
    /// `T̈ = c_T2 (T_∞ − T) − c_T1 Ṫ`, `Q̇ = −c_Q3 Q + b + c_Q1 Q_∞`, `ḃ = −c_Q4 Q + c_Q2 Q_∞`.
    #[inline(always)]
    pub fn derivative(&self, state: &ResponseState<R>, steady: &RotorOutput<R>) -> ResponseRate<R> {
        ResponseRate {
            thrust: state.thrust_rate,
            thrust_rate: self.thrust_c2 * (steady.thrust - state.thrust) - self.thrust_c1 * state.thrust_rate,
            torque: state.torque_memory + self.torque_c1 * steady.torque - self.torque_c3 * state.torque,
            torque_memory: self.torque_c2 * steady.torque - self.torque_c4 * state.torque,
        }
    }

    /// The state at rest with these steady values.
    pub fn equilibrium(&self, steady: &RotorOutput<R>) -> ResponseState<R> {
        let at_rest = RotorOutput {
            thrust: R::zero(),
            torque: R::zero(),
        };
        self.state_for_output(steady, &at_rest, steady)
    }

    /// The state with this thrust and torque and these rates of them (N/s, N m/s), while the static map
    /// says `steady`.
    pub fn state_for_output(
        &self,
        output: &RotorOutput<R>,
        rate: &RotorOutput<R>,
        steady: &RotorOutput<R>,
    ) -> ResponseState<R> {
        ResponseState {
            thrust: output.thrust,
            thrust_rate: rate.thrust,
            torque: output.torque,
            torque_memory: rate.torque + self.torque_c3 * output.torque - self.torque_c1 * steady.torque,
        }
    }
}

/// The empirical linear rotor of level 4: gains behind transfer functions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearRotor<R: Real> {
    /// Thrust gain `K_T`, N per unit of command u.
    pub thrust_gain: R,
    /// Torque gain `K_Q`, N m per unit of command u.
    pub torque_gain: R,
    /// The responses.
    pub dynamics: RotorDynamics<R>,
}

/// A cubic without constant term, `k_1 x + k_2 x² + k_3 x³`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cubic<R> {
    /// `k_1`.
    pub k1: R,
    /// `k_2`.
    pub k2: R,
    /// `k_3`.
    pub k3: R,
}

impl<N> Cubic<N> {
    /// The cubic with each coefficient taken through `f`.
    #[must_use]
    pub fn map<M>(self, f: impl Fn(N) -> M) -> Cubic<M> {
        Cubic {
            k1: f(self.k1),
            k2: f(self.k2),
            k3: f(self.k3),
        }
    }
}

impl<R: Real> Cubic<R> {
    /// Value at `x`.
    #[inline(always)]
    pub fn value(&self, x: R) -> R {
        ((self.k3 * x + self.k2) * x + self.k1) * x
    }

    /// Slope at `x`.
    #[inline(always)]
    pub fn slope(&self, x: R) -> R {
        (self.k3 * x * constant(3.0) + self.k2 * constant(2.0)) * x + self.k1
    }

    /// `[k_1, k_2, k_3]`.
    #[must_use]
    pub fn coefficients(&self) -> [R; 3] {
        [self.k1, self.k2, self.k3]
    }

    /// The cubic with every value so many times as large.
    #[must_use]
    pub fn scaled(&self, factor: R) -> Self {
        self.map(|k| k * factor)
    }

    /// The `x` with `value(x) = y`, `y ≥ 0`, by Newton's method from the root of the quadratic part.
    ///
    /// A cubic that rises and then falls (`k_3 < 0`) takes each value twice; the quadratic part leads to the
    /// root on the rising branch, where `y / k_1` would overshoot the top. Twelve steps: quadratic convergence
    /// doubles the digits each time, so a root that is reached at all is exact to rounding long before. For
    /// cubics that rise through the range of use.
    pub fn inverse(&self, y: R) -> R {
        let discriminant = self.k1 * self.k1 + self.k2 * y * constant(4.0);
        let mut x = y * constant(2.0) / (self.k1 + quad_math::sqrt(discriminant.simd_max(R::zero())));
        for _ in 0..12 {
            x -= (self.value(x) - y) / self.slope(x);
        }
        x
    }
}

/// The empirical non-linear rotor of level 5: polynomials in command and battery voltage behind the
/// transfer functions of level 4.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NonLinearRotor<R: Real> {
    /// Steady thrust, N, against `x = (ū − ū_min) V_b`, V.
    pub thrust: Cubic<R>,
    /// Steady torque, N m, against `x`, V.
    pub torque: Cubic<R>,
    /// Upper end of the range of `x` that the polynomials hold on, V; the lower end is 0.
    pub range_end: R,
    /// Zero-thrust duty above the bottom of the range, `ū_0 − ū_min`.
    pub zero_thrust_offset: R,
    /// The responses.
    pub dynamics: RotorDynamics<R>,
}

impl<R: Real> LinearRotor<R> {
    /// Steady thrust and torque, `T_∞ = K_T u`, `Q_∞ = K_Q u`.
    #[inline(always)]
    pub fn steady(&self, input: &RotorInput<R>) -> RotorOutput<R> {
        RotorOutput {
            thrust: self.thrust_gain * input.command,
            torque: self.torque_gain * input.command,
        }
    }
}

impl<R: Real> NonLinearRotor<R> {
    /// Steady thrust and torque at `x = (u + ū_0 − ū_min) V_b`.
    #[inline(always)]
    pub fn steady(&self, input: &RotorInput<R>) -> RotorOutput<R> {
        let x = (input.command + self.zero_thrust_offset) * input.voltage;
        let inside = x.simd_clamp(R::zero(), self.range_end);
        let beyond = x - inside;
        let extended = |k: &Cubic<R>| k.value(inside) + k.slope(inside) * beyond;
        RotorOutput {
            thrust: extended(&self.thrust),
            torque: extended(&self.torque),
        }
    }
}

/// The part of [`RotorModel`] that both empirical rotors share: a steady map behind the responses.
macro_rules! empirical_rotor {
    () => {
        type State = ResponseState<R>;
        const SPIN_UP: SpinUp = SpinUp::InTorque;

        #[inline(always)]
        fn output(&self, state: &ResponseState<R>, _input: &RotorInput<R>) -> RotorOutput<R> {
            RotorOutput {
                thrust: state.thrust,
                torque: state.torque,
            }
        }

        #[inline(always)]
        fn derivative(&self, state: &ResponseState<R>, input: &RotorInput<R>) -> ResponseRate<R> {
            self.dynamics.derivative(state, &self.steady(input))
        }

        fn equilibrium(&self, input: &RotorInput<R>) -> ResponseState<R> {
            self.dynamics.equilibrium(&self.steady(input))
        }

        #[inline(always)]
        fn output_rate(&self, state: &ResponseState<R>, input: &RotorInput<R>) -> RotorOutput<R> {
            let rate = self.dynamics.derivative(state, &self.steady(input));
            RotorOutput {
                thrust: rate.thrust,
                torque: rate.torque,
            }
        }

        fn state_for_output(
            &self,
            output: &RotorOutput<R>,
            rate: &RotorOutput<R>,
            input: &RotorInput<R>,
        ) -> ResponseState<R> {
            self.dynamics
                .state_for_output(output, rate, &self.steady(input))
        }
    };
}

impl<R: Real> RotorModel<R> for LinearRotor<R> {
    empirical_rotor!();

    #[inline(always)]
    fn command_for_thrust(&self, thrust: R, _voltage: R) -> R {
        thrust / self.thrust_gain
    }
}

impl<R: Real> RotorModel<R> for NonLinearRotor<R> {
    empirical_rotor!();

    fn command_for_thrust(&self, thrust: R, voltage: R) -> R {
        self.thrust.inverse(thrust) / voltage - self.zero_thrust_offset
    }
}

impl<R: Real> State<R> for ResponseState<R> {
    type Rate = ResponseRate<R>;

    #[inline(always)]
    fn advanced(&self, h: R, rate: &ResponseRate<R>) -> Self {
        Self {
            thrust: self.thrust + rate.thrust * h,
            thrust_rate: self.thrust_rate + rate.thrust_rate * h,
            torque: self.torque + rate.torque * h,
            torque_memory: self.torque_memory + rate.torque_memory * h,
        }
    }
}

impl<R: Real> Rate<R> for ResponseRate<R> {
    #[inline(always)]
    fn zero() -> Self {
        let o = R::zero();
        Self {
            thrust: o,
            thrust_rate: o,
            torque: o,
            torque_memory: o,
        }
    }

    #[inline(always)]
    fn add_scaled(&self, h: R, other: &Self) -> Self {
        Self {
            thrust: self.thrust + other.thrust * h,
            thrust_rate: self.thrust_rate + other.thrust_rate * h,
            torque: self.torque + other.torque * h,
            torque_memory: self.torque_memory + other.torque_memory * h,
        }
    }
}

impl<R: Real> Flat<R> for ResponseState<R> {
    const LEN: usize = 4;

    #[inline(always)]
    fn write(&self, out: &mut [R]) {
        out[..4].copy_from_slice(&[self.thrust, self.thrust_rate, self.torque, self.torque_memory]);
    }

    #[inline(always)]
    fn read(v: &[R]) -> Self {
        Self {
            thrust: v[0],
            thrust_rate: v[1],
            torque: v[2],
            torque_memory: v[3],
        }
    }
}

impl<R: Real> Flat<R> for ResponseRate<R> {
    const LEN: usize = 4;

    #[inline(always)]
    fn write(&self, out: &mut [R]) {
        out[..4].copy_from_slice(&[self.thrust, self.thrust_rate, self.torque, self.torque_memory]);
    }

    #[inline(always)]
    fn read(v: &[R]) -> Self {
        Self {
            thrust: v[0],
            thrust_rate: v[1],
            torque: v[2],
            torque_memory: v[3],
        }
    }
}
