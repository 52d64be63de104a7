//! Chapter 4: the propeller's published measurements.

use crate::item::Item;

mod figure_4_7;
mod propeller;
mod propeller_panels;
mod table_4_3;

/// The items of this chapter.
pub(super) const ITEMS: &[Item] = &[figure_4_7::ITEM, table_4_3::ITEM];
