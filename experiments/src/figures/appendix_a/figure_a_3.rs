//! Figure A.3: the view of the camera on the station, with the compass of its direction and inclination.

use super::encounter::{Encounter, Pair};
use super::pointing::{self, aims, most, settled};
use super::still::animation;
use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use quad_dynamics::Level;

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
    "direction and inclination of the compass are those of the quadrotor's receiver, to within 1°",
);

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let flown = Encounter::of(vec![Pair {
        quadrotor: "Quad",
        level: Level::Five,
        station: "ETS",
        position_m: [0.0, 0.0, -1.0],
    }])
    .fly(context)?;
    let pair = &flown.encounter.pairs[0];
    let aims = aims(&flown, pair)?;
    let image = most(&aims, |aim| aim.image);
    let [direction, inclination] = [
        most(&aims, |aim| aim.bearing_error).to_degrees(),
        most(&aims, |aim| aim.inclination_error).to_degrees(),
    ];
    let tenth = flown.nominal().camera.pixels[0] / 10.0;
    let always = settled(&aims).all(|aim| aim.visible);
    let animation = animation(&flown, "View of the camera on the ETS", "t=7.2&still=1&view=ets")?;
    Ok(Drawing::animation(animation)
        .scenario(&flown.encounter)?
        .check(
            SEEN,
            always && image < tenth,
            format!("{image:.1} px off the centre at most, {tenth:.0} px allowed"),
        )
        .check(
            READS,
            direction < 1.0 && inclination < 1.0,
            format!("direction {direction:.2}°, inclination {inclination:.2}° off at most"),
        )
        .data(pointing::table(&[(pair, aims)])))
}
