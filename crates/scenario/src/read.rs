//! From text to a scenario, with the key path in every error.

use crate::error::ScenarioError;
use crate::file::Scenario;
use serde::Deserialize;
use toml::de::{DeTable, Deserializer};

/// Reads a scenario file.
pub(crate) fn scenario(text: &str, origin: &str) -> Result<Scenario, ScenarioError> {
    let deserializer = Deserializer::parse(text).map_err(|error| syntax(text, origin, &error))?;
    typed(text, origin, deserializer)
}

/// Reads a scenario file, and its keys as they are; the text is parsed once.
pub(crate) fn scenario_and_table(text: &str, origin: &str) -> Result<(Scenario, toml::Table), ScenarioError> {
    let parsed = DeTable::parse(text).map_err(|error| syntax(text, origin, &error))?;
    let scenario = typed(text, origin, Deserializer::from(parsed.clone()))?;
    let table = toml::Table::deserialize(Deserializer::from(parsed));
    Ok((scenario, table.map_err(|error| syntax(text, origin, &error))?))
}

fn syntax(text: &str, origin: &str, error: &toml::de::Error) -> ScenarioError {
    ScenarioError::Syntax {
        place: Place::of(text, origin, error),
        message: error.message().to_owned(),
    }
}

fn typed(text: &str, origin: &str, from: Deserializer<'_>) -> Result<Scenario, ScenarioError> {
    serde_path_to_error::deserialize(from).map_err(|error| {
        let place = Place::of(text, origin, error.inner());
        refused(place, &error.path().to_string(), error.inner())
    })
}

/// Reads a scenario from a table.
pub(crate) fn table(table: &toml::Table, origin: &str) -> Result<Scenario, ScenarioError> {
    let table = toml::Value::Table(table.clone());
    serde_path_to_error::deserialize(table).map_err(|error| {
        let place = Place {
            origin: origin.to_owned(),
            position: None,
        };
        refused(place, &error.path().to_string(), error.inner())
    })
}

/// Where in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The file's name.
    pub origin: String,
    /// Line and column, where they are known.
    pub position: Option<Position>,
}

/// A place in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Position {
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1.
    pub column: usize,
}

impl Place {
    fn of(text: &str, origin: &str, error: &toml::de::Error) -> Self {
        let position = error.span().map(|span| {
            let before = text.get(..span.start).unwrap_or(text);
            Position {
                line: before.matches('\n').count() + 1,
                column: before.rsplit('\n').next().map_or(0, |line| line.chars().count()) + 1,
            }
        });
        Self {
            origin: origin.to_owned(),
            position,
        }
    }
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.position {
            Some(Position { line, column }) => write!(f, "{}:{line}:{column}", self.origin),
            None => f.write_str(&self.origin),
        }
    }
}

/// Sorts serde's message into its kinds, which it tells apart in its text only; a text that it does not recognise keeps its
/// words.
fn refused(place: Place, path: &str, error: &toml::de::Error) -> ScenarioError {
    let message = error.message();
    let quoted = |start: &str| message.strip_prefix(start)?.split_once('`');
    if let Some((field, _)) = quoted("missing field `") {
        let key = join(path, field);
        return ScenarioError::MissingKey { place, key };
    }
    if let Some((field, expected)) = quoted("unknown field `") {
        // The path of an unknown key ends in the key itself, unless its table is distinguished by a `kind`.
        let ends_in_it = path.rsplit('.').next() == Some(field);
        let key = if ends_in_it {
            path.to_owned()
        } else {
            join(path, field)
        };
        let expected = expected.trim_start_matches(", ").replace('`', "");
        return ScenarioError::UnknownKey { place, key, expected };
    }
    ScenarioError::Value {
        place,
        key: path.to_owned(),
        message: message.to_owned(),
    }
}

/// `table.key`, or `key` at the top of the file (where the path is `.`).
fn join(table: &str, key: &str) -> String {
    if table.is_empty() || table == "." {
        key.to_owned()
    } else {
        format!("{table}.{key}")
    }
}
