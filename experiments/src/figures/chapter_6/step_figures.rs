//! Figures 6.4, 6.5, 6.7 to 6.13, 6.15 and 6.16: unit steps on several levels, one scenario file each.

use super::steps::{self, Quantity, Steps, rise_time_s};
use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::item::{Item, ItemError, Kind, Make, Origin};

/// What the figures have in common.
const STEP: Item = Item {
    id: "",
    title: "",
    description: "",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[],
    make: Make::NotReproducible("the pattern of a figure"),
};

/// Height, c1.
pub(super) const FIGURE_6_4: Item = Item {
    id: "6.4",
    title: "Unit step in height: c1 on the family",
    description: "A step of one metre in height under controller c1 on every level, input limits off. Settling time designed: 1 s. Above the height, below the collective pseudo-input.",
    claims: &[COINCIDE],
    make: Make::Draw(|_| Ok(coincide(&steps::fly("6.4", Quantity::Height)?))),
    ..STEP
};

/// Height, c1, limited.
pub(super) const FIGURE_6_5: Item = Item {
    id: "6.5",
    title: "Unit step in height: c1 on the family, inputs limited",
    description: "As figure 6.4 with the rotor commands limited to the vehicle's PWM range, in the controller and in every model.",
    claims: &[INSIDE, SLOWER],
    make: Make::Draw(|_| {
        let limited = steps::fly("6.5", Quantity::Height)?;
        let free = steps::fly("6.4", Quantity::Height)?;
        Ok(slower(inside(&limited), &limited, &free))
    }),
    ..STEP
};

/// Height, c2.
pub(super) const FIGURE_6_7: Item = Item {
    id: "6.7",
    title: "Unit step in height: c2 on levels 2 to 5",
    description: "As figure 6.4 with controller c2, which inverts the non-linear rigid body.",
    claims: &[DESIGN],
    make: Make::Draw(|_| as_designed(&steps::fly("6.7", Quantity::Height)?)),
    ..STEP
};

/// Height, c3.
pub(super) const FIGURE_6_8: Item = Item {
    id: "6.8",
    title: "Unit step in height: c3 on levels 3 to 5",
    description: "As figure 6.4 with controller c3, which inverts the rotor's lag too; its extra pole lies at *p*_{z} = 20 *ω*_{n,z}. Levels 4 and 5 are flown with the controller's own rotor observer. The input is cut where its first spike, up to 1.50, would hide the rest.",
    make: Make::Draw(|_| Ok(steps::fly("6.8", Quantity::Height)?.drawing())),
    ..STEP
};

/// Height, c3, limited.
pub(super) const FIGURE_6_9: Item = Item {
    id: "6.9",
    title: "Unit step in height: c3 on levels 3 to 5, inputs limited",
    description: "As figure 6.8 with the rotor commands limited to the vehicle's PWM range.",
    claims: &[INSIDE],
    make: Make::Draw(|_| Ok(inside(&steps::fly("6.9", Quantity::Height)?))),
    ..STEP
};

/// Yaw, c1.
pub(super) const FIGURE_6_10: Item = Item {
    id: "6.10",
    title: "Unit step in yaw: c1 on the family",
    description: "A step of one radian in heading under controller c1, input limits off. Settling time designed: 2 s. Above the heading, below the yaw pseudo-input. The reaction torque of levels 4 and 5 contains the rotors' spin-up, which makes their yaw response lead that of the lower levels.",
    make: Make::Draw(|_| Ok(steps::fly("6.10", Quantity::Yaw)?.drawing())),
    ..STEP
};

/// Yaw, c2.
pub(super) const FIGURE_6_11: Item = Item {
    id: "6.11",
    title: "Unit step in yaw: c2 on levels 2 to 5",
    description: "A step of one radian in heading under controller c2, input limits off. Settling time designed: 2 s. Above the heading, below the yaw pseudo-input.",
    make: Make::Draw(|_| Ok(steps::fly("6.11", Quantity::Yaw)?.drawing())),
    ..STEP
};

/// Yaw, c3.
pub(super) const FIGURE_6_12: Item = Item {
    id: "6.12",
    title: "Unit step in yaw: c3 on levels 3 to 5",
    description: "A step of one radian in heading under controller c3, input limits off. Settling time designed: 2 s. Above the heading, below the yaw pseudo-input, cut where its first spike, up to 0.31, would hide the rest.",
    make: Make::Draw(|_| Ok(steps::fly("6.12", Quantity::Yaw)?.drawing())),
    ..STEP
};

