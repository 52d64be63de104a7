//! Figure E.5: static characterisation of rotor 2, front.

use super::rotor::{self, DESCRIPTION, STATED, TRUTH};
use crate::item::{Item, Kind, Make, Origin};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "E.5",
    title: "Characterisation of rotor 2, front",
    description: DESCRIPTION,
    kind: Kind::Plot,
    origin: Origin::VirtualLaboratory,
    claims: &[STATED, TRUTH],
    make: Make::Draw(|context| rotor::draw(context, 1)),
};
