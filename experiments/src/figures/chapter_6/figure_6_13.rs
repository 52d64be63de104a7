//! Figure 6.13: unit step in horizontal position, controller c1 on the family.

use super::settings;
use super::steps::{self, Quantity};
use crate::drawing::Drawing;
use crate::flight::{Law, Scenario};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use quad_dynamics::Level;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.13",
    title: "Unit step in horizontal position: c1 on the family",
    description: "A step of one metre in *x* under controller c1, input limits off. Above the position, then its difference from level 1, pitch and longitudinal pseudo-input. Settling time designed: 5 s, *ω*_{n,a} = 10 *ω*_{n,p} = 11.7 rad/s, which leaves a margin to the limits of the Routh array above level 3.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[],
    make: Make::Draw(draw),
};

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let scenario = Scenario::position_step(Law::C1, settings::flight(), 8.0);
    let outcomes = steps::fly(context, &scenario, Quantity::X, &Level::ALL)?;
    let drawing = steps::drawing(&scenario, Quantity::X, &outcomes)?;
    Ok(drawing)
}
