//! Figure 6.8: unit step in height, controller c3 on levels 3 to 5.

use super::settings;
use super::steps::{self, Quantity};
use crate::drawing::Drawing;
use crate::flight::{Law, Scenario};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use quad_dynamics::Level;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.8",
    title: "Unit step in height: c3 on levels 3 to 5",
    description: "As figure 6.4 with controller c3, which inverts the rotor's lag too; its extra pole lies at *p*_{z} = 20 *ω*_{n,z}. Levels 4 and 5 are flown with the controller's own rotor observer. The input is cut where its first spike, up to 1.50, would hide the rest.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[],
    make: Make::Draw(draw),
};

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let scenario = Scenario::height_step(Law::C3, settings::height(settings::HEIGHT_SETTLING_S), 5.0);
    let outcomes = steps::fly(context, &scenario, Quantity::Height, &Level::ALL[2..])?;
    let drawing = steps::drawing(&scenario, Quantity::Height, &outcomes)?;
    Ok(drawing)
}
