//! Figure 4.9: steady-state torque against PWM duty and battery voltage, with the polynomial.

use super::characterisation::{self, CUBIC, STATED, TRUTH};
use crate::item::{Item, Kind, Make, Origin};
use sysid::rotor_static::Quantity;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "4.9",
    title: "Steady-state torque against PWM duty and battery voltage",
    description: "Readings of the virtual thrust stand (nominal rotor, three voltages, twenty readings a point) with the cubic in \
                  *x* = (*ū* − *ū*_{min}) *V*_{b} fitted to all of them at once; right, what the cubic leaves. The rotor behind \
                  the readings extrapolates its propeller above 7.84 N.",
    kind: Kind::Plot,
    origin: Origin::VirtualLaboratory,
    claims: &[STATED, TRUTH, CUBIC],
    make: Make::Draw(|context| characterisation::draw(context, Quantity::Torque)),
};
