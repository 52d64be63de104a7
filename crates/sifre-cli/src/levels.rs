//! `sifre levels`: the same scenario at all levels of resolution, and what they differ by.
//!
//! ```text
//! position   |r_ℓ − r_5|
//! attitude   θ = 2 asin(‖R_ℓ − R_5‖_F / √8)
//! ```

use crate::disk::{self, Beside};
use crate::exit::{Exit, Failure};
use crate::varied::{self, setting};
use crate::{drawing, interrupt, model, report};
use comfy_table::presets::UTF8_FULL_CONDENSED;
use comfy_table::{CellAlignment, Table};
use quad_dynamics::Level;
use quad_kinematics::EulerAngles;
use quad_ndi::Law;
use quad_plot::figure::Legends;
use quad_plot::{Figure, Panel, level_name, level_style};
use scenario::{End, Flown, Keep, Scenario, Setting};
use serde_json::json;
use sifre::Recording;
use std::path::PathBuf;

/// Arguments of `sifre levels`.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Scenario file.
    scenario: PathBuf,
    /// Plot the differences to this file, .svg or .png.
    #[arg(long, short)]
    plot: Option<PathBuf>,
    /// Keep the scenario's controllers where they can fly the level, instead of using the inversion of each level.
    #[arg(long)]
    keep_controllers: bool,
    /// Set a key of the scenario: `--set duration_s=5`. May be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = setting)]
    settings: Vec<Setting>,
}

/// The scenario flown at one level.
struct AtLevel {
    level: Level,
    scenario: Scenario,
    flown: Flown,
}

/// A quadrotor's difference to the highest level.
struct Difference {
    level: Level,
    law: Law,
    times_s: Vec<f64>,
    position_m: Vec<f64>,
    attitude_deg: Vec<f64>,
}

/// Flies a scenario at all levels.
pub(crate) fn run(arguments: &Arguments, json: bool) -> Result<Exit, Failure> {
    let scenario = varied::read(&arguments.scenario)?.with(&arguments.settings)?;
    model::check(&scenario)?;
    drawing::check(
        arguments.plot.as_deref(),
        &disk::inputs(&arguments.scenario, &scenario),
    )?;
    interrupt::listen();
    let files = Beside::of(&arguments.scenario);
    let mut flights = Vec::new();
    for level in Level::ALL {
        let laws = model::laws(&scenario, level, arguments.keep_controllers);
        let scenario = model::at(&scenario, level, None, &laws);
        let flown = interrupt::fly(&scenario, &files, &Keep::rows(scenario.output.step_s))?;
        if flown.ending.end == End::Interrupted {
            report::complain("error: interrupted");
            return Ok(Exit::Interrupted);
        }
        flights.push(AtLevel {
            level,
            scenario,
            flown,
        });
    }
    let agents: Vec<String> = scenario
        .quadrotor
        .iter()
        .map(|agent| agent.name.clone())
        .collect();
    let differences: Vec<Vec<Difference>> = (0..agents.len())
        .map(|k| differences(&flights, k, &agents[k]))
        .collect();
    if let Some(path) = &arguments.plot {
        drawing::write(path, &figure(&agents, &differences))?;
    }
    if json {
        report::print(&as_json(&agents, &differences, &flights))?;
    } else {
        report::say(format!("{}\n", table(&agents, &differences, &flights)))?;
        if let Some(path) = &arguments.plot {
            report::say(format!("drawn: {}\n", path.display()))?;
        }
    }
    let all_done = flights.iter().all(|at| at.flown.ending.end == End::Done);
    Ok(if all_done { Exit::Done } else { Exit::Early })
}

/// Differences of a quadrotor at each level to the highest, as long as both fly.
fn differences(flights: &[AtLevel], place: usize, agent: &str) -> Vec<Difference> {
    let Some(AtLevel { flown: best, .. }) = flights.last() else {
        return Vec::new();
    };
    let columns = |recording: &Recording| {
        [
            "position.x",
            "position.y",
            "position.z",
            "attitude.roll",
            "attitude.pitch",
            "attitude.yaw",
        ]
        .map(|name| {
            recording
                .column(&format!("{agent}.{name}"))
                .map_or_else(Vec::new, Iterator::collect::<Vec<f64>>)
        })
    };
    let reference = columns(&best.recording);
    let one = |AtLevel {
                   level,
                   scenario,
                   flown,
               }: &AtLevel| {
        let here = columns(&flown.recording);
        let rows = flown.recording.len().min(best.recording.len());
        let position = |k: usize| {
            (0..3)
                .map(|i| (here[i][k] - reference[i][k]).powi(2))
                .sum::<f64>()
                .sqrt()
        };
        let rotation = |columns: &[Vec<f64>; 6], k: usize| {
            let (roll, pitch, yaw) = (columns[3][k], columns[4][k], columns[5][k]);
            EulerAngles { roll, pitch, yaw }.rotation().matrix
        };
        let attitude = |k: usize| {
            let distance = (rotation(&here, k) - rotation(&reference, k)).norm();
            (2.0 * (distance / 8.0_f64.sqrt()).min(1.0).asin()).to_degrees()
        };
        Difference {
            level: *level,
            law: scenario.quadrotor[place].controller.kind.at(*level),
            times_s: flown.recording.times_s().take(rows).collect(),
            position_m: (0..rows).map(position).collect(),
            attitude_deg: (0..rows).map(attitude).collect(),
        }
    };
    flights.iter().map(one).collect()
}

