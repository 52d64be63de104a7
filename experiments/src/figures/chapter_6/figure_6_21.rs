//! Figure 6.21: dynamic inversion against PID, height and pseudo-input.

use super::comparison::{self, StepShown};
use super::settings;
use crate::drawing::Drawing;
use crate::flight::Scenario;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.21",
    title: "NDI against PID: step in height",
    description: "A step of one metre in height on level 5 with limits, under controller c3 and under cascaded PID tuned there \
                  for the same settling time of 2 s, with a set-point weight of ½ lest its integral overshoot. Above the response; below, on an \
                  axis of its own, the first second of the collective pseudo-input.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[comparison::AS_TUNED],
    make: Make::Draw(draw),
};

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    comparison::step_drawing(
        context,
        Scenario::height_step,
        &StepShown {
            response: ("Height *h* = −*z*, m", |r| -r.flight.position.z),
            set_point: ("set point", |r| -r.reference.flat.position.z),
            input: ("Collective *u*_{col}", |r| r.pseudo_inputs[0]),
            designed_s: settings::flight().height.settling_time_s,
            input_until_s: 1.0,
        },
    )
}
