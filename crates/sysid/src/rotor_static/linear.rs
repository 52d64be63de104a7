//! The line over the operating range, whose zero is the zero-thrust command.

use super::{ONE_VOLTAGE, StaticError, StaticSample, over_settings};
use crate::estimate::{Estimate, Fit, Warning};
use crate::regression::Row;

/// Gains of the linear rotor: `T = K_T (ū − ū_0)`, `Q = K_Q (ū − ū_0)`.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearGains {
    /// Thrust gain `K_T`, N per unit of duty.
    pub thrust_gain: Estimate,
    /// Torque gain `K_Q`, N m per unit of duty, with the same zero as the thrust.
    pub torque_gain: Estimate,
    /// Zero-thrust duty `ū_0`, raw.
    pub zero_thrust: Estimate,
    /// The thrust line `T = a + K_T ū`: parameters `[a, K_T]`.
    pub thrust: Fit<2>,
    /// The torque line `Q = K_Q (ū − ū_0)` at the estimated zero; its own standard error leaves out the zero's.
    pub torque: Fit<1>,
}

impl LinearGains {
    /// Thrust of the line at a raw duty, N.
    pub fn thrust_at(&self, duty: f64) -> Estimate {
        let [a, k] = self.thrust.values();
        self.thrust.propagated(a + k * duty, &[1.0, duty])
    }

    /// Warnings of both lines.
    pub fn warnings(&self) -> impl Iterator<Item = &Warning> {
        self.thrust.warnings.iter().chain(&self.torque.warnings)
    }
}

/// Fits the lines over samples of one voltage within the operating range.
///
/// ```text
/// T = a + K_T ū,   ū_0 = −a/K_T,   var ū_0 = gᵀ C g,   g = [−1/K_T, a/K_T²]
/// K_Q = Σ v Q / Σ v²,   v = ū − ū_0,   ∂K_Q/∂ū_0 = (2 K_Q Σ v − Σ Q) / Σ v²
/// var K_Q = s_Q²/Σ v² + (∂K_Q/∂ū_0)² var ū_0
/// ```
///
/// The last line takes the noise of thrust and torque as independent. The intervals hold for the noise, see
/// [`crate::rotor_static`] on repeated readings; what the line misses of the rotor's curve is announced.
///
/// # Errors
/// Fewer than three samples or one duty only, several voltages, a slope not distinct from zero, non-finite numbers.
pub fn linear_gains(samples: &[StaticSample]) -> Result<LinearGains, StaticError> {
    one_voltage(samples)?;
    let rows: Vec<Row<2>> = samples
        .iter()
        .map(|s| Row {
            regressors: [1.0, s.duty],
            y: s.thrust_n,
        })
        .collect();
    let duties: Vec<f64> = samples.iter().map(|s| s.duty).collect();
    let thrust = over_settings(&rows, samples, &duties)?;
    let [intercept, gain] = thrust.values();
    if !(gain > 0.0 && thrust.parameters[1].interval().lower > 0.0) {
        return Err(StaticError::NoSlope {
            slope: gain,
            standard_error: thrust.parameters[1].standard_error,
        });
    }
    let zero = -intercept / gain;
    let zero_thrust = thrust.propagated(zero, &[-1.0 / gain, intercept / gain.powi(2)]);

    let rows: Vec<Row<1>> = samples
        .iter()
        .map(|s| Row {
            regressors: [s.duty - zero],
            y: s.torque_n_m,
        })
        .collect();
    let torque = over_settings(&rows, samples, &duties)?;
    Ok(LinearGains {
        thrust_gain: thrust.parameters[1],
        torque_gain: with_uncertain_zero(torque.parameters[0], &rows, zero_thrust.standard_error),
        zero_thrust,
        thrust,
        torque,
    })
}

/// The torque gain with the part of its variance that comes from the estimated zero.
fn with_uncertain_zero(gain: Estimate, rows: &[Row<1>], zero_error: f64) -> Estimate {
    let sum = |f: fn(&Row<1>) -> f64| rows.iter().map(f).sum::<f64>();
    let per_zero = (2.0 * gain.value * sum(|r| r.regressors[0]) - sum(|r| r.y))
        / sum(|r| r.regressors[0] * r.regressors[0]);
    Estimate {
        standard_error: gain.standard_error.hypot(per_zero * zero_error),
        ..gain
    }
}

fn one_voltage(samples: &[StaticSample]) -> Result<(), StaticError> {
    let voltages = || samples.iter().map(|s| s.battery_voltage_v);
    let lowest = voltages().fold(f64::INFINITY, f64::min);
    let highest = voltages().fold(f64::NEG_INFINITY, f64::max);
    let mean = voltages().sum::<f64>() / samples.len() as f64;
    if samples.is_empty() || highest - lowest <= ONE_VOLTAGE * mean {
        Ok(())
    } else {
        Err(StaticError::VoltageVaries { lowest, highest })
    }
}
