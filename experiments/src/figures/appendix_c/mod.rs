//! Appendix C: flight tests.

use crate::item::Item;

mod figure_c_2;

/// The items of this appendix.
pub(super) const ITEMS: &[Item] = &[figure_c_2::ITEM];
