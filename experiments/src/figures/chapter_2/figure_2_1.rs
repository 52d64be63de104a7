//! Figure 2.1: confidence against resolution, measured on the model family.

use super::confidence::{self, AXES, Confidence};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::figures::agreement_with_a_recorded_flight;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::figure::Legends;
use crate::plot::style::Marker;
use crate::plot::{Figure, Panel, level_name, level_style};
use crate::vehicle::{NOMINAL_VEHICLE, load_vehicle};
use quad_dynamics::Level;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "2.1",
    title: "Model confidence and cost against resolution",
    description: "After an idea of Lobão and Porto, measured: resolution is the number of features that a model declares; confidence is \
                  the agreement of its accelerations with those of level 5 along level 5's flight of figure 6.17's trajectory, same \
                  commands, each step from the same body state: 1 − *U* with Theil's coefficient *U* (0 perfect, 1 worst), mean of six axes. \
                  Grey: the same with a recorded flight in place of level 5 (figure 4.13). Cost: numbers integrated a second.",
    kind: Kind::Plot,
    origin: Origin::MeasuredAndSimulated,
    claims: &[RISES, COSTED],
    make: Make::Draw(draw),
};

const RISES: Claim = Claim::holds("confidence does not fall from one level to the next");
const COSTED: Claim =
    Claim::holds("each level's cost is shown beside it, and does not fall from one level to the next");

/// A thin line from level to level.
const TREND: crate::plot::Look = crate::plot::Look::solid("#767676", 1.0);
/// Grey for what was recorded.
const MEASURED: crate::plot::Look = crate::plot::Look::solid("#767676", 1.2)
    .dashed("4 3")
    .marked(Marker::Square);

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let family = confidence::of_family(&load_vehicle(context, NOMINAL_VEHICLE)?)?;
    let recorded = recorded(context)?;
    let mut agreement = Panel::new("Resolution, features declared", "Confidence 1 − *U*").x_range(-0.7, 9.7);
    let mut cost = Panel::new("Resolution, features declared", "Cost, 10^{3} numbers s^{−1}")
        .x_range(-0.7, 9.7)
        .y_include(0.0);
    agreement = agreement.line(
        "",
        TREND,
        family.iter().map(|c| (c.features as f64, c.confidence())),
    );
    for c in &family {
        let n = c.level.number();
        let point = |y| std::iter::once((c.features as f64, y));
        agreement = agreement.markers(
            level_name(n),
            level_style(n).marked(Marker::Circle),
            point(c.confidence()),
        );
        cost = cost.markers(
            level_name(n),
            level_style(n).marked(Marker::Circle),
            point(c.cost() / 1e3),
        );
    }
    let of_level = |level| family.iter().find(|c| c.level == level);
    let measured = recorded
        .iter()
        .filter_map(|(level, fit)| of_level(*level).map(|c| (c.features as f64, *fit)));
    let measured: Vec<(f64, f64)> = measured.collect();
    agreement =
        agreement
            .line("", MEASURED, measured.iter().copied())
            .markers("recorded flight", MEASURED, measured);
    let figure = Figure::columns(2)
        .panel(agreement)
        .panel(cost)
        .panel_size(300.0, 220.0)
        .legends(Legends::Common);
    let values: Vec<f64> = family.iter().map(Confidence::confidence).collect();
    let costs: Vec<f64> = family.iter().map(Confidence::cost).collect();
    let never_falls = |of: &[f64]| of.windows(2).all(|pair| pair[1] >= pair[0]);
    Ok(Drawing::picture(figure.draw())
        .data(table(&family))
        .note(words(&recorded))
        .note(
            "Not every axis rises with every level: level 3's torque lags as its thrust does, which in yaw (0.75 after 0.82) is worse than no \
             lag; levels 2 and up turn the wrong thrust of a rotor that doesn't know its voltage into the horizontal.",
        )
        .check(
            RISES,
            never_falls(&values),
            format!("1 − U of levels 1 to 5: {values:.4?}"),
        )
        .check(
            COSTED,
            never_falls(&costs),
            format!("numbers a second, levels 1 to 5: {costs:.0?}"),
        ))
}

/// Agreement with a recorded flight; nothing where the recordings are not on this machine.
fn recorded(context: &Context) -> Result<Vec<(Level, f64)>, ItemError> {
    match agreement_with_a_recorded_flight(context) {
        Err(error) if error.missing().is_some() => Ok(Vec::new()),
        other => other,
    }
}

fn words(recorded: &[(Level, f64)]) -> String {
    if recorded.is_empty() {
        return "The recorded flight is not on this machine (see the data page); its curve is left out."
            .into();
    }
    let fits: Vec<String> = recorded
        .iter()
        .map(|(level, value)| format!("{level} {value:.3}"))
        .collect();
    format!(
        "Agreement with the recorded flight that nothing was fitted on (figure 4.13, one-step, mean of six axes): {}. Recordings \
         drive levels 2 to 5: the replay needs quaternions, which level 1 has not.",
        fits.join(", ")
    )
}

fn table(family: &[Confidence]) -> DataTable {
    let mut columns = vec!["level", "features", "states", "cost_numbers_per_s", "confidence"];
    let names = AXES.map(|axis| format!("confidence_{axis}"));
    columns.extend(names.iter().map(String::as_str));
    let mut data = DataTable::new(columns);
    for c in family {
        let [north, east, down, roll, pitch, yaw] = c.theil.map(|u| (1.0 - u).into());
        data.push([
            f64::from(c.level.number()).into(),
            (c.features as f64).into(),
            (c.states as f64).into(),
            c.cost().into(),
            c.confidence().into(),
            north,
            east,
            down,
            roll,
            pitch,
            yaw,
        ]);
    }
    data
}
