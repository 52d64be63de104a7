//! Figure beyond.2: a flight that is fine near the station and coarse far from it, against one at level 5 throughout.

use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::style::{INK, Look};
use crate::plot::{Figure, Panel, level_name, level_style};
use crate::scenarios::{self, Row, column};
use nalgebra::Vector3;
use quad_dynamics::{Level, Resolution};
use scenario::{PathFile, Scenario};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "beyond.2",
    title: "Dynamic resolution: level 5 near the station, level 2 far from it",
    description: "A quadrotor under c1 flies from 12 m to 1 m from a station and back; the engine's rule makes it fine within 3 m and coarse \
                  beyond 4 m. (a) Distance from the station, by the level in force; (b) distance from the same flight at level 5 throughout. \
                  Far away the coarse level lacks the height error that level 5's battery makes under a controller without integral action.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[SMOOTH, NEAR, CHEAP],
    make: Make::Draw(draw),
};

const SMOOTH: Claim = Claim::holds("no position or velocity jumps where the level changes");
const NEAR: Claim = Claim::holds(
    "near the station the flight is within 10 mm of the flight at level 5 from 3 s after the change on",
);
const CHEAP: Claim =
    Claim::holds("it costs less than three quarters of the flight at level 5, in numbers integrated");

/// Time that the loops take to settle after a change, s.
const SETTLED_S: f64 = 3.0;
/// Largest velocity step between records that is motion and no jump, m/s: 2 g over a step.
const MOTION_M_S: f64 = 2.0 * 9.81 * 1e-3;

fn draw(_: &Context) -> Result<Drawing, ItemError> {
    let file = scenarios::find("beyond.2")?;
    let flown = scenarios::fly("beyond.2")?;
    let (mixed, fine) = (flown.named("mixed")?, flown.named("fine")?);
    let levels = column(&flown.flown.recording, "mixed.level")?;
    let events = &flown.flown.events;
    let h = flown.scenario.output.step_s.seconds();
    let station = station(&flown.scenario)?;
    let away: Vec<f64> = mixed
        .rows
        .iter()
        .map(|row| (row.position - station).norm())
        .collect();
    let pairs = mixed.rows.iter().zip(&fine.rows);
    let apart: Vec<f64> = pairs
        .map(|(a, b)| 1e3 * (a.position - b.position).norm())
        .collect();
    let at = |k: usize| events.get(k).map_or(f64::NAN, |e| e.time_ns as f64 * 1e-9);
    let time = |k: usize| k as f64 * h;
    let largest = |of: fn(&Row, &Row, f64) -> f64| {
        let neighbours = mixed.rows.windows(2).map(|rows| of(&rows[0], &rows[1], h));
        neighbours.fold(0.0, f64::max)
    };
    let jump = largest(|a, b, _| (b.velocity - a.velocity).norm());
    let gap = largest(|a, b, h| (b.position - a.position - (b.velocity + a.velocity) * (h / 2.0)).norm());
    let near = (0..apart.len()).filter(|&k| time(k) > at(1) + SETTLED_S && time(k) < at(2));
    let near = near.map(|k| apart[k]).fold(0.0, f64::max);
    let far = apart.iter().copied().fold(0.0, f64::max);
    let share = cost(&levels) / cost(&column(&flown.flown.recording, "fine.level")?);

    // Every 50th record is enough to see.
    let drawn: Vec<usize> = (0..away.len()).step_by(50).collect();
    let part = |level: f64| {
        let levels = &levels;
        let value = move |k: usize, y: f64| if levels[k] == level { y } else { f64::NAN };
        drawn
            .iter()
            .map(|&k| (time(k), value(k, away[k])))
            .collect::<Vec<_>>()
    };
    let (coarse, fine) = (part(2.0), part(5.0));
    let from_station = Panel::new("Time *t*, s", "Distance from the station, m")
        .y_include(0.0)
        .line(level_name(2), level_style(2), coarse)
        .line(level_name(5), level_style(5), fine);
    let from_level_5 = Panel::new("Time *t*, s", "Distance from level 5, mm")
        .y_include(0.0)
        .line(
            "",
            Look::solid(INK, 1.8),
            drawn.iter().map(|&k| (time(k), apart[k])),
        );
    let figure = Figure::columns(1)
        .panel(from_station)
        .panel(from_level_5)
        .share_x()
        .panel_size(440.0, 170.0);
    let pick = |of: &[f64]| drawn.iter().map(|&k| of[k]).collect::<Vec<_>>();
    let times: Vec<f64> = drawn.iter().map(|&k| time(k)).collect();
    let columns = [
        ("t_s", times),
        ("level", pick(&levels)),
        ("distance_m", pick(&away)),
        ("apart_mm", pick(&apart)),
    ];
    let columns: Vec<(&str, &[f64])> = columns.iter().map(|(name, of)| (*name, of.as_slice())).collect();
    Ok(Drawing::picture(figure.draw())
        .data(DataTable::from_columns(&columns))
        .scenario(file)
        .check(SMOOTH, jump < MOTION_M_S && gap < 1e-6, format!("largest step of velocity {jump:.1e} m/s in {h} s, of position beyond the velocity's {gap:.0e} m"))
        .check(NEAR, near < 10.0, format!("{near:.1} mm at most near the station, {far:.0} mm anywhere"))
        .check(CHEAP, share < 0.75, format!("{:.1} % of the cost, {} changes of level", 100.0 * share, events.len())))
}

/// Where the station stands in W, m.
fn station(scenario: &Scenario) -> Result<Vector3<f64>, ItemError> {
    match scenario.target.first().map(|target| &target.path) {
        Some(PathFile::Fixed { position_m, .. }) => Ok((*position_m).into()),
        _ => Err(ItemError::new("beyond.2.toml has no target that stands")),
    }
}

/// Numbers integrated: states times the four evaluations of each step.
fn cost(levels: &[f64]) -> f64 {
    let states = Level::ALL.map(|level| Resolution::of(level, &level.phenomena()).states as f64);
    levels.iter().map(|level| 4.0 * states[*level as usize - 1]).sum()
}
