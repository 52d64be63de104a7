//! Figure F.3: step in x on level 1: attitude damping varied.

use super::sweep::{self, Varied};
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

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let varied = Varied::Damping;
    let runs = sweep::fly(context, varied)?;
    let labels = ["Position *x*, m", "Pitch *θ*, rad"];
    let picture = sweep::picture(
        varied,
        &runs,
        labels,
        [|r| r.flight.position.x, |r| r.flight.attitude.pitch],
        Some(1.0),
        3.0,
    );
    Ok(Drawing::picture(picture)
        .data(sweep::table(varied, &runs))
        .scenario(&sweep::scenario(varied, runs[0].value))?
        .note("the scenario file has the first of the values; the others differ in this one setting"))
}
