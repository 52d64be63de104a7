//! Appendix F: stability of the linearised loops.

use crate::item::Item;

/// The items of this chapter.
pub(super) const ITEMS: &[Item] = &[];
