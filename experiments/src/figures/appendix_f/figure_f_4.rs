//! Figure F.4: inputs of figure F.3.

use super::sweep::{self, Varied};
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

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let varied = Varied::Damping;
    let runs = sweep::fly(context, varied)?;
    let labels = ["Longitudinal *u*_{long}", "Collective *u*_{col}"];
    let picture = sweep::picture(
        varied,
        &runs,
        labels,
        [|r| r.pseudo_inputs[2], |r| r.pseudo_inputs[0]],
        None,
        1.0,
    );
    Ok(Drawing::picture(picture)
        .data(sweep::table(varied, &runs))
        .scenario(&sweep::scenario(varied, runs[0].value))?
        .note("the scenario file has the first of the values; the others differ in this one setting"))
}
