//! What the property tests across the crates draw from: random vehicles, states and inputs, and the
//! models of the family by name, over any scalar.
//!
//! The tests themselves are in `tests/family`: laws between levels, one battery for every model, no heap in a step.

/// The workspace's front page, whose program is compiled and run as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
pub struct FrontPage;

mod flights;
mod models;
mod vehicles;

pub use flights::{Draw, attitude, body, draw, vector};
pub use models::{
    Family, FamilyFive, FamilyFour, FamilyMechanistic, FamilyOne, FamilyThree, FamilyTwo, flat, from_flat,
    join, phenomena, rate, split,
};
pub use vehicles::{vehicle, without_offset};
