//! How much a vehicle's standard errors matter, to first order.
//!
//! ```text
//! e_k = ∂y/∂p_k σ_k        effect of one standard error of number k on a result y
//! σ_y² = Σ e_k²,   share of k = e_k² / σ_y²
//! ```
//!
//! Two ways to the effects. [`by_differentiation`]: dual numbers through model and rollout, exact. The way from a file to a vehicle
//! is affine (values, and differences of values), so its derivative is a difference of two vehicles, without truncation; from there
//! on everything is generic in the scalar. Trims are not: the commands of a hover are those of the nominal vehicle, constants. A flight
//! that begins in the nominal vehicle's hover begins in that of a model that was built without derivatives. [`by_differences`]: central differences, for results that are not generic in the scalar, such as a whole flight with its
//! controller; `e_k ≈ (y(p̂ + h σ_k) − y(p̂ − h σ_k)) / 2h`, off by `h²/6 σ³ ∂³y/∂p³`.
//!
//! Assumptions: independent errors (a file has no correlations), y close to linear over the standard errors; by how far it is
//! not shows against a Monte Carlo run ([`UncertainVehicle::draw`]). Source: law of propagation of uncertainty, JCGM 100:2008
//! (GUM), 5.1.2.
//!
//! ```
//! use nalgebra::Vector3;
//! use num_dual::Dual64;
//! use quad_dynamics::vehicle::{VehicleFile, builtin::QBALL_X4_TOML};
//! use quad_dynamics::{Level, Level2, QuadrotorModel, UncertainVehicle, VehicleError};
//! use quad_math::rk4_step;
//! use study::sensitivity;
//!
//! let mut file = VehicleFile::parse(QBALL_X4_TOML, "qball-x4")?;
//! file.airframe.mass.standard_error = Some(0.01);
//! let vehicle = UncertainVehicle::of(&file, "qball-x4")?;
//!
//! // Height lost in a second by the commands that hold the nominal vehicle: ½ g t² per share of the mass.
//! let [down] = sensitivity::by_differentiation(&vehicle, |parameters| {
//!     let phenomena = Level::Two.phenomena();
//!     let trim = Level2::<Dual64>::trim(vehicle.nominal(), &phenomena)?;
//!     let model = Level2::<Dual64>::build_trimmed(parameters, &phenomena, &trim)?;
//!     let hover = model.hover(Vector3::zeros(), 0.0.into());
//!     let mut state = hover.state;
//!     for _ in 0..100 {
//!         state = rk4_step(&model, &state, &hover.input, 0.01.into());
//!     }
//!     Ok::<_, Box<dyn std::error::Error>>([model.flight(&state).position.z])
//! })?;
//! assert!((down.standard_deviation() - 0.5 * 9.81 * 0.01 / 1.4).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[cfg(test)]
mod tests;

use num_dual::Dual64;
use quad_dynamics::{UncertainVehicle, Vehicle, VehicleError};

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

/// First-order uncertainty of N results by central differences: two evaluations per uncertain number.
///
/// # Errors
/// If a vehicle [`STEP`] standard errors off is not valid, or the results' own error.
pub fn by_differences<const N: usize, E: From<VehicleError>>(
    vehicle: &UncertainVehicle,
    mut results: impl FnMut(&Vehicle) -> Result<[f64; N], E>,
) -> Result<[FirstOrder; N], E> {
    let count = vehicle.numbers().len();
    gather(count, |k| {
        let [up, down] = deviations(count, k);
        let (above, below) = (results(&vehicle.at(&up)?)?, results(&vehicle.at(&down)?)?);
        Ok(std::array::from_fn(|i| effect(above[i], below[i])))
    })
}

/// First-order uncertainty of N results by automatic differentiation: one evaluation over dual numbers per uncertain number. A
/// model takes the vehicle that it gets in [`quad_dynamics::QuadrotorModel::build_trimmed`].
///
/// # Errors
/// If a vehicle [`STEP`] standard errors off is not valid, or the results' own error.
pub fn by_differentiation<const N: usize, E: From<VehicleError>>(
    vehicle: &UncertainVehicle,
    mut results: impl FnMut(&Vehicle<Dual64>) -> Result<[Dual64; N], E>,
) -> Result<[FirstOrder; N], E> {
    gather(vehicle.numbers().len(), |k| {
        Ok(results(&differentiable(vehicle, k)?)?.map(|result| result.eps))
    })
}

/// The nominal vehicle over dual numbers, with its derivatives by the deviation of number k in standard errors; without derivatives
/// if there is no such number.
///
/// # Errors
/// If a vehicle [`STEP`] standard errors off is not valid.
pub fn differentiable(vehicle: &UncertainVehicle, k: usize) -> Result<Vehicle<Dual64>, VehicleError> {
    let [up, down] = deviations(vehicle.numbers().len(), k);
    let (above, below) = (numbers(&vehicle.at(&up)?), numbers(&vehicle.at(&down)?));
    // The reader is affine in the numbers: a difference is its derivative.
    let mut derivatives = above.into_iter().zip(below).map(|(a, b)| effect(a, b));
    let dual = |value| Dual64::new(value, derivatives.next().unwrap_or(0.0));
    Ok(vehicle.nominal().map(dual))
}

/// All numbers of a vehicle, in the order of [`Vehicle::map`].
fn numbers(vehicle: &Vehicle) -> Vec<f64> {
    let mut all = Vec::new();
    let _: Vehicle<()> = vehicle.map(|value| all.push(value));
    all
}

/// Effects of each number, result by result.
fn gather<const N: usize, E>(
    count: usize,
    mut effects_of: impl FnMut(usize) -> Result<[f64; N], E>,
) -> Result<[FirstOrder; N], E> {
    let mut all = std::array::from_fn(|_| FirstOrder {
        effects: Vec::with_capacity(count),
    });
    for k in 0..count {
        for (result, effect) in all.iter_mut().zip(effects_of(k)?) {
            result.effects.push(effect);
        }
    }
    Ok(all)
}
