//! The energy transmission system of the figures.

use crate::item::{Context, ItemError};
use ets::Station;

/// The station of the figures.
pub const NOMINAL_STATION: &str = "stations/ets.toml";

/// Reads and validates a station's parameter file below `data/`.
///
/// # Errors
/// A file that cannot be read, or that the station's validation refuses.
pub fn load_station(context: &Context, file: &str) -> Result<Station, ItemError> {
    let text = std::fs::read_to_string(context.data(file))?;
    Ok(Station::from_toml_str(&text, file)?)
}
