//! A value and where it comes from.

use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Error, IntoDeserializer, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use std::fmt;
use std::marker::PhantomData;

/// The source of a value whose file does not state one.
pub const NOT_STATED: &str = "not stated";

/// A value with the source that says where it comes from.
///
/// In a file either a table, `{ value = 0.65, source = "scale", standard_error = 0.001 }`, or the plain value, whose source is then
/// [`NOT_STATED`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Sourced<T> {
    /// The value, in the unit that ends the key.
    pub value: T,
    /// Where the value comes from: citation, data file, derivation or, said plainly, an assumption. Not empty.
    pub source: String,
    /// Standard error of the value in the same unit, where it was measured or identified.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub standard_error: Option<T>,
}

impl<T> Sourced<T> {
    /// A value and its source, no standard error.
    pub fn new(value: T, source: &str) -> Self {
        Self {
            value,
            source: source.to_owned(),
            standard_error: None,
        }
    }

    /// Whether the file states a source.
    pub fn is_stated(&self) -> bool {
        self.source != NOT_STATED
    }
}

/// The table form.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Stated<T> {
    value: T,
    #[serde(default = "not_stated", deserialize_with = "not_empty")]
    source: String,
    #[serde(default = "none")]
    standard_error: Option<T>,
}

fn not_stated() -> String {
    NOT_STATED.to_owned()
}

fn none<T>() -> Option<T> {
    None
}

fn not_empty<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    let source = String::deserialize(deserializer)?;
    if source.trim().is_empty() {
        return Err(D::Error::custom(
            "the source is empty; state where the value comes from, or leave `source` out",
        ));
    }
    Ok(source)
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Sourced<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Either(PhantomData))
    }
}

/// Takes the table or the plain value.
struct Either<T>(PhantomData<T>);

impl<T> Either<T> {
    fn plain<'de, E: Error, D: IntoDeserializer<'de, E>>(value: D) -> Result<Sourced<T>, E>
    where
        T: Deserialize<'de>,
    {
        T::deserialize(value.into_deserializer()).map(|value| Sourced::new(value, NOT_STATED))
    }
}

impl<'de, T: Deserialize<'de>> Visitor<'de> for Either<T> {
    type Value = Sourced<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value, or a table with `value`, `source` and `standard_error`")
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
        let Stated {
            value,
            source,
            standard_error,
        } = Stated::deserialize(MapAccessDeserializer::new(map))?;
        Ok(Sourced {
            value,
            source,
            standard_error,
        })
    }

    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Self::Value, A::Error> {
        let value = T::deserialize(SeqAccessDeserializer::new(seq))?;
        Ok(Sourced::new(value, NOT_STATED))
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Self::Value, E> {
        Self::plain(value)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Self::Value, E> {
        Self::plain(value)
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<Self::Value, E> {
        Self::plain(value)
    }

    fn visit_bool<E: Error>(self, value: bool) -> Result<Self::Value, E> {
        Self::plain(value)
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<Self::Value, E> {
        Self::plain(value)
    }

    fn visit_string<E: Error>(self, value: String) -> Result<Self::Value, E> {
        Self::plain(value)
    }
}
