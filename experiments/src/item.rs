//! What an item of the study is: a figure, a table or a photograph, and how it is made.

use std::error::Error;
use std::fmt;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::claim::Claim;
use crate::drawing::Drawing;

/// One figure or table: everything `--list` shows, and the function that makes it.
#[derive(Clone, Copy, Debug)]
pub struct Item {
    /// Identifier as the reader types it: `6.4`, `F.1`, `table-4.3`.
    pub id: &'static str,
    /// Short title in our own words, no full stop.
    pub title: &'static str,
    /// One to three sentences in our own words: what is drawn, with which settings. Rich text.
    pub description: &'static str,
    /// What kind of thing it is.
    pub kind: Kind,
    /// Where its data come from.
    pub origin: Origin,
    /// The claims that its run checks, each exactly once.
    pub claims: &'static [Claim],
    /// How it is made, or why it is not.
    pub make: Make,
}

impl Item {
    /// The chapter or appendix the item belongs to: `6` for `6.4`, `F` for `F.1`, `4` for `table-4.3`.
    pub fn chapter(&self) -> &'static str {
        self.number().split('.').next().unwrap_or_default()
    }

    /// The identifier without `table-`: `4.3`.
    pub fn number(&self) -> &'static str {
        self.id.strip_prefix("table-").unwrap_or(self.id)
    }

    /// Reading order: chapters 1 to 7, appendices A to G; within one, figures before tables.
    pub fn order(&self) -> (bool, &'static str, bool, u32) {
        let position = self.number().split('.').nth(1).unwrap_or_default();
        let digits = position
            .split(|c: char| !c.is_ascii_digit())
            .next()
            .unwrap_or_default();
        let appendix = self.chapter().starts_with(|c: char| c.is_ascii_alphabetic());
        (
            appendix,
            self.chapter(),
            self.id.starts_with("table-"),
            digits.parse().unwrap_or(u32::MAX),
        )
    }

    /// The heading of the item: `Figure 6.4` or `Table 4.3`.
    pub fn heading(&self) -> String {
        let noun = if self.id.starts_with("table-") {
            "Table"
        } else {
            "Figure"
        };
        format!("{noun} {}", self.number())
    }
}

/// What kind of thing an [`Item`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A plot of data.
    Plot,
    /// A block diagram or sketch.
    Diagram,
    /// A table.
    Table,
    /// An animation, with a still of it.
    Animation,
    /// A photograph.
    Photograph,
}

/// Where the data of an [`Item`] come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Origin {
    /// Simulated by the models of this workspace.
    Simulated,
    /// Measured by somebody, the source being cited.
    Measured,
    /// Measurements and simulations together.
    MeasuredAndSimulated,
    /// Follows from equations or parameters alone.
    Derived,
    /// A drawing without data.
    Schematic,
    /// Measured on the virtual laboratory: simulated vehicles behind simulated sensors.
    VirtualLaboratory,
    /// Printed by a manufacturer.
    DataSheet,
}

impl Origin {
    /// The origin in words, for the gallery.
    pub fn words(self) -> &'static str {
        match self {
            Self::Simulated => "simulated data",
            Self::Measured => "measured data",
            Self::MeasuredAndSimulated => "measured and simulated data",
            Self::Derived => "derived from equations and parameters",
            Self::Schematic => "schematic drawing",
            Self::VirtualLaboratory => "virtual laboratory",
            Self::DataSheet => "data-sheet values",
        }
    }
}

/// A function that makes an item.
pub type Draw = fn(&Context) -> Result<Drawing, ItemError>;

/// How an [`Item`] is made.
#[derive(Clone, Copy, Debug)]
pub enum Make {
    /// By this function.
    Draw(Draw),
    /// Not at all, for this reason (photographs).
    NotReproducible(&'static str),
}

/// What the run hands to every item.
#[derive(Clone, Debug)]
pub struct Context {
    /// Whether a shorter run is asked for. Every claim is checked all the same: shorten sweeps, not checks.
    pub quick: bool,
    root: PathBuf,
}

impl Context {
    /// A context whose data are those of the repository at `root`.
    pub fn new(root: impl Into<PathBuf>, quick: bool) -> Self {
        Self {
            quick,
            root: root.into(),
        }
    }

    /// The context of the repository this crate was built in; what tests of items use.
    pub fn of_this_repository(quick: bool) -> Self {
        Self::new(repository_root(), quick)
    }

    /// Path of a file below `data/`, as in `context.data("vehicles/qball-x4.toml")`.
    pub fn data(&self, relative: impl AsRef<Path>) -> PathBuf {
        self.root.join("data").join(relative)
    }
}

/// Root of the repository this crate was built in.
pub fn repository_root() -> PathBuf {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR"));
    manifest.parent().unwrap_or(manifest).to_owned()
}

/// Why an item could not be made: any error of the crates below, so that `?` works on all of them; or data that this machine
/// does not have.
///
/// Like every type with a blanket `From`, it is no `Error` itself; [`ItemError::new`] wraps a message for the rare
/// case that no typed error exists.
#[derive(Debug)]
pub struct ItemError(Cause);

#[derive(Debug)]
enum Cause {
    Failed(Box<dyn Error + Send + Sync>),
    MissingData(String),
}

impl ItemError {
    /// An error from a message alone.
    pub fn new(message: impl Into<String>) -> Self {
        Self(Cause::Failed(message.into().into()))
    }

    /// The item needs recordings that are not part of the repository and not on this machine: no failure, but the item
    /// can't be made and its claims stay unchecked. One sentence without the full stop that says how to get them.
    pub fn missing_data(reason: impl Into<String>) -> Self {
        Self(Cause::MissingData(reason.into()))
    }

    /// Why data are missing, if that is what is wrong.
    pub fn missing(&self) -> Option<&str> {
        match &self.0 {
            Cause::MissingData(reason) => Some(reason),
            Cause::Failed(_) => None,
        }
    }
}

impl<E: Error + Send + Sync + 'static> From<E> for ItemError {
    fn from(error: E) -> Self {
        Self(Cause::Failed(Box::new(error)))
    }
}

impl fmt::Display for ItemError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let error = match &self.0 {
            Cause::MissingData(reason) => return f.write_str(reason),
            Cause::Failed(error) => error,
        };
        write!(f, "{error}")?;
        let mut source = error.source();
        while let Some(cause) = source {
            write!(f, ": {cause}")?;
            source = cause.source();
        }
        Ok(())
    }
}
