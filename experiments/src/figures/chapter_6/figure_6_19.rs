//! Figure 6.19: c2 following the reference trajectory on levels 2 to 5.

use super::paths;
use crate::drawing::Drawing;
use crate::flight::Law;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use quad_dynamics::Level;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.19",
    title: "Following a trajectory: c2 on levels 2 to 5",
    description: "The reference of figure 6.17 followed by controller c2 on levels 2 to 5, its derivatives fed forward, \
                  input limits off. Below, the distance from the reference. Grey: projection on the ground.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[],
    make: Make::Draw(draw),
};

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let paths = paths::fly_levels(context, Law::C2, &Level::ALL[1..])?;
    let drawing = Drawing::picture(paths::picture(&paths))
        .data(paths::table(&paths))
        .scenario(&paths::scenario(Law::C2))?;
    let drawing = paths::remarks(&paths).into_iter().fold(drawing, Drawing::note);
    Ok(drawing)
}
