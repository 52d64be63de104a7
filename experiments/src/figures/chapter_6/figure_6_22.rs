//! Figure 6.22: dynamic inversion against PID, yaw and pseudo-input.

use super::comparison::{self, Shown};
use crate::drawing::Drawing;
use crate::flight::Scenario;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.22",
    title: "NDI against PID: step in yaw",
    description: "A step of one radian in heading on level 5 with limits, under controller c3 and under cascaded PID tuned there \
                  for the same settling time. Above the response, below the yaw pseudo-input.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[],
    make: Make::Draw(draw),
};

const RESPONSE: Shown = ("Yaw *ψ*, rad", |r| r.flight.attitude.yaw);
const INPUT: Shown = ("Yaw input *u*_{yaw}", |r| r.pseudo_inputs[3]);
const SET_POINT: Shown = ("set point", |r| r.reference.flat.yaw);

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let pair = comparison::fly_step(context, Scenario::yaw_step)?;
    let picture = comparison::picture(&pair, 1, &[RESPONSE, INPUT], &[Some(SET_POINT)]);
    let drawing = Drawing::picture(picture)
        .data(comparison::table(&pair))
        .scenario(&pair.scenario)?;
    Ok(comparison::remarks(&pair, RESPONSE.1)
        .into_iter()
        .fold(drawing, Drawing::note))
}
