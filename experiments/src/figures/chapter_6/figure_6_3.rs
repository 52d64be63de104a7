//! Figure 6.3: closed-loop horizontal position on levels 1 to 3, each under its own controller.

use super::steps::{self, Quantity};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::{Figure, Panel, level_name, level_style, reference_style};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.3",
    title: "Closed-loop horizontal position, levels 1 to 3, and the error against the design",
    description: "Unit step in *x* on each of levels 1 to 3 under the controller derived from it, with the attitude \
                  loop ten times as fast as the position loop and a designed settling time of 2 s. The error \
                  *e*_{x} = *x*_{des} − *x*_{i} is against the second-order response that the position loop \
                  alone would give: it is what the attitude loop costs.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[SMALL],
    make: Make::Draw(draw),
};

const SMALL: Claim = Claim::holds("e_x stays small: below 10 % of the step");

/// By hand: the attitude loop delays by 2 ζ_a/ω_a = 0.2/ω_p, the step rises at most at ω_p/e, so e_x is near
/// 0.2/e = 7.4 % of the step, and level 3's extra pole adds a tenth of that.
const LARGEST_ERROR: f64 = 0.1 * steps::STEP;

fn draw(_: &Context) -> Result<Drawing, ItemError> {
    let flown = steps::fly("6.3", Quantity::X)?;
    let gains = flown.outcomes[0].flight.settings.gains::<f64>()?;
    let omega = gains.position.natural_frequency;
    let mut above = Panel::new("Time *t*, s", Quantity::X.label()).horizontal(steps::STEP, "set point");
    let mut below = Panel::new("Time *t*, s", "Error *e*_{x}, m");
    let (mut names, mut columns, mut largest) = (vec!["t_s".to_owned()], Vec::new(), Vec::new());
    for outcome in &flown.outcomes {
        let number = outcome.number();
        let response = outcome.response(Quantity::X);
        let error: Vec<(f64, f64)> = response
            .iter()
            .map(|&(t, x)| (t, steps::design(omega, t) - x))
            .collect();
        if columns.is_empty() {
            let design = response.iter().map(|&(t, _)| (t, steps::design(omega, t)));
            above = above.line("design", reference_style().dashed(""), design);
            columns.push(response.iter().map(|(t, _)| *t).collect::<Vec<f64>>());
        }
        largest.push(error.iter().fold(0.0_f64, |m, (_, e)| m.max(e.abs())));
        names.extend([format!("x_m_level_{number}"), format!("error_m_level_{number}")]);
        columns.push(response.iter().map(|(_, x)| *x).collect());
        columns.push(error.iter().map(|(_, e)| *e).collect());
        above = above.line(level_name(number), level_style(number), response);
        below = below.line(level_name(number), level_style(number), error);
    }
    let table: Vec<(&str, &[f64])> = names
        .iter()
        .zip(&columns)
        .map(|(name, column)| (name.as_str(), column.as_slice()))
        .collect();
    let figure = Figure::columns(1)
        .panel(above)
        .panel(below)
        .share_x()
        .panel_size(440.0, 180.0);
    Ok(Drawing::picture(figure.draw())
        .data(DataTable::from_columns(&table))
        .scenario(flown.file())
        .check(
            SMALL,
            largest.iter().all(|e| *e < LARGEST_ERROR),
            format!("largest |e_x| on levels 1 to 3: {largest:.4?} m"),
        ))
}
