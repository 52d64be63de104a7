//! The items: one module per figure or table, in a folder per chapter.
//!
//! A module holds `pub(super) const ITEM: Item`; its chapter's `ITEMS` lists it, and [`all`] joins the chapters.

use crate::item::Item;

mod appendix_a;
mod appendix_b;
mod appendix_c;
mod appendix_e;
mod appendix_f;
mod appendix_g;
mod chapter_1;
mod chapter_2;
mod chapter_3;
mod chapter_4;
mod chapter_5;
mod chapter_6;
mod chapter_7;
mod estimation;
mod glyphs;
mod photographs;

use appendix_g::table_g_1::escaped;
pub(crate) use chapter_4::agreement_with_a_recorded_flight;
pub(crate) use chapter_6::{claims_of_figure_6_14, flight_settings, path_waypoints};

const CHAPTERS: &[&[Item]] = &[
    photographs::ITEMS,
    chapter_1::ITEMS,
    chapter_2::ITEMS,
    chapter_3::ITEMS,
    chapter_4::ITEMS,
    chapter_5::ITEMS,
    chapter_6::ITEMS,
    chapter_7::ITEMS,
    appendix_a::ITEMS,
    appendix_b::ITEMS,
    appendix_c::ITEMS,
    appendix_e::ITEMS,
    appendix_f::ITEMS,
    appendix_g::ITEMS,
    estimation::ITEMS,
];

/// `steps + 1` numbers from `from` to `to`, evenly apart.
fn sweep(from: f64, to: f64, steps: u32) -> Vec<f64> {
    (0..=steps)
        .map(|k| from + (to - from) * f64::from(k) / f64::from(steps))
        .collect()
}

/// All items in reading order.
pub fn all() -> Vec<Item> {
    let mut items = CHAPTERS.concat();
    items.sort_by_key(Item::order);
    items
}

/// The item with this identifier.
pub fn find(id: &str) -> Option<Item> {
    CHAPTERS
        .iter()
        .copied()
        .flatten()
        .find(|item| item.id == id)
        .copied()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::item::{Kind, Make};

    #[test]
    fn prop_identifiers_and_claims_are_unique() {
        let items = all();
        for (i, item) in items.iter().enumerate() {
            assert!(
                items[..i].iter().all(|other| other.id != item.id),
                "{} is registered twice",
                item.id
            );
            for (j, claim) in item.claims.iter().enumerate() {
                let repeated = item.claims[..j].iter().any(|other| other.text == claim.text);
                assert!(!repeated, "{}: \"{}\" is registered twice", item.id, claim.text);
            }
        }
    }

    #[test]
    fn prop_items_are_described_and_photographs_have_a_reason() {
        for item in all() {
            assert!(
                !item.title.is_empty() && !item.title.ends_with('.'),
                "{}",
                item.id
            );
            assert!(item.description.len() > item.title.len(), "{}", item.id);
            let photograph = item.kind == Kind::Photograph;
            assert_eq!(
                photograph,
                matches!(item.make, Make::NotReproducible(_)),
                "{}",
                item.id
            );
            assert_eq!(
                item.kind == Kind::Table,
                item.id.starts_with("table-"),
                "{}",
                item.id
            );
        }
    }

    #[test]
    fn exact_reading_order() {
        let ids: Vec<_> = all().iter().map(|item| item.id).collect();
        let place = |id: &str| ids.iter().position(|other| *other == id);
        assert!(place("1.1") < place("5.1") && place("5.1") < place("6.1") && place("7.4") < place("C.3"));
    }
}
