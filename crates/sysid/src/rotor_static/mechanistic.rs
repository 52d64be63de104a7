//! The propeller's coefficients, their dependence on speed and on the advance ratio.

use super::{Quantity, StaticError, StaticSample, inspected, positive};
use crate::estimate::{Estimate, Fit};
use crate::regression::{FitError, Row, linear};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// One steady reading of a propeller; a row of a CSV with these columns.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PropellerSample {
    /// Rotor speed Ω, rad/s.
    pub speed_rad_s: f64,
    /// Thrust T, N.
    pub thrust_n: f64,
    /// Torque Q, N m.
    pub torque_n_m: f64,
}

impl From<&StaticSample> for PropellerSample {
    fn from(sample: &StaticSample) -> Self {
        Self {
            speed_rad_s: sample.speed_rad_s,
            thrust_n: sample.thrust_n,
            torque_n_m: sample.torque_n_m,
        }
    }
}

impl PropellerSample {
    fn of(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::Thrust => self.thrust_n,
            Quantity::Torque => self.torque_n_m,
        }
    }
}

/// What makes coefficients of forces: size of the propeller, density of the air.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PropellerScale {
    /// Diameter D, m.
    pub diameter_m: f64,
    /// Air density ρ, kg/m³.
    pub air_density_kg_m3: f64,
}

impl PropellerScale {
    /// `ρ n² D⁴`, N, or `ρ n² D⁵`, N m, with `n = Ω/2π`: thrust or torque of a propeller whose coefficient is one.
    pub fn unit(&self, quantity: Quantity, speed_rad_s: f64) -> f64 {
        let power = match quantity {
            Quantity::Thrust => 4,
            Quantity::Torque => 5,
        };
        self.air_density_kg_m3 * (speed_rad_s / TAU).powi(2) * self.diameter_m.powi(power)
    }

    fn validate(&self) -> Result<(), StaticError> {
        positive("the propeller's diameter in m", self.diameter_m)?;
        positive("the air density in kg/m³", self.air_density_kg_m3)?;
        Ok(())
    }
}

/// The constant coefficient `C_T` or `C_Q`, dimensionless, by least squares on thrust or torque.
///
/// A warning of correlated residuals means that the coefficient depends on the speed: see [`speed_dependence`].
///
/// # Errors
/// Fewer than two samples, a rotor that never turns, numbers that are not finite, a size or density not positive.
pub fn coefficient(
    samples: &[PropellerSample],
    scale: &PropellerScale,
    quantity: Quantity,
) -> Result<Fit<1>, StaticError> {
    scale.validate()?;
    let rows: Vec<Row<1>> = samples
        .iter()
        .map(|s| Row {
            regressors: [scale.unit(quantity, s.speed_rad_s)],
            y: s.of(quantity),
        })
        .collect();
    Ok(over_speed(linear(&rows)?, samples, quantity))
}

/// How a coefficient may follow the speed, and with it the Reynolds number `Re ∝ Ω`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SpeedLaw {
    /// `C = c_0 + c_1 ln(Ω/Ω_ref)`.
    Logarithmic,
    /// `C = c_0 + c_1 (Ω/Ω_ref − 1)`.
    Linear,
}

impl SpeedLaw {
    /// What multiplies `c_1`.
    fn term(self, ratio: f64) -> f64 {
        match self {
            Self::Logarithmic => ratio.ln(),
            Self::Linear => ratio - 1.0,
        }
    }
}

/// A coefficient that depends on the speed.
#[derive(Clone, Debug, PartialEq)]
pub struct SpeedDependence {
    /// The law.
    pub law: SpeedLaw,
    /// Reference speed `Ω_ref`, rad/s.
    pub reference_rad_s: f64,
    /// Coefficient `c_0` at the reference speed.
    pub at_reference: Estimate,
    /// Slope `c_1`: change of the coefficient per relative change of the speed, at the reference.
    pub slope: Estimate,
    /// Probability of so steep a slope if the coefficient were constant.
    pub p_value: f64,
    /// The fit of thrust, N, or torque, N m.
    pub fit: Fit<2>,
}

impl SpeedDependence {
    /// The coefficient at a speed, rad/s.
    pub fn at(&self, speed_rad_s: f64) -> Estimate {
        let gradient = [1.0, self.law.term(speed_rad_s / self.reference_rad_s)];
        let value = self.at_reference.value + self.slope.value * gradient[1];
        self.fit.propagated(value, &gradient)
    }

    /// Whether the data reject a constant coefficient at a level of significance, such as 0.05.
    pub fn is_significant(&self, level: f64) -> bool {
        self.p_value < level
    }
}

/// Fits a coefficient that depends on the speed and tests whether it does.
///
/// # Errors
/// As [`coefficient`], and samples at one speed only; a speed or reference that is not positive.
pub fn speed_dependence(
    samples: &[PropellerSample],
    scale: &PropellerScale,
    quantity: Quantity,
    law: SpeedLaw,
    reference_rad_s: f64,
) -> Result<SpeedDependence, StaticError> {
    scale.validate()?;
    positive("the reference speed in rad/s", reference_rad_s)?;
    let row = |s: &PropellerSample| {
        let ratio = positive("a rotor speed in rad/s", s.speed_rad_s)? / reference_rad_s;
        let unit = scale.unit(quantity, s.speed_rad_s);
        Ok(Row {
            regressors: [unit, unit * law.term(ratio)],
            y: s.of(quantity),
        })
    };
    let rows: Vec<Row<2>> = samples.iter().map(row).collect::<Result<_, StaticError>>()?;
    let fit = over_speed(linear(&rows)?, samples, quantity);
    let [at_reference, slope] = fit.parameters;
    Ok(SpeedDependence {
        law,
        reference_rad_s,
        at_reference,
        slope,
        p_value: slope.p_value_against(0.0),
        fit,
    })
}

fn over_speed<const N: usize>(fit: Fit<N>, samples: &[PropellerSample], quantity: Quantity) -> Fit<N> {
    let speeds: Vec<f64> = samples.iter().map(|s| s.speed_rad_s).collect();
    let data: Vec<f64> = samples.iter().map(|s| s.of(quantity)).collect();
    inspected(fit, &speeds, &data)
}

/// One row of a propeller test in an axial stream; a row of a CSV with these columns.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AdvanceSample {
    /// Advance ratio `J = V/(n D)`, the stream against the thrust side (climb).
    pub advance_ratio: f64,
    /// Thrust coefficient `C_T`.
    pub thrust_coefficient: f64,
}

/// The line `C_T = c_0 + (dC_T/dJ) J`: parameters `[c_0, dC_T/dJ]`, dimensionless; the slope is negative on a working
/// propeller. Choose samples of small J: over the whole range the coefficient bends.
///
/// # Errors
/// Fewer than three samples, samples at one advance ratio only, numbers that are not finite.
pub fn advance_slope(samples: &[AdvanceSample]) -> Result<Fit<2>, FitError> {
    let rows: Vec<Row<2>> = samples
        .iter()
        .map(|s| Row {
            regressors: [1.0, s.advance_ratio],
            y: s.thrust_coefficient,
        })
        .collect();
    let ratios: Vec<f64> = samples.iter().map(|s| s.advance_ratio).collect();
    let data: Vec<f64> = samples.iter().map(|s| s.thrust_coefficient).collect();
    Ok(inspected(linear(&rows)?, &ratios, &data))
}
