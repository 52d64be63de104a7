//! Vehicles and stations by name, or from files that somebody else reads.

use crate::error::ScenarioError;
use crate::file::QuadrotorFile;
use ets::Station;
use quad_dynamics::vehicle::builtin::{CRAZYFLIE_TOML, QBALL_X4_TOML, QBALL_X4_VENDOR_TOML};
use quad_dynamics::vehicle::{Sourced, VehicleFile};
use quad_dynamics::{Vehicle, VehicleError};
use std::cell::RefCell;
use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;
use toml::{Table, Value};

/// The vehicles that come with the project: name and file.
pub const VEHICLES: [(&str, &str); 3] = [
    ("qball-x4", QBALL_X4_TOML),
    ("qball-x4-vendor", QBALL_X4_VENDOR_TOML),
    ("crazyflie", CRAZYFLIE_TOML),
];

/// The stations that come with the project: name and file.
pub const STATIONS: [(&str, &str); 1] = [("nominal", ets::station::NOMINAL_TOML)];

/// Whoever can read files. This crate reads none by itself.
pub trait Files {
    /// The text of the file that a scenario names.
    ///
    /// # Errors
    /// Why it can't be had.
    fn text(&self, name: &str) -> Result<String, std::io::Error>;
}

/// No files: only what comes with the project.
impl Files for () {
    fn text(&self, _name: &str) -> Result<String, std::io::Error> {
        Err(std::io::ErrorKind::NotFound.into())
    }
}

/// Files in memory.
impl Files for BTreeMap<String, String> {
    fn text(&self, name: &str) -> Result<String, std::io::Error> {
        self.get(name)
            .cloned()
            .ok_or_else(|| std::io::ErrorKind::NotFound.into())
    }
}

/// The text behind a name, which is that of something that comes with the project, or of a file.
fn text(
    agent: &str,
    kind: &'static str,
    wanted: &str,
    known: &[(&str, &str)],
    files: &dyn Files,
) -> Result<String, ScenarioError> {
    if let Some((_, text)) = known.iter().find(|(name, _)| *name == wanted) {
        return Ok((*text).to_owned());
    }
    files.text(wanted).map_err(|error| {
        let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
        ScenarioError::NoFile {
            agent: agent.to_owned(),
            kind,
            wanted: wanted.to_owned(),
            reason: format!("neither a known name nor a readable file ({error})"),
            known: names.join(", "),
        }
    })
}

/// The vehicles and stations of a scenario, each read once, however many agents have it.
pub(crate) struct Library<'a> {
    files: &'a dyn Files,
    /// By name, and by the scenario's own parameters.
    vehicles: RefCell<HashMap<(String, String), Arc<Vehicle>>>,
    stations: RefCell<HashMap<String, Station>>,
    /// One for each vehicle whose numbers state no source.
    warnings: RefCell<Vec<String>>,
}

impl<'a> Library<'a> {
    /// Nothing read yet.
    pub(crate) fn new(files: &'a dyn Files) -> Self {
        Self {
            files,
            vehicles: RefCell::default(),
            stations: RefCell::default(),
            warnings: RefCell::default(),
        }
    }

    /// The vehicle of an agent, with these parameters other than in its file.
    pub(crate) fn vehicle(
        &self,
        agent: &str,
        wanted: &str,
        parameters: &Table,
    ) -> Result<Arc<Vehicle>, ScenarioError> {
        let key = (wanted.to_owned(), parameters.to_string());
        if let Some(known) = self.vehicles.borrow().get(&key) {
            return Ok(Arc::clone(known));
        }
        let SoundFile { file, origin } = vehicle_file(agent, wanted, parameters, self.files)?;
        let vehicle = Vehicle::from_file(&file, &origin).map_err(|source| refused(agent, source))?;
        let vehicle = Arc::new(vehicle);
        if let Some(warning) = file.unstated_warning() {
            let mut warnings = self.warnings.borrow_mut();
            if !warnings.contains(&warning) {
                warnings.push(warning);
            }
        }
        self.vehicles.borrow_mut().insert(key, Arc::clone(&vehicle));
        Ok(vehicle)
    }

    /// What to know of the vehicles that were read.
    pub(crate) fn warnings(&self) -> Vec<String> {
        self.warnings.borrow().clone()
    }

