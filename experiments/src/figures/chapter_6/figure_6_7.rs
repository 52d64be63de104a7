//! Figure 6.7: unit step in height, controller c2 on levels 2 to 5.

use super::settings;
use super::steps::{self, Quantity};
use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::flight::{Law, Scenario};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use quad_dynamics::Level;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.7",
    title: "Unit step in height: c2 on levels 2 to 5",
    description: "As figure 6.4 with controller c2, which inverts the non-linear rigid body.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[DESIGN],
    make: Make::Draw(draw),
};

const DESIGN: Claim =
    Claim::holds("on its own level the controller gives the designed second-order response");

/// Commands are held for 1 ms, which delays a response of 5.8 rad/s by half a millisecond.
const HELD: f64 = 5e-3;

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let scenario = Scenario::height_step(Law::C2, settings::height(settings::HEIGHT_SETTLING_S), 5.0);
    let outcomes = steps::fly(context, &scenario, Quantity::Height, &Level::ALL[1..])?;
    let natural_frequency = scenario.settings.gains::<f64>()?.height.natural_frequency;
    let off = steps::distance_from_design(&outcomes[0].response(Quantity::Height), natural_frequency);
    let drawing = steps::drawing(&scenario, Quantity::Height, &outcomes)?;
    Ok(drawing.check(
        DESIGN,
        off < HELD,
        format!("largest distance from the design {:.2} mm", 1e3 * off),
    ))
}
