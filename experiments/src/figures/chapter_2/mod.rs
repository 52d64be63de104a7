//! Chapter 2: background.

use crate::item::Item;

mod figure_2_4;

/// The items of this chapter.
pub(super) const ITEMS: &[Item] = &[figure_2_4::ITEM];
