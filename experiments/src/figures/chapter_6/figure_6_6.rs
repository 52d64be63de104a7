//! Figure 6.6: phase plane of height, c1 with limits and a settling time of 0.2 s.

use super::steps::{self, Quantity};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::{Figure, Look, Panel, level_name, level_style};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.6",
    title: "Phase plane of height: c1 on the family, inputs limited",
    description: "A step of one metre in height with a designed settling time of 0.2 s, more than the rotors can \
                  give: climb rate against height under controller c1 with limits. Start at the origin, target at \
                  (1, 0). 10 s are flown, the first eight drawn thin, the last two thick. The loop's 29.2 rad/s is just inside \
                  the Routh array's 30 rad/s at level 3 and beyond what levels 4 and 5 allow. Levels 1 and 2 come to rest; levels 3 to 5 circle at the limits to the end, levels 3 and 4 \
                  still growing slowly. Levels 1 to 4 brake harder than gravity, since their linear rotor pulls down at the lowest command.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[ACTIVE],
    make: Make::Draw(draw),
};

const ACTIVE: Claim = Claim::holds("the limits are active on every level");

/// Time flown and its last part, which is drawn thick, s.
const FLOWN_S: f64 = 10.0;
const LAST_S: f64 = 2.0;

/// Width of the line of what comes before.
const THIN: f64 = 0.6;

fn draw(_: &Context) -> Result<Drawing, ItemError> {
    let flown = steps::fly("6.6", Quantity::Height)?;
    let outcomes = &flown.outcomes;
    let mut panel =
        Panel::new(Quantity::Height.label(), "Climb rate *ḣ* = −*ż*, m s^{−1}").vertical(steps::STEP, "");
    let mut ends = Vec::new();
    let mut data = DataTable::new(["level", "t_s", "height_m", "climb_rate_m_s"]);
    for o in outcomes {
        let number = o.number();
        let rate = o.flight.series(|row| -row.velocity.z);
        let points: Vec<(f64, f64)> = o
            .response(Quantity::Height)
            .iter()
            .zip(&rate)
            .map(|((_, h), (_, v))| (*h, *v))
            .collect();
        let last = rate.partition_point(|(t, _)| *t < FLOWN_S - LAST_S);
        let thin = Look {
            width: THIN,
            ..level_style(number).dashed("")
        };
        panel = panel.line("", thin, points[..=last].iter().copied()).line(
            level_name(number),
            level_style(number),
            points[last..].iter().copied(),
        );
        ends.push(format!("level {number} {}", ranges(&rate, &points)));
        for ((t, _), (h, v)) in rate.iter().zip(&points).step_by(4) {
            data.push([f64::from(number).into(), (*t).into(), (*h).into(), (*v).into()]);
        }
    }
    // Full down: what the line through the zero-thrust command gives at the lowest command.
    let vehicle = &outcomes[0].flight.vehicle;
    let pull = -4.0 * vehicle.linear_rotor.thrust_gain * vehicle.zeroed_range().start();
    let brake = vehicle.environment.gravity + pull / vehicle.airframe.mass;
    let saturated: Vec<f64> = outcomes.iter().map(|o| o.effort.saturation_time_s).collect();
    let drawing = Drawing::picture(Figure::columns(1).panel(panel).panel_size(440.0, 330.0).draw())
        .data(data)
        .scenario(flown.file());
    let drawing = drawing
        .note(format!(
            "height in the last two seconds and in the two before: {}",
            ends.join("; ")
        ))
        .note(format!("levels 1 to 4 brake at up to {brake:.1} m s⁻²"));
    Ok(drawing.check(
        ACTIVE,
        saturated.iter().all(|s| *s > 0.0),
        format!("a command is at a limit for {saturated:.2?} s of {FLOWN_S} s, levels 1 to 5"),
    ))
}

/// The range of height in the last seconds, and in as many before: whether a cycle has closed.
fn ranges(rate: &[(f64, f64)], points: &[(f64, f64)]) -> String {
    let range = |end: f64| {
        let times = rate.iter().map(|(t, _)| end - LAST_S <= *t && *t <= end);
        let heights = times
            .zip(points)
            .filter(|(inside, _)| *inside)
            .map(|(_, (h, _))| *h);
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| {
            (low.min(h), high.max(h))
        });
        format!("{low:.3} to {high:.3} m")
    };
    format!("{} ({})", range(FLOWN_S), range(FLOWN_S - LAST_S))
}
