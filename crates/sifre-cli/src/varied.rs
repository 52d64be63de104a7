//! Scenarios with keys changed on the command line.

use crate::disk;
use crate::exit::Failure;
use crate::model;
use quad_dynamics::Level;
use scenario::{Setting, Template};
use std::path::Path;
use toml::{Table, Value};

/// Reads `key=value`.
pub(crate) fn setting(text: &str) -> Result<Setting, String> {
    let (key, value) = text.split_once('=').ok_or_else(|| {
        format!("\"{text}\" is not an assignment: write key=value, for example quadrotor.alpha.level=5")
    })?;
    Ok(Setting::new(key.trim(), value_of(value.trim())))
}

/// A value as TOML has it; otherwise a string without quotes.
pub(crate) fn value_of(text: &str) -> Value {
    let table: Option<Table> = toml::from_str(&format!("value = {text}")).ok();
    table
        .and_then(|mut table| table.remove("value"))
        .unwrap_or_else(|| Value::String(text.to_owned()))
}

/// Reads a scenario file.
pub(crate) fn read(path: &Path) -> Result<Template, Failure> {
    let text = disk::read(path)?;
    Ok(Template::from_toml_str(&text, &path.display().to_string())?)
}

/// The same scenario with every quadrotor at a level, with the level's own phenomena and the inversion that belongs to it.
pub(crate) fn at_level(template: Template, level: Level) -> Result<Template, Failure> {
    let laws = model::laws(template.scenario(), level, false);
    let scenario = model::at(template.scenario(), level, None, &laws);
    Ok(template.replaced(scenario)?)
}
