//! Figure E.7: static characterisation of rotor 4, right.

use super::rotor::{self, DESCRIPTION, STATED, TRUTH};
use crate::item::{Item, Kind, Make, Origin};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "E.7",
    title: "Characterisation of rotor 4, right",
    description: DESCRIPTION,
    kind: Kind::Plot,
    origin: Origin::VirtualLaboratory,
    claims: &[STATED, TRUTH],
    make: Make::Draw(|context| rotor::draw(context, 3)),
};
