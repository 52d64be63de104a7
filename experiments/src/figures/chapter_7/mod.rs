//! Chapter 7: energy transmission, its geometry and its tracking.

use crate::item::Item;

mod figure_7_1;
mod figure_7_14;
mod figure_7_15;
mod figure_7_2;
mod figure_7_3;
mod figure_7_5;
mod figure_7_6;
mod growth;
pub(super) mod mission;
mod overfill;
mod tracking;

/// The items of this chapter.
pub(super) const ITEMS: &[Item] = &[
    figure_7_1::ITEM,
    figure_7_2::ITEM,
    figure_7_3::ITEM,
    figure_7_5::ITEM,
    figure_7_6::ITEM,
    figure_7_14::ITEM,
    figure_7_15::ITEM,
];
