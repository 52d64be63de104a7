//! From text to a type, with the key path in every error.

use crate::Place;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use toml::de::{DeTable, Deserializer};

/// Why a file can't be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// Not TOML at all.
    #[error("{place}: not valid TOML: {message}")]
    Syntax {
        /// Where.
        place: Place,
        /// What the parser says.
        message: String,
    },
    /// A key that every file must have is absent.
    #[error("{place}: missing key `{key}`")]
    MissingKey {
        /// The table that lacks it.
        place: Place,
        /// Full path of the absent key, as in `airframe.mass_kg`.
        key: String,
    },
    /// A key that the schema does not have, most often misspelt.
    #[error("{place}: unknown key `{key}`; {expected}")]
    UnknownKey {
        /// Where.
        place: Place,
        /// Full path of the unknown key.
        key: String,
        /// The keys that would be known there, as in `expected one of a, b`.
        expected: String,
    },
    /// A value of another type than the schema's, or one that its key can't have.
    #[error("{place}: `{key}`: {message}")]
    Value {
        /// Where.
        place: Place,
        /// Full path of the key.
        key: String,
        /// What was found and what was expected.
        message: String,
    },
}

impl ReadError {
    /// Full path of the key; `None` if the text is no TOML.
    #[must_use]
    pub fn key(&self) -> Option<&str> {
        match self {
            Self::Syntax { .. } => None,
            Self::MissingKey { key, .. } | Self::UnknownKey { key, .. } | Self::Value { key, .. } => {
                Some(key)
            }
        }
    }

    /// Where the mistake is.
    #[must_use]
    pub fn place(&self) -> &Place {
        match self {
            Self::Syntax { place, .. }
            | Self::MissingKey { place, .. }
            | Self::UnknownKey { place, .. }
            | Self::Value { place, .. } => place,
        }
    }
}

/// Reads the text of a TOML file; `origin` is the file's name in messages.
///
/// # Errors
/// The first mistake found, with line, column and key path.
pub fn from_toml<T: DeserializeOwned>(text: &str, origin: &str) -> Result<T, ReadError> {
    let deserializer = Deserializer::parse(text).map_err(|error| syntax(text, origin, &error))?;
    deserialized(text, origin, deserializer)
}

/// Reads the text of a TOML file, and its keys as they are; the text is parsed once.
///
/// # Errors
/// As [`from_toml`].
pub fn from_toml_and_table<T: DeserializeOwned>(
    text: &str,
    origin: &str,
) -> Result<(T, toml::Table), ReadError> {
    let parsed = DeTable::parse(text).map_err(|error| syntax(text, origin, &error))?;
    let typed = deserialized(text, origin, Deserializer::from(parsed.clone()))?;
    let table = toml::Table::deserialize(Deserializer::from(parsed));
    Ok((typed, table.map_err(|error| syntax(text, origin, &error))?))
}

/// Reads a table; its errors have key paths and no lines.
///
/// # Errors
/// The first mistake found.
pub fn from_table<T: DeserializeOwned>(table: &toml::Table, origin: &str) -> Result<T, ReadError> {
    let table = toml::Value::Table(table.clone());
    serde_path_to_error::deserialize(table).map_err(|error| {
        let place = Place::somewhere(origin);
        refused(place, &error.path().to_string(), error.inner().message())
    })
}

fn deserialized<T: DeserializeOwned>(
    text: &str,
    origin: &str,
    from: Deserializer<'_>,
) -> Result<T, ReadError> {
    serde_path_to_error::deserialize(from).map_err(|error| {
        let place = place(text, origin, error.inner());
        refused(place, &error.path().to_string(), error.inner().message())
    })
}

pub(crate) fn place(text: &str, origin: &str, error: &toml::de::Error) -> Place {
    match error.span() {
        Some(span) => Place::at(text, origin, span.start),
        None => Place::somewhere(origin),
    }
}

pub(crate) fn syntax(text: &str, origin: &str, error: &toml::de::Error) -> ReadError {
    ReadError::Syntax {
        place: place(text, origin, error),
        message: error.message().to_owned(),
    }
}

/// Sorts serde's message into its kinds, which it tells apart in its text only; a text that is not recognised keeps its words.
pub(crate) fn refused(place: Place, path: &str, message: &str) -> ReadError {
    let quoted = |start: &str| message.strip_prefix(start)?.split_once('`');
    if let Some((field, _)) = quoted("missing field `") {
        let key = join(path, field);
        return ReadError::MissingKey { place, key };
    }
    if let Some((field, expected)) = quoted("unknown field `") {
        // The path of an unknown key ends in the key itself, unless its table is told apart by a `kind`.
        let ends_in_it = path.rsplit('.').next() == Some(field);
        let key = if ends_in_it {
            path.to_owned()
        } else {
            join(path, field)
        };
        let expected = expected.trim_start_matches(", ").replace('`', "");
        return ReadError::UnknownKey { place, key, expected };
    }
    ReadError::Value {
        place,
        key: path.to_owned(),
        message: message.to_owned(),
    }
}

/// `table.key` or `list[1]`; the path of the top of a file is `.`.
pub(crate) fn join(table: &str, key: &str) -> String {
    if table.is_empty() || table == "." {
        key.to_owned()
    } else if key.is_empty() || key == "." {
        table.to_owned()
    } else if key.starts_with('[') {
        format!("{table}{key}")
    } else {
        format!("{table}.{key}")
    }
}
