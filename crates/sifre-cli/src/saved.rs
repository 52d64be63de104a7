//! Flights saved to go on later: the engine's snapshots as files.

use crate::disk;
use crate::exit::Failure;
use scenario::{AgentInfo, AgentKind, Built, Run};
use sifre::{ModelQuadrotor, SimulationSnapshot, SnapshotError};
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// The flight of a scenario, going on from a file.
pub(crate) fn resume(built: Built, from: &Path) -> Result<Run, Failure> {
    let file = File::open(from).map_err(|source| Failure::Read {
        path: from.to_owned(),
        source,
    })?;
    let refuse =
        |error: SnapshotError| Failure::Usage(format!("{}: not a saved flight: {error}", from.display()));
    let snapshot = SimulationSnapshot::read_json(BufReader::new(file)).map_err(refuse)?;
    let run = built.resume(&snapshot)?;
    let (now_s, end_s) = (run.simulation.now_s(), run.duration_s);
    if now_s >= end_s {
        return Err(Failure::Usage(format!(
            "{} is at {now_s} s and the scenario ends at {end_s} s: set a later `duration_s`",
            from.display()
        )));
    }
    Ok(run)
}

/// What goes on otherwise than the scenario says that a flight begins.
pub(crate) fn notes(run: &Run) -> Vec<String> {
    let differs = |agent: &AgentInfo| {
        let AgentKind::Quadrotor { level: said, .. } = agent.kind else {
            return None;
        };
        let level = run.simulation.agent::<ModelQuadrotor>(&agent.name)?.level();
        (level != said).then(|| {
            format!(
                "\"{}\" goes on at level {}, where it was; `level = {}` is that of the start (level_changes changes it on the way)",
                agent.name,
                level.number(),
                said.number()
            )
        })
    };
    run.agents.iter().filter_map(differs).collect()
}

/// Writes the flight as it is, whole at any time.
pub(crate) fn save(run: &Run, to: &Path) -> Result<(), Failure> {
    let mut text = Vec::new();
    let written = run.simulation.save().and_then(|s| s.write_json(&mut text));
    written.map_err(|error| Failure::Flight(format!("{}: can't be saved: {error}", to.display())))?;
    disk::replace(to, text)
}

/// Refuses a recording that is there: the one of the flight so far must not be written over.
pub(crate) fn leave_alone(recording: &Path) -> Result<(), Failure> {
    if recording.exists() {
        return Err(Failure::Usage(format!(
            "{} is there already, perhaps from the flight so far: record what comes under another name with --out",
            recording.display()
        )));
    }
    Ok(())
}
