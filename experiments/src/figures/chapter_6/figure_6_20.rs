//! Figure 6.20: c3 following the reference trajectory on levels 3 to 5.

use super::paths;
use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::flight::Law;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use quad_dynamics::Level;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.20",
    title: "Following a trajectory: c3 on levels 3 to 5",
    description: "The reference of figure 6.17 followed by controller c3 on levels 3 to 5, its derivatives fed forward, \
                  input limits off. Below, the distance from the reference. Grey: projection on the ground.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[FALLS],
    make: Make::Draw(draw),
};

const FALLS: Claim = Claim::does_not_hold(
    "on level 5 the error falls from c1 to c3",
    "height dominates: the rotor that is not linear leaves an offset that no controller without integral action removes, and c3's \
     third-order height loop with its own rotor observer is not stiffer than c2's; along the ground the error falls from c1 to c2 and c3",
);

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let paths = paths::fly_levels(context, Law::C3, &Level::ALL[2..])?;
    let (mut on_level_5, mut along_ground) = (Vec::new(), Vec::new());
    for law in [Law::C1, Law::C2, Law::C3] {
        let path = paths::fly_levels(context, law, &[Level::Five])?;
        on_level_5.push(path[0].rms_error());
        along_ground.push(path[0].rms_along_ground());
    }
    let drawing = Drawing::picture(paths::picture(&paths))
        .data(paths::table(&paths))
        .scenario(&paths::scenario(Law::C3))?;
    let drawing = paths::remarks(&paths).into_iter().fold(drawing, Drawing::note);
    Ok(drawing.check(
        FALLS,
        on_level_5.is_sorted_by(|a, b| a > b),
        format!("RMS distance on level 5 under c1, c2, c3: {on_level_5:.4?} m, of it along the ground {along_ground:.4?} m"),
    ))
}
