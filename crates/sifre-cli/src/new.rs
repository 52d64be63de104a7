//! `sifre new`: a commented scenario to start from.

use crate::disk;
use crate::exit::{Exit, Failure};
use crate::report;
use std::path::PathBuf;

/// The scenarios that come with the project: name and file.
pub(crate) const READY: [(&str, &str); 20] = [
    ("template", include_str!("../template.toml")),
    ("hover", include_str!("../../../scenarios/hover.toml")),
    (
        "step-in-height",
        include_str!("../../../scenarios/step-in-height.toml"),
    ),
    (
        "horizontal-step",
        include_str!("../../../scenarios/horizontal-step.toml"),
    ),
    ("helix", include_str!("../../../scenarios/helix.toml")),
    ("waypoints", include_str!("../../../scenarios/waypoints.toml")),
    ("gust", include_str!("../../../scenarios/gust.toml")),
    (
        "estimator-in-the-loop",
        include_str!("../../../scenarios/estimator-in-the-loop.toml"),
    ),
    ("wrong-start", include_str!("../../../scenarios/wrong-start.toml")),
    (
        "near-the-ground",
        include_str!("../../../scenarios/near-the-ground.toml"),
    ),
    ("crazyflie", include_str!("../../../scenarios/crazyflie.toml")),
    ("payload", include_str!("../../../scenarios/payload.toml")),
    (
        "level-change",
        include_str!("../../../scenarios/level-change.toml"),
    ),
    ("track-fixed", include_str!("../../../scenarios/track-fixed.toml")),
    ("lost-view", include_str!("../../../scenarios/lost-view.toml")),
    (
        "power-transmission-10s",
        include_str!("../../../scenarios/power-transmission-10s.toml"),
    ),
    (
        "power-transmission-20s",
        include_str!("../../../scenarios/power-transmission-20s.toml"),
    ),
    (
        "optimise-transmission",
        include_str!("../../../scenarios/optimise-transmission.toml"),
    ),
    (
        "two-quadrotors",
        include_str!("../../../scenarios/two-quadrotors.toml"),
    ),
    ("swarm", include_str!("../../../scenarios/swarm.toml")),
];

/// Arguments of `sifre new`.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The file to write; on standard output without one.
    file: Option<PathBuf>,
    /// What to start from: `template` explains every key, the others are ready to fly.
    #[arg(long, default_value = "template", value_parser = clap::builder::PossibleValuesParser::new(READY.map(|(name, _)| name)))]
    from: String,
    /// Replace a file that is there already.
    #[arg(long)]
    force: bool,
}

/// Writes a scenario.
pub(crate) fn run(arguments: &Arguments, json: bool) -> Result<Exit, Failure> {
    let known = READY.iter().find(|(name, _)| *name == arguments.from);
    let text = known.map_or(READY[0].1, |(_, text)| text);
    let Some(path) = &arguments.file else {
        report::say(text);
        return Ok(Exit::Done);
    };
    if path.exists() && !arguments.force {
        return Err(Failure::Exists { path: path.clone() });
    }
    disk::write(path, text)?;
    if json {
        report::print(&serde_json::json!({ "written": path, "from": arguments.from }));
    } else {
        report::say(format!("written: {0}\nfly it:  sifre run {0}\n", path.display()));
    }
    Ok(Exit::Done)
}
