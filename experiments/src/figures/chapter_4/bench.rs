//! The vehicle on the bench of this chapter.

use crate::item::{Context, ItemError};
use crate::vehicle::{NOMINAL_VEHICLE, load_vehicle};
use quad_dynamics::Vehicle;

/// Centre of mass of the vehicle on the bench, m along the airframe's axes: the vendor's model has it in the middle, which would
/// leave nothing to find.
pub(super) const CENTRE_OF_MASS_M: [f64; 3] = [0.004, -0.006, 0.012];

/// The nominal vehicle with its centre of mass out of the middle.
pub(super) fn vehicle(context: &Context) -> Result<Vehicle, ItemError> {
    let mut vehicle = load_vehicle(context, NOMINAL_VEHICLE)?;
    vehicle.airframe.centre_of_mass = CENTRE_OF_MASS_M.into();
    Ok(vehicle)
}
