//! Figure 6.10: unit step in yaw, controller c1 on the family.

use super::settings;
use super::steps::{self, Quantity};
use crate::drawing::Drawing;
use crate::flight::{Law, Scenario};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use quad_dynamics::Level;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.10",
    title: "Unit step in yaw: c1 on the family",
    description: "A step of one radian in heading under controller c1, input limits off. Settling time designed: 2 s. Above the heading, below the yaw pseudo-input. The reaction torque of levels 4 and 5 contains the rotors' spin-up, which makes their yaw response lead that of the lower levels.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[],
    make: Make::Draw(draw),
};

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let scenario = Scenario::yaw_step(Law::C1, settings::flight(), 6.0);
    let outcomes = steps::fly(context, &scenario, Quantity::Yaw, &Level::ALL)?;
    let drawing = steps::drawing(&scenario, Quantity::Yaw, &outcomes)?;
    Ok(drawing)
}
