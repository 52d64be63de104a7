//! Figures 4.8 and 4.9: the static characterisation of the nominal rotor, for thrust and for torque.

use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::item::{Context, ItemError};
use crate::plot::Figure;
use crate::rotor_bench::{RotorBench, panels};
use sysid::rotor_static::Quantity;

pub(super) const STATED: Claim =
    Claim::holds("fit residuals and coefficients with 95 % intervals are stated");
pub(super) const TRUTH: Claim =
    Claim::holds("the polynomial meets the rotor's true curve within 2 % of the largest value");
pub(super) const CUBIC: Claim = Claim::does_not_hold(
    "the residuals are noise: a cubic in the effective voltage describes the rotor",
    "a mechanistic rotor with friction and back-EMF is no polynomial, and twenty readings a point make that visible",
);

/// The figure of one quantity.
pub(super) fn draw(context: &Context, quantity: Quantity) -> Result<Drawing, ItemError> {
    let bench = RotorBench::default();
    let vehicle = bench.vehicle(context)?;
    let rotor = bench.nominal(&vehicle)?;
    let found = bench.characterise(&rotor)?;
    let minimum = rotor.stand.minimum_duty;
    let fit = found.fit(quantity);
    let figure = Figure::columns(2)
        .panel(panels::against_duty(&bench, minimum, &found, quantity))
        .panel(panels::residuals(&bench, minimum, &found, quantity));
    let truth = rotor.noiseless(&found.samples);
    let largest = truth.iter().map(|s| s.of(quantity)).fold(0.0, f64::max);
    let off = truth
        .iter()
        .map(|s| (found.cubic(quantity).value(s.effective(minimum)) - s.of(quantity)).abs())
        .fold(0.0, f64::max);
    let unit = match quantity {
        Quantity::Thrust => "N",
        Quantity::Torque => "N m",
    };
    let terms: Vec<String> = (1..)
        .zip(&fit.parameters)
        .map(|(i, k)| format!("k_{i} = {:.4} ± {:.4}", k.value, k.half_width()))
        .collect();
    let noise = fit.warnings.is_empty();
    Ok(Drawing::picture(figure.draw())
        .data(panels::table(&found, minimum))
        .settings(&bench)?
        .check(
            STATED,
            fit.goodness.standard_deviation > 0.0 && fit.parameters.iter().all(|k| k.half_width() > 0.0),
            format!(
                "residual standard deviation {:.2e} {unit}, largest {:.2e} {unit}; {} ({unit}/V, /V², /V³)",
                fit.goodness.standard_deviation,
                fit.goodness.largest_residual,
                terms.join(", ")
            ),
        )
        .check(
            TRUTH,
            off < 0.02 * largest,
            format!("furthest {off:.2e} {unit} of {largest:.3} {unit}"),
        )
        .check(
            CUBIC,
            noise,
            fit.warnings
                .iter()
                .map(ToString::to_string)
                .collect::<Vec<_>>()
                .join("; "),
        ))
}
