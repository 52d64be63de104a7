//! Figures and tables E.1 to E.3: calibration of the load cells for thrust and for torque in both directions.

use super::calibration::{DEPARTURE_ALLOWED, Subject, curve, samples};
use crate::claim::Claim;
use crate::item::{Item, Kind, Make, Origin};
use sysid::laboratory::load_cells::Channel;

/// Registered for each figure.
pub(super) const LINEAR: Claim = Claim::holds("linear");
/// Registered for each figure.
pub(super) const INSIDE: Claim = Claim::holds(
    "zero and sensitivity of the virtual cell lie inside 89 to 98 % of the 95 % intervals of 200 calibrations with other noise",
);

const THRUST: Subject = Subject {
    channel: Channel::Thrust,
    quantity: "Thrust *T*",
    unit: "N",
    column: "load_n",
    scale: 1.0,
    seed: 61,
};
const CLOCKWISE: Subject = Subject {
    channel: Channel::TorqueClockwise,
    quantity: "Torque *Q*, clockwise",
    unit: "mN m",
    column: "load_n_m",
    scale: 1e3,
    seed: 62,
};
const COUNTER_CLOCKWISE: Subject = Subject {
    channel: Channel::TorqueCounterClockwise,
    quantity: "Torque *Q*, counter-clockwise",
    unit: "mN m",
    column: "load_n_m",
    scale: 1e3,
    seed: 63,
};

const _: () = assert!(DEPARTURE_ALLOWED == 1e-3, "the descriptions say 0.1 %");

/// Figure E.1.
pub(super) const FIGURE_E_1: Item = figure(
    "E.1",
    "Calibration of the load cell, thrust",
    "Readings of the thrust cell in the virtual laboratory under dead weights, up and down, two readings each, with the \
     calibration line (a) and the residuals with the line's 95 % band (b). *Linear* means: neither a quadratic term nor a lack of \
     fit is significant at one in a thousand, and the best parabola departs by less than 0.1 % of the span.",
    Make::Draw(|_| curve(&THRUST)),
);
/// Figure E.2.
pub(super) const FIGURE_E_2: Item = figure(
    "E.2",
    "Calibration of the load cell, torque clockwise",
    "As figure E.1, for the torque cell loaded clockwise by weights on its arm. Virtual laboratory.",
    Make::Draw(|_| curve(&CLOCKWISE)),
);
/// Figure E.3.
pub(super) const FIGURE_E_3: Item = figure(
    "E.3",
    "Calibration of the load cell, torque counter-clockwise",
    "As figure E.2, loaded the other way: torque and reading are negative, and the virtual cell is 0.4 % less sensitive \
     (assumed), which is why both directions are calibrated. Virtual laboratory.",
    Make::Draw(|_| curve(&COUNTER_CLOCKWISE)),
);
/// Table E.1.
pub(super) const TABLE_E_1: Item = table(
    "table-E.1",
    "Load-cell samples, thrust",
    "The readings drawn in figure E.1, on the way up and on the way down. Virtual laboratory.",
    Make::Draw(|_| samples(&THRUST)),
);
/// Table E.2.
pub(super) const TABLE_E_2: Item = table(
    "table-E.2",
    "Load-cell samples, torque clockwise",
    "The readings drawn in figure E.2, on the way up and on the way down. Virtual laboratory.",
    Make::Draw(|_| samples(&CLOCKWISE)),
);
/// Table E.3.
pub(super) const TABLE_E_3: Item = table(
    "table-E.3",
    "Load-cell samples, torque counter-clockwise",
    "The readings drawn in figure E.3, on the way up and on the way down. Virtual laboratory.",
    Make::Draw(|_| samples(&COUNTER_CLOCKWISE)),
);

const fn figure(id: &'static str, title: &'static str, description: &'static str, make: Make) -> Item {
    Item {
        id,
        title,
        description,
        kind: Kind::Plot,
        origin: Origin::VirtualLaboratory,
        claims: &[LINEAR, INSIDE],
        make,
    }
}

const fn table(id: &'static str, title: &'static str, description: &'static str, make: Make) -> Item {
    Item {
        id,
        title,
        description,
        kind: Kind::Table,
        origin: Origin::VirtualLaboratory,
        claims: &[],
        make,
    }
}
