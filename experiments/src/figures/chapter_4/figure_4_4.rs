//! Figure 4.4: support data, planes, lines and the centre of mass from them.

use super::support_pictures::{close, whole};
use super::supports;
use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::Figure;
use crate::plot::figure::Legends;
use sysid::laboratory::supports::SupportRig;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "4.4",
    title: "Support data, planes, lines and the centre of mass",
    description: "Five placings in each of two orientations in the virtual laboratory: scales that read to 0.01 N, points \
                  measured to 0.5 mm, planes levelled to 0.1°. (a) Support points, planes and lines; (b) the lines where they meet, with \
                  the 95 % intervals of the centre of mass along the airframe's axes and the true centre.",
    kind: Kind::Plot,
    origin: Origin::VirtualLaboratory,
    claims: &[INSIDE],
    make: Make::Draw(draw),
};

const INSIDE: Claim = Claim::holds(
    "true centre inside the reported interval: in at least 88 % of the 300 intervals of 100 tests with other noise",
);

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let test = supports::test(context, SupportRig::default())?;
    let found = &test.found;
    let truth = test.vehicle.airframe.centre_of_mass;
    let share = supports::coverage(context)?.centre;
    let words: Vec<String> = found
        .position
        .iter()
        .zip(truth.iter())
        .map(|(p, t)| {
            format!(
                "{:.2} ± {:.2} mm (true {:.2})",
                1e3 * p.value,
                1e3 * p.half_width(),
                1e3 * t
            )
        })
        .collect();
    let mut drawing = Drawing::picture(
        Figure::columns(2)
            .legends(Legends::EachPanel)
            .panel_size(310.0, 300.0)
            .panel(whole(&test))
            .panel(close(found, &truth))
            .draw(),
    );
    for warning in &found.warnings {
        drawing = drawing.note(warning.to_string());
    }
    Ok(drawing
        .data(supports::table(&test.placings))
        .settings(&test.settings)?
        .check(
            INSIDE,
            supports::EXPECTED.contains(&share),
            format!(
                "{:.1} % of them; here {}; lines miss it by {:.2} mm (standard deviation)",
                100.0 * share,
                words.join(", "),
                1e3 * found.goodness.standard_deviation
            ),
        ))
}
