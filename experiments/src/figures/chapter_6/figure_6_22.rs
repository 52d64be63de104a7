//! Figure 6.22: dynamic inversion against PID, yaw and pseudo-input.

use super::comparison::{self, StepShown};
use super::settings;
use crate::drawing::Drawing;
use crate::flight::Scenario;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.22",
    title: "NDI against PID: step in yaw",
    description: "A step of one radian in heading on level 5 with limits, under controller c3 and under cascaded PID tuned there \
                  for the same settling time of 2 s, with a set-point weight of ½ lest its integral overshoot. Above the response; below, on an \
                  axis of its own, the first second of the yaw pseudo-input.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[comparison::AS_TUNED],
    make: Make::Draw(draw),
};

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    comparison::step_drawing(
        context,
        Scenario::yaw_step,
        &StepShown {
            response: ("Yaw *ψ*, rad", |r| r.flight.attitude.yaw),
            set_point: ("set point", |r| r.reference.flat.yaw),
            input: ("Yaw input *u*_{yaw}", |r| r.pseudo_inputs[3]),
            designed_s: settings::flight().yaw.settling_time_s,
            input_until_s: 1.0,
        },
    )
}
