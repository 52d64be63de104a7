//! Where in a file.

/// A place in a file, as messages print it: `file:line:column`.
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
    /// Line, counted from 1.
    pub line: usize,
    /// Column in characters, counted from 1.
    pub column: usize,
}

impl Place {
    /// The place of a byte of the text of a file.
    #[must_use]
    pub fn at(text: &str, origin: &str, byte: usize) -> Self {
        let before = text.get(..byte).unwrap_or(text);
        let position = Position {
            line: before.matches('\n').count() + 1,
            column: before.rsplit('\n').next().map_or(0, |line| line.chars().count()) + 1,
        };
        Self {
            position: Some(position),
            ..Self::somewhere(origin)
        }
    }

    /// Somewhere in a file.
    #[must_use]
    pub fn somewhere(origin: &str) -> Self {
        Self {
            origin: origin.to_owned(),
            position: None,
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
