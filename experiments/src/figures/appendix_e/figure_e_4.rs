//! Figure E.4: static characterisation of rotor 1, rear.

use super::rotor::{self, DESCRIPTION, STATED, TRUTH};
use crate::item::{Item, Kind, Make, Origin};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "E.4",
    title: "Characterisation of rotor 1, rear",
    description: DESCRIPTION,
    kind: Kind::Plot,
    origin: Origin::VirtualLaboratory,
    claims: &[STATED, TRUTH],
    make: Make::Draw(|context| rotor::draw(context, 0)),
};
