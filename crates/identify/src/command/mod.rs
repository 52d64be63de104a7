//! One module for each identification: reads, identifies, and fills the answer with numbers and picture.

mod centre_of_mass;
mod flight;
mod load_cell;
mod pendulum;
mod rotor_response;
mod thrust_stand;

use crate::arguments::What;
use crate::output::Answer;
use std::error::Error;

/// What an identification says that may be refused; what it has noticed until then is in the answer.
type Done = Result<(), Box<dyn Error>>;

/// Runs a command's identification.
pub(crate) fn identify(what: &What, answer: &mut Answer) -> Done {
    match what {
        What::CentreOfMass(common) => centre_of_mass::identify(common, answer),
        What::Pendulum { common, hung } => pendulum::identify(common, hung, answer),
        What::LoadCell { common, capacity } => load_cell::identify(common, *capacity, answer),
        What::ThrustStand { common, range } => thrust_stand::identify(common, *range, answer),
        What::RotorResponse(common) => rotor_response::identify(common, answer),
        What::Flight { common, flown } => flight::identify(common, flown, answer),
        What::Template { .. } => Ok(()),
    }
}
