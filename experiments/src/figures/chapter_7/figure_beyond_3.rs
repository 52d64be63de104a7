//! Figure beyond.3: crossings judged by the energy they deliver and the energy that misses the receiver.

use super::energy::{Energy, Supply, front};
use super::optimisations::{Case, Effort};
use super::solution_table::vector;
use super::solutions::{SEARCHED, every};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::figures::sweep;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::figure::Legends;
use crate::plot::style::{GREY, INK, Look, Marker, PURPLE, SKY};
use crate::plot::{Figure, Panel, series_style};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "beyond.3",
    title: "Energy delivered and energy missed: the Pareto front of the crossings",
    description: "Not in the source. Crossings in 20 s at level 5, on a grid over the box of the two variables: electrical energy delivered against optical \
                  energy that passes the receiver, the hazard of overfill. (a) With the laser on all the time. (b) With the laser \
                  switched off while the receiver catches less than a given share of the light. Marked: the minimum of *Φ*, of two and of four variables. Fronts: less \
                  missed or more delivered than on the line is not known. Energies missed below 10^{−7} of the laser's are below what the quadrature over the \
                  receiver resolves: they count as equal and stand at this floor.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[NEAR, GATE],
    make: Make::Draw(draw),
};

const NEAR: Claim = Claim::holds(
    "no sampled crossing that misses no more energy than the Φ-optimum delivers one hundredth more",
);
const GATE: Claim = Claim::holds(
    "off while the receiver catches less than 90 % of the light, the laser misses a hundredth of the energy and delivers all but 1 % of it, over all crossings",
);

/// Shares of the light below which the laser is switched off; 0: never.
const SHARES: [f64; 12] = [0.0, 0.5, 0.7, 0.8, 0.85, 0.9, 0.93, 0.95, 0.97, 0.98, 0.99, 0.995];
/// The share of claim GATE.
const POOR: f64 = 0.9;
/// Energy missed that the quadrature over the receiver no longer resolves, of the laser's: its accuracy up to 50° of incidence (`ets::power`),
/// to which the light neglected beyond 2.8 beam radii contributes 4e-8.
const RESOLVED: f64 = 1e-7;
/// Shares up to which the laser is drawn as rarely off.
const RARELY: f64 = 0.9;
/// Range of energies missed in (b), as multiples of the floor.
const SHOWN: [f64; 2] = [0.4, 4e7];
/// Intervals of the grid along each variable.
const GRID: u32 = 20;
const GRID_QUICK: u32 = 8;

/// The Φ-optimum of a case at level 5.
fn optimum(case: Case, effort: Effort) -> Result<(Supply, Vec<f64>), ItemError> {
    let solved = case
        .solved(effort)?
        .last()
        .ok_or_else(|| ItemError::new("no level was searched"))?;
    let best = solved.first().best();
    Ok((
        Supply::of(&solved.problem, best, every(&solved.problem))?,
        best.to_vec(),
    ))
}

fn points(energies: &[Energy]) -> Vec<(f64, f64)> {
    energies.iter().map(|e| (e.missed, e.delivered)).collect()
}

