//! The scenarios that the figures fly: TOML files in `experiments/scenarios/`, flown as `sifre run` flies them.
//!
//! They are compiled in, and each is written beside the figures that it belongs to. Most have one quadrotor for each curve
//! of their figure.

use crate::item::ItemError;
use nalgebra::Vector3;
use quad_dynamics::{CommandLimits, Level, Phenomenon, PhenomenonSet, Vehicle};
use quad_kinematics::EulerAngles;
use quad_ndi::{Allocation, Settings};
use scenario::{AgentKind, End, Files, Flown, Keep, Scenario};
use sifre::Recording;
use std::sync::Arc;

/// A scenario file of the figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ScenarioFile {
    /// Its name without the ending, which is the identifier of its figure or begins with it.
    pub name: &'static str,
    /// What it says.
    pub text: &'static str,
}

macro_rules! files {
    ($($name:literal),+ $(,)?) => {
        &[$(ScenarioFile {
            name: $name,
            text: include_str!(concat!("../scenarios/", $name, ".toml")),
        }),+]
    };
}

/// All of them.
pub const ALL: &[ScenarioFile] = files![
    "4.10-flight",
    "6.2",
    "6.3",
    "6.4",
    "6.5",
    "6.6",
    "6.7",
    "6.8",
    "6.9",
    "6.10",
    "6.11",
    "6.12",
    "6.13",
    "6.14",
    "6.15",
    "6.16",
    "6.18",
    "6.18-steady-heading",
    "6.19",
    "6.20",
    "6.21",
    "6.22",
    "6.23",
    "6.24",
    "A.1",
    "A.2",
    "F.1",
    "F.3",
    "table-G.4",
    "beyond.1",
    "beyond.2",
];

/// The file of this name.
///
/// # Errors
/// If there is none.
pub fn find(name: &str) -> Result<&'static ScenarioFile, ItemError> {
    let found = ALL.iter().find(|file| file.name == name);
    found.ok_or_else(|| ItemError::new(format!("no file {name}.toml in experiments/scenarios")))
}

/// Flies the file of this name as it is.
///
/// # Errors
/// If there is none, or it can't be flown. A flight that ends early is no error: see [`Flights::is_complete`].
pub fn fly(name: &str) -> Result<Flights, ItemError> {
    Flights::of(&find(name)?.scenario()?, &())
}

impl ScenarioFile {
    /// What the file says.
    ///
    /// # Errors
    /// A file that is no scenario.
    pub fn scenario(&self) -> Result<Scenario, ItemError> {
        Ok(Scenario::from_toml_str(
            self.text,
            &format!("{}.toml", self.name),
        )?)
    }
}

/// A scenario that was flown, quadrotor by quadrotor.
#[derive(Debug)]
pub struct Flights {
    /// The scenario.
    pub scenario: Scenario,
    /// Its quadrotors, in the order of the file.
    pub flights: Vec<Flight>,
    /// What became of it, with the rows of all agents.
    pub flown: Flown,
}

/// What one quadrotor of a scenario did.
#[derive(Clone, Debug)]
pub struct Flight {
    /// Its name in the file.
    pub name: String,
    /// The level that it begins at.
    pub level: Level,
    /// The phenomena that are switched on at that level.
    pub phenomena: PhenomenonSet,
    /// Its vehicle.
    pub vehicle: Arc<Vehicle>,
    /// What the loops of its controller are asked for.
    pub settings: Settings,
    /// Its rows, in order of time.
    pub rows: Vec<Row>,
    /// Whether it was flown to the end.
    pub is_complete: bool,
}

/// A quadrotor at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Time, s.
    pub time_s: f64,
    /// Position in W, m.
    pub position: Vector3<f64>,
    /// Velocity in W, m/s.
    pub velocity: Vector3<f64>,
    /// Attitude, rad.
    pub attitude: EulerAngles<f64>,
    /// Where it should be, in W, m.
    pub reference: Vector3<f64>,
    /// Heading that is asked for, rad, not wrapped.
    pub reference_yaw: f64,
    /// Commands from this instant on, duty, as offsets from zero thrust.
    pub commands: [f64; 4],
    /// Pseudo-inputs `u* = C u`: collective, lateral, longitudinal, yaw.
    pub pseudo_inputs: [f64; 4],
}

