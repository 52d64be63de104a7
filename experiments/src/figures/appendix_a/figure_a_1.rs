//! Figure A.1: one quadrotor and one station, as animation and still.

use super::encounter::Encounter;
use super::pointing::{self, YAW_ERROR_RAD, aims, most};
use super::still::animation;
use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "A.1",
    title: "Animation of one quadrotor and one energy transmission system",
    description: "A still at 7.2 s of a flight of 12 s at level 5, flown by c3, at a distance of 3.6 m about a station on a mast of 1 m. The station's \
                  camera has to find the receiver first, 14° off its axis, and then keeps the beam on it; the quadrotor yaws to face the \
                  station. Thin and grey: the path still ahead. Beside it range, incidence and offset of the spot on the receiver, and the view of the station's camera. The \
                  animation plays in any browser.",
    kind: Kind::Animation,
    origin: Origin::Simulated,
    claims: &[POINTS, FACES],
    make: Make::Draw(draw),
};

const POINTS: Claim = Claim::holds(
    "the ETS points at the quadrotor: once it has settled, the axis of its beam always meets the receiver",
);
const FACES: Claim = Claim::holds(
    "the quadrotor's yaw points at the ETS, to within an angle that costs the receiver a hundredth of its power",
);

fn draw(_: &Context) -> Result<Drawing, ItemError> {
    let flown = Encounter::fly("A.1")?;
    let pair = &flown.pairs[0];
    let aims = aims(&flown, pair)?;
    let of_half = most(&aims, |aim| aim.off / aim.half_receiver);
    let yaw_error = most(&aims, |aim| aim.yaw_error);
    let animation = animation(&flown, "One quadrotor and one ETS", "t=7.2&still=1")?;
    Ok(Drawing::animation(animation)
        .scenario(flown.file)
        .check(
            POINTS,
            of_half < 1.0,
            format!(
                "the axis at most {:.2} of half the receiver's width off its centre, {:.2}° off the direction to it",
                of_half,
                most(&aims, |aim| aim.off).to_degrees()
            ),
        )
        .check(
            FACES,
            yaw_error < YAW_ERROR_RAD,
            format!(
                "{:.2}° at most, {:.1}° allowed",
                yaw_error.to_degrees(),
                YAW_ERROR_RAD.to_degrees()
            ),
        )
        .data(pointing::table(&[(pair, aims)])))
}
