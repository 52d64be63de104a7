//! Appendix E: calibration of the load cells.

use crate::item::Item;

mod calibration;
mod load_cells;

/// The items of this appendix.
pub(super) const ITEMS: &[Item] = &[
    load_cells::FIGURE_E_1,
    load_cells::FIGURE_E_2,
    load_cells::FIGURE_E_3,
    load_cells::TABLE_E_1,
    load_cells::TABLE_E_2,
    load_cells::TABLE_E_3,
];
