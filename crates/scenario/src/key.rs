//! Keys of a scenario by their path: how a sweep or an optimiser changes it.
//!
//! A path is keys with dots between them. An entry of a list is named by its number from 0 or, where entries have
//! names, by its name: `quadrotor.0.level` and `quadrotor.alpha.level` are the same.

use crate::error::KeyError;
use toml::{Table, Value};

/// Sets a key of a scenario, given as a table. Tables on the way that aren't there are added.
///
/// Whether the key exists in scenarios and may have the value is seen when the table is read
/// ([`Scenario::from_table`](crate::Scenario::from_table)).
///
/// ```
/// let mut table: toml::Table = toml::from_str("[[quadrotor]]\nname = \"alpha\"\nlevel = 3")?;
/// scenario::set(&mut table, "quadrotor.alpha.level", 5)?;
/// assert_eq!(scenario::get(&table, "quadrotor.0.level")?, &toml::Value::from(5));
/// assert!(scenario::set(&mut table, "quadrotor.bravo.level", 5).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// An entry of a list that isn't there; a key below a value.
pub fn set(table: &mut Table, path: &str, value: impl Into<Value>) -> Result<(), KeyError> {
    let Some((last, way)) = split(path)? else {
        return Err(empty(path));
    };
    let mut seen = Vec::new();
    let mut here = Here::Table(table);
    for key in way {
        here = here.below(key, path, &seen)?;
        seen.push(key);
    }
    match here {
        Here::Table(table) => {
            table.insert(last.to_owned(), value.into());
        }
        Here::List(list) => {
            let place = entry(list, last).ok_or_else(|| no_entry(path, &seen, last, list))?;
            list[place] = value.into();
        }
    }
    Ok(())
}

/// The value of a key of a scenario, given as a table.
///
/// # Errors
/// A key that isn't there; it may have a default all the same.
pub fn get<'a>(table: &'a Table, path: &str) -> Result<&'a Value, KeyError> {
    let Some((last, way)) = split(path)? else {
        return Err(empty(path));
    };
    let no_key = |key: &str| KeyError::NoKey {
        path: path.to_owned(),
        key: key.to_owned(),
    };
    let mut keys = way.into_iter().chain([last]);
    let first = keys.next().unwrap_or(last);
    let mut value = table.get(first).ok_or_else(|| no_key(first))?;
    for key in keys {
        value = match value {
            Value::Table(table) => table.get(key),
            Value::Array(list) => entry(list, key).map(|place| &list[place]),
            _ => None,
        }
        .ok_or_else(|| no_key(key))?;
    }
    Ok(value)
}

/// Where a path has led to.
enum Here<'a> {
    Table(&'a mut Table),
    List(&'a mut Vec<Value>),
}

impl<'a> Here<'a> {
    /// What stands below a key, which is added if it isn't there.
    fn below(self, key: &str, path: &str, seen: &[&str]) -> Result<Self, KeyError> {
        let value = match self {
            Self::Table(table) => table
                .entry(key.to_owned())
                .or_insert_with(|| Value::Table(Table::new())),
            Self::List(list) => match entry(list, key) {
                Some(place) => &mut list[place],
                None => return Err(no_entry(path, seen, key, list)),
            },
        };
        match value {
            Value::Table(table) => Ok(Self::Table(table)),
            Value::Array(list) => Ok(Self::List(list)),
            _ => Err(KeyError::NotATable {
                path: path.to_owned(),
                value: [seen, &[key]].concat().join("."),
            }),
        }
    }
}

/// The last key of a path, and those before it.
fn split(path: &str) -> Result<Option<(&str, Vec<&str>)>, KeyError> {
    let mut keys: Vec<&str> = path.split('.').collect();
    if keys.iter().any(|key| key.trim().is_empty()) {
        return Err(empty(path));
    }
    Ok(keys.pop().map(|last| (last, keys)))
}

fn empty(path: &str) -> KeyError {
    KeyError::Empty {
        path: path.to_owned(),
    }
}

/// The place of an entry by its number or its name.
fn entry(list: &[Value], key: &str) -> Option<usize> {
    let named = list.iter().position(|value| name(value) == Some(key));
    named.or_else(|| key.parse().ok().filter(|&place: &usize| place < list.len()))
}

fn name(value: &Value) -> Option<&str> {
    value.get("name").and_then(Value::as_str)
}

fn no_entry(path: &str, seen: &[&str], key: &str, list: &[Value]) -> KeyError {
    let names: Vec<String> = list
        .iter()
        .enumerate()
        .map(|(k, value)| name(value).map_or_else(|| k.to_string(), str::to_owned))
        .collect();
    KeyError::NoEntry {
        path: path.to_owned(),
        entry: key.to_owned(),
        list: seen.join("."),
        known: if names.is_empty() {
            "no entries".to_owned()
        } else {
            names.join(", ")
        },
    }
}
