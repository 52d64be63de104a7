//! One module per figure or table of the study, with the claims each of them checks.
//!
//! An [`item::Item`] states what it draws, where its data come from and which [`claim::Claim`]s its run must
//! check; [`figures::all`] lists the items, [`run::run`] makes them and [`gallery`] shows them. The plot layer
//! ([`plot`]) fixes one style for all: the same colour *and* dash for the same level everywhere.
//!
//! ```
//! use experiments::figures;
//!
//! let item = figures::find("5.1").expect("figure 5.1 is registered");
//! assert_eq!(item.chapter(), "5");
//! ```

pub mod claim;
pub mod cli;
pub mod data;
pub mod drawing;
pub mod figures;
pub mod gallery;
pub mod identify;
pub mod item;
pub mod output;
pub mod recordings;
pub mod reference;
mod rotor_bench;
pub mod run;
pub mod scenarios;
pub mod station;
pub mod summary;
pub mod vehicle;

pub use quad_plot as plot;
