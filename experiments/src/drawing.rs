//! What an item's run hands back: the picture or table, its data, its settings and its findings.

use serde::Serialize;

use crate::claim::{Claim, Finding};
use crate::data::DataTable;
use crate::plot::svg::Svg;
use crate::plot::text;
use crate::scenarios::ScenarioFile;

/// The result of making an item.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// The picture or the table.
    pub body: Body,
    /// A table shown beneath a picture, written as `<id>.html`.
    pub beneath: Option<DisplayTable>,
    /// The data drawn; the first table becomes `<id>.csv`, a further one `<id>-<name>.csv`.
    pub data: Vec<(String, DataTable)>,
    /// The resolved settings, written as `<id>.toml`.
    pub settings: Option<toml::Table>,
    /// The scenarios that were flown: the first is written as `<id>.toml` unless the settings are, further ones under
    /// their own names.
    pub scenarios: Vec<&'static ScenarioFile>,
    /// Files that a scenario names, with their texts.
    pub files: Vec<(String, String)>,
    /// What the run found for the item's claims.
    pub findings: Vec<Finding>,
    /// Remarks shown under the item. Rich text.
    pub notes: Vec<String>,
}

/// The visible part of a [`Drawing`].
#[derive(Clone, Debug)]
pub enum Body {
    /// A picture, written as SVG and PNG.
    Picture(Svg),
    /// A table, shown in the gallery.
    Table(DisplayTable),
    /// An animation, written as a page of its own.
    Animation(Animation),
}

/// A page that moves, and a still of it.
#[derive(Clone, Debug)]
pub struct Animation {
    /// The page, as HTML.
    pub page: String,
    /// The still as PNG, where a browser could draw it.
    pub still: Option<Vec<u8>>,
}

impl Drawing {
    /// A drawing that shows a still of an animation and leads to it.
    pub fn animation(animation: Animation) -> Self {
        Self::new(Body::Animation(animation))
    }

    /// A drawing that shows a picture.
    pub fn picture(svg: Svg) -> Self {
        Self::new(Body::Picture(svg))
    }

    /// A drawing that shows a table.
    pub fn table(table: DisplayTable) -> Self {
        Self::new(Body::Table(table))
    }

    fn new(body: Body) -> Self {
        Self {
            body,
            beneath: None,
            data: Vec::new(),
            settings: None,
            scenarios: Vec::new(),
            files: Vec::new(),
            findings: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// Shows a table beneath the picture.
    pub fn beneath(mut self, table: DisplayTable) -> Self {
        self.beneath = Some(table);
        self
    }

    /// Adds the data drawn, written as `<id>.csv`.
    pub fn data(self, table: DataTable) -> Self {
        self.named_data("", table)
    }

    /// Adds further data, written as `<id>-<name>.csv`.
    pub fn named_data(mut self, name: &str, table: DataTable) -> Self {
        self.data.push((name.to_owned(), table));
        self
    }

    /// Records the resolved settings: any serialisable struct, or a `toml::toml! { .. }` table.
    ///
    /// # Errors
    /// Settings that TOML cannot express, such as a bare number.
    pub fn settings<S: Serialize>(mut self, settings: &S) -> Result<Self, toml::ser::Error> {
        self.settings = Some(toml::Table::try_from(settings)?);
        Ok(self)
    }

    /// Records a scenario that was flown.
    pub fn scenario(mut self, file: &'static ScenarioFile) -> Self {
        self.scenarios.push(file);
        self
    }

    /// Records a file that a scenario names.
    pub fn file(mut self, name: impl Into<String>, text: impl Into<String>) -> Self {
        self.files.push((name.into(), text.into()));
        self
    }

    /// Records what the run found for a registered claim: whether it holds, and the measured number with its unit.
    pub fn check(mut self, claim: Claim, pass: bool, measured: impl Into<String>) -> Self {
        self.findings.push(Finding {
            text: claim.text.into(),
            pass,
            measured: measured.into(),
        });
        self
    }

    /// Adds a remark shown under the item. Rich text.
    pub fn note(mut self, remark: impl Into<String>) -> Self {
        self.notes.push(remark.into());
        self
    }
}

/// A table as a reader sees it: rounded numbers, rich text (`*K*_{T}`) in every cell.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DisplayTable {
    /// Column headings.
    pub header: Vec<String>,
    /// Rows of cells.
    pub rows: Vec<Vec<String>>,
}

impl DisplayTable {
    /// An empty table with these column headings.
    pub fn new<S: Into<String>>(header: impl IntoIterator<Item = S>) -> Self {
        Self {
            header: header.into_iter().map(Into::into).collect(),
            rows: Vec::new(),
        }
    }

    /// Appends a row.
    pub fn push<S: Into<String>>(&mut self, row: impl IntoIterator<Item = S>) {
        self.rows.push(row.into_iter().map(Into::into).collect());
    }

    /// The table as an HTML fragment; cells that hold a number are aligned to the right.
    pub fn to_html(&self) -> String {
        let cells = |tag: &str, row: &[String]| -> String {
            let cell = |content: &String| {
                let class = if is_number(content) {
                    " class=\"number\""
                } else {
                    ""
                };
                format!("<{tag}{class}>{}</{tag}>", text::html(content))
            };
            row.iter().map(cell).collect()
        };
        let head = cells("th", &self.header);
        let body: String = self
            .rows
            .iter()
            .map(|row| format!("<tr>{}</tr>\n", cells("td", row)))
            .collect();
        format!("<table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody>\n</table>\n")
    }
}

fn is_number(cell: &str) -> bool {
    let first = cell.trim_start_matches(['-', '−', '+', '±', '<', '>', '≤', '≥', ' ']);
    first.starts_with(|c: char| c.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_html_of_a_table() {
        let mut table = DisplayTable::new(["*K*_{T}", "value"]);
        table.push(["a < b", "−1.2"]);
        let html = table.to_html();
        assert!(html.contains("<th><i>K</i><sub>T</sub></th>"), "{html}");
        assert!(
            html.contains("<td>a &lt; b</td><td class=\"number\">−1.2</td>"),
            "{html}"
        );
    }

    #[test]
    fn prop_settings_must_be_a_table() {
        let drawing = || Drawing::table(DisplayTable::default());
        assert!(drawing().settings(&1.0).is_err());
        assert!(drawing().settings(&toml::toml! { settling_time_s = 0.2 }).is_ok());
    }
}
