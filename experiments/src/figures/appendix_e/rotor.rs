//! Figures E.4 to E.7: the static characterisation of one of the four rotors.

use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::item::{Context, ItemError};
use crate::plot::Figure;
use crate::rotor_bench::{RotorBench, panels};
use sysid::rotor_static::Quantity;

pub(super) const DESCRIPTION: &str = "Thrust and reaction torque of one rotor against PWM duty at three battery voltages (virtual \
                                      thrust stand, twenty readings a point), with the cubics of table 4.4. The four rotors differ from the \
                                      nominal one at random, by a few percent in motor and propeller.";

pub(super) const STATED: Claim =
    Claim::holds("fit residuals and coefficients with 95 % intervals are stated");
pub(super) const TRUTH: Claim =
    Claim::holds("the polynomials meet this rotor's true curves within 2 % of the largest value");

/// The figure of one rotor, counted from 0.
pub(super) fn draw(context: &Context, index: usize) -> Result<Drawing, ItemError> {
    let bench = RotorBench::default();
    let vehicle = bench.vehicle(context)?;
    let rotor = bench.four(&vehicle)?[index];
    let found = bench.characterise(&rotor)?;
    let minimum = rotor.stand.minimum_duty;
    let quantities = [Quantity::Thrust, Quantity::Torque];
    let figure = quantities.iter().fold(Figure::columns(2), |figure, &quantity| {
        figure.panel(panels::against_duty(&bench, minimum, &found, quantity))
    });
    let truth = rotor.noiseless(&found.samples);
    let off = quantities.map(|quantity| {
        let largest = truth.iter().map(|s| s.of(quantity)).fold(0.0, f64::max);
        let error = |s| {
            found
                .cubic(quantity)
                .value(sysid::rotor_static::StaticSample::effective(s, minimum))
                - s.of(quantity)
        };
        truth.iter().map(|s| error(s).abs()).fold(0.0, f64::max) / largest
    });
    let (thrust, torque) = (&found.thrust, &found.torque);
    let terms = |fit: &sysid::Fit<3>, scale: f64| {
        let each = fit
            .parameters
            .map(|k| format!("{:.2} ± {:.2}", scale * k.value, scale * k.half_width()));
        each.join(", ")
    };
    Ok(Drawing::picture(figure.draw())
        .data(panels::table(&found, minimum))
        .settings(&bench)?
        .check(
            STATED,
            [thrust, torque].iter().all(|f| f.parameters.iter().all(|k| k.half_width() > 0.0)),
            format!(
                "residual standard deviation {:.3} N and {:.2} mN m; k_1, k_2, k_3 of thrust (N/V, /V², /V³) {}; of torque (mN m) {}",
                thrust.goodness.standard_deviation,
                1e3 * torque.goodness.standard_deviation,
                terms(thrust, 1.0),
                terms(torque, 1e3)
            ),
        )
        .check(
            TRUTH,
            off.iter().all(|o| *o < 0.02),
            format!("furthest {:.2} % (thrust), {:.2} % (torque)", 100.0 * off[0], 100.0 * off[1]),
        ))
}
