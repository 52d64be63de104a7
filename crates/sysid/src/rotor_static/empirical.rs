//! Cubics without constant term in the effective voltage.

use super::{Quantity, StaticError, StaticSample, over_settings, positive};
use crate::estimate::Fit;
use crate::regression::Row;
use quad_rotor::Cubic;

/// Fits `k_1 x + k_2 x² + k_3 x³` with `x = (ū − ū_min) V_b` in V to thrust, N, or torque, N m.
///
/// Parameters `[k_1, k_2, k_3]` in N/V, N/V², N/V³ (torque: N m for N). A warning that the curve misses, or of
/// correlated residuals, means that the rotor's curve is no cubic within the noise: the fit is then the best cubic over these
/// samples, and depends on them. Intervals: see [`crate::rotor_static`] on repeated readings.
///
/// # Errors
/// Fewer than four samples, fewer than three values of x, a duty below the bottom of the range, a voltage not positive,
/// numbers that are not finite.
pub fn polynomial(
    samples: &[StaticSample],
    minimum_duty: f64,
    quantity: Quantity,
) -> Result<Fit<3>, StaticError> {
    let row = |(index, sample): (usize, &StaticSample)| {
        positive("a battery voltage in V", sample.battery_voltage_v)?;
        if sample.duty < minimum_duty {
            return Err(StaticError::BelowRange {
                index,
                duty: sample.duty,
                minimum: minimum_duty,
            });
        }
        let x = sample.effective(minimum_duty);
        Ok(Row {
            regressors: [x, x * x, x * x * x],
            y: sample.of(quantity),
        })
    };
    let rows: Vec<Row<3>> = samples.iter().enumerate().map(row).collect::<Result<_, _>>()?;
    let x: Vec<f64> = rows.iter().map(|row| row.regressors[0]).collect();
    Ok(over_settings(&rows, samples, &x)?)
}

/// The fitted polynomial as the rotor model of level 5 takes it.
pub fn cubic(fit: &Fit<3>) -> Cubic<f64> {
    let [k1, k2, k3] = fit.values();
    Cubic { k1, k2, k3 }
}
