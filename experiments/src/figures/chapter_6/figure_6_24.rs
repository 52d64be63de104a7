//! Figure 6.24: dynamic inversion against PID along the reference trajectory.

use super::comparison;
use super::paths::{self, Path};
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.24",
    title: "NDI against PID: following a trajectory",
    description: "The reference of figure 6.17 on level 5 with limits, under controller c3 with its feed-forward and \
                  under cascaded PID, which gets position, heading and their first derivatives. Below, the distance from the reference. Grey: projection on the ground.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[],
    make: Make::Draw(draw),
};

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let pair = comparison::fly_trajectory(context)?;
    let path = |(name, look, log): (&str, crate::plot::Look, quad_ndi::FlightLog)| Path {
        name: name.to_owned(),
        column: name.to_owned(),
        look,
        log,
    };
    let scenario = pair.scenario;
    let paths = pair.flights.map(path);
    let drawing = Drawing::picture(paths::picture(&paths))
        .data(paths::table(&paths))
        .scenario(&scenario)?;
    Ok(paths::remarks(&paths).into_iter().fold(drawing, Drawing::note))
}
