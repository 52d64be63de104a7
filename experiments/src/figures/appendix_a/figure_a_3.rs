//! Figure A.3: the view of the camera on the station, with the compass of its direction and inclination.

use super::encounter::Encounter;
use super::pointing::{self, aims, most};
use super::still::animation;
use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "A.3",
    title: "View of the camera on the energy transmission system",
    description: "The flight of figure A.1 at 7.2 s as the station's camera sees it, with its lens's proportions. The compass along the upper edge \
                  and the rose give the direction of the camera (blue the field of view, grey what the gimbal can't reach), the scale \
                  along the right edge and the quadrant its inclination; the cross-hair is the optical axis, along which the beam runs.",
    kind: Kind::Animation,
    origin: Origin::Simulated,
    claims: &[SEEN, READS],
    make: Make::Draw(draw),
};

const SEEN: Claim = Claim::holds(
    "the camera sees the receiver throughout, within a tenth of the picture's width of its centre once settled",
);
const READS: Claim = Claim::holds(
    "once it has settled, direction and inclination of the compass are those of the quadrotor's receiver, to within half its width",
);

fn draw(_: &Context) -> Result<Drawing, ItemError> {
    let flown = Encounter::fly("A.1")?;
    let pair = &flown.pairs[0];
    let aims = aims(&flown, pair)?;
    let image = most(&aims, |aim| aim.image);
    let of_half = most(&aims, |aim| {
        aim.bearing_error.max(aim.inclination_error) / aim.half_receiver
    });
    let [direction, inclination] = [
        most(&aims, |aim| aim.bearing_error).to_degrees(),
        most(&aims, |aim| aim.inclination_error).to_degrees(),
    ];
    let tenth = pair.ets.camera.pixels[0] / 10.0;
    let always = aims.iter().all(|aim| aim.visible);
    let animation = animation(&flown, "View of the camera on the ETS", "t=7.2&still=1&view=ets")?;
    Ok(Drawing::animation(animation)
        .scenario(flown.file)
        .check(
            SEEN,
            always && image < tenth,
            format!("{image:.1} px off the centre at most, {tenth:.0} px allowed"),
        )
        .check(
            READS,
            of_half < 1.0,
            format!("direction {direction:.2}°, inclination {inclination:.2}° off at most; {of_half:.2} of half the width"),
        )
        .data(pointing::table(&[(pair, aims)])))
}
