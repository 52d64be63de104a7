//! The parts of a difference as text, JSON and picture.

use super::{Controllers, Explained, Pair};
use comfy_table::presets::UTF8_FULL_CONDENSED;
use comfy_table::{CellAlignment, Table};
use quad_dynamics::Feature;
use quad_ndi::Law;
use quad_plot::figure::Legends;
use quad_plot::panel::Bar;
use quad_plot::style::{BLUE, Marker};
use quad_plot::{Figure, Panel, series_style};
use serde_json::{Value, json};
use study::attribution::Share;

fn part_name(share: &Share) -> String {
    match share.part {
        Feature::Phenomenon(phenomenon) => phenomenon.name().replace('-', " "),
        part => part.to_string(),
    }
}

fn law_names(laws: &[Law]) -> String {
    let mut names: Vec<&str> = laws.iter().map(|law| law.name()).collect();
    names.dedup();
    names.join(", ")
}

fn change(controllers: &Controllers) -> String {
    format!(
        "controller {} to {}",
        law_names(&controllers.lower),
        law_names(&controllers.upper)
    )
}

/// A number with its sign, as short as it may be.
fn signed(value: f64) -> String {
    format!("{value:+.4e}")
}

/// For people.
pub(crate) fn text(metric: &str, pairs: &[Pair]) -> String {
    let mut text = String::new();
    for (lower, upper, explained) in pairs {
        let (a, b) = (lower.number(), upper.number());
        match explained {
            Err(words) => text += &format!("level {a} to level {b}: not available: {words}\n\n"),
            Ok(explained) => {
                let from = explained.models.base;
                let to = from + explained.difference();
                text += &format!(
                    "{metric}, level {a} to level {b}: {from:.6} to {to:.6}, a difference of {}\n{}\n",
                    signed(explained.difference()),
                    table(explained)
                );
                text += &format!("{}\n\n", verdict(explained));
            }
        }
    }
    text
}

/// What makes most of it.
fn verdict(explained: &Explained) -> String {
    let parts = explained.models.shares.iter().map(|s| (part_name(s), s.shapley));
    let controllers = explained.controllers.iter().map(|c| (change(c), c.adds));
    let largest = parts
        .chain(controllers)
        .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    match largest {
        Some((name, share)) if share != 0.0 => format!("the largest part: {name}"),
        _ => "no part makes a difference here".to_owned(),
    }
}

fn table(explained: &Explained) -> Table {
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED);
    table.set_header(["phenomenon", "alone", "taken away", "Shapley"]);
    for share in &explained.models.shares {
        table.add_row([
            part_name(share),
            signed(share.from_below),
            signed(share.from_above),
            signed(share.shapley),
        ]);
    }
    if let Some(controllers) = &explained.controllers {
        table.add_row([
            change(controllers),
            String::new(),
            String::new(),
            signed(controllers.adds),
        ]);
    }
    table.add_row([
        "sum".to_owned(),
        String::new(),
        String::new(),
        signed(explained.difference()),
    ]);
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

/// For machines.
pub(crate) fn json(metric: &str, pairs: &[Pair]) -> Value {
    let one = |(lower, upper, explained): &Pair| match explained {
        Err(words) => json!({ "from": lower.number(), "to": upper.number(), "error": words }),
        Ok(explained) => {
            let shares = explained.models.shares.iter().map(|s| {
                json!({
                    "phenomenon": part_name(s),
                    "from_below": s.from_below,
                    "from_above": s.from_above,
                    "shapley": s.shapley,
                })
            });
            let controllers = explained.controllers.as_ref().map(|c| {
                let [from, to] = [&c.lower, &c.upper].map(|laws| law_names(laws));
                json!({ "from": from, "to": to, "adds": c.adds })
            });
            json!({
                "from": lower.number(),
                "to": upper.number(),
                "base": explained.models.base,
                "top": explained.models.top,
                "difference": explained.difference(),
                "shares": shares.collect::<Vec<_>>(),
                "controllers": controllers,
            })
        }
    };
    json!({ "metric": metric, "pairs": pairs.iter().map(one).collect::<Vec<_>>() })
}

/// A panel per pair of levels: Shapley values as bars, the other two as marks on them.
pub(crate) fn figure(metric: &str, pairs: &[Pair]) -> Figure {
    let explained = pairs.iter().filter_map(|(.., explained)| explained.as_ref().ok());
    let panels: Vec<Panel> = explained.map(|explained| panel(metric, explained)).collect();
    let figure = Figure::columns(panels.len().clamp(1, 2)).legends(Legends::Common);
    panels.into_iter().fold(figure, Figure::panel)
}

/// A metric as an axis has it: its unit behind a comma, and no underscores, which would begin an index.
fn axis_label(metric: &str) -> String {
    let units = [("_m", "m"), ("_s", "s"), ("_deg", "°"), ("_j", "J")];
    let with_unit =
        |&(ending, unit): &(&str, &str)| Some(format!("{}, {unit}", metric.strip_suffix(ending)?));
    let label = units.iter().find_map(with_unit);
    label.unwrap_or_else(|| metric.to_owned()).replace('_', " ")
}

fn panel(metric: &str, explained: &Explained) -> Panel {
    let shares = &explained.models.shares;
    let mut bars: Vec<(String, f64)> = shares.iter().map(|s| (part_name(s), s.shapley)).collect();
    bars.extend(explained.controllers.iter().map(|c| (change(c), c.adds)));
    let names: Vec<String> = bars.iter().map(|(name, _)| name.clone()).collect();
    let right = names.len() as f64 + 0.5;
    let coloured = bars.iter().zip(1..).map(|((_, value), k)| Bar {
        x: f64::from(k),
        height: *value,
        colour: BLUE,
    });
    let points = |value: fn(&Share) -> f64, offset: f64| -> Vec<(f64, f64)> {
        let places = shares.iter().enumerate();
        places.map(|(i, s)| (i as f64 + 1.0 + offset, value(s))).collect()
    };
    let (lower, upper) = (explained.lower.number(), explained.upper.number());
    Panel::new("", format!("Change of {}", axis_label(metric)))
        .caption(format!("Level {lower} to level {upper}"))
        .x_categories(names)
        .bars("Shapley value", 0.5, coloured)
        .x_range(0.5, right)
        .horizontal(0.0, "")
        .markers(
            "alone",
            series_style(1).marked(Marker::Triangle),
            points(|s| s.from_below, -0.12),
        )
        .markers(
            "taken away",
            series_style(2).marked(Marker::TriangleDown),
            points(|s| s.from_above, 0.12),
        )
}
