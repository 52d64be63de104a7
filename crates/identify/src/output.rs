//! What an identification says, and how it is printed.

use quad_plot::Figure;
use std::fmt::{Display, Write as _};
use std::path::Path;
use sysid::Estimate;

/// An identified number.
pub(crate) struct Found {
    /// Its key in a vehicle file, `group.name` or `group.name[i]`; a name without a dot is in no file.
    pub(crate) key: String,
    /// Its unit; `1` if it has none.
    unit: &'static str,
    pub(crate) estimate: Estimate,
    /// How it was made, where data, file or program chose something; empty if there was nothing to choose.
    made: String,
}

/// All that an identification says.
#[derive(Default)]
pub(crate) struct Answer {
    pub(crate) found: Vec<Found>,
    /// What the user must know before using the numbers.
    pub(crate) warnings: Vec<String>,
    /// Data, fit and residuals.
    pub(crate) figure: Option<Figure>,
}

impl Answer {
    pub(crate) fn warn<W: Display>(&mut self, warnings: &[W]) {
        self.warnings.extend(warnings.iter().map(W::to_string));
    }

    pub(crate) fn push(&mut self, key: &str, unit: &'static str, estimate: Estimate) {
        self.push_made(key, unit, estimate, "");
    }

    /// Rejects numbers that the data don't determine: a fit may end with a parameter that has no effect on the measurements.
    pub(crate) fn check(&self) -> Result<(), String> {
        let is_known = |f: &&Found| f.estimate.value.is_finite() && f.estimate.standard_error.is_finite();
        match self.found.iter().find(|found| !is_known(found)) {
            Some(Found {
                key, unit, estimate, ..
            }) => Err(format!(
                "the data do not determine {key}: {} {unit} with a standard error of {}; record more changes of the input",
                estimate.value, estimate.standard_error
            )),
            None => Ok(()),
        }
    }

    /// The same with words on how the number was made.
    pub(crate) fn push_made(&mut self, key: &str, unit: &'static str, estimate: Estimate, made: &str) {
        self.found.push(Found {
            key: key.to_owned(),
            unit,
            estimate,
            made: made.to_owned(),
        });
    }
}

impl Found {
    /// The source of the number for the vehicle file: the command, the measurements, the choices.
    pub(crate) fn source(&self, command: &str, data: &Path) -> String {
        let file = data
            .file_name()
            .map_or_else(|| data.to_string_lossy(), |name| name.to_string_lossy());
        let made = match self.made.as_str() {
            "" => String::new(),
            made => format!("; {made}"),
        };
        format!("identified: identify {command} {file}{made}")
    }
}

/// A table for people.
pub(crate) fn table(answer: &Answer) -> String {
    let mut text = format!(
        "{:<40} {:>14} {:>11}  {:<28} unit\n",
        "number", "estimate", "std. error", "95 % interval"
    );
    for Found {
        key, unit, estimate, ..
    } in &answer.found
    {
        let i = estimate.interval();
        let (value, error) = (estimate.value, estimate.standard_error);
        let places = decimals(error);
        let interval = format!("{:.places$} to {:.places$}", i.lower, i.upper);
        let value = format!("{value:.places$}");
        let _ = writeln!(
            text,
            "{key:<40} {value:>14} {error:>11.2e}  {interval:<28} {unit}"
        );
    }
    let mut made: Vec<&str> = answer.found.iter().map(|f| f.made.as_str()).collect();
    made.dedup();
    for made in made.into_iter().filter(|made| !made.is_empty()) {
        let mut keys = answer
            .found
            .iter()
            .filter(|f| f.made == made)
            .map(|f| f.key.as_str());
        let first = keys.next().unwrap_or_default();
        let all = keys.fold(first.to_owned(), |all, key| all + ", " + key);
        let _ = writeln!(text, "{all}: {made}");
    }
    text
}

/// Decimals that show three digits of a standard error.
fn decimals(error: f64) -> usize {
    const MOST: f64 = 12.0;
    const USUAL: usize = 6;
    if error.is_finite() && error > 0.0 {
        (2.0 - error.log10().floor()).clamp(0.0, MOST) as usize
    } else {
        USUAL
    }
}

/// The same for machines.
pub(crate) fn json(answer: &Answer) -> String {
    let numbers = answer.found.iter().map(|f| {
        let i = f.estimate.interval();
        serde_json::json!({
            "key": f.key, "unit": f.unit, "value": f.estimate.value, "standard_error": f.estimate.standard_error,
            "lower": i.lower, "upper": i.upper, "made": f.made,
        })
    });
    serde_json::json!({ "numbers": numbers.collect::<Vec<_>>(), "warnings": answer.warnings }).to_string()
}
