//! `sifre schema`: the JSON schema of scenario files.

use crate::exit::{Exit, Failure};
use crate::report;
use scenario::Scenario;

/// Prints the schema.
pub(crate) fn run() -> Result<Exit, Failure> {
    report::print(&Scenario::json_schema())?;
    Ok(Exit::Done)
}
