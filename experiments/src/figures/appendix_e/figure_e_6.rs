//! Figure E.6: static characterisation of rotor 3, left.

use super::rotor::{self, DESCRIPTION, STATED, TRUTH};
use crate::item::{Item, Kind, Make, Origin};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "E.6",
    title: "Characterisation of rotor 3, left",
    description: DESCRIPTION,
    kind: Kind::Plot,
    origin: Origin::VirtualLaboratory,
    claims: &[STATED, TRUTH],
    make: Make::Draw(|context| rotor::draw(context, 2)),
};
