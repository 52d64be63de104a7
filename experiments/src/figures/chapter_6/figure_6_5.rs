//! Figure 6.5: unit step in height, controller c1 on all levels, with limits.

use super::settings;
use super::steps::{self, Outcome, Quantity, rise_time_s};
use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::flight::{Law, Scenario};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use quad_dynamics::Level;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.5",
    title: "Unit step in height: c1 on the family, inputs limited",
    description: "As figure 6.4 with the rotor commands limited to the vehicle's PWM range, in the controller and in every model.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[INSIDE, SLOWER],
    make: Make::Draw(draw),
};

const INSIDE: Claim = Claim::holds("inputs stay inside the limits");
const SLOWER: Claim =
    Claim::holds("the response is slower than in figure 6.4: every level rises to 90 % later");

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let free = Scenario::height_step(Law::C1, settings::height(settings::HEIGHT_SETTLING_S), 5.0);
    let scenario = Scenario {
        input_limits: true,
        ..free.clone()
    };
    let outcomes = steps::fly(context, &scenario, Quantity::Height, &Level::ALL)?;
    let unlimited = steps::fly(context, &free, Quantity::Height, &Level::ALL)?;
    let range = scenario.vehicle(context)?.zeroed_range();
    let excess = steps::largest_excess(&outcomes, &range);
    let rise = |o: &Outcome| rise_time_s(&o.response(Quantity::Height));
    let delays: Vec<f64> = outcomes
        .iter()
        .zip(&unlimited)
        .map(|(l, f)| rise(l) - rise(f))
        .collect();
    let drawing = steps::drawing(&scenario, Quantity::Height, &outcomes)?;
    Ok(drawing
        .check(
            INSIDE,
            excess <= 0.0,
            format!("largest command beyond a limit {excess:.1e}"),
        )
        .check(
            SLOWER,
            delays.iter().all(|d| *d > 0.0),
            format!("delays of levels 1 to 5: {delays:.3?} s"),
        ))
}
