//! Appendix C: flight tests.

use crate::item::Item;

mod figure_c_1;
mod figure_c_2;
mod rig;
mod rig_picture;

/// The items of this appendix.
pub(super) const ITEMS: &[Item] = &[figure_c_1::ITEM, figure_c_2::ITEM];
