//! Figure 6.23: dynamic inversion against PID, horizontal position and pseudo-input.

use super::comparison::{self, StepShown};
use super::settings;
use crate::drawing::Drawing;
use crate::flight::Scenario;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.23",
    title: "NDI against PID: step in horizontal position",
    description: "A step of one metre in *x* on level 5 with limits, under controller c3 and under cascaded PID tuned there \
                  for the same settling time of 5 s, with a set-point weight of ½ lest its integral overshoot. Above the response; below, on an \
                  axis of its own, the first two seconds of the longitudinal pseudo-input.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[comparison::AS_TUNED],
    make: Make::Draw(draw),
};

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    comparison::step_drawing(
        context,
        Scenario::position_step,
        &StepShown {
            response: ("Position *x*, m", |r| r.flight.position.x),
            set_point: ("set point", |r| r.reference.flat.position.x),
            input: ("Longitudinal *u*_{long}", |r| r.pseudo_inputs[2]),
            designed_s: settings::POSITION_SETTLING_S,
            input_until_s: 2.0,
        },
    )
}