/// The front as stairs, from no energy delivered to `end`: between two of its points nothing better than the left one is known.
fn stairs(front: &[Energy], end: f64) -> Vec<(f64, f64)> {
    let mut stairs = Vec::new();
    let mut delivered = 0.0;
    for point in front {
        stairs.push((point.missed, delivered));
        stairs.push((point.missed, point.delivered));
        delivered = point.delivered;
    }
    stairs.push((end, delivered));
    stairs
}

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let effort = Effort::of(context.quick);
    let solved = Case::TwoIn20
        .solved(effort)?
        .last()
        .ok_or_else(|| ItemError::new("no level was searched"))?;
    let problem = &solved.problem;
    let steps = if context.quick { GRID_QUICK } else { GRID };
    let [first, second] = problem.decisions() else {
        return Err(ItemError::new("the grid needs two variables"));
    };
    let decisions: Vec<Vec<f64>> = sweep(first.lower, first.upper, steps)
        .iter()
        .flat_map(|&a| {
            sweep(second.lower, second.upper, steps)
                .into_iter()
                .map(move |b| vec![a, b])
        })
        .collect();
    let supplies = Supply::of_all(problem, &decisions, every(problem))?;
    let mission = problem.mission();
    let floor = RESOLVED * mission.station.beam.power * mission.duration_s;
    let of = |supply: &Supply, share: f64| supply.energy(share).resolved(floor);
    let all_at = |share: f64| supplies.iter().map(move |s| of(s, share));
    let on: Vec<Energy> = all_at(0.0).collect();
    let gated: Vec<Energy> = SHARES.into_iter().flat_map(all_at).collect();
    let gated_by = |wanted: &dyn Fn(f64) -> bool| -> Vec<Energy> {
        let shares = SHARES.into_iter().filter(|share| wanted(*share));
        shares.flat_map(all_at).collect()
    };
    let (two, at) = optimum(Case::TwoIn20, effort)?;
    let (four, _) = optimum(Case::Four, effort)?;
    let best = of(&two, 0.0);
    let no_worse = on.iter().filter(|e| e.missed <= best.missed).map(|e| e.delivered);
    let gain = no_worse.fold(best.delivered, f64::max) / best.delivered - 1.0;
    let nearer = on.iter().filter(|e| e.dominates(&best)).count();
    let total = |share: f64| {
        let sum = |sum: Energy, e: Energy| Energy {
            delivered: sum.delivered + e.delivered,
            missed: sum.missed + e.missed,
        };
        let energies = supplies.iter().map(|s| s.energy(share));
        energies.fold(
            Energy {
                delivered: 0.0,
                missed: 0.0,
            },
            sum,
        )
    };
    let (always, gated_at) = (total(0.0), total(POOR));
    let (kept, left) = (
        gated_at.delivered / always.delivered,
        gated_at.missed / always.missed,
    );
    let marks = [
        ("*Φ*-optimum, two variables", &two, 1, Marker::Square),
        ("*Φ*-optimum, four variables", &four, 2, Marker::Triangle),
    ];
    let delivered = |energies: &[Energy]| energies.iter().map(|e| e.delivered).fold(0.0, f64::max);
    let within: Vec<Energy> = gated.iter().filter(|e| e.missed <= floor).copied().collect();
    let (clean, most) = (delivered(&within), delivered(&gated));
    let panel = || Panel::new("Energy missed, J", "Energy delivered, J").y_include(0.0);
    let cloud = |colour| Look::solid(colour, 0.6).marked(Marker::Dot);
    let mut all = panel().caption("laser always on").x_range(-4.0, 104.0).markers(
        "crossings, always on",
        cloud(GREY),
        points(&on),
    );
    let mut gate = panel()
        .caption("laser off at a poor catch")
        .log_x()
        .x_range(SHOWN[0] * floor, SHOWN[1] * floor)
        .vertical(floor, "resolved by the quadrature")
        .markers("", cloud(GREY), points(&on))
        .markers(
            "off below 50 to 90 % of the light",
            cloud(SKY),
            points(&gated_by(&|share| share > 0.0 && share <= RARELY)),
        )
        .markers(
            "off below 93 to 99.5 %",
            cloud(PURPLE),
            points(&gated_by(&|share| share > RARELY)),
        );
    for (name, supply, index, marker) in marks {
        let look = series_style(index).marked(marker);
        all = all.markers(name, look, points(&[of(supply, 0.0)]));
        gate = gate.markers(name, look, points(&SHARES.map(|share| of(supply, share))));
    }
    // On top of the markers, which would hide its corner.
    let bold = Look::solid(INK, 1.4);
    all = all.line(
        "front",
        bold,
        stairs(&front(&on), mission.station.beam.power * mission.duration_s),
    );
    gate = gate.line("front", bold, stairs(&front(&gated), SHOWN[1] * floor));
    let mut data = DataTable::new(["x_0_m", "x_f_m", "share", "delivered_j", "missed_j"]);
    for (x, supply) in decisions.iter().zip(&supplies) {
        for share in SHARES {
            let e = of(supply, share);
            data.push([
                x[0].into(),
                x[1].into(),
                share.into(),
                e.delivered.into(),
                e.missed.into(),
            ]);
        }
    }
    let mut optima =
        DataTable::new(["variables", "share", "delivered_j", "missed_j"]).with_tolerance(SEARCHED);
    for (name, supply) in [("two", &two), ("four", &four)] {
        for share in SHARES {
            let e = of(supply, share);
            optima.push([name.into(), share.into(), e.delivered.into(), e.missed.into()]);
        }
    }
    let figure = Figure::columns(2)
        .legends(Legends::Common)
        .panel_size(320.0, 260.0)
        .panel(all)
        .panel(gate);
    Ok(Drawing::picture(figure.draw())
        .data(data)
        .named_data("optima", optima)
        .scenario(&Case::TwoIn20.settings(effort)?)?
        .check(
            NEAR,
            gain < 0.01,
            format!(
                "the Φ-optimum {} delivers {:.2} J and misses no more than the {floor:.0e} J that are resolved; {nearer} of {} crossings miss as little and deliver more, the best of them by {:.2} %",
                vector(&at),
                best.delivered,
                on.len(),
                1e2 * gain
            ),
        )
        .check(
            GATE,
            kept > 0.99 && left < 0.01,
            format!("{:.2} % of the energy delivered and {:.3} % of that missed are left", 1e2 * kept, 1e2 * left),
        )
        .note(format!(
            "With the laser always on the two energies add up to what the air lets through, so a crossing that delivers more misses less: the front is a corner, \
             and *Φ*, which weighs no energy at all, leads into it. Switching the laser off moves it little: a crossing may miss nothing that is resolved and \
             deliver all but {:.3} % of the most. Only for crossings off the front does the share trade one energy for the other.",
            1e2 * (1.0 - clean / most)
        )))
}
