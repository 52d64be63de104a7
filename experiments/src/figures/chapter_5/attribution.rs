//! Figure beyond.1: what separates neighbouring levels, part by part, in the flight of figure 6.14.

use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::style::Marker;
use crate::plot::{Figure, Panel, series_style};
use crate::scenarios::{self, Flights};
use quad_dynamics::{Feature, Level, PhenomenonSet};
use scenario::Scenario;
use study::attribution::{Attribution, Parts, Share};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "beyond.1",
    title: "What separates the levels: height lost in a horizontal step, attributed to single parts",
    description: "In the flight of figure 6.14 (controller c1, one metre in *x*), all parts between two levels are switched on and off in every \
                  combination. Drawn is the change of the height error (root mean square over 12 s) due to each part: switched on alone, switched on last, \
                  and its Shapley value; Shapley values sum to the total difference. Level 5 has the \
                  voltage sag of its battery here, which figure 6.14 leaves out.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[ADDS_UP, ROTOR],
    make: Make::Draw(draw),
};

const ADDS_UP: Claim =
    Claim::holds("the Shapley values of the parts add up to the difference between the levels");
const ROTOR: Claim =
    Claim::holds("what separates levels 4 and 5 in height is the rotor and its battery, not the limits");

/// Relative rounding of a sum of some ten numbers.
const ROUNDING: f64 = 1e-9;

/// Root mean square of the height over the flight, mm: it is asked to stay at zero.
fn height_error_mm(scenario: &Scenario, level: Level, on: &PhenomenonSet) -> Result<f64, ItemError> {
    let mut scenario = scenario.clone();
    scenario.quadrotor[0].level = level;
    scenario.quadrotor[0].phenomena = Some(on.clone());
    let Flights { flights, .. } = Flights::of(&scenario, &())?;
    let rows = &flights[0].rows;
    let squares = rows.iter().map(|row| row.position.z.powi(2));
    Ok(1e3 * (squares.sum::<f64>() / rows.len() as f64).sqrt())
}

fn draw(_: &Context) -> Result<Drawing, ItemError> {
    let file = scenarios::find("beyond.1")?;
    let scenario = file.scenario()?;
    let mut figure = Figure::columns(2).panel_size(330.0, 220.0);
    let mut data = DataTable::new([
        "from_level",
        "part",
        "from_below_mm",
        "from_above_mm",
        "shapley_mm",
    ]);
    let (mut worst, mut last) = (0.0_f64, None);
    for (lower, upper) in [(Level::Three, Level::Four), (Level::Four, Level::Five)] {
        let parts = Parts::between_levels(lower, upper);
        let found = parts
            .attribute(|level, on| height_error_mm(&scenario, level, on).map_err(|e| Run(e.to_string())))?;
        let sum: f64 = found.shares.iter().map(|s| s.shapley).sum();
        worst = worst.max((sum - found.difference()).abs() / found.top.abs().max(1.0));
        for s in &found.shares {
            data.push([
                f64::from(lower.number()).into(),
                s.part.to_string().as_str().into(),
                s.from_below.into(),
                s.from_above.into(),
                s.shapley.into(),
            ]);
        }
        figure = figure.panel(panel(lower, upper, &found));
        last = Some(found);
    }
    let share = |part: Feature| {
        let found = last.as_ref().and_then(|a| a.share(part));
        found.map_or(f64::NAN, |s| s.shapley)
    };
    let (rotor, sag, limits) = (
        share(Feature::NonLinearRotor),
        share(Feature::Phenomenon(quad_dynamics::Phenomenon::VoltageSag)),
        share(Feature::Phenomenon(quad_dynamics::Phenomenon::InputLimits)),
    );
    Ok(Drawing::picture(figure.draw())
        .data(data)
        .scenario(file)
        .check(
            ADDS_UP,
            worst < ROUNDING,
            format!("relative difference {worst:.1e}"),
        )
        .check(
            ROTOR,
            limits.abs() < 0.01 * (rotor.abs() + sag.abs()),
            format!("rotor {rotor:.1} mm, voltage sag {sag:.1} mm, limits {limits:.2} mm"),
        ))
}

/// A run that failed, in words.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
struct Run(String);

fn panel(lower: Level, upper: Level, found: &Attribution) -> Panel {
    let name = |s: &Share| match s.part {
        Feature::Phenomenon(phenomenon) => phenomenon.name().replace('-', " "),
        part => part.to_string(),
    };
    let names: Vec<String> = found.shares.iter().map(name).collect();
    let points = |offset: f64, value: fn(&Share) -> f64| {
        let places = found.shares.iter().enumerate();
        let points: Vec<_> = places.map(|(i, s)| (i as f64 + 1.0 + offset, value(s))).collect();
        points
    };
    let look = |i: usize, marker| series_style(i).marked(marker);
    Panel::new("", "Change of height error, mm")
        .caption(format!(
            "{lower} to {}: {:.2} mm to {:.2} mm",
            upper.number(),
            found.base,
            found.top
        ))
        .x_categories(names)
        .horizontal(0.0, "")
        .markers(
            "alone",
            look(0, Marker::Triangle),
            points(-0.15, |s| s.from_below),
        )
        .markers("Shapley", look(1, Marker::Circle), points(0.0, |s| s.shapley))
        .markers(
            "last",
            look(2, Marker::TriangleDown),
            points(0.15, |s| s.from_above),
        )
}
