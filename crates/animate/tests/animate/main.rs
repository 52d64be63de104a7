//! Pages, their data and what a browser makes of them.

mod bad_input;
mod browser;
mod contents;
#[cfg(feature = "mcap")]
mod mcap;
mod support;
