//! Scenarios with keys changed on the command line.

use crate::disk;
use crate::exit::Failure;
use crate::model;
use quad_dynamics::Level;
use scenario::Scenario;
use std::path::{Path, PathBuf};
use toml::{Table, Value};

/// A key and its value, as in `quadrotor.alpha.level=5`.
#[derive(Clone, Debug)]
pub(crate) struct Setting {
    /// Path of the key.
    pub(crate) key: String,
    /// Its value.
    pub(crate) value: Value,
}

/// Reads `key=value`.
pub(crate) fn setting(text: &str) -> Result<Setting, String> {
    let (key, value) = text
        .split_once('=')
        .ok_or_else(|| format!("\"{text}\": write key=value, as in quadrotor.alpha.level=5"))?;
    Ok(Setting {
        key: key.trim().to_owned(),
        value: value_of(value.trim()),
    })
}

/// A value as TOML has it; a text without quotes where it is none.
pub(crate) fn value_of(text: &str) -> Value {
    let table: Option<Table> = toml::from_str(&format!("value = {text}")).ok();
    table
        .and_then(|mut table| table.remove("value"))
        .unwrap_or_else(|| Value::String(text.to_owned()))
}

/// A scenario file as a table that keys can be set in.
#[derive(Clone, Debug)]
pub(crate) struct Template {
    /// The file.
    pub(crate) path: PathBuf,
    table: Table,
}

impl Template {
    /// Reads a scenario file. It is checked as it is first, so that an error in it is told with its line.
    pub(crate) fn read(path: &Path) -> Result<Self, Failure> {
        let text = disk::read(path)?;
        Scenario::from_toml_str(&text, &path.display().to_string())?;
        Ok(Self {
            path: path.to_owned(),
            table: toml::from_str(&text).unwrap_or_default(),
        })
    }

    /// The scenario with these keys set.
    pub(crate) fn with<'a>(
        &self,
        settings: impl IntoIterator<Item = &'a Setting>,
    ) -> Result<Scenario, Failure> {
        let mut table = self.table.clone();
        let mut origin = self.path.display().to_string();
        for (k, Setting { key, value }) in settings.into_iter().enumerate() {
            scenario::set(&mut table, key, value.clone())?;
            origin += if k == 0 { " with " } else { ", " };
            origin += &format!("{key} = {value}");
        }
        Ok(Scenario::from_table(&table, &origin)?)
    }

    /// The same with these keys set for good.
    pub(crate) fn set(mut self, settings: &[Setting]) -> Result<Self, Failure> {
        for Setting { key, value } in settings {
            scenario::set(&mut self.table, key, value.clone())?;
        }
        Ok(self)
    }

    /// The same with every quadrotor at a level, with the level's own phenomena and the inversion that belongs to it.
    pub(crate) fn at_level(mut self, level: Level) -> Result<Self, Failure> {
        let scenario = self.with([])?;
        let laws = model::laws(&scenario, level, false);
        let scenario = model::at(&scenario, level, None, &laws);
        self.table = Table::try_from(&scenario).map_err(|error| Failure::Usage(error.to_string()))?;
        Ok(self)
    }

    /// The value of a key, if it stands in the file.
    pub(crate) fn get(&self, key: &str) -> Option<&Value> {
        scenario::get(&self.table, key).ok()
    }

    /// The file as a table.
    pub(crate) fn table(&self) -> &Table {
        &self.table
    }
}
