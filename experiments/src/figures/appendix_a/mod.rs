//! Appendix A: the simulation engine's animations.

use crate::item::Item;

mod encounter;
mod figure_a_1;
mod figure_a_2;
mod figure_a_3;
mod pointing;
mod still;

/// The items of this appendix.
pub(super) const ITEMS: &[Item] = &[figure_a_1::ITEM, figure_a_2::ITEM, figure_a_3::ITEM];
