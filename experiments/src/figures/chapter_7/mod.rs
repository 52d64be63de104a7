//! Chapter 7: energy transmission, its geometry and its tracking.

use crate::item::Item;

mod annealed;
mod crossed;
mod crossed_energy;
mod energy;
mod figure_7_1;
mod figure_7_14;
mod figure_7_15;
mod figure_7_2;
mod figure_7_3;
mod figure_7_5;
mod figure_7_6;
mod figure_7_7;
mod figure_beyond_3;
mod figure_beyond_4;
mod four_variables;
mod global_minima;
mod growth;
mod guided;
mod himmelblau;
pub(super) mod mission;
mod optimisations;
mod overfill;
mod run_time;
mod six_variables;
mod solution_table;
mod solutions;
mod tracking;
mod two_variables;

/// The items of this chapter.
pub(super) const ITEMS: &[Item] = &[
    figure_7_1::ITEM,
    figure_7_2::ITEM,
    figure_7_3::ITEM,
    figure_7_5::ITEM,
    figure_7_6::ITEM,
    figure_7_7::ITEM,
    two_variables::FIGURE_7_8,
    two_variables::FIGURE_7_9,
    two_variables::FIGURE_7_10,
    two_variables::FIGURE_7_11,
    two_variables::FIGURE_7_12,
    two_variables::FIGURE_7_13,
    two_variables::TABLE_7_1,
    two_variables::TABLE_7_2,
    four_variables::FIGURE_7_16,
    four_variables::FIGURE_7_17,
    four_variables::FIGURE_7_18,
    four_variables::FIGURE_7_19,
    four_variables::FIGURE_7_20,
    four_variables::TABLE_7_3,
    four_variables::TABLE_7_4,
    six_variables::FIGURE_7_21,
    six_variables::FIGURE_7_22,
    six_variables::FIGURE_7_23,
    six_variables::FIGURE_7_24,
    six_variables::FIGURE_7_25,
    six_variables::TABLE_7_5,
    six_variables::TABLE_7_7,
    global_minima::TABLE_7_6,
    crossed::FIGURE_7_26,
    crossed::FIGURE_7_27,
    figure_7_14::ITEM,
    figure_7_15::ITEM,
    figure_beyond_3::ITEM,
    figure_beyond_4::ITEM,
];
