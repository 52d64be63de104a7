//! Figure A.2: quadrotors of levels 1 and 5, each with a station of its own, as animation and still.

use super::encounter::{Encounter, Pair};
use super::pointing::{self, Aim, YAW_ERROR_RAD, aims, most};
use super::still::animation;
use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "A.2",
    title: "Animation of quadrotors of levels 1 and 5, each paired with an energy transmission system",
    description: "A still at 7.2 s of one simulation with four agents: Quad1 is a model of level 1 flown by c1, Quad5 one of level 5 flown by c3; \
                  each flies the path of figure A.1 about a station of its own, 5 m apart, and faces it. The stations know only the \
                  quadrotor that they are paired with. Thin and grey: the paths still ahead.",
    kind: Kind::Animation,
    origin: Origin::Simulated,
    claims: &[POINT, FACE],
    make: Make::Draw(draw),
};

const POINT: Claim = Claim::holds(
    "each ETS points at its own quadrotor: once it has settled, its beam always meets that receiver",
);
const FACE: Claim = Claim::holds(
    "the yaw of the quadrotors, of level 1 as of level 5, points at their own ETS, to within a hundredth of the power",
);

/// The worst of each pair in words, and of all.
fn worst<'a>(pairs: &[(&'a Pair, Vec<Aim>)], what: impl Fn(&Aim) -> f64 + Copy) -> Vec<(&'a str, f64)> {
    pairs
        .iter()
        .map(|(pair, aims)| (pair.quadrotor.as_str(), most(aims, what)))
        .collect()
}

fn draw(_: &Context) -> Result<Drawing, ItemError> {
    let flown = Encounter::fly("A.2")?;
    let pairs: Vec<(&Pair, Vec<Aim>)> = flown
        .pairs
        .iter()
        .map(|pair| Ok((pair, aims(&flown, pair)?)))
        .collect::<Result<_, ItemError>>()?;
    let points = worst(&pairs, |aim| aim.off / aim.half_receiver);
    let faces = worst(&pairs, |aim| aim.yaw_error);
    let words = |all: &[(&str, f64)], say: &dyn Fn(f64) -> String| -> String {
        let each: Vec<String> = all
            .iter()
            .map(|(name, x)| format!("{name} {}", say(*x)))
            .collect();
        each.join(", ")
    };
    let animation = animation(
        &flown,
        "Two quadrotors and two ETSs",
        "t=7.2&still=1&station=ETS5",
    )?;
    Ok(Drawing::animation(animation)
        .scenario(flown.file)
        .check(
            POINT,
            points.iter().all(|(_, x)| *x < 1.0),
            format!(
                "of half the receiver's width at most: {}",
                words(&points, &|x| format!("{x:.2}"))
            ),
        )
        .check(
            FACE,
            faces.iter().all(|(_, x)| *x < YAW_ERROR_RAD),
            format!(
                "{}; {:.1}° allowed",
                words(&faces, &|x| format!("{:.2}°", x.to_degrees())),
                YAW_ERROR_RAD.to_degrees()
            ),
        )
        .data(pointing::table(&pairs)))
}
