//! Figure 6.9: unit step in height, controller c3 on levels 3 to 5, with limits.

use super::settings;
use super::steps::{self, Quantity};
use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::flight::{Law, Scenario};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use quad_dynamics::Level;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.9",
    title: "Unit step in height: c3 on levels 3 to 5, inputs limited",
    description: "As figure 6.8 with the rotor commands limited to the vehicle's PWM range.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[INSIDE],
    make: Make::Draw(draw),
};

const INSIDE: Claim = Claim::holds("inputs stay inside the limits");

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let scenario = Scenario {
        input_limits: true,
        ..Scenario::height_step(Law::C3, settings::height(settings::HEIGHT_SETTLING_S), 5.0)
    };
    let outcomes = steps::fly(context, &scenario, Quantity::Height, &Level::ALL[2..])?;
    let range = scenario.vehicle(context)?.zeroed_range();
    let excess = steps::largest_excess(&outcomes, &range);
    let drawing = steps::drawing(&scenario, Quantity::Height, &outcomes)?;
    Ok(drawing.check(
        INSIDE,
        excess <= 0.0,
        format!("largest command beyond a limit {excess:.1e}"),
    ))
}
