//! Chapter 4: identification, from published measurements and the virtual laboratory.

use crate::item::Item;

mod advance;
mod bench;
mod characterisation;
mod dynamics;
mod figure_4_10;
mod figure_4_11;
mod figure_4_12;
mod figure_4_13;
mod figure_4_2;
mod figure_4_3;
mod figure_4_4;
mod figure_4_5;
mod figure_4_6;
mod figure_4_7;
mod figure_4_8;
mod figure_4_9;
mod flights;
mod identified;
mod motor_steps;
mod pendulum_sketch;
mod pendulums;
mod propeller;
mod propeller_panels;
mod replays;
mod supports;
mod table_4_1;
mod table_4_2;
mod table_4_3;
mod table_4_4;
mod table_4_5;
mod table_4_6;

pub(crate) use flights::agreement_with_a_recorded_flight;

/// The items of this chapter.
pub(super) const ITEMS: &[Item] = &[
    figure_4_2::ITEM,
    figure_4_3::ITEM,
    figure_4_4::ITEM,
    figure_4_5::ITEM,
    figure_4_6::ITEM,
    figure_4_7::ITEM,
    figure_4_8::ITEM,
    figure_4_9::ITEM,
    figure_4_10::ITEM,
    figure_4_11::ITEM,
    figure_4_12::ITEM,
    figure_4_13::ITEM,
    table_4_1::ITEM,
    table_4_2::ITEM,
    table_4_3::ITEM,
    table_4_4::ITEM,
    table_4_5::ITEM,
    table_4_6::ITEM,
];
