//! Appendix E: calibration of the load cells, characterisation of the rotors.

use crate::item::Item;

mod calibration;
mod figure_e_4;
mod figure_e_5;
mod figure_e_6;
mod figure_e_7;
mod figure_e_8;
mod load_cells;
mod rotor;

/// The items of this appendix.
pub(super) const ITEMS: &[Item] = &[
    load_cells::FIGURE_E_1,
    load_cells::FIGURE_E_2,
    load_cells::FIGURE_E_3,
    figure_e_4::ITEM,
    figure_e_5::ITEM,
    figure_e_6::ITEM,
    figure_e_7::ITEM,
    figure_e_8::ITEM,
    load_cells::TABLE_E_1,
    load_cells::TABLE_E_2,
    load_cells::TABLE_E_3,
];
