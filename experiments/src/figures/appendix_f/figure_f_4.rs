//! Figure F.4: inputs of figure F.3.

use super::sweep::{self, Shown, Varied};
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "F.4",
    title: "Inputs of figure F.3",
    description: "Pseudo-inputs of the flights of figure F.3: longitudinal above, collective below, which stays at hover because level 1 does not couple height and attitude. The first second, after which less than a hundredth of each peak is left.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[],
    make: Make::Draw(draw),
};

fn draw(_: &Context) -> Result<Drawing, ItemError> {
    let sweep = sweep::fly(Varied::Damping)?;
    let shown = Shown {
        labels: ["Longitudinal *u*_{long}", "Collective *u*_{col}"],
        quantities: [|row| row.pseudo_inputs[2], |row| row.pseudo_inputs[0]],
        step: None,
        until_s: 1.0,
    };
    Ok(sweep.drawing(&shown))
}
