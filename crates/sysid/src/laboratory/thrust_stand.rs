//! The virtual thrust stand: one mechanistic rotor, its supply, four instruments.
//!
//! The rotor is [`quad_rotor::MechanisticRotor`] (propeller, motor, controller lag); the torque is the reaction that a bench
//! feels, aerodynamic and spin-up together, `Q + I_R Ω̇`. Static sweeps read its equilibrium; recordings integrate it (RK4,
//! at most 1 ms a step) while the command is held from one sample to the next, as a flight computer does.
//!
//! Instruments and spread between rotors are assumptions of usual size, no measurements: see their fields. Valid where the
//! mechanistic rotor is; above 7.84 N the Qball-X4's propeller was not measured.

mod excitation;
mod instruments;
#[cfg(test)]
mod tests;

pub use excitation::{Prbs, Step, irregular_times, uniform_times};
pub use instruments::{Instruments, RotorSpread};

use super::{Generator, SensorError};
use crate::rotor_dynamics::DynamicSample;
use crate::rotor_static::StaticSample;
use quad_dynamics::FamilyRotor;
use quad_dynamics::{BuildError, Vehicle};
use quad_math::{FixedStep, System};
use quad_rotor::{MechanisticRotor, RotorInput, RotorModel, RotorOutput, Sag, SpinRate, SpinState};

/// A rotor on the stand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThrustStand {
    /// The rotor: the truth.
    pub rotor: MechanisticRotor<f64>,
    /// Raw duty `ū_min` at the bottom of the range.
    pub minimum_duty: f64,
    /// The instruments.
    pub instruments: Instruments,
}

/// What feeds the rotor on the stand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BenchSupply {
    /// A power supply that holds its voltage.
    Regulated {
        /// Voltage, V.
        voltage_v: f64,
    },
    /// A battery at a state of charge that does not change noticeably during the test.
    Pack {
        /// Its discharge behaviour.
        sag: Sag<f64>,
        /// Charge drawn from it before the test, A h.
        charge_drawn_ah: f64,
    },
}

/// A static sweep: every duty at every supply.
#[derive(Clone, Debug, PartialEq)]
pub struct StaticSweep {
    /// Raw duties.
    pub duties: Vec<f64>,
    /// Supplies.
    pub supplies: Vec<BenchSupply>,
    /// Readings averaged for each point.
    pub readings: usize,
}

/// Why a test on the stand was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StandError {
    /// The vehicle has no mechanistic rotor.
    #[error(transparent)]
    Vehicle(#[from] BuildError),
    /// An instrument's numbers make no sense.
    #[error("the {instrument} sensor: {source}")]
    Sensor {
        /// Which.
        instrument: &'static str,
        /// Why.
        source: SensorError,
    },
    /// Times that do not rise or are not finite.
    #[error("sampling times must be finite and increase, got {time_s} s at {index} (counted from 0)")]
    Times {
        /// Place.
        index: usize,
        /// The time, s.
        time_s: f64,
    },
    /// A number that must be positive is not.
    #[error("{what} must be positive and finite, got {value}")]
    NotPositive {
        /// What.
        what: &'static str,
        /// The value.
        value: f64,
    },
    /// A duty that is not finite or below the bottom of the range.
    #[error("the duty must be at least {minimum}, the bottom of the range, got {duty}")]
    Duty {
        /// The duty.
        duty: f64,
        /// `ū_min`.
        minimum: f64,
    },
}

/// Longest step of the integration, s: a tenth of the controller's lag of 10 ms, where RK4's error is `0.1⁵/120 < 1e-7` of
/// the transient.
const LONGEST_STEP_S: f64 = 1e-3;

/// Iterations of voltage against current at rest, each half a step: the error shrinks to `|1 − q|/2` with `q = R_i/R · d²`, to
/// a half or less for a pack of less than three times the motor's resistance, so 60 reach rounding.
const VOLTAGE_ITERATIONS: usize = 60;

impl BenchSupply {
    /// Terminal voltage, V, while a current, A, is drawn.
    fn voltage(&self, current: f64) -> f64 {
        match self {
            Self::Regulated { voltage_v } => *voltage_v,
            Self::Pack { sag, charge_drawn_ah } => {
                sag.open_circuit_voltage(*charge_drawn_ah) - sag.internal_resistance * current
            }
        }
    }

    fn validate(&self) -> Result<(), StandError> {
        let value = self.voltage(0.0);
        if value.is_finite() && value > 0.0 {
            Ok(())
        } else {
            let what = "the supply's voltage in V";
            Err(StandError::NotPositive { what, value })
        }
    }
}

/// The rotor and its supply under a held command.
struct Driven<'a> {
    stand: &'a ThrustStand,
    supply: BenchSupply,
}

impl System<f64> for Driven<'_> {
    type State = SpinState<f64>;
    type Input = f64;

    fn derivative(&self, state: &SpinState<f64>, &duty: &f64) -> SpinRate<f64> {
        self.stand
            .rotor
            .derivative(state, &self.stand.input(duty, self.voltage(state, duty)))
    }
}

