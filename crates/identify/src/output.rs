//! What is printed, and the vehicle file with the identified numbers.

use quad_dynamics::Vehicle;
use quad_dynamics::vehicle::file::VehicleFile;
use std::error::Error;
use std::fmt::{Display, Write as _};
use std::path::Path;
use sysid::Estimate;

/// An identified number.
pub(crate) struct Found {
    /// Its key in a vehicle file, `group.name` or `group.name[i]`; a name without a dot stands in no file.
    key: String,
    unit: &'static str,
    estimate: Estimate,
}

impl Found {
    pub(crate) fn new(key: &str, unit: &'static str, estimate: Estimate) -> Self {
        Self {
            key: key.to_owned(),
            unit,
            estimate,
        }
    }
}

/// All that an identification says.
#[derive(Default)]
pub(crate) struct Answer {
    pub(crate) found: Vec<Found>,
    pub(crate) warnings: Vec<String>,
}

impl Answer {
    pub(crate) fn warn<W: Display>(&mut self, warnings: &[W]) {
        self.warnings.extend(warnings.iter().map(W::to_string));
    }
}

/// A table for people.
pub(crate) fn table(answer: &Answer) -> String {
    let mut text = format!(
        "{:<42} {:>14} {:>12}  95 % interval\n",
        "number", "estimate", "std. error"
    );
    for Found { key, unit, estimate } in &answer.found {
        let i = estimate.interval();
        let (value, error) = (estimate.value, estimate.standard_error);
        let _ = writeln!(
            text,
            "{key:<42} {value:>14.6} {error:>12.2e}  {:.6} to {:.6} {unit}",
            i.lower, i.upper
        );
    }
    text
}

/// The same for machines.
pub(crate) fn json(answer: &Answer) -> String {
    let numbers = answer.found.iter().map(|f| {
        let i = f.estimate.interval();
        serde_json::json!({
            "key": f.key, "unit": f.unit, "value": f.estimate.value, "standard_error": f.estimate.standard_error,
            "lower": i.lower, "upper": i.upper,
        })
    });
    serde_json::json!({ "numbers": numbers.collect::<Vec<_>>(), "warnings": answer.warnings }).to_string()
}

/// A vehicle file's text with the identified numbers in the place of the old ones, checked to be a vehicle.
pub(crate) fn updated(text: &str, path: &Path, found: &[Found]) -> Result<String, Box<dyn Error>> {
    let origin = path.display().to_string();
    VehicleFile::from_toml_str(text, &origin)?;
    let mut table: toml::Table = text.parse()?;
    for Found { key, estimate, .. } in found {
        let Some((group, name)) = key.split_once('.') else {
            continue;
        };
        let (name, index) = match name.split_once('[') {
            Some((name, rest)) => (name, rest.trim_end_matches(']').parse::<usize>().ok()),
            None => (name, None),
        };
        let entry = table
            .get_mut(group)
            .and_then(|g| g.get_mut(name))
            .and_then(toml::Value::as_table_mut)
            .ok_or_else(|| format!("{origin}: there is no {group}.{name} to replace"))?;
        let (value, error) = (estimate.value.into(), estimate.standard_error.into());
        match index {
            None => {
                entry.insert("value".into(), value);
                entry.insert("standard_error".into(), error);
            }
            Some(i) => {
                set(entry, "value", i, value);
                set(entry, "standard_error", i, error);
            }
        }
        entry.insert("source".into(), "identified: by the program identify".into());
    }
    let file = VehicleFile::from_toml_str(&toml::to_string(&table)?, &origin)?;
    Vehicle::from_file(&file, &origin)?;
    Ok(file.to_toml())
}

/// Sets a component of a triple that may not be there yet.
fn set(entry: &mut toml::Table, key: &str, index: usize, value: toml::Value) {
    let zeros = || toml::Value::Array(vec![0.0.into(); 3]);
    let triple = entry.entry(key).or_insert_with(zeros);
    if let Some(component) = triple.get_mut(index) {
        *component = value;
    }
}
