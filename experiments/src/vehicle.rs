//! The vehicle of the figures.

use crate::item::{Context, ItemError};
use quad_dynamics::Vehicle;

/// The vehicle of the figures.
pub const NOMINAL_VEHICLE: &str = "vehicles/qball-x4.toml";

/// A vehicle from its parameter file below `data/`.
///
/// # Errors
/// A file that can't be read or is not a valid vehicle.
pub fn load_vehicle(context: &Context, relative: &str) -> Result<Vehicle, ItemError> {
    let path = context.data(relative);
    let text =
        std::fs::read_to_string(&path).map_err(|e| ItemError::new(format!("{}: {e}", path.display())))?;
    Ok(Vehicle::from_toml_str(&text, relative)?)
}
