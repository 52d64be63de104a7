//! Chapter 5: models at several resolutions.

use crate::item::Item;

mod attribution;
mod dynamic_resolution;
mod figure_5_1;
mod figure_5_2;
mod models;
mod table_5_1;

/// The items of this chapter.
pub(super) const ITEMS: &[Item] = &[
    figure_5_1::ITEM,
    figure_5_2::ITEM,
    table_5_1::ITEM,
    attribution::ITEM,
    dynamic_resolution::ITEM,
];
