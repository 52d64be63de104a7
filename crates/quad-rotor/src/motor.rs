//! The brushless direct-current motor, its controller, and the mechanistic rotor they drive.
//!
//! ```text
//! V̇_eff = (V_cmd − V_eff) / τ_c           motor controller, V_cmd = (ū − ū_min) V_b / d_full
//! I     = (V_eff − Ω/K_v) / R             winding, inductance neglected
//! Q_e   = (I − I_0) / K_v                 electromagnetic torque on the rotor, reaction on the airframe
//! I_R Ω̇ = Q_e − k_Q Ω²                    rotor
//! ```
//!
//! Assumes that the controller can brake (current of either sign) and that the no-load current is the
//! same at every speed. Valid while the propeller's static law is: still air, 2400 to 6500 rpm measured.
//! A stopped rotor stays stopped until the torque turns it forward (a kink at `Ω = 0`). Source: Drela,
//! *First-Order DC Electric Motor Model* (2007), with the rotor's equation of motion.

use crate::{Propeller, RotorInput, RotorModel, RotorOutput, SpinUp};
use quad_math::{Flat, Rate, Real, State, constant};

/// A brushless direct-current motor with its controller.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motor<R> {
    /// Speed constant `K_v`, rad/(s V); its inverse is the torque constant, N m/A.
    pub velocity_constant: R,
    /// Resistance `R` of windings, controller and leads together, ohm.
    pub resistance: R,
    /// No-load current `I_0`, A.
    pub no_load_current: R,
    /// Moment of inertia `I_R` of propeller and motor bell about the spin axis, kg m².
    pub rotor_inertia: R,
    /// Time constant `τ_c` of the motor controller, s.
    pub controller_lag: R,
    /// Duty `d_full` above the bottom of the range at which the whole battery voltage is applied.
    pub full_voltage_duty: R,
}

impl<R: Real> Motor<R> {
    /// Motor current `I = (V_eff − Ω/K_v) / R`, A.
    #[inline(always)]
    pub fn current(&self, effective_voltage: R, speed: R) -> R {
        (effective_voltage - speed / self.velocity_constant) / self.resistance
    }

    /// Electromagnetic torque `Q_e = (I − I_0) / K_v`, N m: on the rotor along its spin, on the airframe
    /// against it.
    #[inline(always)]
    pub fn torque(&self, current: R) -> R {
        (current - self.no_load_current) / self.velocity_constant
    }

    /// Motor current `I = K_v Q_e + I_0`, A, that gives the electromagnetic torque, N m.
    #[inline(always)]
    pub fn current_for_torque(&self, torque: R) -> R {
        torque * self.velocity_constant + self.no_load_current
    }

    /// Fraction of the battery voltage that a duty above the bottom of the range asks for.
    #[inline(always)]
    pub fn duty_fraction(&self, duty_above_minimum: R) -> R {
        duty_above_minimum / self.full_voltage_duty
    }
}

/// State of the mechanistic rotor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpinState<R: Real> {
    /// Rotor speed Ω, rad/s, not negative.
    pub speed: R,
    /// Effective motor voltage `V_eff` behind the controller, V.
    pub effective_voltage: R,
}

/// Rate of [`SpinState`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpinRate<R: Real> {
    /// Ω̇, rad/s².
    pub speed: R,
    /// V̇_eff, V/s.
    pub effective_voltage: R,
}

/// The mechanistic rotor: propeller, motor and controller; the 'truth' that the empirical models are
/// identified from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MechanisticRotor<R: Real> {
    /// The propeller.
    pub propeller: Propeller<R>,
    /// The motor and its controller.
    pub motor: Motor<R>,
    /// Zero-thrust duty above the bottom of the range, `ū_0 − ū_min`.
    pub zero_thrust_offset: R,
}

impl<R: Real> MechanisticRotor<R> {
    /// Steady speed Ω, rad/s, under the effective voltage, V: the root of
    /// `k_Q Ω² + Ω/(R K_v²) + I_0/K_v − V_eff/(R K_v) = 0`; 0 where the voltage can't overcome friction.
    pub fn steady_speed(&self, effective_voltage: R) -> R {
        let (m, kq) = (&self.motor, self.propeller.torque_per_speed_squared);
        let drive = m
            .torque(m.current(effective_voltage, R::zero()))
            .simd_max(R::zero());
        let b = R::one() / (m.resistance * m.velocity_constant * m.velocity_constant);
        // The form without cancellation: 2c / (b + √(b² + 4 k_Q c)).
        let root = quad_math::sqrt(b * b + kq * drive * constant(4.0));
        drive * constant(2.0) / (b + root)
    }

    /// Effective voltage, V, that holds the speed: `V_eff = Ω/K_v + R (K_v k_Q Ω² + I_0)`.
    pub fn steady_voltage(&self, speed: R) -> R {
        let current = self.motor.current_for_torque(self.propeller.torque(speed));
        speed / self.motor.velocity_constant + self.motor.resistance * current
    }