/// Root mean square and largest of a difference.
struct Size {
    rms: f64,
    largest: f64,
}

impl Size {
    fn of(values: &[f64]) -> Self {
        let squares: f64 = values.iter().map(|x| x * x).sum();
        Self {
            rms: (squares / values.len().max(1) as f64).sqrt(),
            // A maximum that propagates NaN, which `f64::max` hides.
            largest: if squares.is_nan() {
                f64::NAN
            } else {
                values.iter().fold(0.0, |most, x| most.max(x.abs()))
            },
        }
    }
}

fn table(agents: &[String], differences: &[Vec<Difference>], flights: &[AtLevel]) -> Table {
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED);
    table.set_header([
        "agent",
        "level",
        "law",
        "position rms, m",
        "max, m",
        "attitude rms, °",
        "max, °",
        "computing, s",
        "end",
    ]);
    for (agent, differences) in agents.iter().zip(differences) {
        for (difference, AtLevel { flown, .. }) in differences.iter().zip(flights) {
            let (position, attitude) = (
                Size::of(&difference.position_m),
                Size::of(&difference.attitude_deg),
            );
            table.add_row([
                agent.clone(),
                difference.level.number().to_string(),
                difference.law.name().to_owned(),
                format!("{:.4}", position.rms),
                format!("{:.4}", position.largest),
                format!("{:.3}", attitude.rms),
                format!("{:.3}", attitude.largest),
                format!("{:.3}", flown.wall_s),
                flown.ending.to_string(),
            ]);
        }
    }
    for column in table.column_iter_mut().skip(3).take(5) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

fn as_json(agents: &[String], differences: &[Vec<Difference>], flights: &[AtLevel]) -> serde_json::Value {
    let rows = agents.iter().zip(differences).flat_map(|(agent, differences)| {
        differences
            .iter()
            .zip(flights)
            .map(move |(difference, AtLevel { flown, .. })| {
                let (position, attitude) = (
                    Size::of(&difference.position_m),
                    Size::of(&difference.attitude_deg),
                );
                json!({
                    "agent": agent,
                    "level": difference.level.number(),
                    "law": difference.law.name(),
                    "position_rms_m": position.rms,
                    "position_max_m": position.largest,
                    "attitude_rms_deg": attitude.rms,
                    "attitude_max_deg": attitude.largest,
                    "wall_s": flown.wall_s,
                    "end": flown.ending.to_string(),
                })
            })
    });
    json!({ "differences_to_level": Level::HIGHEST, "rows": rows.collect::<Vec<_>>() })
}

/// A column per quadrotor: position above, attitude below.
fn figure(agents: &[String], differences: &[Vec<Difference>]) -> Figure {
    let panel = |label: &str, agent: &str, differences: &[Difference], of: fn(&Difference) -> &[f64]| {
        let lower = differences
            .iter()
            .filter(|difference| difference.level != Level::HIGHEST);
        let panel = Panel::new("Time *t*, s", label).caption(agent);
        lower.fold(panel, |panel, difference| {
            let number = difference.level.number();
            let name = format!("{}, {}", level_name(number), difference.law.name());
            let points = difference
                .times_s
                .iter()
                .copied()
                .zip(of(difference).iter().copied());
            panel.line(name, level_style(number), points)
        })
    };
    let mut figure = Figure::columns(agents.len()).share_x();
    for (agent, differences) in agents.iter().zip(differences) {
        let label = format!("Position, difference to {}, m", Level::HIGHEST);
        figure = figure.panel(panel(&label, agent, differences, |d| &d.position_m));
    }
    for differences in differences {
        let label = format!("Attitude, difference to {}, °", Level::HIGHEST);
        figure = figure.panel(panel(&label, "", differences, |d| &d.attitude_deg));
    }
    figure.legends(if agents.len() == 1 {
        Legends::Common
    } else {
        Legends::EachPanel
    })
}
