//! Figure 4.13: as 4.12 on a flight that nothing was fitted on.

use super::figure_4_12::{ROTATION, STATED, VERTICAL, rotation, stated, vertical};
use super::flights::{self, FITTED, UNSEEN};
use super::replays;
use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::figures::escaped;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "4.13",
    title: "Accelerations, flight test against simulation: an unseen flight",
    description: "As 4.12 with the same numbers, on the figure of eight at 1 m/s and on another charge of the battery: no part of the model was \
                  fitted on this flight.",
    kind: Kind::Plot,
    origin: Origin::MeasuredAndSimulated,
    claims: &[UNFITTED, STATED, VERTICAL, ROTATION],
    make: Make::Draw(draw),
};

const UNFITTED: Claim = Claim::holds("the model was not fitted on this flight");
fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let study = flights::study(context, UNSEEN)?;
    // The recordings themselves, not their names: a copy under another name would be noticed.
    let unfitted = study.flight.position != study.calibrated_on.position;
    let stated = stated(&study)?;
    let vertical = vertical(&study)?;
    let rotation = rotation(&study)?;
    Ok(replays::drawing(&study, UNSEEN)?
        .check(
            UNFITTED,
            unfitted,
            format!(
                "fitted on the ARPL flights and on {} ({:.2} V on average), drawn: {} ({:.2} V)",
                escaped(FITTED),
                study.calibration.voltage,
                escaped(UNSEEN),
                mean_voltage(&study)
            ),
        )
        .check(STATED, stated.pass, stated.measured)
        .check(VERTICAL, vertical.pass, vertical.measured)
        .check(ROTATION, rotation.pass, rotation.measured))
}

fn mean_voltage(study: &flights::Study) -> f64 {
    let samples = study
        .flight
        .inertial
        .window(flights::WINDOW.start, flights::WINDOW.end);
    let voltage = &study.flight.voltage[samples];
    voltage.iter().sum::<f64>() / voltage.len() as f64
}
