//! Photographs, which a program cannot reproduce; they are listed so that no number is missing.

use crate::item::{Item, Kind, Make, Origin};

/// The photographs of all chapters.
pub(super) const ITEMS: &[Item] = &[
    photograph(
        "1.1",
        "A quadrotor in flight",
        "An example of the class of vehicles that the study is about.",
    ),
    photograph(
        "1.2",
        "The Qball-X4",
        "The quadrotor in its protective cage whose parameters the study identifies.",
    ),
    photograph(
        "2.2",
        "Early wireless transmission of power",
        "A historical photograph of Tesla's experiments.",
    ),
    photograph(
        "2.3",
        "Flight on beamed power",
        "A photograph by NASA of an aircraft flying on a beam of light.",
    ),
    photograph(
        "4.1",
        "The flight laboratory",
        "The indoor flight volume with its motion-capture cameras.",
    ),
    photograph(
        "7.4",
        "The energy transmission station",
        "The gimballed laser with its camera, as built.",
    ),
    photograph(
        "C.3",
        "Flights in the laboratory",
        "Photographs taken during the recorded flights.",
    ),
];

const fn photograph(id: &'static str, title: &'static str, description: &'static str) -> Item {
    Item {
        id,
        title,
        description,
        kind: Kind::Photograph,
        origin: Origin::Measured,
        claims: &[],
        make: Make::NotReproducible("a photograph; there is nothing to compute"),
    }
}
