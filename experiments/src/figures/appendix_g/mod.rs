//! Appendix G: properties of vehicle, station and controllers.

use crate::item::Item;

/// The items of this chapter.
pub(super) const ITEMS: &[Item] = &[];
