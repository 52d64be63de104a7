//! Figure 6.4: unit step in height, controller c1 on all levels, without limits.

use super::settings;
use super::steps::{self, Quantity};
use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::flight::{Law, Scenario};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use quad_dynamics::Level;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.4",
    title: "Unit step in height: c1 on the family",
    description: "A step of one metre in height under controller c1 on every level, input limits off. Settling time designed: 1 s. Above the height, below the collective pseudo-input.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[COINCIDE],
    make: Make::Draw(draw),
};

const COINCIDE: Claim = Claim::holds("levels 1 and 2 coincide");

/// Rounding of a few seconds of RK4 steps on numbers of order one.
const SAME: f64 = 1e-9;

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let scenario = Scenario::height_step(Law::C1, settings::height(settings::HEIGHT_SETTLING_S), 5.0);
    let outcomes = steps::fly(context, &scenario, Quantity::Height, &Level::ALL)?;
    let apart = steps::distance(
        &outcomes[0].response(Quantity::Height),
        &outcomes[1].response(Quantity::Height),
    );
    let drawing = steps::drawing(&scenario, Quantity::Height, &outcomes)?;
    Ok(drawing.check(COINCIDE, apart < SAME, format!("largest distance {apart:.1e} m")))
}
