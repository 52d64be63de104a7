//! What an optimisation leaves: the best scenario, the history, pictures, and a report.

use super::problem::Problem;
use super::state::{Course, State, label};
use crate::exit::Failure;
use crate::{disk, drawing, varied};
use optim::StopReason;
use quad_plot::figure::Legends;
use quad_plot::style::{GREY, Look, Marker};
use quad_plot::{Figure, Panel, series_style};
use scenario::{Keep, Outcome, Setting};
use serde_json::{Value, json};
use sifre::black_box::CsvBox;
use sifre::{BlackBox, BlackBoxError, Recording};
use std::path::Path;

/// What was found.
pub(super) struct Summary {
    keys: Vec<String>,
    found: Vec<Found>,
    folder: String,
}

/// What was found at one level.
struct Found {
    level: Option<u8>,
    values: Vec<f64>,
    outcome: Outcome,
    flights: usize,
    failed: usize,
    elapsed_s: f64,
    stop: StopReason,
}

/// Names of the files that are written for each level.
const FILES: [(&str, &str); 5] = [
    ("best", "toml"),
    ("history", "csv"),
    ("best", "csv"),
    ("history", "svg"),
    ("best", "svg"),
];

/// Names of all files that [`write`] makes.
pub(super) fn names(problem: &Problem) -> impl Iterator<Item = String> {
    let labels = problem.levels().into_iter().map(label);
    labels.flat_map(|label| FILES.map(|(name, ending)| format!("{name}{label}.{ending}")))
}

/// Writes everything; nothing if it was interrupted.
pub(super) fn write(problem: &Problem, state: &State, folder: &Path) -> Result<Option<Summary>, Failure> {
    let mut found = Vec::new();
    for course in &state.courses {
        let Some((best, _)) = course.best() else {
            continue;
        };
        let keep = Keep {
            rows: Some(problem.template.scenario().output.step_s),
            ..Keep::COSTS
        };
        let Some(flown) = problem.fly(&best.values, course.level, keep) else {
            return Ok(None);
        };
        let (Some(outcome), Some(recording)) = (flown.outcome, flown.recording) else {
            let why = flown.failure.unwrap_or_default();
            return Err(Failure::Flight(format!(
                "the best flight cannot be repeated: {why}"
            )));
        };
        let file = |name: &str, ending: &str| folder.join(format!("{name}{}.{ending}", label(course.level)));
        disk::replace(
            &file("best", "toml"),
            best_scenario(problem, course, &best.values)?,
        )?;
        disk::replace(&file("history", "csv"), history(problem, course)?)?;
        let refuse = |source| Failure::Recording {
            path: file("best", "csv"),
            source,
        };
        disk::replace(&file("best", "csv"), as_csv(&recording).map_err(refuse)?)?;
        drawing::write(&file("history", "svg"), &costs(course))?;
        drawing::write(&file("best", "svg"), &trajectory(problem, &recording))?;
        found.push(Found {
            level: course.level.map(|level| level.number()),
            values: best.values.clone(),
            outcome,
            flights: course.rows.len(),
            failed: course.failed(),
            elapsed_s: course.elapsed_s,
            stop: course.stop.unwrap_or(StopReason::Stalled { iterations: 0 }),
        });
    }
    Ok(Some(Summary {
        keys: problem.variables.iter().map(|v| v.name.clone()).collect(),
        found,
        folder: folder.display().to_string(),
    }))
}

/// The scenario with the best values set.
fn best_scenario(problem: &Problem, course: &Course, values: &[f64]) -> Result<String, Failure> {
    let mut settings = problem.settings(values);
    for (k, value) in values.iter().enumerate() {
        settings.push(Setting::new(format!("optimise.variables.{k}.start"), *value));
    }
    let mut template = problem.template.clone().set(&settings)?;
    if let Some(level) = course.level {
        template = varied::at_level(template, level)?;
    }
    let table = template.table();
    let text = toml::to_string(table).map_err(|error| Failure::Usage(error.to_string()))?;
    Ok(format!("# The best that `sifre optimise` found.\n{text}"))
}

/// A recording as CSV.
fn as_csv(recording: &Recording) -> Result<Vec<u8>, BlackBoxError> {
    let mut csv = CsvBox::new(Vec::new());
    csv.begin(recording.channels())?;
    for row in recording.rows() {
        csv.record(row.time_ns, row.values)?;
    }
    csv.finish()?;
    csv.into_inner()
}

