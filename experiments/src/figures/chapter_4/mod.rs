//! Chapter 4: identification of the parameters.

use crate::item::Item;

/// The items of this chapter.
pub(super) const ITEMS: &[Item] = &[];
