//! Figure 6.14: height during the horizontal step of figure 6.13.

use super::steps::Quantity;
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::{Figure, Panel, level_name, level_style};
use crate::scenarios::{self, Flight, Flights};
use quad_dynamics::Vehicle;
use std::collections::BTreeMap;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.14",
    title: "Height during a step in horizontal position",
    description: "The flights of figure 6.13, seen from the side: height under controller c1 while the vehicle \
                  pitches to move one metre in *x*. Below, levels 1 to 4 enlarged.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[LEVEL_1_KEEPS, OTHERS_LOSE, LEVEL_5_OFFSET],
    make: Make::Draw(draw),
};

const LEVEL_1_KEEPS: Claim = Claim::holds("level 1 keeps its height");
const OTHERS_LOSE: Claim = Claim::holds("levels 2 and up do not keep their height");
const LEVEL_5_OFFSET: Claim = Claim::holds("level 5 has a steady-state error from the non-linear rotor");

/// Rounding of some seconds of RK4 steps on numbers of order one, m.
const KEPT: f64 = 1e-9;
/// Loss of height that a picture of a metre can show, m.
const LOST: f64 = 1e-3;

/// End of the time axis, s: rest follows, in the data and the claims.
const SHOWN_S: f64 = 5.0;

/// A claim, and what flights say of it.
pub(crate) struct Judged {
    pub(crate) claim: Claim,
    pub(crate) holds: bool,
    pub(crate) measured: String,
}

fn draw(_: &Context) -> Result<Drawing, ItemError> {
    let file = scenarios::find("6.14")?;
    let Flights { flights, .. } = scenarios::fly("6.14")?;
    let heights = heights(&flights);
    let drawing = Drawing::picture(picture(&flights, &heights))
        .data(data(&flights, &heights))
        .scenario(file);
    let judged = judge(&heights, predicted_offset(&flights[0])?).into_iter();
    Ok(judged.fold(drawing, |d, j| d.check(j.claim, j.holds, j.measured)))
}

/// The figure's claims with another vehicle, given as the text of its file.
pub(crate) fn claims_of(vehicle: &str) -> Result<[Judged; 3], ItemError> {
    const NAME: &str = "another-vehicle.toml";
    let mut scenario = scenarios::find("6.14")?.scenario()?;
    for quadrotor in &mut scenario.quadrotor {
        quadrotor.vehicle = NAME.to_owned();
    }
    let files = BTreeMap::from([(NAME.to_owned(), vehicle.to_owned())]);
    let Flights { flights, .. } = Flights::of(&scenario, &files)?;
    Ok(judge(&heights(&flights), predicted_offset(&flights[0])?))
}

fn heights(flights: &[Flight]) -> Vec<Vec<(f64, f64)>> {
    let height = |flight: &Flight| flight.series(|row| Quantity::Height.of(row));
    flights.iter().map(height).collect()
}

fn judge(heights: &[Vec<(f64, f64)>], predicted: f64) -> [Judged; 3] {
    let excursion = |i: usize| heights[i].iter().map(|(_, h)| h.abs()).fold(0.0, f64::max);
    let others: Vec<f64> = (1..5).map(excursion).collect();
    let last = |i: usize| heights[i].last().map_or(f64::NAN, |(_, h)| *h);
    let judged = |claim, holds, measured| Judged {
        claim,
        holds,
        measured,
    };
    [
        judged(
            LEVEL_1_KEEPS,
            excursion(0) < KEPT,
            format!("largest excursion {:.1e} m", excursion(0)),
        ),
        judged(
            OTHERS_LOSE,
            others.iter().all(|e| *e > LOST),
            format!("largest excursions of levels 2 to 5: {others:.4?} m"),
        ),
        // The controller believes in a line through its zero-thrust command; the polynomial differs at hover.
        judged(
            LEVEL_5_OFFSET,
            last(4).abs() > LOST
                && last(3).abs() < LOST
                && (last(4) - predicted).abs() < 0.1 * predicted.abs(),
            format!(
                "{:.4} m at the end, {predicted:.4} m predicted from the rotor's error at hover over the loop's stiffness; \
                 level 4: {:.1e} m",
                last(4),
                last(3)
            ),
        ),
    ]
}

/// Height offset at rest, m: acceleration missing in hover over ω_n², from the static rotor models alone.
fn predicted_offset(flight: &Flight) -> Result<f64, ItemError> {
    let vehicle: &Vehicle = &flight.vehicle;
    let polynomial = vehicle.require_polynomial_rotor("figure 6.14")?.thrust;
    let voltage = vehicle.require_battery("figure 6.14")?.nominal_voltage;
    let weight_share = vehicle.hover_thrust_per_rotor();
    let omega = flight.settings.gains::<f64>()?.height.natural_frequency;
    // Which offset e makes the polynomial carry the weight? Demand per rotor is weight + m ω² e / 4.
    let thrust = |demand: f64| {
        let duty = demand / vehicle.linear_rotor.thrust_gain + vehicle.pwm.zero_thrust - vehicle.pwm.minimum;
        polynomial.value(duty * voltage)
    };
    let (mut low, mut high) = (0.0, 2.0 * weight_share);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if thrust(middle) < weight_share {
            low = middle
        } else {
            high = middle
        }
    }
    // Demand above weight means that the vehicle hangs below its set point.
    Ok(-4.0 * (low - weight_share) / (vehicle.airframe.mass * omega * omega))
}

fn picture(flights: &[Flight], heights: &[Vec<(f64, f64)>]) -> crate::plot::svg::Svg {
    let panel = |levels: usize| {
        let empty = Panel::new("Time *t*, s", Quantity::Height.label());
        flights
            .iter()
            .zip(heights)
            .take(levels)
            .fold(empty, |panel, (flight, h)| {
                let number = flight.level.number();
                panel.line(level_name(number), level_style(number), h.iter().copied())
            })
    };
    Figure::columns(1)
        .panel(panel(5).x_range(0.0, SHOWN_S))
        .panel(panel(4).x_range(0.0, SHOWN_S))
        .share_x()
        .panel_size(440.0, 180.0)
        .draw()
}

fn data(flights: &[Flight], heights: &[Vec<(f64, f64)>]) -> DataTable {
    let names: Vec<String> = flights
        .iter()
        .map(|flight| format!("height_m_level_{}", flight.level.number()))
        .collect();
    let times: Vec<f64> = heights[0].iter().map(|(t, _)| *t).collect();
    let columns: Vec<Vec<f64>> = heights
        .iter()
        .map(|h| h.iter().map(|(_, y)| *y).collect())
        .collect();
    let mut all: Vec<(&str, &[f64])> = vec![("t_s", &times)];
    all.extend(
        names
            .iter()
            .zip(&columns)
            .map(|(n, c)| (n.as_str(), c.as_slice())),
    );
    DataTable::from_columns(&all)
}
