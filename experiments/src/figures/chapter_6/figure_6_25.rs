//! Figure 6.25: dynamic inversion against PID along the reference trajectory, outputs and inputs.

use super::comparison::{self, Shown};
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.25",
    title: "NDI against PID: outputs and inputs along a trajectory",
    description: "The flights of figure 6.24: the four outputs on the left with the reference, the four \
                  pseudo-inputs on the right. The reference is smooth to its fourth derivative; c3 feeds the fifth forward too, \
                  which jumps at the waypoints (3, 6, 9 and 12 s), and so do its lateral and longitudinal inputs.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[],
    make: Make::Draw(draw),
};

/// Outputs and pseudo-inputs, row by row.
const SHOWN: [Shown; 8] = [
    ("North *x*, m", |r| r.flight.position.x),
    ("Collective *u*_{col}", |r| r.pseudo_inputs[0]),
    ("East *y*, m", |r| r.flight.position.y),
    ("Lateral *u*_{lat}", |r| r.pseudo_inputs[1]),
    ("Height −*z*, m", |r| -r.flight.position.z),
    ("Longitudinal *u*_{long}", |r| r.pseudo_inputs[2]),
    ("Yaw *ψ*, rad", |r| unwrapped_yaw(r)),
    ("Yaw input *u*_{yaw}", |r| r.pseudo_inputs[3]),
];

const REFERENCE: [Option<Shown>; 8] = [
    Some(("reference", |r| r.reference.flat.position.x)),
    None,
    Some(("reference", |r| r.reference.flat.position.y)),
    None,
    Some(("reference", |r| -r.reference.flat.position.z)),
    None,
    Some(("reference", |r| r.reference.flat.yaw)),
    None,
];

/// The heading on the reference's turn of the circle, rad.
fn unwrapped_yaw(r: &quad_ndi::Record) -> f64 {
    use std::f64::consts::TAU;
    let error = r.reference.flat.yaw - r.flight.attitude.yaw;
    r.flight.attitude.yaw + (error / TAU).round() * TAU
}

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let pair = comparison::fly_trajectory(context)?;
    Ok(
        Drawing::picture(comparison::picture(&pair, 2, &SHOWN, &REFERENCE))
            .data(comparison::table(&pair, 0.0))
            .scenario(&pair.scenario)?,
    )
}
