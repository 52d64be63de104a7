//! Uncertainties as text and JSON.

use super::Ensemble;
use super::statistics::{Answer, Summary};
use comfy_table::presets::UTF8_FULL_CONDENSED;
use comfy_table::{CellAlignment, Table};
use serde_json::{Map, Value, json};

/// Numbers that are named for a metric.
const MOST_NAMED: usize = 3;

/// Least share that is named.
const LEAST_SHARE: f64 = 0.01;

/// A number of the flight and how much of a metric's variance is due to it.
struct Contribution<'a> {
    key: &'a str,
    effect: f64,
    share: f64,
}

/// Contributions to a metric, the largest first.
fn contributions<'a>(ensemble: &'a Ensemble, summary: &Summary) -> Option<Vec<Contribution<'a>>> {
    let first_order = summary.first_order.as_ref()?;
    let effects = first_order.effects.iter().zip(first_order.shares());
    let mut all: Vec<_> = ensemble
        .numbers
        .iter()
        .zip(effects)
        .map(|(number, (&effect, share))| Contribution {
            key: &number.number.key,
            effect,
            share,
        })
        .collect();
    all.sort_by(|a, b| b.share.total_cmp(&a.share));
    Some(all)
}

/// For people.
pub(super) fn text(ensemble: &Ensemble, answer: &Answer) -> String {
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED);
    table.set_header([
        "metric",
        "nominal",
        "mean",
        "sd",
        "95 % from",
        "to",
        "sd, first order",
        "mostly due to",
    ]);
    for summary in &answer.metrics {
        let of = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:.5}"));
        let spread = summary.spread;
        table.add_row([
            summary.name.clone(),
            of(Some(summary.nominal)),
            of(spread.map(|s| s.mean)),
            of(spread.map(|s| s.standard_deviation)),
            of(spread.map(|s| s.low)),
            of(spread.map(|s| s.high)),
            of(summary.first_order.as_ref().map(|f| f.standard_deviation())),
            contributions(ensemble, summary).map_or_else(String::new, |all| named(&all)),
        ]);
    }
    for column in table.column_iter_mut().skip(1).take(6) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    let mut text = format!(
        "{}: {} uncertain numbers; vehicles drawn: {} flown, {} ended early, {} could not be flown\n{table}\n",
        ensemble.scenario.name,
        ensemble.numbers.len(),
        answer.done,
        answer.early,
        answer.refused
    );
    if let Some(trouble) = &answer.first_trouble {
        text += &format!("first run that did not finish: {trouble}\n");
    }
    text
}

fn named(contributions: &[Contribution<'_>]) -> String {
    let large = contributions
        .iter()
        .take(MOST_NAMED)
        .filter(|c| c.share >= LEAST_SHARE);
    let one = |c: &Contribution<'_>| format!("{} {:.0} %", c.key, 100.0 * c.share);
    large.map(one).collect::<Vec<_>>().join("\n")
}

/// For machines.
pub(super) fn json(ensemble: &Ensemble, answer: &Answer) -> Value {
    let number = |number: &super::Number| {
        let number = &number.number;
        json!({ "key": number.key, "value": number.value, "standard_error": number.standard_error })
    };
    let metrics = answer
        .metrics
        .iter()
        .map(|summary| (summary.name.clone(), one(ensemble, summary)));
    json!({
        "scenario": ensemble.scenario.name,
        "runs": answer.done + answer.early + answer.refused,
        "done": answer.done,
        "ended_early": answer.early,
        "refused": answer.refused,
        "first_trouble": answer.first_trouble,
        "numbers": ensemble.numbers.iter().map(number).collect::<Vec<_>>(),
        "metrics": Value::Object(metrics.collect::<Map<_, _>>()),
    })
}

fn one(ensemble: &Ensemble, summary: &Summary) -> Value {
    let spread = summary.spread;
    let contribution = |c: Contribution<'_>| json!({ "key": c.key, "effect": c.effect, "share": c.share });
    let contributions =
        contributions(ensemble, summary).map(|all| all.into_iter().map(contribution).collect::<Vec<_>>());
    json!({
        "nominal": summary.nominal,
        "draws": spread.map_or(0, |s| s.count),
        "mean": spread.map(|s| s.mean),
        "standard_deviation": spread.map(|s| s.standard_deviation),
        "range_95": spread.map(|s| [s.low, s.high]),
        "first_order_standard_deviation": summary.first_order.as_ref().map(|f| f.standard_deviation()),
        "contributions": contributions,
    })
}
