//! Table G.4: step sizes of the agents, from the engine's declarations, and what halving all of them changes.

use super::crossing::{NAME, cross};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::{DisplayTable, Drawing};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::scenarios;
use crate::station::{NOMINAL_STATION, load_station};
use quad_dynamics::Level;
use sifre::{Recording, StepSize, steps};

/// The table.
pub(super) const ITEM: Item = Item {
    id: "table-G.4",
    title: "Step sizes of the agents in the energy transmission simulation",
    description: "The step of each kind of agent as the engine declares it, with its reason. Beside the quadrotors: how far halving *all* steps \
                  moves the vehicle and the spot of the beam, at most, while the vehicle crosses the station's field in 10 s (6 m at a \
                  distance of 5 m, facing the station; c1 on level 1, c2 on level 2, c3 above). The thesis' own values are not available; \
                  these are the project's.",
    kind: Kind::Table,
    origin: Origin::Simulated,
    claims: &[SMALL, FIRST_ORDER],
    make: Make::Draw(draw),
};

const SMALL: Claim = Claim::holds(
    "halving every step moves no vehicle and no spot by more than a hundredth of the limit on the spot's offset",
);
const FIRST_ORDER: Claim = Claim::holds(
    "halving every step again changes the flight of every level half as much: the hold of commands is of first order",
);

/// Largest distance of two recordings in the space of these channels, in their unit.
fn distance<const N: usize>(a: &Recording, b: &Recording, channels: [&str; N]) -> f64 {
    let column = |of: &Recording, name: &str| {
        of.column(name)
            .map(Iterator::collect::<Vec<_>>)
            .unwrap_or_default()
    };
    let pairs = channels.map(|name| (column(a, name), column(b, name)));
    let squares = |k: usize| pairs.iter().map(|(a, b)| (a[k] - b[k]).powi(2)).sum::<f64>();
    (0..a.len()).map(|k| squares(k).sqrt()).fold(0.0, f64::max)
}

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let station = load_station(context, NOMINAL_STATION)?;
    let mut shown = DisplayTable::new([
        "Agent",
        "Step, ms",
        "Vehicle moves, µm",
        "Spot moves, mm",
        "Reason for the step",
    ]);
    let mut data = DataTable::new(["agent", "level", "step_s", "vehicle_moves_m", "spot_moves_m"]);
    let (mut worst, mut ratios) = (0.0_f64, Vec::new());
    let milliseconds = |step: StepSize| format!("{}", 1e3 * step.seconds());
    for level in Level::ALL {
        let runs = [1, 2, 4].map(|refinement| cross(level, refinement));
        let [declared, half, quarter] = runs;
        let (declared, half, quarter) = (declared?, half?, quarter?);
        let position = [
            "quadrotor.position.x",
            "quadrotor.position.y",
            "quadrotor.position.z",
        ];
        let vehicle_moves = distance(&declared, &half, position);
        let spot_moves = distance(&declared, &half, ["station.spot.right", "station.spot.up"]);
        ratios.push(vehicle_moves / distance(&half, &quarter, position));
        worst = worst.max(vehicle_moves).max(spot_moves);
        let step = steps::QUADROTOR.step;
        data.push([
            "quadrotor".into(),
            f64::from(level.number()).into(),
            step.seconds().into(),
            vehicle_moves.into(),
            spot_moves.into(),
        ]);
        shown.push([
            format!("quadrotor, {level}"),
            milliseconds(step),
            format!("{:.3}", 1e6 * vehicle_moves),
            format!("{:.3}", 1e3 * spot_moves),
            steps::QUADROTOR.reason.into(),
        ]);
    }
    for other in &steps::ALL[1..] {
        shown.push([
            other.of.into(),
            milliseconds(other.step),
            String::new(),
            String::new(),
            other.reason.into(),
        ]);
        data.push([
            other.of.into(),
            "".into(),
            other.step.seconds().into(),
            "".into(),
            "".into(),
        ]);
    }
    let limit = station.limits.spot / 100.0;
    let [least, most] = [f64::min, f64::max].map(|f| ratios.iter().copied().reduce(f).unwrap_or(f64::NAN));
    Ok(Drawing::table(shown)
        .data(data)
        .scenario(scenarios::find(NAME)?)
        .check(
            SMALL,
            worst < limit,
            format!("{:.3} mm at most, {:.1} mm allowed", 1e3 * worst, 1e3 * limit),
        )
        // The next term of the error is h times the attitude loop's 29 rad/s: 3 %.
        .check(
            FIRST_ORDER,
            least > 1.9 && most < 2.1,
            format!("ratios of {least:.3} to {most:.3}"),
        ))
}
