//! Figure beyond.2: a flight that is fine near the station and coarse far from it, against one at level 5 throughout.

use super::near_and_far::{STATION, fly};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::flight::{NOMINAL_VEHICLE, load_vehicle};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::style::{INK, Look};
use crate::plot::{Figure, Panel, level_name, level_style};
use quad_dynamics::Level;
use sifre::quadrotor::LevelRule;
use sifre::steps;
use std::sync::Arc;

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

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let vehicle = Arc::new(load_vehicle(context, NOMINAL_VEHICLE)?);
    let rule = LevelRule {
        near: "station".into(),
        fine: Level::Five.into(),
        coarse: Level::Two.into(),
        fine_within_m: 3.0,
        coarse_beyond_m: 4.0,
    };
    let (mixed, whole) = (fly(&vehicle, Some(rule.clone()))?, fly(&vehicle, None)?);
    let h = steps::QUADROTOR.step.seconds();
    let (positions, velocities, levels) = (
        mixed.vectors("position"),
        mixed.vectors("velocity"),
        mixed.column("level"),
    );
    let away: Vec<f64> = positions
        .iter()
        .map(|p| (p - nalgebra::Vector3::from(STATION)).norm())
        .collect();
    let apart: Vec<f64> = positions
        .iter()
        .zip(whole.vectors("position"))
        .map(|(a, b)| 1e3 * (a - b).norm())
        .collect();
    let at = |k: usize| mixed.events.get(k).map_or(f64::NAN, |e| e.time_ns as f64 * 1e-9);
    let time = |k: usize| k as f64 * h;
    let jump = velocities
        .windows(2)
        .map(|v| (v[1] - v[0]).norm())
        .fold(0.0, f64::max);
    let gap = (1..positions.len())
        .map(|k| (positions[k] - positions[k - 1] - (velocities[k] + velocities[k - 1]) * (h / 2.0)).norm())
        .fold(0.0, f64::max);
    let near = (0..apart.len()).filter(|&k| time(k) > at(1) + SETTLED_S && time(k) < at(2));
    let near = near.map(|k| apart[k]).fold(0.0, f64::max);
    let far = apart.iter().copied().fold(0.0, f64::max);
    let share = mixed.cost() / whole.cost();

    // Every 50th record is enough to see.
    let drawn: Vec<usize> = (0..away.len()).step_by(50).collect();
    let part = |level: f64| {
        let value = move |k: usize, y: f64| if levels[k] == level { y } else { f64::NAN };
        drawn
            .iter()
            .map(|&k| (time(k), value(k, away[k])))
            .collect::<Vec<_>>()
    };
    let (coarse, fine) = (part.clone()(2.0), part(5.0));
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
        ("level", pick(&mixed.column("level"))),
        ("distance_m", pick(&away)),
        ("apart_mm", pick(&apart)),
    ];
    let columns: Vec<(&str, &[f64])> = columns.iter().map(|(name, of)| (*name, of.as_slice())).collect();
    Ok(Drawing::picture(figure.draw())
        .data(DataTable::from_columns(&columns))
        .scenario(&rule)?
        .check(SMOOTH, jump < MOTION_M_S && gap < 1e-6, format!("largest step of velocity {jump:.1e} m/s in {h} s, of position beyond the velocity's {gap:.0e} m"))
        .check(NEAR, near < 10.0, format!("{near:.1} mm at most near the station, {far:.0} mm anywhere"))
        .check(CHEAP, share < 0.75, format!("{:.1} % of the cost, {} changes of level", 100.0 * share, mixed.events.len())))
}
