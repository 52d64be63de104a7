//! Figure F.2: inputs of figure F.1.

use super::sweep::{self, Shown, Varied};
use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "F.2",
    title: "Inputs of figure F.1",
    description: "Pseudo-inputs of the flights of figure F.1: longitudinal above, collective below, which stays at hover because level 1 does not couple height and attitude. The first three seconds: a slow attitude loop works longer.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[LARGER],
    make: Make::Draw(draw),
};

const LARGER: Claim = Claim::holds("a larger ratio needs larger inputs");

fn draw(_: &Context) -> Result<Drawing, ItemError> {
    let sweep = sweep::fly(Varied::FrequencyRatio)?;
    let largest: Vec<f64> = sweep.runs.iter().map(sweep::Run::largest_input).collect();
    let shown = Shown {
        labels: ["Longitudinal *u*_{long}", "Collective *u*_{col}"],
        quantities: [|row| row.pseudo_inputs[2], |row| row.pseudo_inputs[0]],
        step: None,
        until_s: 3.0,
    };
    Ok(sweep.drawing(&shown).check(
        LARGER,
        largest.is_sorted_by(|a, b| a < b),
        format!("largest |u_long| for ratios 3, 5, 10, 20: {largest:.3?}"),
    ))
}