    /// The station of an agent.
    pub(crate) fn station(&self, agent: &str, wanted: &str) -> Result<Station, ScenarioError> {
        if let Some(known) = self.stations.borrow().get(wanted) {
            return Ok(known.clone());
        }
        let text = text(agent, "station", wanted, &STATIONS, self.files)?;
        let station = Station::from_toml_str(&text, wanted).map_err(|source| station_error(agent, source))?;
        self.stations
            .borrow_mut()
            .insert(wanted.to_owned(), station.clone());
        Ok(station)
    }
}

/// A vehicle file that has been read, and its name in messages.
pub(crate) struct SoundFile {
    pub(crate) file: VehicleFile,
    pub(crate) origin: String,
}

/// The vehicle file of an agent, with these parameters other than in the file as it is.
pub(crate) fn vehicle_file(
    agent: &str,
    wanted: &str,
    parameters: &Table,
    files: &dyn Files,
) -> Result<SoundFile, ScenarioError> {
    let text = text(agent, "vehicle", wanted, &VEHICLES, files)?;
    let mut file = VehicleFile::parse(&text, wanted).map_err(|source| refused(agent, source))?;
    if parameters.is_empty() {
        let origin = wanted.to_owned();
        return Ok(SoundFile { file, origin });
    }
    // The file as it is must be sound first, so that a parameter isn't blamed for an error in it.
    Vehicle::from_file(&file, wanted).map_err(|source| refused(agent, source))?;
    change(agent, &mut file, parameters, "")?;
    let origin = format!("{wanted} with the scenario's parameters");
    Ok(SoundFile { file, origin })
}

fn refused(agent: &str, source: VehicleError) -> ScenarioError {
    ScenarioError::Vehicle {
        agent: agent.to_owned(),
        source: Box::new(source),
    }
}

impl QuadrotorFile {
    /// The vehicle that this quadrotor flies, as a file with sources and standard errors; the scenario's own parameters,
    /// which have no standard errors, stand in the place of the file's.
    ///
    /// # Errors
    /// If the vehicle isn't there, its file is wrong, or it doesn't have one of the parameters.
    pub fn vehicle_file(&self, files: &dyn Files) -> Result<VehicleFile, ScenarioError> {
        vehicle_file(&self.name, &self.vehicle, &self.parameters, files).map(|sound| sound.file)
    }
}

/// Takes over parameters into a vehicle file: numbers and vectors take the place of the file's, tables are gone into.
fn change(agent: &str, file: &mut VehicleFile, parameters: &Table, above: &str) -> Result<(), ScenarioError> {
    for (name, wanted) in parameters {
        let key = if above.is_empty() {
            name.clone()
        } else {
            format!("{above}.{name}")
        };
        if let Value::Table(below) = wanted {
            change(agent, file, below, &key)?;
            continue;
        }
        let refuse = |reason: String| ScenarioError::Parameter {
            agent: agent.to_owned(),
            key: key.clone(),
            reason,
        };
        let components = match wanted {
            Value::Array(components) => components.iter().enumerate().collect(),
            number => vec![(usize::MAX, number)],
        };
        for (k, component) in components {
            let path = match k {
                usize::MAX => key.clone(),
                k => format!("{key}[{k}]"),
            };
            let number = as_number(component).ok_or_else(|| refuse("expected a number".to_owned()))?;
            file.set(&path, &Sourced::new(number, "the scenario"))
                .ok_or_else(|| refuse(unknown(file, &key)))?;
        }
    }
    Ok(())
}

fn as_number(value: &Value) -> Option<f64> {
    match value {
        Value::Float(number) => Some(*number),
        Value::Integer(number) => Some(*number as f64),
        _ => None,
    }
}

/// What the vehicle file has in the place of a key that it has not: the keys of its group, or its groups.
fn unknown(file: &VehicleFile, key: &str) -> String {
    let group = key.split_once('.').map(|(group, _)| group);
    let (mut groups, mut names) = (Vec::new(), Vec::new());
    file.for_each_number(|entry, _| {
        let (of, name) = entry.group_and_name();
        if !groups.contains(&of) {
            groups.push(of);
        }
        if Some(of) == group && !names.contains(&name) {
            names.push(name);
        }
    });
    let known = if names.is_empty() { groups } else { names };
    format!(
        "the vehicle file has no such number; expected one of {}",
        known.join(", ")
    )
}

pub(crate) fn station_error(agent: &str, source: ets::StationError) -> ScenarioError {
    ScenarioError::Station {
        agent: agent.to_owned(),
        source: Box::new(source),
    }
}
