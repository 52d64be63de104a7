//! The evidence as text, JSON and picture.

use super::{Case, Evidence};
use crate::attribute;
use comfy_table::presets::UTF8_FULL_CONDENSED;
use comfy_table::{CellAlignment, Table};
use quad_dynamics::Level;
use quad_plot::figure::Legends;
use quad_plot::style::Marker;
use quad_plot::{Figure, Panel, level_style, series_style};
use serde_json::{Value, json};

impl Case {
    fn settings(&self) -> String {
        let all = self.settings.iter().map(|s| format!("{} = {}", s.key, s.value));
        all.collect::<Vec<_>>().join(", ")
    }
}

/// For people.
pub(super) fn text(evidence: &Evidence) -> String {
    let selection = &evidence.selection;
    let price = |level: Level| {
        let of = selection.levels.iter().find(|a| a.answer.level == level);
        of.map_or(f64::NAN, |a| a.answer.price)
    };
    let of = |level: Level| {
        format!(
            "{level} ({:.2} ms of computing per second flown, {:.1} times cheaper than {})",
            price(level) * 1e3,
            price(Level::HIGHEST) / price(level),
            Level::HIGHEST
        )
    };
    let mut text = format!("{}\n", table(evidence));
    text += &format!("cheapest level that agrees:    {}\n", of(selection.cheapest));
    text += &format!("and all levels above it agree: {}\n", of(selection.dependable));
    if selection.cheapest != selection.dependable {
        text += &format!(
            "level {} may agree by chance: a level above it does not\n",
            selection.cheapest.number()
        );
    }
    match (&evidence.why, &evidence.hint) {
        (Some(pair), _) => {
            text += "\nwhat the next level down is missing:\n";
            text += &attribute::as_text(&evidence.why_metric, std::slice::from_ref(pair));
        }
        (None, Some(hint)) => text += &format!("what the next level down is missing: {hint}\n"),
        (None, None) => {}
    }
    text
}

fn table(evidence: &Evidence) -> Table {
    let has_settings = evidence.cases.iter().any(|case| !case.settings.is_empty());
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED);
    let mut header = vec!["level", "metric"];
    if has_settings {
        header.push("case");
    }
    header.extend(["value", "difference", "allowed", "agrees", "ms per s", "end"]);
    table.set_header(header);
    let Some(reference) = evidence.selection.levels.last() else {
        return table;
    };
    for (level, ends) in evidence.selection.levels.iter().zip(&evidence.ends) {
        for (k, case) in evidence.cases.iter().enumerate() {
            let (value, truth) = (level.answer.values[k], reference.answer.values[k]);
            let agrees = evidence.strain(value, truth) <= 1.0;
            let mut row = vec![level.answer.level.number().to_string(), case.metric.clone()];
            if has_settings {
                row.push(case.settings());
            }
            row.extend([
                number(value),
                number((value - truth).abs()),
                number(evidence.allowed(truth)),
                if agrees { "yes" } else { "no" }.to_owned(),
                format!("{:.2}", level.answer.price * 1e3),
                ends[k].clone().unwrap_or_default(),
            ]);
            table.add_row(row);
        }
    }
    let first = if has_settings { 3 } else { 2 };
    for (k, column) in table.column_iter_mut().enumerate() {
        if (first..first + 3).contains(&k) || k == first + 4 {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    table
}

fn number(value: f64) -> String {
    if value.is_finite() {
        format!("{value:.6}")
    } else {
        "none".to_owned()
    }
}

/// Machine-readable output. Non-finite numbers are null.
pub(super) fn json(evidence: &Evidence) -> Value {
    let selection = &evidence.selection;
    let cases = evidence.cases.iter().map(|case| {
        let settings: serde_json::Map<String, Value> = case
            .settings
            .iter()
            .map(|s| (s.key.clone(), json!(s.value)))
            .collect();
        json!({ "metric": case.metric, "settings": settings })
    });
    let levels = selection.levels.iter().zip(&evidence.ends).map(|(level, ends)| {
        json!({
            "level": level.answer.level.number(),
            "values": level.answer.values,
            "difference": level.difference,
            "strain": level.strain,
            "agrees": level.agrees(),
            "price_s_per_s": level.answer.price,
            "ended_early": ends,
        })
    });
    let why = evidence
        .why
        .as_ref()
        .map(|pair| attribute::as_json(&evidence.why_metric, std::slice::from_ref(pair)));
    json!({
        "tolerance": evidence.tolerance.absolute,
        "relative": evidence.tolerance.relative,
        "cases": cases.collect::<Vec<_>>(),
        "levels": levels.collect::<Vec<_>>(),
        "cheapest": selection.cheapest.number(),
        "dependable": selection.dependable.number(),
        "attribute": evidence.hint,
        "why": why,
    })
}

/// Differences against what is allowed, and prices.
pub(super) fn figure(evidence: &Evidence) -> Figure {
    let levels = &evidence.selection.levels;
    let reference = levels.last().map_or(&[][..], |a| &a.answer.values);
    let several = evidence.cases.len() > 1;
    let differences = Panel::new("Level", format!("Difference to {} / allowed", Level::HIGHEST))
        .x_categories(Level::ALL.map(|level| level.number().to_string()))
        .x_range(0.5, f64::from(Level::HIGHEST.number()) + 0.5)
        .caption("Agrees at 1 and below")
        .log_y()
        .horizontal(1.0, "");
    // A logarithmic axis has no place for no difference; the reference level differs from itself by nothing.
    let differences = evidence
        .cases
        .iter()
        .enumerate()
        .fold(differences, |panel, (k, case)| {
            let points = levels.iter().filter_map(|level| {
                let strain = evidence.strain(level.answer.values[k], reference[k]);
                let place = f64::from(level.answer.level.number());
                (strain.is_finite() && strain > 0.0).then_some((place, strain))
            });
            let name = match (several, case.settings.is_empty()) {
                (false, _) => String::new(),
                (true, true) => case.metric.clone(),
                (true, false) => format!("{}, {}", case.metric, case.settings()),
            };
            panel.markers(name.replace('_', " "), series_style(k), points)
        });
    let prices = Panel::new("Level", "Computing per second flown, ms")
        .x_categories(Level::ALL.map(|level| level.number().to_string()))
        .x_range(0.5, f64::from(Level::HIGHEST.number()) + 0.5)
        .y_include(0.0);
    let prices = levels.iter().fold(prices, |panel, level| {
        let number = level.answer.level.number();
        let look = level_style(number).marked(Marker::Circle);
        panel.markers("", look, [(f64::from(number), level.answer.price * 1e3)])
    });
    Figure::columns(2)
        .legends(if several {
            Legends::EachPanel
        } else {
            Legends::None
        })
        .panel(differences)
        .panel(prices)
}
