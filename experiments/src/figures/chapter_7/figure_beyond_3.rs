//! Figure beyond.3: crossings judged by the energy they deliver and the energy that misses the receiver.

use super::crossed_energy::{SHARES, Study, stairs};
use super::energy::{Energy, front};
use super::optimisations::{Case, Effort};
use super::solution_table::vector;
use crate::claim::Claim;
use crate::drawing::Drawing;
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
                  switched off while the receiver catches less than a given share of the light. Marked: the minimum of *Φ*, of two and of four variables. Fronts: no crossing found misses less \
                  or delivers more than the line. Energies missed below 10^{−7} of the laser's are below what the quadrature over the \
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

/// The share of claim [`GATE`].
const POOR: f64 = 0.9;
/// Shares up to which the laser is drawn as rarely off.
const RARELY: f64 = 0.9;
/// Range of energies missed in (b), as multiples of the floor.
const SHOWN: [f64; 2] = [0.4, 4e7];
/// Intervals of the grid along each variable.
const GRID: u32 = 20;
const GRID_QUICK: u32 = 8;

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let effort = Effort::of(context.quick);
    let study = Study::of(effort, if context.quick { GRID_QUICK } else { GRID })?;
    let (near, numbers) = near(&study);
    let (gate, shares) = gate(&study);
    Ok(Drawing::picture(picture(&study).draw())
        .data(study.table())
        .named_data("optima", study.optima_table())
        .settings(&Case::TwoIn20.settings(effort)?)?
        .check(NEAR, near, numbers)
        .check(GATE, gate, shares)
        .note(format!(
            "With the laser always on the two energies add up to what the air lets through, so a crossing that delivers more misses less: the front is a corner, \
             and *Φ*, which weighs no energy at all, leads into it. Switching the laser off moves it little: a crossing may miss nothing that is resolved and \
             deliver all but {:.3} % of the most. Only for crossings off the front does the share trade one energy for the other.",
            1e2 * lost_without_a_miss(&study)
        )))
}

/// Whether no crossing misses as little as the Φ-optimum and delivers a hundredth more.
fn near(study: &Study) -> (bool, String) {
    let best = study.energy(&study.two, 0.0);
    let on = study.energies(|share| share == 0.0);
    let no_worse = on.iter().filter(|e| e.missed <= best.missed);
    let gain = no_worse.map(|e| e.delivered).fold(best.delivered, f64::max) / best.delivered - 1.0;
    let nearer = on.iter().filter(|e| e.dominates(&best)).count();
    let said = format!(
        "the Φ-optimum {} delivers {:.2} J and misses no more than the {:.0e} J that are resolved; {nearer} of {} crossings miss as little and deliver more, the best of them by {:.2} %",
        vector(&study.two.x),
        best.delivered,
        study.floor,
        on.len(),
        1e2 * gain
    );
    (gain < 0.01, said)
}

/// Whether a switch leaves a hundredth of what misses and nearly all of what is delivered.
fn gate(study: &Study) -> (bool, String) {
    let (always, gated) = (study.total(0.0), study.total(POOR));
    let kept = gated.delivered / always.delivered;
    let left = gated.missed / always.missed;
    let said = format!(
        "{:.2} % of the energy delivered and {:.3} % of that missed are left",
        1e2 * kept,
        1e2 * left
    );
    (kept > 0.99 && left < 0.01, said)
}

/// Share of the most energy that must be given up to miss nothing that is resolved.
fn lost_without_a_miss(study: &Study) -> f64 {
    let all = study.energies(|_| true);
    let most = |energies: Vec<&Energy>| energies.iter().map(|e| e.delivered).fold(0.0, f64::max);
    let clean = all.iter().filter(|e| e.missed <= study.floor).collect();
    1.0 - most(clean) / most(all.iter().collect())
}

fn points(energies: &[Energy]) -> Vec<(f64, f64)> {
    energies.iter().map(|e| (e.missed, e.delivered)).collect()
}

fn picture(study: &Study) -> Figure {
    let on = study.energies(|share| share == 0.0);
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
        .x_range(SHOWN[0] * study.floor, SHOWN[1] * study.floor)
        .vertical(study.floor, "resolved by the quadrature")
        .markers("", cloud(GREY), points(&on))
        .markers(
            "off below 50 to 90 % of the light",
            cloud(SKY),
            points(&study.energies(|share| share > 0.0 && share <= RARELY)),
        )
        .markers(
            "off below 93 to 99.5 %",
            cloud(PURPLE),
            points(&study.energies(|share| share > RARELY)),
        );
    for (name, crossing, index, marker) in [
        ("*Φ*-optimum, two variables", &study.two, 1, Marker::Square),
        ("*Φ*-optimum, four variables", &study.four, 2, Marker::Triangle),
    ] {
        let look = series_style(index).marked(marker);
        let at = |share| study.energy(crossing, share);
        all = all.markers(name, look, points(&[at(0.0)]));
        gate = gate.markers(name, look, points(&SHARES.map(at)));
    }
    // On top of the markers, which would hide its corner.
    let bold = Look::solid(INK, 1.4);
    let gated = front(&study.energies(|_| true));
    Figure::columns(2)
        .legends(Legends::Common)
        .panel_size(320.0, 260.0)
        .panel(all.line("front", bold, stairs(&front(&on), study.emitted)))
        .panel(gate.line("front", bold, stairs(&gated, SHOWN[1] * study.floor)))
}
