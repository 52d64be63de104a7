//! `sifre plot`: a recording as panels over time, a column per agent.

use crate::exit::{Exit, Failure};
use crate::{drawing, recorder, report};
use quad_plot::figure::Legends;
use quad_plot::style::series_style;
use quad_plot::{Figure, Panel, reference_style};
use sifre::Recording;
use std::path::PathBuf;

/// Arguments of `sifre plot`.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Recording: .csv, .parquet or .jsonl. A damaged file is plotted up to its last complete row.
    recording: PathBuf,
    /// Plot to this file, .svg or .png [default: beside the recording].
    #[arg(long, short)]
    out: Option<PathBuf>,
    /// Plot only this agent. May be repeated.
    #[arg(long = "agent", value_name = "NAME")]
    agents: Vec<String>,
}

/// Draws a recording.
pub(crate) fn run(arguments: &Arguments, json: bool) -> Result<Exit, Failure> {
    let out = arguments
        .out
        .clone()
        .unwrap_or_else(|| arguments.recording.with_extension("svg"));
    drawing::check(Some(&out), std::slice::from_ref(&arguments.recording))?;
    let recovered = recorder::read(&arguments.recording)?;
    let recording = &recovered.recording;
    if let Some(damage) = &recovered.damage {
        report::complain(format!(
            "note: {damage}; plotting the {} rows before it",
            recording.len()
        ));
    }
    if recording.is_empty() {
        return Err(Failure::Usage(format!(
            "{}: the recording has no rows",
            arguments.recording.display()
        )));
    }
    let columns: Vec<Vec<Panel>> = chosen(recording, &arguments.agents)?
        .iter()
        .map(|agent| panels(recording, agent))
        .filter(|panels| !panels.is_empty())
        .collect();
    if columns.is_empty() {
        let path = arguments.recording.display();
        return Err(Failure::Usage(format!(
            "{path}: the recording has no channels that can be plotted"
        )));
    }
    drawing::write(&out, &figure(columns))?;
    if json {
        report::print(&serde_json::json!({
            "picture": out,
            "rows": recording.len(),
            "damage": recovered.damage.map(|damage| damage.to_string()),
        }))?;
    } else {
        report::say(format!("drawn: {}\n", out.display()))?;
    }
    Ok(Exit::Done)
}

/// Names of the recorded agents, or of those that are asked for.
fn chosen(recording: &Recording, wanted: &[String]) -> Result<Vec<String>, Failure> {
    let mut known: Vec<String> = Vec::new();
    for channel in recording.channels() {
        if let Some((agent, _)) = channel.name.split_once('.')
            && !known.iter().any(|other| other == agent)
        {
            known.push(agent.to_owned());
        }
    }
    if let Some(missing) = wanted.iter().find(|name| !known.contains(name)) {
        let known = known.join(", ");
        return Err(Failure::Usage(format!(
            "--agent: no agent {missing} in the recording; known: {known}"
        )));
    }
    known.retain(|name| wanted.is_empty() || wanted.contains(name));
    Ok(known)
}

/// The columns side by side, filled up to the same height by empty axes.
fn figure(columns: Vec<Vec<Panel>>) -> Figure {
    let rows = columns.iter().map(Vec::len).max().unwrap_or(0);
    let mut figure = Figure::columns(columns.len()).legends(Legends::EachPanel);
    for row in 0..rows {
        for column in &columns {
            let panel = column.get(row).cloned();
            figure = figure.panel(panel.unwrap_or_else(|| Panel::new("", "")));
        }
    }
    figure
}

/// A curve: its channel, its name in the legend, and what it is multiplied by.
type Curve = (&'static str, &'static str, f64);

/// Degrees in a radian.
const DEGREES: f64 = 180.0 / std::f64::consts::PI;

/// What is drawn of a quadrotor: label of the axis, curves, references.
const QUADROTOR: [(&str, &[Curve], &[Curve]); 4] = [
    (
        "Position, m",
        &[("position.x", "north", 1.0), ("position.y", "east", 1.0)],
        &[
            ("reference.position.x", "reference", 1.0),
            ("reference.position.y", "", 1.0),
        ],
    ),
    (
        "Height −*z*, m",
        &[("position.z", "height", -1.0)],
        &[("reference.position.z", "reference", -1.0)],
    ),
    (
        "Attitude, °",
        &[
            ("attitude.roll", "roll *φ*", DEGREES),
            ("attitude.pitch", "pitch *θ*", DEGREES),
            ("attitude.yaw", "yaw *ψ*", DEGREES),
        ],
        &[],
    ),
    (
        "Thrust *T*, N",
        &[
            ("thrust.1", "rotor 1", 1.0),
            ("thrust.2", "rotor 2", 1.0),
            ("thrust.3", "rotor 3", 1.0),
            ("thrust.4", "rotor 4", 1.0),
        ],
        &[],
    ),
];

/// What is drawn of a station.
const STATION: [(&str, &[Curve], &[Curve]); 4] = [
    (
        "Gimbal, °",
        &[("gimbal.pan", "pan", DEGREES), ("gimbal.tilt", "tilt", DEGREES)],
        &[],
    ),
    (
        "Image from the middle, px",
        &[("image.x", "right", 1.0), ("image.y", "down", 1.0)],
        &[],
    ),
    (
        "Light, W",
        &[
            ("power.received", "received", 1.0),
            ("power.missed", "missed", 1.0),
        ],
        &[],
    ),
    ("Range *R*, m", &[("range", "range", 1.0)], &[]),
];

/// The panels of an agent, without curves that are not in the recording.
fn panels(recording: &Recording, agent: &str) -> Vec<Panel> {
    let has = |channel: &str| recording.column(&format!("{agent}.{channel}")).is_some();
    let drawn = if has("power.received") || has("gimbal.pan") {
        STATION
    } else {
        QUADROTOR
    };
    let shown = drawn
        .iter()
        .filter(|(_, curves, _)| curves.iter().any(|(channel, ..)| has(channel)));
    shown
        .enumerate()
        .map(|(row, (label, curves, references))| {
            let mut panel = Panel::new("Time *t*, s", *label);
            if row == 0 {
                panel = panel.caption(agent);
            }
            for (k, curve) in curves.iter().enumerate() {
                panel = line(recording, agent, panel, curve, series_style(k));
            }
            for curve in *references {
                panel = line(recording, agent, panel, curve, reference_style());
            }
            panel
        })
        .collect()
}

fn line(recording: &Recording, agent: &str, panel: Panel, curve: &Curve, look: quad_plot::Look) -> Panel {
    let (channel, name, factor) = *curve;
    match recording.column(&format!("{agent}.{channel}")) {
        Some(values) => {
            let points: Vec<(f64, f64)> = recording
                .times_s()
                .zip(values.map(|value| value * factor))
                .collect();
            panel.line(name, look, points)
        }
        None => panel,
    }
}
