//! Chapter 6: non-linear dynamic inversion on the model family.

use crate::item::Item;

pub(crate) use figure_6_14::claims_of as claims_of_figure_6_14;
pub(crate) use paths::{flight_settings, waypoints as path_waypoints};

mod comparison;
mod figure_6_1;
mod figure_6_14;
mod figure_6_17;
mod figure_6_2;
mod figure_6_3;
mod figure_6_6;
mod paths;
mod step_figures;
mod steps;
mod trajectory_figures;

/// The items of this chapter.
pub(super) const ITEMS: &[Item] = &[
    figure_6_1::ITEM,
    figure_6_2::ITEM,
    figure_6_3::ITEM,
    step_figures::FIGURE_6_4,
    step_figures::FIGURE_6_5,
    figure_6_6::ITEM,
    step_figures::FIGURE_6_7,
    step_figures::FIGURE_6_8,
    step_figures::FIGURE_6_9,
    step_figures::FIGURE_6_10,
    step_figures::FIGURE_6_11,
    step_figures::FIGURE_6_12,
    step_figures::FIGURE_6_13,
    figure_6_14::ITEM,
    step_figures::FIGURE_6_15,
    step_figures::FIGURE_6_16,
    figure_6_17::ITEM,
    trajectory_figures::FIGURE_6_18,
    trajectory_figures::FIGURE_6_19,
    trajectory_figures::FIGURE_6_20,
    comparison::FIGURE_6_21,
    comparison::FIGURE_6_22,
    comparison::FIGURE_6_23,
    comparison::FIGURE_6_24,
    comparison::FIGURE_6_25,
];
