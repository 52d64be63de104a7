//! Rotor statics: from steady readings of a thrust stand to coefficients, polynomials and gains.
//!
//! ```text
//! mechanistic:  T = C_T ρ n² D⁴,  Q = C_Q ρ n² D⁵,  n = Ω/2π            coefficient, speed_dependence, advance_slope
//! polynomial:   T = k_1 x + k_2 x² + k_3 x³,  x = (ū − ū_min) V_b       polynomial      (the same for Q)
//! linear:       T = K_T (ū − ū_0),  Q = K_Q (ū − ū_0)                   linear_gains
//! ```
//!
//! Assumptions: still air, steady readings, noise on thrust and torque of equal variance, duty, voltage and speed known
//! far better than thrust and torque. An interval speaks of noise only: a bias of a force sensor shifts an estimate and is
//! in no interval, so tare before a test. Where the model misses the rotor's curve by more than the noise, a warning reports it.
//!
//! Cubics and lines are not the rotor's law: an interval is that of the best curve over the settings measured. **Read each setting
//! several times**, best in a second pass: then the scatter of repeated readings, which is noise alone, makes the interval, and a
//! test tells whether the curve misses more than that ([`Warning::CurveMisses`]). With one reading of a setting, or fewer than ten
//! repetitions in all, noise and misfit cannot be distinguished; intervals come from the residuals and are wider than the noise
//! where the curve misses much.
//!
//! Valid over the speeds, duties and voltages measured. Source: thesis, chapter 4.5 and tables 4.3 to 4.5; Brandt and
//! Selig, *Propeller Performance Data at Low Reynolds Numbers*, AIAA 2011-1255.

mod empirical;
mod linear;
mod mechanistic;
#[cfg(test)]
pub(crate) mod tests;

pub use empirical::{cubic, polynomial};
pub use linear::{LinearGains, linear_gains};
pub use mechanistic::{
    AdvanceSample, PropellerSample, PropellerScale, SpeedDependence, SpeedLaw, advance_slope, coefficient,
    speed_dependence,
};

use crate::estimate::{Fit, Warning};
use crate::lack_of_fit::LackOfFit;
use crate::regression::{FitError, Row, linear};
use crate::residual::Whiteness;
use serde::{Deserialize, Serialize};

/// One steady reading of a rotor on a thrust stand; a row of a CSV with these columns.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StaticSample {
    /// Raw PWM duty ū, dimensionless.
    pub duty: f64,
    /// Battery voltage `V_b` at the controller's terminals, V.
    pub battery_voltage_v: f64,
    /// Thrust T, N, positive up.
    pub thrust_n: f64,
    /// Reaction torque Q, N m, positive against the spin.
    pub torque_n_m: f64,
    /// Rotor speed Ω, rad/s.
    pub speed_rad_s: f64,
}

/// Which of a rotor's two outputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Thrust T, N.
    Thrust,
    /// Reaction torque Q, N m.
    Torque,
}

impl StaticSample {
    /// Thrust, N, or torque, N m.
    pub fn of(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::Thrust => self.thrust_n,
            Quantity::Torque => self.torque_n_m,
        }
    }

    /// `x = (ū − ū_min) V_b`, V, for a duty `ū_min` at the bottom of the range.
    pub fn effective(&self, minimum_duty: f64) -> f64 {
        (self.duty - minimum_duty) * self.battery_voltage_v
    }
}

/// Why rotor statics were refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StaticError {
    /// The regression was refused.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A number that must be positive is not.
    #[error("{what} must be positive and finite, got {value}")]
    NotPositive {
        /// What.
        what: &'static str,
        /// The value.
        value: f64,
    },
    /// A duty below the bottom of the range.
    #[error("sample {index}: the duty must be at least {minimum}, the bottom of the range, got {duty}")]
    BelowRange {
        /// Place in the order of the data.
        index: usize,
        /// Its duty.
        duty: f64,
        /// `ū_min`.
        minimum: f64,
    },
    /// A line in the duty alone over data of several voltages.
    #[error(
        "a line over the duty holds at one battery voltage, got {lowest} V to {highest} V: choose the samples of one voltage"
    )]
    VoltageVaries {
        /// Lowest, V.
        lowest: f64,
        /// Highest, V.
        highest: f64,
    },
    /// The slope does not differ from zero, so that the line has no zero.
    #[error(
        "the thrust does not change with the duty ({slope} ± {standard_error} N), so no zero-thrust duty exists"
    )]
    NoSlope {
        /// Slope, N.
        slope: f64,
        /// Its standard error, N.
        standard_error: f64,
    },
}

