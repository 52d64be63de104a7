//! Figure 6.11: unit step in yaw, controller c2 on levels 2 to 5.

use super::settings;
use super::steps::{self, Quantity};
use crate::drawing::Drawing;
use crate::flight::{Law, Scenario};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use quad_dynamics::Level;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.11",
    title: "Unit step in yaw: c2 on levels 2 to 5",
    description: "A step of one radian in heading under controller c2, input limits off. Settling time designed: 2 s. Above the heading, below the yaw pseudo-input.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[],
    make: Make::Draw(draw),
};

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let scenario = Scenario::yaw_step(Law::C2, settings::flight(), 6.0);
    let outcomes = steps::fly(context, &scenario, Quantity::Yaw, &Level::ALL[1..])?;
    let drawing = steps::drawing(&scenario, Quantity::Yaw, &outcomes)?;
    Ok(drawing)
}
