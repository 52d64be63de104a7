#![doc = include_str!("../README.md")]
#![doc = "\n# Example\n"]
//! ```
//! use provenance::{Sourced, from_toml};
//! use serde::Deserialize;
//!
//! #[derive(Deserialize)]
//! struct Body {
//!     mass_kg: Sourced<f64>,
//! }
//!
//! let body: Body = from_toml("mass_kg = { value = 0.65, source = \"scale\" }", "body.toml")?;
//! assert_eq!((body.mass_kg.value, body.mass_kg.source.as_str()), (0.65, "scale"));
//!
//! let error = from_toml::<Body>("mass = 0.65", "body.toml").map(|_| ()).unwrap_err();
//! assert_eq!(error.to_string(), "body.toml:1:1: missing key `mass_kg`");
//! # Ok::<(), provenance::ReadError>(())
//! ```

mod document;
mod place;
mod quantity;
mod read;
mod sourced;
#[cfg(test)]
mod tests;

pub use document::Document;
pub use place::{Place, Position};
pub use quantity::{Quantity, RangeError};
pub use read::{ReadError, from_table, from_toml, from_toml_and_table};
pub use sourced::{NOT_STATED, Sourced};