impl Driven<'_> {
    /// Terminal voltage, V: the controller passes the fraction d of the time, so the supply gives `d I`, and takes nothing back.
    fn voltage(&self, state: &SpinState<f64>, duty: f64) -> f64 {
        let motor = &self.stand.rotor.motor;
        let current = motor.current(state.effective_voltage, state.speed);
        let fraction = motor.duty_fraction(duty - self.stand.minimum_duty);
        self.supply.voltage(current.max(0.0) * fraction)
    }

    /// The state at rest.
    fn equilibrium(&self, duty: f64) -> SpinState<f64> {
        let rotor = &self.stand.rotor;
        let at_rest = |voltage| rotor.equilibrium(&self.stand.input(duty, voltage));
        let mut voltage = self.supply.voltage(0.0);
        for _ in 0..VOLTAGE_ITERATIONS {
            voltage = 0.5 * (voltage + self.voltage(&at_rest(voltage), duty));
        }
        at_rest(voltage)
    }
}

impl ThrustStand {
    /// The vehicle's nominal rotor with the usual instruments.
    ///
    /// # Errors
    /// A vehicle without propeller or motor.
    pub fn of(vehicle: &Vehicle) -> Result<Self, StandError> {
        Ok(Self {
            rotor: MechanisticRotor::of(vehicle)?,
            minimum_duty: vehicle.pwm.minimum,
            instruments: Instruments::default(),
        })
    }

    /// Four rotors like the vehicle's that differ as real ones do, in the order 1 rear, 2 front, 3 left, 4 right.
    ///
    /// # Errors
    /// As [`ThrustStand::of`].
    pub fn four(
        vehicle: &Vehicle,
        spread: &RotorSpread,
        generator: &mut Generator,
    ) -> Result<[Self; 4], StandError> {
        let nominal = Self::of(vehicle)?;
        Ok(std::array::from_fn(|_| Self {
            rotor: spread.applied(&nominal.rotor, generator),
            ..nominal
        }))
    }

    /// Steady readings at every duty of the sweep on every supply, supplies outermost.
    ///
    /// # Errors
    /// Instruments, supplies or duties that make no sense.
    pub fn sweep(
        &self,
        sweep: &StaticSweep,
        generator: &mut Generator,
    ) -> Result<Vec<StaticSample>, StandError> {
        self.instruments.validate()?;
        let mut samples = Vec::with_capacity(sweep.supplies.len() * sweep.duties.len());
        for supply in &sweep.supplies {
            supply.validate()?;
            let driven = Driven {
                stand: self,
                supply: *supply,
            };
            for &duty in &sweep.duties {
                self.check_duty(duty)?;
                let state = driven.equilibrium(duty);
                let truth = self.truth(&driven, &state, 0.0, duty);
                samples.push(self.instruments.steady(&truth, sweep.readings.max(1), generator));
            }
        }
        Ok(samples)
    }

    /// A recording at these times, s, from rest under the first command; each command is held to the next time.
    ///
    /// # Errors
    /// Instruments, supply, times or duties that make no sense.
    pub fn record(
        &self,
        times_s: &[f64],
        duty: impl Fn(f64) -> f64,
        supply: BenchSupply,
        generator: &mut Generator,
    ) -> Result<Vec<DynamicSample>, StandError> {
        self.instruments.validate()?;
        supply.validate()?;
        check_times(times_s)?;
        let driven = Driven { stand: self, supply };
        let mut samples = Vec::with_capacity(times_s.len());
        let mut state = None;
        for (k, &time_s) in times_s.iter().enumerate() {
            let command = duty(time_s);
            self.check_duty(command)?;
            let mut now = state.unwrap_or_else(|| driven.equilibrium(command));
            let truth = self.truth(&driven, &now, time_s, command);
            samples.push(self.instruments.read(&truth, generator));
            if let Some(next) = times_s.get(k + 1) {
                let steps = ((next - time_s) / LONGEST_STEP_S).ceil();
                for _ in 0..steps as usize {
                    now = FixedStep::Rk4.step(&driven, &now, &command, (next - time_s) / steps);
                }
            }
            state = Some(now);
        }
        Ok(samples)
    }

    /// Steady thrust, N, and torque, N m, at a raw duty and a voltage, V: the truth behind the readings.
    pub fn steady(&self, duty: f64, voltage_v: f64) -> RotorOutput<f64> {
        let input = self.input(duty, voltage_v);
        self.rotor.output(&self.rotor.equilibrium(&input), &input)
    }

    fn input(&self, duty: f64, voltage: f64) -> RotorInput<f64> {
        RotorInput {
            command: duty - self.minimum_duty - self.rotor.zero_thrust_offset,
            voltage,
        }
    }

    fn truth(&self, driven: &Driven, state: &SpinState<f64>, time_s: f64, duty: f64) -> DynamicSample {
        let voltage = driven.voltage(state, duty);
        let output = self.rotor.output(state, &self.input(duty, voltage));
        DynamicSample {
            time_s,
            duty,
            battery_voltage_v: voltage,
            thrust_n: output.thrust,
            torque_n_m: output.torque,
            speed_rad_s: state.speed,
        }
    }

    fn check_duty(&self, duty: f64) -> Result<(), StandError> {
        let minimum = self.minimum_duty;
        if duty.is_finite() && duty >= minimum {
            Ok(())
        } else {
            Err(StandError::Duty { duty, minimum })
        }
    }
}

fn check_times(times_s: &[f64]) -> Result<(), StandError> {
    let wrong = |k: usize| !times_s[k].is_finite() || (k > 0 && times_s[k] <= times_s[k - 1]);
    match (0..times_s.len()).find(|&k| wrong(k)) {
        Some(index) => Err(StandError::Times {
            index,
            time_s: times_s[index],
        }),
        None => Ok(()),
    }
}
