//! Saved flights, to be resumed later: the engine's saved simulations as files, with check sums of what they were saved from.
//!
//! ```text
//! {"sifre_saved_flight":1, "check_sum":"…", "of":{"agents":"…", "files":{"drone.toml":"…"}}, "flight":{…}}
//! ```
//!
//! `check_sum` is that of the rest, `agents` that of what the scenario says of its agents and seed, `files` those of the vehicles and
//! stations that it names. Where a flight begins (starts, levels, pan and tilt), how long it lasts, what ends it and what is recorded may change.

use crate::disk::{self, Beside};
use crate::exit::Failure;
use output::checksum;
use scenario::{AgentInfo, AgentKind, Built, Files, Run, STATIONS, Scenario, VEHICLES};
use serde::{Deserialize, Serialize};
use sifre::{ModelQuadrotor, SimulationSnapshot};
use std::collections::BTreeMap;
use std::path::Path;

/// Version of the file.
const FORMAT: u32 = 1;

/// Largest file, bytes: some hundred thousand quadrotors.
const LONGEST: u64 = 1 << 30;

/// Keys of a scenario that may change.
const FREE: [&str; 6] = ["name", "description", "duration_s", "stop", "output", "optimise"];

/// Keys of an agent that are about its start, by the kind of agent.
const STARTS: [(&str, &[&str]); 2] = [
    ("quadrotor", &["level", "phenomena", "start"]),
    ("ets", &["pan_deg", "tilt_deg"]),
];

/// A saved flight on disk.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Saved {
    sifre_saved_flight: u32,
    check_sum: String,
    of: Origin,
    flight: SimulationSnapshot,
}

/// What a flight was saved from.
#[derive(PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Origin {
    agents: String,
    files: BTreeMap<String, String>,
}

impl Origin {
    /// That of a scenario.
    pub(crate) fn of(scenario: &Scenario, beside: &Beside) -> Result<Self, Failure> {
        let mut table = toml::Table::try_from(scenario)
            .map_err(|error| Failure::Usage(format!("the scenario can't be written as TOML: {error}")))?;
        for key in FREE {
            table.remove(key);
        }
        for (kind, keys) in STARTS {
            let agents = table.get_mut(kind).and_then(toml::Value::as_array_mut);
            for agent in agents.into_iter().flatten().filter_map(toml::Value::as_table_mut) {
                for key in keys {
                    agent.remove(*key);
                }
            }
        }
        let known: BTreeMap<&str, &str> = VEHICLES.into_iter().chain(STATIONS).collect();
        let sum = |name: &str| match known.get(name) {
            Some(text) => Ok(checksum(text.as_bytes())),
            None => beside
                .text(name)
                .map(|text| checksum(text.as_bytes()))
                .map_err(|source| Failure::Read {
                    path: beside.path(name),
                    source,
                }),
        };
        Ok(Self {
            agents: checksum(table.to_string().as_bytes()),
            files: scenario
                .named_files()
                .map(|name| Ok((name.to_owned(), sum(name)?)))
                .collect::<Result<_, Failure>>()?,
        })
    }

    /// Why a flight that was saved from another scenario can't be resumed in this one.
    fn refuses(&self, other: &Self) -> Option<String> {
        let changed = |(name, sum): &(&String, &String)| other.files.get(*name).is_some_and(|s| s != *sum);
        if let Some((name, _)) = self.files.iter().find(changed) {
            return Some(format!("{name} has changed since the flight was saved"));
        }
        (self != other).then(|| {
            "its agents or its seed have changed since the flight was saved; only their starts, duration_s, stop and output may change".to_owned()
        })
    }
}

impl Saved {
    /// The check sum of all but itself. Numbers come back from JSON bit for bit, so it is the same after reading.
    fn sum(&self) -> Result<String, serde_json::Error> {
        Ok(checksum(
            serde_json::to_string(&(&self.of, &self.flight))?.as_bytes(),
        ))
    }
}

/// The flight of a scenario, resumed from a file.
pub(crate) fn resume(built: Built, origin: &Origin, from: &Path) -> Result<Run, Failure> {
    let text = disk::read_up_to(from, LONGEST)?;
    let refuse = |why: String| Failure::Usage(format!("{}: not a saved flight: {why}", from.display()));
    let saved: Saved = serde_json::from_str(&text).map_err(|error| refuse(error.to_string()))?;
    if saved.sifre_saved_flight != FORMAT {
        let found = saved.sifre_saved_flight;
        return Err(refuse(format!(
            "it has format {found}, this version reads format {FORMAT}"
        )));
    }
    if saved.check_sum != saved.sum().map_err(|error| refuse(error.to_string()))? {
        return Err(refuse("it is damaged (its check sum differs)".to_owned()));
    }
    if let Some(why) = origin.refuses(&saved.of) {
        return Err(Failure::Usage(format!(
            "{}: the saved flight can't be resumed in this scenario: {why}",
            from.display()
        )));
    }
    let run = built.resume(&saved.flight)?;
    let (now_s, end_s) = (run.simulation.now_s(), run.duration_s);
    if now_s >= end_s {
        return Err(Failure::Usage(format!(
            "{}: the saved time {now_s} s is not before the scenario's end, {end_s} s: set a later `duration_s`",
            from.display()
        )));
    }
    Ok(run)
}

/// What continues otherwise than the scenario says that a flight begins.
pub(crate) fn notes(run: &Run) -> Vec<String> {
    let differs = |agent: &AgentInfo| {
        let AgentKind::Quadrotor { level: said, .. } = agent.kind else {
            return None;
        };
        let level = run.simulation.agent::<ModelQuadrotor>(&agent.name)?.level();
        (level != said).then(|| {
            format!(
                "\"{}\" resumes at level {}, its saved level; `level = {}` applies to the start only (use level_changes to change it in flight)",
                agent.name,
                level.number(),
                said.number()
            )
        })
    };
    run.agents.iter().filter_map(differs).collect()
}

/// Writes the flight as it is, atomically.
pub(crate) fn save(run: &Run, of: Origin, to: &Path) -> Result<(), Failure> {
    let refuse = |why: String| Failure::Flight(format!("{}: cannot be saved: {why}", to.display()));
    let flight = run.simulation.save().map_err(|error| refuse(error.to_string()))?;
    let mut saved = Saved {
        sifre_saved_flight: FORMAT,
        check_sum: String::new(),
        of,
        flight,
    };
    saved.check_sum = saved.sum().map_err(|error| refuse(error.to_string()))?;
    let text = serde_json::to_string(&saved).map_err(|error| refuse(error.to_string()))?;
    disk::replace(to, text)
}

/// Rejects an existing recording: the one of the flight so far must not be overwritten.
pub(crate) fn leave_alone(recording: &Path) -> Result<(), Failure> {
    if recording.exists() {
        return Err(Failure::Usage(format!(
            "{}: already exists, perhaps with the flight so far; record the resumed part to another file with --out",
            recording.display()
        )));
    }
    Ok(())
}
