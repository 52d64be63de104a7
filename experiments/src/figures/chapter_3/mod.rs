//! Chapter 3: forces and moments of a quadrotor.

use crate::item::Item;

/// The items of this chapter.
pub(super) const ITEMS: &[Item] = &[];
