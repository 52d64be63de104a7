//! Chapter 4: the propeller's published measurements, and models against recorded flights.

use crate::item::Item;

mod figure_4_12;
mod figure_4_13;
mod figure_4_7;
mod flights;
mod propeller;
mod replays;
mod table_4_3;

/// The items of this chapter.
pub(super) const ITEMS: &[Item] = &[
    figure_4_7::ITEM,
    figure_4_12::ITEM,
    figure_4_13::ITEM,
    table_4_3::ITEM,
];
