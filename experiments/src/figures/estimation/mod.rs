//! State estimation: not of the thesis' figures, but of what it asks for.

use crate::item::Item;

mod figure_est_1;
mod figure_est_2;
mod flight;
mod study;
mod sums;
mod table_est_1;

/// The items on state estimation.
pub(super) const ITEMS: &[Item] = &[figure_est_1::ITEM, figure_est_2::ITEM, table_est_1::ITEM];
