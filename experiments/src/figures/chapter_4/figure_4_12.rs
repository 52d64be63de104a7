//! Figure 4.12: accelerations, flight test against simulation, on the flight that the vehicle was calibrated on.

use super::flights::{self, FITTED, LEVELS, Study};
use super::replays::{self, cell};
use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use quad_dynamics::Level;
use sysid::validation::{Agreement, Prediction};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "4.12",
    title: "Accelerations, flight test against simulation: the fitted flight",
    description: "A Crazyflie flies a figure of eight at 0.5 m/s under motion capture (NanoBench, Ullah and Baca 2026); its recorded motor \
                  commands and battery voltage drive levels 2 to 5. Thrust curve and rotors were identified on other flights (ARPL, \
                  Eschmann, Albani and Loianno 2024); effective mass, inertia, lag and trim of this vehicle *on this flight*. \
                  Lines are one-step predictions, means over 0.05 s, of which 4 of 13 s are drawn; fits are level 5's over all 13 s. \
                  In (d) the levels lie some 10 rad s^{−2} above the measurement: the motors' commands hold a moment of the rotors in sideways flow, \
                  which none of the levels has.",
    kind: Kind::Plot,
    origin: Origin::MeasuredAndSimulated,
    claims: &[STATED, VERTICAL, ROTATION],
    make: Make::Draw(draw),
};

pub(super) const STATED: Claim =
    Claim::holds("fit % per axis is stated, with Theil's coefficient, for levels 2 to 5");
pub(super) const VERTICAL: Claim = Claim::holds(
    "level 5, which knows the battery voltage, has the smallest Theil coefficient in vertical acceleration",
);
pub(super) const ROTATION: Claim = Claim::does_not_hold(
    "roll and pitch accelerations are predicted better than by their mean",
    "none of the levels has the moment of rotors in sideways flow, which goes with velocity and which the motors worked against all the time",
);

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let study = flights::study(context, FITTED)?;
    let stated = stated(&study)?;
    let vertical = vertical(&study)?;
    let rotation = rotation(&study)?;
    let drawing = replays::drawing(&study, FITTED)?;
    Ok(drawing
        .check(STATED, stated.pass, stated.measured)
        .check(VERTICAL, vertical.pass, vertical.measured)
        .check(ROTATION, rotation.pass, rotation.measured))
}

/// What a claim's check found.
pub(super) struct Outcome {
    pub(super) pass: bool,
    pub(super) measured: String,
}

/// Whether every level has a fit on every axis; level 5's as words.
pub(super) fn stated(study: &Study) -> Result<Outcome, ItemError> {
    let mut pass = true;
    let mut words = Vec::new();
    for level in LEVELS {
        let agreement = &study.run(level, Prediction::OneStep)?.agreement;
        let axes: Vec<&Agreement> = agreement
            .acceleration
            .iter()
            .chain(&agreement.angular_acceleration)
            .collect();
        pass &= axes
            .iter()
            .all(|a| a.fit_percent.is_some_and(f64::is_finite) && (0.0..=1.0).contains(&a.theil));
        let cells: Vec<String> = axes.iter().map(|a| cell(a)).collect();
        words.push(format!("{level}: {}", cells.join(", ")));
    }
    let measured = format!("one-step, x, y, z, roll, pitch, yaw: {}", words.join("; "));
    Ok(Outcome { pass, measured })
}

/// Whether level 5's vertical acceleration is the best.
pub(super) fn vertical(study: &Study) -> Result<Outcome, ItemError> {
    let theil =
        |level| Ok::<f64, ItemError>(study.run(level, Prediction::OneStep)?.agreement.acceleration[2].theil);
    let five = theil(Level::Five)?;
    let others = [theil(Level::Two)?, theil(Level::Three)?, theil(Level::Four)?];
    Ok(Outcome {
        pass: others.iter().all(|u| five < *u),
        measured: format!(
            "U = {five:.2} at level 5; {:.2}, {:.2}, {:.2} at levels 2, 3, 4",
            others[0], others[1], others[2]
        ),
    })
}

/// Whether roll and pitch accelerations of level 5 have a positive fit, and how much of what is left goes with velocity.
pub(super) fn rotation(study: &Study) -> Result<Outcome, ItemError> {
    let run = study.run(Level::Five, Prediction::OneStep)?;
    let mut pass = true;
    let mut words = Vec::new();
    for (axis, name) in ["roll", "pitch"].iter().enumerate() {
        let fit = run.agreement.angular_acceleration[axis]
            .fit_percent
            .unwrap_or(f64::NEG_INFINITY);
        let left =
            sysid::validation::moment_of_velocity(&study.flight, &run.replay.angular_acceleration[axis])?;
        let explained = 100.0 * left.goodness.r_squared.unwrap_or(0.0);
        pass &= fit > 0.0;
        words.push(format!(
            "{name} {fit:.0} %, velocity explains {explained:.0} % of the variance left"
        ));
    }
    Ok(Outcome {
        pass,
        measured: format!("level 5, one-step: {}", words.join("; ")),
    })
}
