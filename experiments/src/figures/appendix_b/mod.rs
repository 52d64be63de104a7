//! Appendix B: equipment.

use crate::item::Item;

mod table_b_1;

/// The items of this appendix.
pub(super) const ITEMS: &[Item] = &[table_b_1::ITEM];
