//! Chapter 3: the quadrotor's frames, forces and moments.

use crate::item::Item;

mod figure_3_1;
mod figure_3_2;

/// The items of this chapter.
pub(super) const ITEMS: &[Item] = &[figure_3_1::ITEM, figure_3_2::ITEM];
