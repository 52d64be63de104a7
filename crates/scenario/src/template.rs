//! A scenario file that keys are set in: what sweeps, optimisers and `--set` work on.

use crate::error::{KeyError, ScenarioError};
use crate::file::Scenario;
use crate::key;
use toml::{Table, Value};

/// A key and its value, as in `quadrotor.alpha.level = 5`.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// Path of the key, as [`set`](crate::set) takes it.
    pub key: String,
    /// Its value.
    pub value: Value,
}

impl Setting {
    /// This value for this key.
    pub fn new(key: impl Into<String>, value: impl Into<Value>) -> Self {
        Self {
            key: key.into(),
            value: value.into(),
        }
    }
}

/// A scenario file, parsed once, from which scenarios with other values follow.
///
/// An error in the file itself is found when it is read and has a line; after that only a key that is set can be wrong.
///
/// ```
/// use scenario::{Setting, Template};
///
/// let text = "name = \"hover\"\nduration_s = 2\n[[quadrotor]]\nname = \"alpha\"\nreference = { kind = \"hold\", position_m = [0, 0, -1] }";
/// let template = Template::from_toml_str(text, "hover.toml")?;
/// let longer = template.with(&[Setting::new("duration_s", 3.0)])?;
/// assert_eq!((template.scenario().duration_s, longer.duration_s), (2.0, 3.0));
/// # Ok::<(), scenario::ScenarioError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Template {
    origin: String,
    table: Table,
    scenario: Scenario,
}

impl Template {
    /// Reads the text of a scenario file; `origin` is the file's name in messages.
    ///
    /// # Errors
    /// As [`Scenario::from_toml_str`].
    pub fn from_toml_str(text: &str, origin: &str) -> Result<Self, ScenarioError> {
        let (scenario, table) = provenance::from_toml_and_table(text, origin)?;
        Ok(Self {
            origin: origin.to_owned(),
            table,
            scenario,
        })
    }

    /// The file's name in messages.
    #[must_use]
    pub fn origin(&self) -> &str {
        &self.origin
    }

    /// The scenario as it is.
    #[must_use]
    pub const fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// The scenario as a table.
    #[must_use]
    pub const fn table(&self) -> &Table {
        &self.table
    }

    /// The value of a key, if the file has it.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<&Value> {
        key::get(&self.table, key).ok()
    }

    /// The scenario with these keys set.
    ///
    /// # Errors
    /// [`ScenarioError::Key`] for a path that leads nowhere; an unknown key or a value of the wrong type.
    pub fn with<'a>(
        &self,
        settings: impl IntoIterator<Item = &'a Setting>,
    ) -> Result<Scenario, ScenarioError> {
        let mut settings = settings.into_iter().peekable();
        if settings.peek().is_none() {
            return Ok(self.scenario.clone());
        }
        let mut table = self.table.clone();
        let mut origin = self.origin.clone();
        for (k, Setting { key, value }) in settings.enumerate() {
            key::set(&mut table, key, value.clone())?;
            origin += if k == 0 { " with " } else { ", " };
            origin += &format!("{key} = {value}");
        }
        Scenario::from_table(&table, &origin)
    }

    /// The template with these keys set for good.
    ///
    /// # Errors
    /// As [`Self::with`].
    pub fn set(self, settings: &[Setting]) -> Result<Self, ScenarioError> {
        let scenario = self.with(settings)?;
        let mut table = self.table;
        settings
            .iter()
            .try_for_each(|Setting { key, value }| key::set(&mut table, key, value.clone()))?;
        Ok(Self {
            origin: self.origin,
            table,
            scenario,
        })
    }

    /// The template of another scenario under the same name; comments and the order of keys are not kept.
    ///
    /// # Errors
    /// [`KeyError::NoToml`] if TOML can't express it.
    pub fn replaced(self, scenario: Scenario) -> Result<Self, ScenarioError> {
        let table = Table::try_from(&scenario).map_err(|error| KeyError::NoToml {
            message: error.to_string(),
        })?;
        Ok(Self {
            origin: self.origin,
            table,
            scenario,
        })
    }
}
