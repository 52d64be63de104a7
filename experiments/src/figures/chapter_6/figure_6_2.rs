//! Figure 6.2: closed-loop height on levels 1 to 3, each under its own controller.

use super::steps::{self, Quantity};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::{Figure, Panel, level_name, level_style, reference_style};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.2",
    title: "Closed-loop height, levels 1 to 3, and the error of the extra pole",
    description: "Unit step in height on each of levels 1 to 3 under the controller derived from it. Levels 1 and 2 \
                  answer with two poles, level 3 with a third at *p*_{z} = 20 *ω*_{n,z}; the error \
                  *e*_{z} = *z*_{1/2} − *z*_{3} is what that pole costs. Designed settling time 2 s.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[SMALL],
    make: Make::Draw(draw),
};

const SMALL: Claim = Claim::holds("e_z = z_1/2 − z_3 is small: below 2 % of the step");

/// By hand: the pole delays by 1/p_z = 1/(20 ω), the step rises at most at ω/e, so e_z ≤ 1/(20 e) = 1.8 %.
const LARGEST_ERROR: f64 = 0.02 * steps::STEP;

/// End of the time axis, s: rest follows.
const SHOWN_S: f64 = 3.0;

fn draw(_: &Context) -> Result<Drawing, ItemError> {
    let flown = steps::fly("6.2", Quantity::Height)?;
    let heights = flown.responses();
    let times: Vec<f64> = heights[0].iter().map(|(t, _)| *t).collect();
    let columns: Vec<Vec<f64>> = heights
        .iter()
        .map(|h| h.iter().map(|(_, y)| *y).collect())
        .collect();
    // Heights are −z, so e_z = z_1 − z_3 = h_3 − h_1.
    let error: Vec<f64> = columns[2]
        .iter()
        .zip(&columns[0])
        .map(|(h3, h1)| h3 - h1)
        .collect();
    let mut above = Panel::new("Time *t*, s", Quantity::Height.label()).horizontal(steps::STEP, "");
    for (outcome, height) in flown.outcomes.iter().zip(&heights) {
        let number = outcome.number();
        above = above.line(level_name(number), level_style(number), height.iter().copied());
    }
    let below = Panel::new("Time *t*, s", "Error *e*_{z}, m").line(
        "",
        reference_style().dashed(""),
        times.iter().copied().zip(error.iter().copied()),
    );
    let largest = error.iter().fold(0.0_f64, |m, e| m.max(e.abs()));
    let figure = Figure::columns(1)
        .panel(above.x_range(0.0, SHOWN_S))
        .panel(below.x_range(0.0, SHOWN_S))
        .share_x()
        .panel_size(440.0, 180.0);
    Ok(Drawing::picture(figure.draw())
        .data(DataTable::from_columns(&[
            ("t_s", &times),
            ("height_m_level_1", &columns[0]),
            ("height_m_level_2", &columns[1]),
            ("height_m_level_3", &columns[2]),
            ("error_m", &error),
        ]))
        .scenario(flown.file())
        .check(
            SMALL,
            largest < LARGEST_ERROR,
            format!("largest |e_z| = {largest:.4} m"),
        ))
}