/// Lags of the test of residuals in the order of an abscissa: neighbours see the same error of a curve.
const LAGS: usize = 5;

/// Number of equal readings at the top from which a sensor counts as saturated.
const SATURATED_FROM: usize = 3;

/// Largest spread of the voltage, relative to its mean, that still counts as one voltage: noise and sag of a
/// reading. Thrust goes at most with the square of the voltage, so 2 % of it are at most 4 % of thrust.
const ONE_VOLTAGE: f64 = 0.02;

/// Numbers the settings of the stand, a duty and a voltage each, in the order of their first reading: for each sample that
/// of its own.
fn settings(samples: &[StaticSample]) -> Vec<usize> {
    let mut known: Vec<StaticSample> = Vec::new();
    let same = |a: &StaticSample, b: &StaticSample| {
        let apart = (a.battery_voltage_v - b.battery_voltage_v).abs();
        a.duty == b.duty && apart <= ONE_VOLTAGE * a.battery_voltage_v
    };
    let mut number = |sample: &StaticSample| {
        // From the last one on: repeated readings usually follow each other.
        known.iter().rposition(|k| same(k, sample)).unwrap_or_else(|| {
            known.push(*sample);
            known.len() - 1
        })
    };
    samples.iter().map(&mut number).collect()
}

/// A curve over samples of the stand: intervals by the scatter of repeated readings where there are enough, and what a
/// reader must know.
fn over_settings<const N: usize>(
    rows: &[Row<N>],
    samples: &[StaticSample],
    abscissa: &[f64],
) -> Result<Fit<N>, FitError> {
    let fit = linear(rows)?;
    let data: Vec<f64> = rows.iter().map(|row| row.y).collect();
    let settings = settings(samples);
    let Some(test) = LackOfFit::test(&fit.residuals, &settings, N) else {
        return Ok(inspected(fit, abscissa, &data));
    };
    let regressors: Vec<[f64; N]> = rows.iter().map(|row| row.regressors).collect();
    let mut fit = fit.with_pure_error(&regressors, &settings, &test);
    if test.is_significant() {
        fit.warnings.push(Warning::CurveMisses {
            misfit: test.misfit,
            p_value: test.p_value,
        });
        fit.warnings.extend(saturation(abscissa, &data));
        return Ok(fit);
    }
    Ok(inspected(fit, abscissa, &data))
}

/// Adds what a reader must know: residuals that follow a curve over the abscissa, readings stuck at the top.
fn inspected<const N: usize>(mut fit: Fit<N>, abscissa: &[f64], data: &[f64]) -> Fit<N> {
    let mut order: Vec<usize> = (0..abscissa.len()).collect();
    order.sort_by(|&i, &j| abscissa[i].total_cmp(&abscissa[j]));
    let residuals: Vec<f64> = order.iter().map(|&i| fit.residuals[i]).collect();
    let whiteness = Whiteness::test(&residuals, LAGS);
    if !whiteness.is_white() {
        fit.warnings.push(Warning::CorrelatedResiduals {
            p_value: whiteness.p_value,
            lags: whiteness.autocorrelation.len(),
        });
    }
    fit.warnings.extend(saturation(abscissa, data));
    fit
}

/// Readings that repeat the largest one at different abscissae: thrust and torque rise, so a sensor stands at its end.
///
/// The lower end is not looked at: a rotor at rest reads zero many times.
fn saturation(abscissa: &[f64], data: &[f64]) -> Option<Warning> {
    let limit = data.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let mut stuck: Vec<f64> = abscissa
        .iter()
        .zip(data)
        .filter(|(_, y)| **y == limit)
        .map(|(x, _)| *x)
        .collect();
    let samples = stuck.len();
    stuck.sort_by(f64::total_cmp);
    stuck.dedup();
    (stuck.len() >= SATURATED_FROM).then_some(Warning::Saturated { samples, limit })
}

/// Refuses a number that is not positive and finite.
fn positive(what: &'static str, value: f64) -> Result<f64, StaticError> {
    if value.is_finite() && value > 0.0 {
        Ok(value)
    } else {
        Err(StaticError::NotPositive { what, value })
    }
}