/// Flights in the order of their candidates.
fn history(problem: &Problem, course: &Course) -> Result<Vec<u8>, Failure> {
    let mut rows: Vec<_> = course.rows.iter().collect();
    rows.sort_by_key(|row| row.candidate);
    let mut csv = csv::Writer::from_writer(Vec::new());
    let keys = problem.variables.iter().map(|v| v.name.as_str());
    let wrong = |error: csv::Error| Failure::Usage(error.to_string());
    let head = ["candidate"].into_iter().chain(keys);
    csv.write_record(head.chain(["cost", "best", "failure"]))
        .map_err(wrong)?;
    let mut best = f64::INFINITY;
    for row in rows {
        if row.failure.is_none() {
            best = best.min(row.cost.unwrap_or(f64::INFINITY));
        }
        let number = |x: f64| {
            if x.is_finite() {
                x.to_string()
            } else {
                String::new()
            }
        };
        let mut record = vec![row.candidate.to_string()];
        record.extend(row.values.iter().map(ToString::to_string));
        record.extend([row.cost.map_or_else(String::new, number), number(best)]);
        record.push(row.failure.clone().unwrap_or_default());
        csv.write_record(&record).map_err(wrong)?;
    }
    csv.into_inner()
        .map_err(|error| Failure::Usage(error.to_string()))
}

/// Cost of each flight, and the least so far.
fn costs(course: &Course) -> Figure {
    let mut rows: Vec<_> = course.rows.iter().filter(|row| row.failure.is_none()).collect();
    rows.sort_by_key(|row| row.candidate);
    let flights: Vec<(f64, f64)> = rows
        .iter()
        .filter_map(|row| Some((row.candidate as f64 + 1.0, row.cost?)))
        .collect();
    let mut least = f64::INFINITY;
    let best: Vec<(f64, f64)> = flights
        .iter()
        .map(|&(n, cost)| {
            least = least.min(cost);
            (n, least)
        })
        .collect();
    let grey = Look::solid(GREY, 1.0).marked(Marker::Circle);
    let panel = Panel::new("Flight", "Cost Φ")
        .markers("flights", grey, flights)
        .line("best so far", series_style(0), best);
    // Costs of a search span decades.
    Figure::columns(1).legends(Legends::Common).panel(panel.log_y())
}

/// The best flight, seen from above and from the side.
fn trajectory(problem: &Problem, recording: &Recording) -> Figure {
    let (name, station) = (&problem.pair().quadrotor, &problem.pair().station);
    let column = |what: &str| -> Vec<f64> { recording.column(what).map_or_else(Vec::new, Iterator::collect) };
    let flown = ["x", "y", "z"].map(|axis| column(&format!("{name}.position.{axis}")));
    let asked = ["x", "y", "z"].map(|axis| column(&format!("{name}.reference.position.{axis}")));
    let stands = ["x", "y", "z"].map(|axis| {
        column(&format!("{station}.position.{axis}"))
            .first()
            .copied()
            .unwrap_or(0.0)
    });
    let from_above =
        |p: &[Vec<f64>; 3]| -> Vec<(f64, f64)> { p[1].iter().copied().zip(p[0].iter().copied()).collect() };
    let from_the_side = |p: &[Vec<f64>; 3]| -> Vec<(f64, f64)> {
        p[1].iter().copied().zip(p[2].iter().map(|z| -z)).collect()
    };
    let mark = Look::solid(GREY, 1.0).marked(Marker::Square);
    let above = Panel::new("East *y*, m", "North *x*, m")
        .caption("From above")
        .line("flown", series_style(0), from_above(&flown))
        .line("reference", quad_plot::reference_style(), from_above(&asked))
        .markers("station", mark, [(stands[1], stands[0])])
        .equal_aspect();
    let side = Panel::new("East *y*, m", "Height, m")
        .caption("From the south")
        .line("flown", series_style(0), from_the_side(&flown))
        .line("reference", quad_plot::reference_style(), from_the_side(&asked))
        .y_include(0.0);
    Figure::columns(2)
        .legends(Legends::Common)
        .panel(above)
        .panel(side)
}

impl Summary {
    /// For people.
    pub(super) fn text(&self) -> String {
        let mut text = String::new();
        for found in &self.found {
            if let Some(level) = found.level {
                text += &format!("level {level}\n");
            }
            text += &format!("  {:44} {:>12.6}\n", "cost", found.outcome.cost);
            for (key, value) in self.keys.iter().zip(&found.values) {
                text += &format!("  {key:44} {value:>12.6}\n");
            }
            text += &format!(
                "  {} flights, {} of them failed, {:.1} s; {}\n",
                found.flights, found.failed, found.elapsed_s, found.stop
            );
        }
        text + &format!("written into {}\n", self.folder)
    }

    /// For machines.
    pub(super) fn json(&self) -> Value {
        let one = |found: &Found| {
            let values = self
                .keys
                .iter()
                .cloned()
                .zip(found.values.iter().map(|x| json!(x)));
            json!({
                "level": found.level,
                "cost": found.outcome.cost,
                "means": found.outcome.means,
                "values": Value::Object(values.collect()),
                "flights": found.flights,
                "failed": found.failed,
                "elapsed_s": found.elapsed_s,
                "stop": found.stop.to_string(),
            })
        };
        json!({ "found": self.found.iter().map(one).collect::<Vec<_>>(), "output": self.folder })
    }
}
