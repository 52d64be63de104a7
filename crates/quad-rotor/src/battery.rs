//! Batteries: constant voltage, or a lithium-polymer pack that sags under load and with charge.
//!
//! `V = V_full − A (1 − exp(−B q)) − R_i I`, `q̇ = I / 3600` with the charge drawn `q` in Ah: the
//! Shepherd model in the form of Tremblay and Dessaint (*World Electric Vehicle Journal* 3, 2009)
//! without its polarisation term, so it holds from full charge to the plateau and misses the knee at the
//! end of a discharge.

use quad_math::{Flat, Rate, Real, State, constant};

/// Seconds in an hour: charge is counted in Ah.
const SECONDS_PER_HOUR: f64 = 3600.0;

/// What feeds the rotors.
pub trait Supply<R: Real>: Copy {
    /// The supply's state; `()` if it has none.
    type State: State<R, Rate: Flat<R>> + Flat<R>;

    /// Terminal voltage, V, while the current, A, is drawn.
    fn voltage(&self, state: &Self::State, current: R) -> R;

    /// Rate of the state while the current, A, is drawn.
    fn derivative(&self, state: &Self::State, current: R) -> <Self::State as State<R>>::Rate;

    /// The state of a full supply.
    fn full(&self) -> Self::State;
}

/// A stiff supply: the same voltage at any load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstantVoltage<R: Real> {
    /// Voltage, V.
    pub voltage: R,
}

impl<R: Real> Supply<R> for ConstantVoltage<R> {
    type State = ();

    #[inline(always)]
    fn voltage(&self, (): &(), _current: R) -> R {
        self.voltage
    }

    #[inline(always)]
    fn derivative(&self, (): &(), _current: R) {}

    fn full(&self) {}
}

/// A lithium-polymer pack, or a stiff supply of its nominal voltage when sag is switched off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Battery<R: Real> {
    /// Voltage while sag is off, V.
    pub nominal_voltage: R,
    /// The discharge behaviour; `None` switches voltage sag off.
    pub sag: Option<Sag<R>>,
}

/// How the voltage of a lithium-polymer pack falls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sag<R: Real> {
    /// Open-circuit voltage of the full pack `V_full`, V.
    pub full_voltage: R,
    /// Internal resistance `R_i`, ohm.
    pub internal_resistance: R,
    /// Height `A` of the exponential zone, V.
    pub exponential_amplitude: R,
    /// Inverse charge `B` of the exponential zone, 1/Ah.
    pub exponential_rate: R,
}

/// Charge drawn from a battery.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BatteryState<R: Real> {
    /// Charge drawn since full, Ah.
    pub charge_drawn: R,
}

/// Rate of [`BatteryState`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BatteryRate<R: Real> {
    /// Rate of the charge drawn, Ah/s.
    pub charge_drawn: R,
}

impl<R: Real> Sag<R> {
    /// Open-circuit voltage, V, after a charge, Ah, was drawn.
    #[inline(always)]
    pub fn open_circuit_voltage(&self, charge_drawn: R) -> R {
        let decay = (-self.exponential_rate * charge_drawn).simd_exp();
        self.full_voltage - self.exponential_amplitude * (R::one() - decay)
    }
}

impl<R: Real> Supply<R> for Battery<R> {
    type State = BatteryState<R>;

    #[inline(always)]
    fn voltage(&self, state: &BatteryState<R>, current: R) -> R {
        match &self.sag {
            Some(sag) => sag.open_circuit_voltage(state.charge_drawn) - sag.internal_resistance * current,
            None => self.nominal_voltage,
        }
    }

    #[inline(always)]
    fn derivative(&self, _state: &BatteryState<R>, current: R) -> BatteryRate<R> {
        BatteryRate {
            charge_drawn: current * constant(1.0 / SECONDS_PER_HOUR),
        }
    }

    fn full(&self) -> BatteryState<R> {
        BatteryState {
            charge_drawn: R::zero(),
        }
    }
}

impl<R: Real> State<R> for BatteryState<R> {
    type Rate = BatteryRate<R>;

    #[inline(always)]
    fn advanced(&self, h: R, rate: &BatteryRate<R>) -> Self {
        Self {
            charge_drawn: self.charge_drawn + rate.charge_drawn * h,
        }
    }
}

impl<R: Real> Rate<R> for BatteryRate<R> {
    #[inline(always)]
    fn zero() -> Self {
        Self {
            charge_drawn: R::zero(),
        }
    }

    #[inline(always)]
    fn add_scaled(&self, h: R, other: &Self) -> Self {
        Self {
            charge_drawn: self.charge_drawn + other.charge_drawn * h,
        }
    }
}

impl<R: Real> Flat<R> for BatteryState<R> {
    const LEN: usize = 1;

    #[inline(always)]
    fn write(&self, out: &mut [R]) {
        out[0] = self.charge_drawn;
    }

    #[inline(always)]
    fn read(values: &[R]) -> Self {
        Self {
            charge_drawn: values[0],
        }
    }
}

impl<R: Real> Flat<R> for BatteryRate<R> {
    const LEN: usize = 1;

    #[inline(always)]
    fn write(&self, out: &mut [R]) {
        out[0] = self.charge_drawn;
    }

    #[inline(always)]
    fn read(values: &[R]) -> Self {
        Self {
            charge_drawn: values[0],
        }
    }
}
