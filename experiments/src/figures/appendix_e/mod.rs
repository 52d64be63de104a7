//! Appendix E: calibration and characterisation on the bench.

use crate::item::Item;

mod figure_e_4;
mod figure_e_5;
mod figure_e_6;
mod figure_e_7;
mod figure_e_8;
mod rotor;

/// The items of this appendix.
pub(super) const ITEMS: &[Item] = &[
    figure_e_4::ITEM,
    figure_e_5::ITEM,
    figure_e_6::ITEM,
    figure_e_7::ITEM,
    figure_e_8::ITEM,
];
