//! How much a vehicle's standard errors matter, to first order.
//!
//! ```text
//! e_k = (y(p̂ + h σ_k) − y(p̂ − h σ_k)) / 2h ≈ ∂y/∂p_k σ_k        effect of one standard error
//! σ_y² = Σ e_k²,   share of k = e_k² / σ_y²
//! ```
//!
//! y is any number that follows from a vehicle: a state at the end of a rollout, a metric of a whole flight with its controller. The
//! derivatives are central differences over the numbers of the *file*, not automatic differentiation: the way from the file to a
//! model goes through checks and a trim that are not generic in the scalar, and a flight's metrics have maxima. Their error is
//! `h²/6 σ³ ∂³y/∂p³`. Assumptions: independent errors (a file has no correlations), y close to linear over the standard errors; by how
//! far it is not shows against a Monte Carlo run ([`UncertainVehicle::draw`]).
//!
//! Source: Taylor series of first order, JCGM 100:2008 (GUM), 5.1.2.

use crate::{UncertainVehicle, Vehicle, VehicleError};

/// Step h, in standard errors. Half of one: a quarter of a whole one's error of third order, and still large against
/// the rounding of a flight and against a metric's time grid.
pub const STEP: f64 = 0.5;

/// What one standard error of each number does to a result.
#[derive(Debug, Clone, PartialEq)]
pub struct FirstOrder {
    /// Effect `∂y/∂p_k σ_k` of each number, in the result's unit, in the order of [`UncertainVehicle::numbers`].
    pub effects: Vec<f64>,
}

impl FirstOrder {
    /// Standard deviation of the result σ_y, in its unit.
    #[must_use]
    pub fn standard_deviation(&self) -> f64 {
        self.variance().sqrt()
    }

    /// Share of each number in the variance, together 1; all 0 if none has an effect.
    #[must_use]
    pub fn shares(&self) -> Vec<f64> {
        let variance = self.variance();
        let share = |effect: &f64| {
            if variance > 0.0 {
                effect.powi(2) / variance
            } else {
                0.0
            }
        };
        self.effects.iter().map(share).collect()
    }

    fn variance(&self) -> f64 {
        self.effects.iter().map(|effect| effect.powi(2)).sum()
    }
}

/// The effect of one standard error from the results at ±[`STEP`] standard errors.
#[must_use]
pub fn effect(above: f64, below: f64) -> f64 {
    (above - below) / (2.0 * STEP)
}

/// The deviations at which [`effect`] is taken: only number k off its value, by [`STEP`] up or down.
#[must_use]
pub fn deviations(numbers: usize, k: usize) -> [Vec<f64>; 2] {
    [STEP, -STEP].map(|step| (0..numbers).map(|i| if i == k { step } else { 0.0 }).collect())
}

/// First-order uncertainty of N results of a vehicle, by two evaluations per uncertain number.
///
/// # Errors
/// If a vehicle half a standard error off is not valid, or the results' own error.
pub fn first_order<const N: usize, E: From<VehicleError>>(
    vehicle: &UncertainVehicle,
    mut results: impl FnMut(&Vehicle) -> Result<[f64; N], E>,
) -> Result<[FirstOrder; N], E> {
    let count = vehicle.numbers().len();
    let mut effects: [Vec<f64>; N] = std::array::from_fn(|_| Vec::with_capacity(count));
    for k in 0..count {
        let [up, down] = deviations(count, k);
        let (above, below) = (results(&vehicle.at(&up)?)?, results(&vehicle.at(&down)?)?);
        for (all, (above, below)) in effects.iter_mut().zip(above.into_iter().zip(below)) {
            all.push(effect(above, below));
        }
    }
    Ok(effects.map(|effects| FirstOrder { effects }))
}
