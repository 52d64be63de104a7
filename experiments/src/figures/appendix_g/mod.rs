//! Appendix G: data tables.

use crate::item::Item;

pub(super) mod crossing;
pub(super) mod table_g_1;
mod table_g_2;
mod table_g_3;
mod table_g_4;

/// The items of this appendix.
pub(super) const ITEMS: &[Item] = &[table_g_1::ITEM, table_g_2::ITEM, table_g_3::ITEM, table_g_4::ITEM];