    /// Bandwidth of the linearised rotor, rad/s: `(2 k_Q Ω + 1/(R K_v²)) / I_R`.
    pub fn bandwidth(&self, speed: R) -> R {
        let m = &self.motor;
        let damping = R::one() / (m.resistance * m.velocity_constant * m.velocity_constant);
        (self.propeller.torque_per_speed_squared * speed * constant(2.0) + damping) / self.motor.rotor_inertia
    }

    #[inline(always)]
    fn commanded_voltage(&self, input: &RotorInput<R>) -> R {
        self.motor.duty_fraction(input.command + self.zero_thrust_offset) * input.voltage
    }
}

impl<R: Real> RotorModel<R> for MechanisticRotor<R> {
    type State = SpinState<R>;
    const SPIN_UP: SpinUp = SpinUp::InTorque;

    fn output(&self, state: &SpinState<R>, _input: &RotorInput<R>) -> RotorOutput<R> {
        let current = self.motor.current(state.effective_voltage, state.speed);
        // A stopped rotor rests on its friction, not on its winding.
        let running = state.speed.simd_gt(R::zero());
        RotorOutput {
            thrust: self.propeller.thrust(state.speed),
            torque: self.motor.torque(current).select(running, R::zero()),
        }
    }

    fn derivative(&self, state: &SpinState<R>, input: &RotorInput<R>) -> SpinRate<R> {
        let current = self.motor.current(state.effective_voltage, state.speed);
        let net = self.motor.torque(current) - self.propeller.torque(state.speed);
        let speed_rate = net / self.motor.rotor_inertia;
        let running = state.speed.simd_gt(R::zero());
        SpinRate {
            speed: speed_rate.select(running, speed_rate.simd_max(R::zero())),
            effective_voltage: (self.commanded_voltage(input) - state.effective_voltage)
                / self.motor.controller_lag,
        }
    }

    fn equilibrium(&self, input: &RotorInput<R>) -> SpinState<R> {
        let effective_voltage = self.commanded_voltage(input);
        SpinState {
            speed: self.steady_speed(effective_voltage),
            effective_voltage,
        }
    }

    fn command_for_thrust(&self, thrust: R, voltage: R) -> R {
        let effective = self.steady_voltage(self.propeller.speed_for_thrust(thrust));
        effective / voltage * self.motor.full_voltage_duty - self.zero_thrust_offset
    }

    fn speed(&self, state: &SpinState<R>, _thrust: R, _propeller: &Propeller<R>) -> R {
        state.speed
    }

    fn output_rate(&self, state: &SpinState<R>, input: &RotorInput<R>) -> RotorOutput<R> {
        let (rate, m) = (self.derivative(state, input), &self.motor);
        let torque_per_volt = R::one() / (m.resistance * m.velocity_constant);
        RotorOutput {
            thrust: self.propeller.thrust_per_speed_squared * state.speed * rate.speed * constant(2.0),
            torque: (rate.effective_voltage - rate.speed / m.velocity_constant) * torque_per_volt,
        }
    }

    fn state_for_output(
        &self,
        output: &RotorOutput<R>,
        _rate: &RotorOutput<R>,
        _input: &RotorInput<R>,
    ) -> SpinState<R> {
        let m = &self.motor;
        let speed = self.propeller.speed_for_thrust(output.thrust);
        let current = m.current_for_torque(output.torque);
        SpinState {
            speed,
            effective_voltage: speed / m.velocity_constant + m.resistance * current,
        }
    }
}

impl<R: Real> State<R> for SpinState<R> {
    type Rate = SpinRate<R>;

    #[inline(always)]
    fn advanced(&self, h: R, rate: &SpinRate<R>) -> Self {
        Self {
            speed: self.speed + rate.speed * h,
            effective_voltage: self.effective_voltage + rate.effective_voltage * h,
        }
    }

    #[inline(always)]
    fn normalised(self) -> Self {
        Self {
            speed: self.speed.simd_max(R::zero()),
            ..self
        }
    }
}

impl<R: Real> Rate<R> for SpinRate<R> {
    #[inline(always)]
    fn zero() -> Self {
        Self {
            speed: R::zero(),
            effective_voltage: R::zero(),
        }
    }

    #[inline(always)]
    fn add_scaled(&self, h: R, other: &Self) -> Self {
        Self {
            speed: self.speed + other.speed * h,
            effective_voltage: self.effective_voltage + other.effective_voltage * h,
        }
    }
}

impl<R: Real> Flat<R> for SpinState<R> {
    const LEN: usize = 2;

    #[inline(always)]
    fn write(&self, out: &mut [R]) {
        out[..2].copy_from_slice(&[self.speed, self.effective_voltage]);
    }

    #[inline(always)]
    fn read(values: &[R]) -> Self {
        Self {
            speed: values[0],
            effective_voltage: values[1],
        }
    }
}

impl<R: Real> Flat<R> for SpinRate<R> {
    const LEN: usize = 2;

    #[inline(always)]
    fn write(&self, out: &mut [R]) {
        out[..2].copy_from_slice(&[self.speed, self.effective_voltage]);
    }

    #[inline(always)]
    fn read(values: &[R]) -> Self {
        Self {
            speed: values[0],
            effective_voltage: values[1],
        }
    }
}
