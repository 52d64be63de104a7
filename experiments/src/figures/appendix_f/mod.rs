//! Appendix F: tuning of the attitude controller and stability of the horizontal response.

use crate::item::Item;

mod figure_f_1;
mod figure_f_2;
mod figure_f_3;
mod figure_f_4;
mod sweep;
mod table_f_1;

/// The items of this appendix.
pub(super) const ITEMS: &[Item] = &[
    figure_f_1::ITEM,
    figure_f_2::ITEM,
    figure_f_3::ITEM,
    figure_f_4::ITEM,
    table_f_1::ITEM,
];
