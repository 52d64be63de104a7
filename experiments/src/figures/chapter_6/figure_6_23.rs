//! Figure 6.23: dynamic inversion against PID, horizontal position and pseudo-input.

use super::comparison::{self, Shown};
use crate::drawing::Drawing;
use crate::flight::Scenario;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.23",
    title: "NDI against PID: step in horizontal position",
    description: "A step of one metre in *x* on level 5 with limits, under controller c3 and under cascaded PID tuned there \
                  for the same settling time. Above the response, below the longitudinal pseudo-input.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[],
    make: Make::Draw(draw),
};

const RESPONSE: Shown = ("Position *x*, m", |r| r.flight.position.x);
const INPUT: Shown = ("Longitudinal *u*_{long}", |r| r.pseudo_inputs[2]);
const SET_POINT: Shown = ("set point", |r| r.reference.flat.position.x);

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let pair = comparison::fly_step(context, Scenario::position_step)?;
    let picture = comparison::picture(&pair, 1, &[RESPONSE, INPUT], &[Some(SET_POINT)]);
    let drawing = Drawing::picture(picture)
        .data(comparison::table(&pair))
        .scenario(&pair.scenario)?;
    Ok(comparison::remarks(&pair, RESPONSE.1)
        .into_iter()
        .fold(drawing, Drawing::note))
}
