//! Chapter 4: bench tests in the virtual laboratory, and the propeller's published measurements.

use crate::item::Item;

mod bench;
mod figure_4_2;
mod figure_4_3;
mod figure_4_4;
mod figure_4_5;
mod figure_4_6;
mod figure_4_7;
mod pendulum_sketch;
mod pendulums;
mod propeller;
mod supports;
mod table_4_1;
mod table_4_2;
mod table_4_3;

/// The items of this chapter.
pub(super) const ITEMS: &[Item] = &[
    figure_4_2::ITEM,
    figure_4_3::ITEM,
    figure_4_4::ITEM,
    figure_4_5::ITEM,
    figure_4_6::ITEM,
    figure_4_7::ITEM,
    table_4_1::ITEM,
    table_4_2::ITEM,
    table_4_3::ITEM,
];
