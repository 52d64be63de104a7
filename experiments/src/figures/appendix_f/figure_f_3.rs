//! Figure F.3: step in x on level 1: attitude damping varied.

use super::sweep::{self, Shown, Varied};
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "F.3",
    title: "Step in *x* on level 1: attitude damping varied",
    description: "Unit step in *x* on level 1 under c1 with *ζ*_{p} = 1, *ω*_{n,a} = 10 *ω*_{n,p}, *τ*_{s,p} = 2 s: the damping of the attitude loop. Above the position, below the pitch that moves it.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[],
    make: Make::Draw(draw),
};

fn draw(_: &Context) -> Result<Drawing, ItemError> {
    let sweep = sweep::fly(Varied::Damping)?;
    let shown = Shown {
        labels: ["Position *x*, m", "Pitch *θ*, rad"],
        quantities: [|row| row.position.x, |row| row.attitude.pitch],
        step: Some(1.0),
        until_s: 3.0,
    };
    Ok(sweep.drawing(&shown))
}
