//! Figure est.2: errors of one flight within what the filter says of them.

use super::flight::{Eyes, STEP_S, Truth, filter, noise};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::panel::BandPoint;
use crate::plot::{Figure, Panel, level_style, series_style};
use crate::vehicle::{NOMINAL_VEHICLE, load_vehicle};
use quad_dynamics::Level;
use quad_estimation::sensor::Quality;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "est.2",
    title: "State estimation: errors over a flight and three standard deviations, poor sensors",
    description: "One of the flights of figure est.1 with poor sensors, estimated by the extended filter on level 5: truth less estimate (line) within \
                  three of the deviations that the filter states (band). The position fixes come five times a second, 50 ms late.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[INSIDE],
    make: Make::Draw(draw),
};

const INSIDE: Claim =
    Claim::holds("at least 98 % of the errors drawn are within three stated standard deviations");

/// Place among the twelve errors, label, factor into its unit.
const SHOWN: [(usize, &str, f64); 6] = [
    (0, "North *δx*, m", 1.0),
    (2, "Down *δz*, m", 1.0),
    (3, "*δv*_{x}, m/s", 1.0),
    (5, "*δv*_{z}, m/s", 1.0),
    (7, "Pitch *δθ*_{y}, °", 57.295_779_513_082_32),
    (8, "Yaw *δθ*_{z}, °", 57.295_779_513_082_32),
];

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let vehicle = load_vehicle(context, NOMINAL_VEHICLE)?;
    let quality = Quality::Poor;
    let truth = Truth::fly(&vehicle, quality, 0, Eyes::Truth)?;
    let filter = filter(&vehicle, Level::Five, noise(quality), quality, &truth)?;
    let mut rows = Vec::new();
    truth.filtered(
        filter,
        quality.suite().longest_delay_ns(),
        2,
        |k, body, estimate| {
            rows.push((
                k as f64 * STEP_S,
                estimate.error(body).vector(),
                estimate.deviations(),
            ));
        },
    )?;
    let mut figure = Figure::columns(2).share_x().panel_size(300.0, 120.0);
    let (mut inside, mut all) = (0_u32, 0_u32);
    for (place, label, scale) in SHOWN {
        let band = rows.iter().map(|(t, _, s)| BandPoint {
            x: *t,
            lower: -3.0 * scale * s[place],
            upper: 3.0 * scale * s[place],
        });
        let line = rows.iter().map(|(t, e, _)| (*t, scale * e[place]));
        let panel = Panel::new("Time *t*, s", label)
            .band(
                if place == 0 { "three deviations" } else { "" },
                series_style(5),
                band,
            )
            .line(
                if place == 0 { "error" } else { "" },
                level_style(5).dashed(""),
                line,
            );
        figure = figure.panel(panel);
        for (_, e, s) in &rows {
            all += 1;
            inside += u32::from(e[place].abs() < 3.0 * s[place]);
        }
    }
    let mut data = DataTable::new(["t_s", "error", "value", "deviation"]);
    let names = [
        "x_m",
        "y_m",
        "z_m",
        "vx_m_s",
        "vy_m_s",
        "vz_m_s",
        "roll_rad",
        "pitch_rad",
        "yaw_rad",
    ];
    for (t, e, s) in rows.iter().step_by(5) {
        for (i, name) in names.iter().enumerate() {
            data.push([(*t).into(), (*name).into(), e[i].into(), s[i].into()]);
        }
    }
    let share = 100.0 * f64::from(inside) / f64::from(all);
    Ok(Drawing::picture(figure.draw())
        .data(data)
        .check(INSIDE, share >= 98.0, format!("{share:.2} %")))
}
