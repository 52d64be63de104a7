//! Table G.3: properties of the controllers in the energy transmission simulations.

use crate::data::{Cell, DataTable};
use crate::drawing::{DisplayTable, Drawing};
use crate::figures::chapter_7::mission::problem;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use quad_dynamics::Level;
use quad_ndi::{Gains, Law, LoopGains, TiltLaw};
use wpt_optim::Choice;

/// The table.
pub(super) const ITEM: Item = Item {
    id: "table-G.3",
    title: "Controller properties of the energy transmission simulation",
    description: "Which controller flies which level, the design of its loops and the gains that follow: settling time *τ*_{s} to 2 %, damping *ζ*, \
                  natural frequency *ω*_{n} and, for c3, the extra real pole *p*. The thesis' own values are not available; these are the project's: \
                  the position loop is as slow as in the trajectory figures of chapter 6.",
    kind: Kind::Table,
    origin: Origin::Derived,
    claims: &[],
    make: Make::Draw(draw),
};

/// A loop of a controller.
struct Loop {
    name: &'static str,
    settling_s: Option<f64>,
    gains: LoopGains<f64>,
    has_pole: bool,
}

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let mut shown = DisplayTable::new([
        "Controller",
        "Levels",
        "Tilt",
        "Loop",
        "*τ*_{s}, s",
        "*ζ*",
        "*ω*_{n}, rad s^{−1}",
        "*p*, rad s^{−1}",
    ]);
    let mut data = DataTable::new([
        "controller",
        "levels",
        "loop",
        "settling_time_s",
        "damping",
        "natural_frequency_rad_s",
        "pole_rad_s",
    ]);
    for (law, levels) in [(Law::C1, "1"), (Law::C2, "2"), (Law::C3, "3 to 5")] {
        let name = law.name();
        let settings = problem(context, Choice::Two, 20.0, Level::One)?
            .mission()
            .settings;
        let gains: Gains<f64> = settings.gains()?;
        let third = law == Law::C3;
        let tilt = match law.tilt_law() {
            TiltLaw::SmallAngle => "small angles",
            TiltLaw::Exact => "exact",
        };
        let entry = |name, settling_s, gains, has_pole| Loop {
            name,
            settling_s,
            gains,
            has_pole,
        };
        for l in [
            entry(
                "height",
                Some(settings.height.settling_time_s),
                gains.height,
                third,
            ),
            entry("yaw", Some(settings.yaw.settling_time_s), gains.yaw, third),
            entry(
                "horizontal position",
                Some(settings.position.settling_time_s),
                gains.position,
                false,
            ),
            entry("roll and pitch", None, gains.attitude, third),
        ] {
            let optional = |value: Option<f64>, digits: usize| {
                value.map_or("–".to_owned(), |v| format!("{v:.digits$}"))
            };
            let pole = l.has_pole.then_some(l.gains.pole);
            shown.push([
                name.to_owned(),
                levels.to_owned(),
                tilt.to_owned(),
                l.name.to_owned(),
                optional(l.settling_s, 1),
                format!("{:.1}", l.gains.damping),
                format!("{:.3}", l.gains.natural_frequency),
                optional(pole, 2),
            ]);
            let number = |value: Option<f64>| value.map_or(Cell::from(""), Cell::from);
            data.push([
                name.into(),
                levels.into(),
                l.name.into(),
                number(l.settling_s),
                l.gains.damping.into(),
                l.gains.natural_frequency.into(),
                number(pole),
            ]);
        }
    }
    Ok(Drawing::table(shown).data(data))
}
