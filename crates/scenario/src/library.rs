//! Vehicles and stations by name, or from files that somebody else reads.

use crate::error::ScenarioError;
use crate::file::QuadrotorFile;
use ets::Station;
use quad_dynamics::vehicle::VehicleFile;
use quad_dynamics::vehicle::builtin::{CRAZYFLIE_TOML, QBALL_X4_TOML, QBALL_X4_VENDOR_TOML};
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
}

impl<'a> Library<'a> {
    /// Nothing read yet.
    pub(crate) fn new(files: &'a dyn Files) -> Self {
        Self {
            files,
            vehicles: RefCell::default(),
            stations: RefCell::default(),
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
        self.vehicles.borrow_mut().insert(key, Arc::clone(&vehicle));
        Ok(vehicle)
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
    let mut text = text(agent, "vehicle", wanted, &VEHICLES, files)?;
    let read = |text: &str, origin: String| {
        let file = VehicleFile::from_toml_str(text, &origin).map_err(|source| refused(agent, source))?;
        Ok(SoundFile { file, origin })
    };
    if parameters.is_empty() {
        return read(&text, wanted.to_owned());
    }
    // The file itself must be sound first, so that an error in it is reported with its line.
    Vehicle::from_toml_str(&text, wanted).map_err(|source| refused(agent, source))?;
    let mut file: Table = toml::from_str(&text).unwrap_or_default();
    change(agent, &mut file, parameters, "")?;
    text = toml::to_string(&file).unwrap_or(text);
    read(&text, format!("{wanted} with the scenario's parameters"))
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

/// Takes over parameters into a vehicle file: numbers take the place of values, tables are gone into.
fn change(agent: &str, file: &mut Table, parameters: &Table, above: &str) -> Result<(), ScenarioError> {
    for (key, wanted) in parameters {
        let path = if above.is_empty() {
            key.clone()
        } else {
            format!("{above}.{key}")
        };
        let refuse = |reason: String| ScenarioError::Parameter {
            agent: agent.to_owned(),
            key: path.clone(),
            reason,
        };
        let known = || file.keys().cloned().collect::<Vec<_>>().join(", ");
        let reason = format!("unknown key of the vehicle file; available: {}", known());
        match (file.get_mut(key), wanted) {
            (Some(Value::Table(sourced)), value) if sourced.contains_key("value") => {
                sourced.insert("value".to_owned(), value.clone());
                sourced.insert("source".to_owned(), Value::from("the scenario"));
                sourced.remove("standard_error");
            }
            (Some(Value::Table(below)), Value::Table(parameters)) => {
                change(agent, below, parameters, &path)?;
            }
            (Some(Value::Table(_)), _) => {
                return Err(refuse("a table, not a number: set one of its keys".to_owned()));
            }
            (Some(_), _) => return Err(refuse("only numbers with a source can be set".to_owned())),
            (None, _) => return Err(refuse(reason)),
        }
    }
    Ok(())
}

pub(crate) fn station_error(agent: &str, source: ets::StationError) -> ScenarioError {
    ScenarioError::Station {
        agent: agent.to_owned(),
        source: Box::new(source),
    }
}
