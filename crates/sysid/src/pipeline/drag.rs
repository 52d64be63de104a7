//! Drag of the airframe along `x_B` and `y_B` from a flight.
//!
//! The rotors push along `z_B` only, so along `x_B` and `y_B` an accelerometer in the centre of mass feels drag alone:
//!
//! ```text
//! f_i = −(k_i/m) |v_i| v_i + b_i,   i = x, y
//! ```
//!
//! Linear in `k_i/m` and the sensor's bias `b_i`. Assumptions: still air, rotor axes along `z_B`, noise of the velocity small
//! against the velocity (0.01 m/s against some m/s changes k by its square, 1e-5).

use crate::estimate::{Estimate, Fit, Warning};
use crate::laboratory::flights::FlightSample;
use crate::regression::{FitError, Row, linear};
use crate::residual::Whiteness;

/// Drag along the two horizontal body axes.
#[derive(Clone, Debug, PartialEq)]
pub struct DragFit {
    /// `k_x`, N s²/m².
    pub forward: Estimate,
    /// `k_y`, N s²/m².
    pub right: Estimate,
    /// The regressions along x and y: parameters `[k_i/m, b_i]`.
    pub fits: [Fit<2>; 2],
}

impl DragFit {
    /// Warnings of both regressions.
    pub fn warnings(&self) -> Vec<Warning> {
        self.fits.iter().flat_map(|fit| fit.warnings.clone()).collect()
    }
}

/// Lags of the whiteness test.
const LAGS: usize = 20;

/// Fits drag along `x_B` and `y_B` for a vehicle of this mass, kg.
///
/// # Errors
/// Too few samples, a vehicle that did not move, numbers that are not finite.
pub fn identify_drag(samples: &[FlightSample], mass_kg: f64) -> Result<DragFit, FitError> {
    let forward = axis(samples, |s| (s.velocity_x_m_s, s.force_x_m_s2))?;
    let right = axis(samples, |s| (s.velocity_y_m_s, s.force_y_m_s2))?;
    let drag = |fit: &Fit<2>| fit.parameters[0].mapped(mass_kg * fit.parameters[0].value, mass_kg);
    Ok(DragFit {
        forward: drag(&forward),
        right: drag(&right),
        fits: [forward, right],
    })
}

fn axis(samples: &[FlightSample], of: fn(&FlightSample) -> (f64, f64)) -> Result<Fit<2>, FitError> {
    let row = |sample: &FlightSample| {
        let (velocity, force) = of(sample);
        Row {
            regressors: [-velocity.abs() * velocity, 1.0],
            y: force,
        }
    };
    let mut fit = linear(&samples.iter().map(row).collect::<Vec<_>>())?;
    let whiteness = Whiteness::test(&fit.residuals, LAGS);
    if !whiteness.is_white() {
        fit.warnings.push(Warning::CorrelatedResiduals {
            p_value: whiteness.p_value,
            lags: whiteness.autocorrelation.len(),
        });
    }
    Ok(fit)
}
