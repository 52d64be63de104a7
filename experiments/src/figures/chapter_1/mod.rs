//! Chapter 1: the scenario.

use crate::item::Item;

mod figure_1_3;

/// The items of this chapter.
pub(super) const ITEMS: &[Item] = &[figure_1_3::ITEM];
