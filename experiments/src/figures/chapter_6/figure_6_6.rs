//! Figure 6.6: phase plane of height, c1 with limits and a settling time of 0.2 s.

use super::settings;
use super::steps::{self, Quantity};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::flight::{Law, Scenario, series};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::{Figure, Panel, level_name, level_style};
use quad_dynamics::Level;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.6",
    title: "Phase plane of height: c1 on the family, inputs limited",
    description: "A step of one metre in height with a designed settling time of 0.2 s, more than the rotors can \
                  give: climb rate against height under controller c1 with limits. Start at the origin, target at \
                  (1, 0). The loop's 29.2 rad/s is just inside the Routh array's 30 rad/s at level 3 and beyond what \
                  levels 4 and 5 allow, so these end in a limit cycle.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[ACTIVE],
    make: Make::Draw(draw),
};

const ACTIVE: Claim = Claim::holds("the limits are active on every level");

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let scenario = Scenario {
        input_limits: true,
        record_every: 1,
        ..Scenario::height_step(Law::C1, settings::height(0.2), 2.0)
    };
    let outcomes = steps::fly(context, &scenario, Quantity::Height, &Level::ALL)?;
    let mut panel =
        Panel::new(Quantity::Height.label(), "Climb rate *ḣ* = −*ż*, m s^{−1}").vertical(steps::STEP, "");
    let mut data = DataTable::new(["level", "t_s", "height_m", "climb_rate_m_s"]);
    for o in &outcomes {
        let number = o.level.number();
        let rate = series(&o.log, |r| -r.flight.velocity.z);
        let points: Vec<(f64, f64)> = o
            .response(Quantity::Height)
            .iter()
            .zip(&rate)
            .map(|((_, h), (_, v))| (*h, *v))
            .collect();
        panel = panel.line(level_name(number), level_style(number), points.iter().copied());
        for ((t, _), (h, v)) in rate.iter().zip(&points).step_by(4) {
            data.push([f64::from(number).into(), (*t).into(), (*h).into(), (*v).into()]);
        }
    }
    let saturated: Vec<f64> = outcomes.iter().map(|o| o.effort.saturation_time_s).collect();
    let drawing = Drawing::picture(Figure::columns(1).panel(panel).panel_size(440.0, 330.0).draw())
        .data(data)
        .scenario(&scenario)?;
    Ok(drawing.check(
        ACTIVE,
        saturated.iter().all(|s| *s > 0.0),
        format!("a command is at a limit for {saturated:.2?} s of 2 s, levels 1 to 5"),
    ))
}
