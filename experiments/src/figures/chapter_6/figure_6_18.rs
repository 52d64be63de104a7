//! Figure 6.18: c1 following the reference trajectory on levels 1 to 5.

use super::paths;
use crate::drawing::Drawing;
use crate::flight::Law;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use quad_dynamics::Level;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.18",
    title: "Following a trajectory: c1 on levels 1 to 5",
    description: "The reference of figure 6.17 followed by controller c1 on levels 1 to 5, its derivatives fed forward, \
                  input limits off. Below, the distance from the reference. c1 takes body rates for rates of the Euler angles, \
                  which they are not while a tilted vehicle turns its heading: level 1, which c1 follows to a few millimetres at a steady heading, is off by that. \
                  Grey: projection on the ground.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[],
    make: Make::Draw(draw),
};

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let paths = paths::fly_levels(context, Law::C1, &Level::ALL)?;
    let drawing = Drawing::picture(paths::picture(&paths))
        .data(paths::table(&paths))
        .scenario(&paths::scenario(Law::C1))?;
    let straight = paths::steady_heading(paths::scenario(Law::C1));
    let log = straight.fly(context, Level::One)?;
    let largest = paths::largest_distance(&log);
    let drawing = paths::remarks(&paths).into_iter().fold(drawing, Drawing::note);
    Ok(drawing.note(format!(
        "the same path flown at a steady heading: level 1 within {:.2} mm",
        1e3 * largest
    )))
}
