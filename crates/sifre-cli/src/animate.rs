//! `sifre animate`: a flight as one HTML page that needs nothing else.

use crate::disk::{self, Beside};
use crate::exit::{Exit, Failure};
use crate::varied;
use crate::{interrupt, recorder, report};
use ::animate::{AnimateError, Options, Scene, html};
use scenario::{AgentInfo, AgentKind, End, Keep, Run};
use sifre::Recording;
use std::path::{Path, PathBuf};

/// Arguments of `sifre animate`.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Scenario (.toml), which is flown, or recording (.csv, .parquet, .jsonl).
    input: PathBuf,
    /// Scenario of the recording, for the looks of its agents [default: guessed from the recording].
    #[arg(long)]
    scenario: Option<PathBuf>,
    /// Write to this file [default: NAME.html in this folder]. A name that ends in .mcap writes a file for Foxglove and rerun instead
    /// (if built with the feature `mcap`).
    #[arg(long, short)]
    out: Option<PathBuf>,
}

/// Draws a flight.
pub(crate) fn run(arguments: &Arguments, json: bool) -> Result<Exit, Failure> {
    // A flight's outputs are where the program runs, as those of `run` are, not among the scenarios.
    let name = arguments.input.file_name().unwrap_or(arguments.input.as_os_str());
    let out = arguments
        .out
        .clone()
        .unwrap_or_else(|| Path::new(name).with_extension("html"));
    check(arguments, &out)?;
    let (recording, scene, exit) = if is_scenario(&arguments.input) {
        interrupt::listen();
        let Ready { scene, mut run } = Ready::read(&arguments.input)?;
        let flown = run.fly(&Keep::rows(run.output.step_s), &mut interrupt::watch())?;
        if flown.ending.end != End::Done {
            report::complain(format!("note: {}", flown.ending));
        }
        (flown.recording, scene, flown.ending.end.into())
    } else {
        let recording = recorded(&arguments.input)?;
        let scene = match &arguments.scenario {
            Some(path) => Ready::read(path)?.scene,
            None => Scene::from_recording(&recording),
        };
        (recording, scene, Exit::Done)
    };
    let is_mcap = out.extension().is_some_and(|ending| ending == "mcap");
    let drawn = if is_mcap {
        mcap(&recording, &scene)?
    } else {
        html(&recording, &scene, &Options::default()).map(String::into_bytes)
    };
    let refused = |error| Failure::Usage(format!("{}: {error}", arguments.input.display()));
    disk::replace(&out, drawn.map_err(refused)?)?;
    if json {
        report::print(
            &serde_json::json!({ "page": out, "rows": recording.len(), "exit_code": exit.code() }),
        )?;
    } else {
        let viewer = if is_mcap { "Foxglove or rerun" } else { "a browser" };
        report::say(format!("written: {}; open it in {viewer}\n", out.display()))?;
    }
    Ok(exit)
}

/// Refuses a page that would be written over what it is drawn from.
fn check(arguments: &Arguments, page: &Path) -> Result<(), Failure> {
    let mut inputs = vec![arguments.input.clone()];
    let scenario = match &arguments.scenario {
        Some(path) => Some(path),
        None => Some(&arguments.input).filter(|path| is_scenario(path)),
    };
    if let Some(path) = scenario {
        inputs.extend(disk::inputs(path, varied::read(path)?.scenario()));
    }
    disk::check_outputs(&inputs, &[page.to_owned()])
}

/// Whether an input is a scenario, which is flown.
fn is_scenario(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == "toml")
}

/// The recording as an MCAP file.
#[cfg(feature = "mcap")]
fn mcap(recording: &Recording, scene: &Scene) -> Result<Result<Vec<u8>, AnimateError>, Failure> {
    let mut file = std::io::Cursor::new(Vec::new());
    Ok(::animate::foxglove::write_mcap(recording, scene, &mut file).map(|()| file.into_inner()))
}

/// The recording as an MCAP file.
#[cfg(not(feature = "mcap"))]
fn mcap(_: &Recording, _: &Scene) -> Result<Result<Vec<u8>, AnimateError>, Failure> {
    Err(Failure::Usage(
        "this build cannot write MCAP files: build it with `--features mcap`".to_owned(),
    ))
}

fn recorded(path: &Path) -> Result<Recording, Failure> {
    let recovered = recorder::read(path)?;
    if let Some(damage) = &recovered.damage {
        report::complain(format!(
            "note: {damage}; animating the {} rows before it",
            recovered.recording.len()
        ));
    }
    Ok(recovered.recording)
}

/// A scenario ready to fly, and the looks of its agents.
struct Ready {
    scene: Scene,
    run: Run,
}

impl Ready {
    fn read(path: &Path) -> Result<Self, Failure> {
        let template = varied::read(path)?;
        let scenario = template.scenario();
        let run = scenario.build(&Beside::of(path))?.start()?;
        let scene = run.agents.iter().fold(Scene::new(scenario.name.clone()), drawn);
        Ok(Self { scene, run })
    }
}

/// The scene with an agent.
fn drawn(scene: Scene, AgentInfo { name, kind }: &AgentInfo) -> Scene {
    match kind {
        AgentKind::Quadrotor { vehicle, .. } => scene.quadrotor(name.clone(), vehicle.airframe.arm_length),
        AgentKind::Ets { station, tracks } => scene.ets(name.clone(), tracks.clone(), station),
        AgentKind::Target => scene.target(name.clone()),
    }
}
