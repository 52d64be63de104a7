//! Chapter 6: non-linear dynamic inversion on the model family.

use crate::item::Item;

pub(crate) use figure_6_14::claims_of as claims_of_figure_6_14;
pub(crate) use paths::scenario as reference_scenario;
pub(crate) use paths::waypoints as path_waypoints;
pub(crate) use settings::flight as flight_settings;

mod comparison;
mod figure_6_1;
mod figure_6_10;
mod figure_6_11;
mod figure_6_12;
mod figure_6_13;
mod figure_6_14;
mod figure_6_15;
mod figure_6_16;
mod figure_6_17;
mod figure_6_18;
mod figure_6_19;
mod figure_6_2;
mod figure_6_20;
mod figure_6_21;
mod figure_6_22;
mod figure_6_23;
mod figure_6_24;
mod figure_6_25;
mod figure_6_3;
mod figure_6_4;
mod figure_6_5;
mod figure_6_6;
mod figure_6_7;
mod figure_6_8;
mod figure_6_9;
mod paths;
mod settings;
mod steps;

/// The items of this chapter.
pub(super) const ITEMS: &[Item] = &[
    figure_6_1::ITEM,
    figure_6_2::ITEM,
    figure_6_3::ITEM,
    figure_6_4::ITEM,
    figure_6_5::ITEM,
    figure_6_6::ITEM,
    figure_6_7::ITEM,
    figure_6_8::ITEM,
    figure_6_9::ITEM,
    figure_6_10::ITEM,
    figure_6_11::ITEM,
    figure_6_12::ITEM,
    figure_6_13::ITEM,
    figure_6_14::ITEM,
    figure_6_15::ITEM,
    figure_6_16::ITEM,
    figure_6_17::ITEM,
    figure_6_18::ITEM,
    figure_6_19::ITEM,
    figure_6_20::ITEM,
    figure_6_21::ITEM,
    figure_6_22::ITEM,
    figure_6_23::ITEM,
    figure_6_24::ITEM,
    figure_6_25::ITEM,
];
