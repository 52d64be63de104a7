//! Figure 6.12: unit step in yaw, controller c3 on levels 3 to 5.

use super::settings;
use super::steps::{self, Quantity};
use crate::drawing::Drawing;
use crate::flight::{Law, Scenario};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use quad_dynamics::Level;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.12",
    title: "Unit step in yaw: c3 on levels 3 to 5",
    description: "A step of one radian in heading under controller c3, input limits off. Settling time designed: 2 s. Above the heading, below the yaw pseudo-input, cut where its first spike, up to 0.31, would hide the rest.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[],
    make: Make::Draw(draw),
};

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let scenario = Scenario::yaw_step(Law::C3, settings::flight(), 6.0);
    let outcomes = steps::fly(context, &scenario, Quantity::Yaw, &Level::ALL[2..])?;
    let drawing = steps::drawing(&scenario, Quantity::Yaw, &outcomes)?;
    Ok(drawing)
}
