//! Figures 6.18 to 6.20: the reference trajectory followed on several levels, one scenario file each.

use super::paths::{self, Path};
use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::item::{Item, ItemError, Kind, Make, Origin};
use crate::scenarios;
use quad_dynamics::Level;

/// What the figures have in common.
const PATH: Item = Item {
    id: "",
    title: "",
    description: "",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[],
    make: Make::NotReproducible("the pattern of a figure"),
};

/// c1.
pub(super) const FIGURE_6_18: Item = Item {
    id: "6.18",
    title: "Following a trajectory: c1 on levels 1 to 5",
    description: "The reference of figure 6.17 followed by controller c1 on levels 1 to 5, its derivatives fed forward, \
                  input limits off. Below, the distance from the reference. c1 takes body rates for rates of the Euler angles, \
                  which they are not while a tilted vehicle turns its heading: level 1, which c1 follows to a few millimetres at a steady heading, is off by that. \
                  Grey: projection on the ground.",
    make: Make::Draw(|_| steady(follow("6.18", &paths::fly_levels("6.18")?)?)),
    ..PATH
};

/// c2.
pub(super) const FIGURE_6_19: Item = Item {
    id: "6.19",
    title: "Following a trajectory: c2 on levels 2 to 5",
    description: "The reference of figure 6.17 followed by controller c2 on levels 2 to 5, its derivatives fed forward, \
                  input limits off. Below, the distance from the reference. Grey: projection on the ground.",
    make: Make::Draw(|_| follow("6.19", &paths::fly_levels("6.19")?)),
    ..PATH
};

/// c3.
pub(super) const FIGURE_6_20: Item = Item {
    id: "6.20",
    title: "Following a trajectory: c3 on levels 3 to 5",
    description: "The reference of figure 6.17 followed by controller c3 on levels 3 to 5, its derivatives fed forward, \
                  input limits off. Below, the distance from the reference. Grey: projection on the ground.",
    claims: &[FALLS],
    make: Make::Draw(|_| {
        let paths = paths::fly_levels("6.20")?;
        falls(follow("6.20", &paths)?, &paths)
    }),
    ..PATH
};

const FALLS: Claim = Claim::does_not_hold(
    "on level 5 the error falls from c1 to c3",
    "height dominates: the rotor that is not linear leaves an offset that no controller without integral action removes, and c3's \
     third-order height loop with its own rotor observer is not stiffer than c2's; along the ground the error falls from c1 to c2 and c3",
);

fn follow(name: &str, paths: &[Path]) -> Result<Drawing, ItemError> {
    let drawing = Drawing::picture(paths::picture(paths))
        .data(paths::table(paths))
        .scenario(scenarios::find(name)?);
    Ok(paths::remarks(paths).into_iter().fold(drawing, Drawing::note))
}

/// Adds what remains at a steady heading.
fn steady(drawing: Drawing) -> Result<Drawing, ItemError> {
    const NAME: &str = "6.18-steady-heading";
    let flown = scenarios::fly(NAME)?;
    let largest = paths::largest_distance(flown.on(Level::One)?);
    Ok(drawing.scenario(scenarios::find(NAME)?).note(format!(
        "the same path flown at a steady heading: level 1 within {:.2} mm",
        1e3 * largest
    )))
}

/// Checks the error of the highest level under the three controllers.
fn falls(drawing: Drawing, c3: &[Path]) -> Result<Drawing, ItemError> {
    let (c1, c2) = (paths::fly_levels("6.18")?, paths::fly_levels("6.19")?);
    let highest = [&c1, &c2, c3].map(<[Path]>::last);
    let of = |error: fn(&Path) -> f64| highest.map(|path| path.map_or(f64::NAN, error));
    let (on_level_5, along_ground) = (of(Path::rms_error), of(Path::rms_along_ground));
    Ok(drawing.check(
        FALLS,
        on_level_5.is_sorted_by(|a, b| a > b),
        format!("RMS distance on level 5 under c1, c2, c3: {on_level_5:.4?} m, of it along the ground {along_ground:.4?} m"),
    ))
}
