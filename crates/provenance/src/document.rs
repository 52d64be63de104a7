//! A file whose tables are walked by their reader, so that all its mistakes can be reported at once.

use crate::read::{join, place, refused, syntax};
use crate::{Place, ReadError};
use serde::de::DeserializeOwned;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};

/// A TOML file, parsed, with the place of every key and value.
#[derive(Clone, Debug)]
pub struct Document<'a> {
    text: &'a str,
    origin: &'a str,
    root: Spanned<DeTable<'a>>,
}

impl<'a> Document<'a> {
    /// Parses the text of a file; `origin` is the file's name in messages.
    ///
    /// # Errors
    /// [`ReadError::Syntax`].
    pub fn parse(text: &'a str, origin: &'a str) -> Result<Self, ReadError> {
        let root = DeTable::parse(text).map_err(|error| syntax(text, origin, &error))?;
        Ok(Self { text, origin, root })
    }

    /// The table at the top of the file.
    #[must_use]
    pub fn root(&self) -> &DeTable<'a> {
        self.root.get_ref()
    }

    /// The file's name.
    #[must_use]
    pub fn origin(&self) -> &'a str {
        self.origin
    }

    /// The place of a span of the text.
    #[must_use]
    pub fn place(&self, span: &Range<usize>) -> Place {
        Place::at(self.text, self.origin, span.start)
    }

    /// A value of the file as a type; `key` is its full path.
    ///
    /// # Errors
    /// A value of another type, with line, column and the path of what is wrong within it.
    pub fn typed<T: DeserializeOwned>(
        &self,
        value: &Spanned<DeValue<'a>>,
        key: &str,
    ) -> Result<T, ReadError> {
        let whole = value.span();
        serde_path_to_error::deserialize(ValueDeserializer::from(value.clone())).map_err(|error| {
            let place = match error.inner().span() {
                Some(_) => place(self.text, self.origin, error.inner()),
                None => self.place(&whole),
            };
            let path = join(key, &error.path().to_string());
            refused(place, &path, error.inner().message())
        })
    }

    /// The error of a table without a key: `table` is the table's full path, empty at the top of the file.
    #[must_use]
    pub fn missing(&self, span: &Range<usize>, table: &str, key: &str) -> ReadError {
        ReadError::MissingKey {
            place: self.place(span),
            key: join(table, key),
        }
    }

    /// The errors of a table's keys that are none of the known ones; `path` is the table's full path.
    pub fn unknown<'t>(
        &'t self,
        table: &'t DeTable<'a>,
        path: &'t str,
        known: &'t [&str],
    ) -> impl Iterator<Item = ReadError> + 't {
        table
            .keys()
            .filter(|key| !known.contains(&key.get_ref().as_ref()))
            .map(move |key| ReadError::UnknownKey {
                place: self.place(&key.span()),
                key: join(path, key.get_ref()),
                expected: format!("expected one of {}", known.join(", ")),
            })
    }
}