impl Flights {
    /// Flies a scenario; a row is kept for each `output.step_s`.
    ///
    /// # Errors
    /// A scenario that can't be flown.
    pub fn of(scenario: &Scenario, files: &dyn Files) -> Result<Self, ItemError> {
        let mut run = scenario.build(files)?.start()?;
        let flown = run.fly(&Keep::rows(scenario.output.step_s), &mut ())?;
        let mut flights = Vec::new();
        for file in &scenario.quadrotor {
            let agent = run.agents.iter().find(|agent| agent.name == file.name);
            let Some(AgentKind::Quadrotor { vehicle, level, .. }) = agent.map(|agent| &agent.kind) else {
                return Err(ItemError::new(format!("\"{}\" was not flown", file.name)));
            };
            flights.push(Flight {
                name: file.name.clone(),
                level: *level,
                phenomena: file.phenomena.clone().unwrap_or_else(|| level.phenomena()),
                settings: file.controller.design().inversion,
                rows: rows(&flown.recording, &file.name, vehicle)?,
                vehicle: Arc::clone(vehicle),
                is_complete: flown.ending.end == End::Done,
            });
        }
        Ok(Self {
            scenario: scenario.clone(),
            flights,
            flown,
        })
    }

    /// Whether all flew to the end.
    pub fn is_complete(&self) -> bool {
        self.flown.ending.end == End::Done
    }

    /// The flight of the quadrotor of this name.
    ///
    /// # Errors
    /// If there is none.
    pub fn named(&self, name: &str) -> Result<&Flight, ItemError> {
        let found = self.flights.iter().find(|flight| flight.name == name);
        found.ok_or_else(|| ItemError::new(format!("no quadrotor \"{name}\" in \"{}\"", self.scenario.name)))
    }

    /// The flight on this level.
    ///
    /// # Errors
    /// If there is none.
    pub fn on(&self, level: Level) -> Result<&Flight, ItemError> {
        let found = self.flights.iter().find(|flight| flight.level == level);
        found.ok_or_else(|| ItemError::new(format!("no quadrotor on {level} in \"{}\"", self.scenario.name)))
    }
}

impl Flight {
    /// A quantity over time, `(t, value)`.
    pub fn series(&self, value: impl Fn(&Row) -> f64) -> Vec<(f64, f64)> {
        self.rows.iter().map(|row| (row.time_s, value(row))).collect()
    }

    /// The limits of its commands, if they are switched on.
    pub fn limits(&self) -> Option<CommandLimits<f64>> {
        let are_on = self.phenomena.contains(Phenomenon::InputLimits);
        are_on.then(|| CommandLimits::of(&self.vehicle))
    }

    /// Distance from the reference over time, `(t, m)`.
    pub fn distances(&self) -> Vec<(f64, f64)> {
        self.series(|row| (row.reference - row.position).norm())
    }
}

/// A column of a recording.
///
/// # Errors
/// If there is no such channel.
pub fn column(recording: &Recording, name: &str) -> Result<Vec<f64>, ItemError> {
    let found = recording.column(name).map(Iterator::collect);
    found.ok_or_else(|| ItemError::new(format!("the recording has no channel {name}")))
}

