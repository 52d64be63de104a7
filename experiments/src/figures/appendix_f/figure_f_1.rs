//! Figure F.1: step in x on level 1: frequency ratio varied.

use super::sweep::{self, Shown, Varied};
use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "F.1",
    title: "Step in *x* on level 1: frequency ratio varied",
    description: "Unit step in *x* on level 1 under c1 with *ζ*_{p} = 1, *ζ*_{a} = 1, *τ*_{s,p} = 2 s: the attitude loop's natural frequency as a multiple of the position loop's (legend). Above the position, below the pitch that moves it.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[CHANGES],
    make: Make::Draw(draw),
};

const CHANGES: Claim = Claim::holds("the ratio changes the response");

/// Difference between responses that a reader of the figure can see: a hundredth of the step.
const VISIBLE_M: f64 = 0.01;

fn draw(_: &Context) -> Result<Drawing, ItemError> {
    let sweep = sweep::fly(Varied::FrequencyRatio)?;
    let slow = sweep.runs[0].position();
    let apart = sweep.runs[1..]
        .iter()
        .map(|run| {
            run.position()
                .iter()
                .zip(&slow)
                .map(|(a, b)| (a.1 - b.1).abs())
                .fold(0.0, f64::max)
        })
        .fold(f64::INFINITY, f64::min);
    let shown = Shown {
        labels: ["Position *x*, m", "Pitch *θ*, rad"],
        quantities: [|row| row.position.x, |row| row.attitude.pitch],
        step: Some(1.0),
        until_s: 5.0,
    };
    Ok(sweep.drawing(&shown).check(
        CHANGES,
        apart > VISIBLE_M,
        format!("every response is at least {apart:.3} m from that of the smallest ratio"),
    ))
}
