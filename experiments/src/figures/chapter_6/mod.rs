//! Chapter 6: non-linear dynamic inversion on the model family.

use crate::item::Item;

mod figure_6_1;

/// The items of this chapter.
pub(super) const ITEMS: &[Item] = &[figure_6_1::ITEM];