fn rows(recording: &Recording, quadrotor: &str, vehicle: &Vehicle) -> Result<Vec<Row>, ItemError> {
    let of = |channel: &str| column(recording, &format!("{quadrotor}.{channel}"));
    let three = |channel: &str, ends: [&str; 3]| -> Result<[Vec<f64>; 3], ItemError> {
        let [a, b, c] = ends.map(|end| of(&format!("{channel}.{end}")));
        Ok([a?, b?, c?])
    };
    let xyz = ["x", "y", "z"];
    let (position, velocity) = (three("position", xyz)?, three("velocity", xyz)?);
    let attitude = three("attitude", ["roll", "pitch", "yaw"])?;
    let (reference, reference_yaw) = (three("reference.position", xyz)?, of("reference.yaw")?);
    let [u1, u2, u3, u4] = ["1", "2", "3", "4"].map(|rotor| of(&format!("command.{rotor}")));
    let commands = [u1?, u2?, u3?, u4?];
    let allocation = Allocation::<f64>::of(vehicle)?;
    let at = |(k, time_s): (usize, f64)| {
        let vector = |columns: &[Vec<f64>; 3]| Vector3::from(columns.each_ref().map(|x| x[k]));
        let [roll, pitch, yaw] = attitude.each_ref().map(|x| x[k]);
        let commands = commands.each_ref().map(|u| u[k]);
        Row {
            time_s,
            position: vector(&position),
            velocity: vector(&velocity),
            attitude: EulerAngles { roll, pitch, yaw },
            reference: vector(&reference),
            reference_yaw: reference_yaw[k],
            commands,
            pseudo_inputs: allocation.pseudo_inputs(&commands),
        }
    };
    Ok(recording.times_s().enumerate().map(at).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn exact_every_file_in_the_folder_is_compiled_in() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/scenarios");
        let found: BTreeSet<String> = std::fs::read_dir(folder)
            .expect("the folder")
            .map(|entry| {
                entry
                    .expect("an entry")
                    .file_name()
                    .to_string_lossy()
                    .into_owned()
            })
            .collect();
        let known: BTreeSet<String> = ALL.iter().map(|file| format!("{}.toml", file.name)).collect();
        assert_eq!(found, known);
    }

    #[test]
    fn prop_files_belong_to_figures_and_say_how_to_fly_them() {
        for file in ALL {
            let scenario = file.scenario().unwrap_or_else(|error| panic!("{error}"));
            assert!(!scenario.description.is_empty(), "{}", file.name);
            let items = crate::figures::all();
            let item = items.iter().find(|item| file.name.starts_with(item.id));
            assert!(item.is_some(), "{} is of no figure", file.name);
            let first = file.text.lines().next().unwrap_or_default();
            let number = item.map_or("", |item| item.number());
            assert!(
                first.starts_with('#') && first.contains(number),
                "{}: {first}",
                file.name
            );
            let command = format!("{}.toml", file.name);
            let is_told = |line: &str| line.contains("`sifre ") && line.contains(&command);
            assert!(file.text.lines().any(is_told), "{}", file.name);
        }
    }

    /// The quadrotors of a family of flights differ in nothing but their level and what belongs to it.
    #[test]
    fn prop_members_of_a_family_differ_in_their_level_alone() {
        let families = ALL.iter().filter(|file| {
            let scenario = file.scenario().expect("a scenario");
            scenario.quadrotor.iter().all(|q| q.name.starts_with("level-"))
        });
        // Each level under its own controller.
        for file in families.filter(|file| !["6.2", "6.3"].contains(&file.name)) {
            let scenario = file.scenario().expect("a scenario");
            let limited = |k: usize| {
                let q = &scenario.quadrotor[k];
                let on = q.phenomena.clone().unwrap_or_else(|| q.level.phenomena());
                assert_eq!(q.name, format!("level-{}", q.level.number()));
                assert!(!on.contains(Phenomenon::VoltageSag), "{} {}", file.name, q.name);
                on.contains(Phenomenon::InputLimits)
            };
            for (k, quadrotor) in scenario.quadrotor.iter().enumerate() {
                let first = &scenario.quadrotor[0];
                let alike = scenario::QuadrotorFile {
                    name: first.name.clone(),
                    level: first.level,
                    phenomena: first.phenomena.clone(),
                    ..quadrotor.clone()
                };
                assert_eq!(&alike, first, "{} {}", file.name, quadrotor.name);
                assert_eq!(limited(k), limited(0), "{} {}", file.name, quadrotor.name);
            }
        }
    }
}
