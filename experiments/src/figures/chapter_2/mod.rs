//! Chapter 2: background.

use crate::item::Item;

mod confidence;
mod figure_2_1;
mod figure_2_4;

/// The items of this chapter.
pub(super) const ITEMS: &[Item] = &[figure_2_1::ITEM, figure_2_4::ITEM];