/// Horizontal position, c1.
pub(super) const FIGURE_6_13: Item = Item {
    id: "6.13",
    title: "Unit step in horizontal position: c1 on the family",
    description: "A step of one metre in *x* under controller c1, input limits off. Above the position, then its difference from level 1, pitch and longitudinal pseudo-input. Settling time designed: 5 s, *ω*_{n,a} = 10 *ω*_{n,p} = 11.7 rad/s, which leaves a margin to the limits of the Routh array above level 3.",
    make: Make::Draw(|_| Ok(steps::fly("6.13", Quantity::X)?.drawing())),
    ..STEP
};

/// Horizontal position, c2.
pub(super) const FIGURE_6_15: Item = Item {
    id: "6.15",
    title: "Unit step in horizontal position: c2 on levels 2 to 5",
    description: "A step of one metre in *x* under controller c2, input limits off. Above the position, then its difference from level 2, pitch and longitudinal pseudo-input. Settling time designed: 5 s, *ω*_{n,a} = 10 *ω*_{n,p} = 11.7 rad/s, which leaves a margin to the limits of the Routh array above level 3.",
    make: Make::Draw(|_| Ok(steps::fly("6.15", Quantity::X)?.drawing())),
    ..STEP
};

/// Horizontal position, c3.
pub(super) const FIGURE_6_16: Item = Item {
    id: "6.16",
    title: "Unit step in horizontal position: c3 on levels 3 to 5",
    description: "A step of one metre in *x* under controller c3, input limits off. Above the position, then its difference from level 3, pitch and the longitudinal pseudo-input, cut where its first spike, up to 0.043, would hide the rest. Settling time designed: 5 s, *ω*_{n,a} = 10 *ω*_{n,p} = 11.7 rad/s, which leaves a margin to the limits of the Routh array above level 3. The source repeats the caption of figure 6.15 here; this is controller c3 on levels 3 to 5, which its series lacks.",
    make: Make::Draw(|_| Ok(steps::fly("6.16", Quantity::X)?.drawing())),
    ..STEP
};

const COINCIDE: Claim = Claim::holds("levels 1 and 2 coincide");
const INSIDE: Claim = Claim::holds("inputs stay inside the limits");
const SLOWER: Claim =
    Claim::holds("the response is slower than in figure 6.4: every level rises to 90 % later");
const DESIGN: Claim =
    Claim::holds("on its own level the controller gives the designed second-order response");

/// Rounding of a few seconds of RK4 steps on numbers of order one.
const SAME: f64 = 1e-9;

/// Commands are held for 1 ms, which delays a response of 5.8 rad/s by half a millisecond.
const HELD: f64 = 5e-3;

fn coincide(steps: &Steps) -> Drawing {
    let responses = steps.responses();
    let apart = steps::distance(&responses[0], &responses[1]);
    let measured = format!("largest distance {apart:.1e} m");
    steps.drawing().check(COINCIDE, apart < SAME, measured)
}

fn inside(steps: &Steps) -> Drawing {
    let excess = steps.largest_excess();
    let measured = format!("largest command beyond a limit {excess:.1e}");
    steps.drawing().check(INSIDE, excess <= 0.0, measured)
}

fn slower(drawing: Drawing, limited: &Steps, free: &Steps) -> Drawing {
    let pairs = limited.responses().into_iter().zip(free.responses());
    let delays: Vec<f64> = pairs.map(|(l, f)| rise_time_s(&l) - rise_time_s(&f)).collect();
    let measured = format!("delays of levels 1 to 5: {delays:.3?} s");
    drawing.check(SLOWER, delays.iter().all(|d| *d > 0.0), measured)
}

fn as_designed(steps: &Steps) -> Result<Drawing, ItemError> {
    let gains = steps.outcomes[0].flight.settings.gains::<f64>()?;
    let off = steps::distance_from_design(&steps.responses()[0], gains.height.natural_frequency);
    let measured = format!("largest distance from the design {:.2} mm", 1e3 * off);
    Ok(steps.drawing().check(DESIGN, off < HELD, measured))
}
