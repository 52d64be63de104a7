//! `sifre new`: a commented scenario to start from.

use crate::disk;
use crate::exit::{Exit, Failure};
use crate::report;
use std::path::PathBuf;

/// The scenario that explains every key.
const TEMPLATE: (&str, &str) = ("template", include_str!("../template.toml"));

/// The template, then the scenarios that come with the project: name and text.
pub(crate) fn known() -> impl Iterator<Item = (&'static str, &'static str)> {
    std::iter::once(TEMPLATE).chain(scenario::READY.iter().copied())
}

/// Arguments of `sifre new`.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// File to write [default: standard output].
    file: Option<PathBuf>,
    /// Scenario to start from: `template` explains every key, the others are ready to fly.
    #[arg(long, default_value = "template", value_parser = clap::builder::PossibleValuesParser::new(known().map(|(name, _)| name)))]
    from: String,
    /// Replace an existing file.
    #[arg(long)]
    force: bool,
}

/// Writes a scenario.
pub(crate) fn run(arguments: &Arguments, json: bool) -> Result<Exit, Failure> {
    let chosen = known().find(|(name, _)| *name == arguments.from);
    let (_, text) = chosen.unwrap_or(TEMPLATE);
    let Some(path) = &arguments.file else {
        report::say(text)?;
        return Ok(Exit::Done);
    };
    if std::fs::symlink_metadata(path).is_ok() && !arguments.force {
        return Err(Failure::Exists { path: path.clone() });
    }
    disk::replace(path, text)?;
    if json {
        report::print(&serde_json::json!({ "written": path, "from": arguments.from }))?;
    } else {
        report::say(format!("written: {0}\nfly it:  sifre run {0}\n", path.display()))?;
    }
    Ok(Exit::Done)
}
