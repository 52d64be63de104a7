//! The vehicle file: from text and back, and numbers changed by their keys.
//!
//! The file is the only place where a number and its source live together; a plain [`Vehicle`] holds bare numbers, so that a study
//! that changes one does not leave a source behind that never said so.

use super::{Entry, Sourced, Vehicle, VehicleError, VehicleFile, read};
use provenance::{NOT_STATED, Place, Quantity};
use toml::Value;

/// The source of a number that a file leaves out because it is zero.
pub(super) const ABSENT: &str = "left out of the file: zero";

impl VehicleFile {
    /// Reads the text of a vehicle file; `origin` is the file's name in messages.
    ///
    /// A number is `{ value, source, standard_error }` or just its value, whose source is then "not stated"
    /// ([`VehicleFile::unstated`]).
    ///
    /// # Errors
    /// Text that is no TOML; else every missing or unknown key, value of the wrong type and number outside its range, each with
    /// line, column and key path.
    pub fn parse(text: &str, origin: &str) -> Result<Self, VehicleError> {
        read::vehicle_file(text, origin)
    }

    /// The file as TOML text, which [`VehicleFile::parse`] reads back unchanged.
    ///
    /// A vector whose components have one source and all or no standard errors is one table, any other one a list of three.
    #[must_use]
    pub fn to_toml(&self) -> String {
        Writer::default().vehicle(self)
    }

    /// Keys of the numbers whose source is not stated.
    #[must_use]
    pub fn unstated(&self) -> Vec<String> {
        let mut keys = Vec::new();
        self.for_each_number(|entry, number| {
            let key = entry.key();
            if !number.is_stated() && keys.last() != Some(&key) {
                keys.push(key);
            }
        });
        keys
    }

    /// One warning about the numbers whose source is not stated; `None` if each has one.
    #[must_use]
    pub fn unstated_warning(&self) -> Option<String> {
        const SHOWN: usize = 3;
        let keys = self.unstated();
        let more = match keys.len().saturating_sub(SHOWN) {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        let shown = keys.iter().take(SHOWN).map(|key| format!("`{key}`"));
        let shown = shown.collect::<Vec<_>>().join(", ");
        let name = &self.name;
        (!keys.is_empty()).then(|| {
            format!(
                "vehicle \"{name}\": {} numbers without a source: {shown}{more}",
                keys.len()
            )
        })
    }

    /// The number with this path, as in `airframe.mass_kg` or `drag.quadratic_n_s2_m2[1]`.
    #[must_use]
    pub fn get(&self, path: &str) -> Option<Sourced<f64>> {
        let mut found = None;
        self.for_each_number(|entry, number| {
            if entry.path() == path {
                found = Some(number.clone());
            }
        });
        found
    }

    /// Puts a number in the place of the one with this path, as in `airframe.mass_kg` or `drag.quadratic_n_s2_m2[1]`, and
    /// says what it is; `None` if the file has no such number.
    pub fn set(&mut self, path: &str, number: &Sourced<f64>) -> Option<&'static Quantity> {
        let mut found = None;
        self.for_each_number_mut(|entry, old| {
            if entry.path() == path {
                found = Some(entry.quantity);
                *old = number.clone();
            }
        });
        found
    }

    /// Makes sure of an optional group, such as `polynomial_rotor`, whose numbers are NaN until they are [set](VehicleFile::set)
    /// if it was absent.
    pub fn ensure_group(&mut self, group: &str) {
        let mut blank = read::template().map_numbers(|_, ()| Sourced::new(f64::NAN, NOT_STATED));
        read::retain_groups(&mut blank, |name| name == group);
        self.rotor_dynamics = self.rotor_dynamics.take().or(blank.rotor_dynamics);
        self.polynomial_rotor = self.polynomial_rotor.take().or(blank.polynomial_rotor);
        self.propeller = self.propeller.take().or(blank.propeller);
        self.motor = self.motor.take().or(blank.motor);
        self.battery = self.battery.take().or(blank.battery);
        self.drag = self.drag.take().or(blank.drag);
        self.arms = self.arms.take().or(blank.arms);
    }
}

impl Vehicle {
    /// Reads and validates a vehicle from the text of its file; `origin` is the file's name in messages.
    ///
    /// # Errors
    /// Any [`VehicleError`] but [`VehicleError::MissingGroup`].
    pub fn from_toml_str(text: &str, origin: &str) -> Result<Self, VehicleError> {
        Self::from_file(&VehicleFile::parse(text, origin)?, origin)
    }

    /// Takes the numbers out of a file and validates them; `origin` is the file's name in messages.
    ///
    /// # Errors
    /// As [`Vehicle::from_toml_str`], less what concerns the text.
    pub fn from_file(file: &VehicleFile, origin: &str) -> Result<Self, VehicleError> {
        let mut faults = Vec::new();
        let vehicle = file.map_numbers(|entry, number| {
            if number.source.trim().is_empty() {
                let (origin, key) = (origin.to_owned(), entry.key());
                faults.push(VehicleError::EmptySource { origin, key });
            }
            faults.extend(standard_error(entry, number, &Place::somewhere(origin)).err());
            number.value
        });
        VehicleError::all(faults)?;
        vehicle.validate(origin)?;
        Ok(vehicle)
    }

    /// The vehicle as a file, every number with the same source: a vehicle does not remember where each came from.
    #[must_use]
    pub fn to_file(&self, source: &str) -> VehicleFile {
        self.map_numbers(|entry, &number| match entry.quantity.default {
            Some(default) if default == number => Sourced::new(number, ABSENT),
            _ => Sourced::new(number, source),
        })
    }

    /// The vehicle as TOML text, every number with the same source (see [`Vehicle::to_file`]).
    #[must_use]
    pub fn to_toml(&self, source: &str) -> String {
        self.to_file(source).to_toml()
    }
}

/// A standard error is finite and not negative.
pub(super) fn standard_error(
    entry: &Entry,
    number: &Sourced<f64>,
    place: &Place,
) -> Result<(), VehicleError> {
    let Some(error) = number.standard_error else {
        return Ok(());
    };
    let key = match entry.axis {
        Some(axis) => format!("{}.standard_error[{axis}]", entry.key()),
        None => format!("{}.standard_error", entry.key()),
    };
    let bounds = entry.quantity.within((0.0, f64::MAX), "");
    bounds
        .check(error)
        .map_err(VehicleError::range(place.clone(), key))
}

/// Writes tables in the order in which the numbers are visited.
#[derive(Default)]
struct Writer {
    text: String,
    /// The table being written: the group, or the rotor.
    table: Option<(String, Option<usize>)>,
    /// Components of a vector whose last has not come yet.
    vector: Vec<Sourced<f64>>,
}

impl Writer {
    fn vehicle(mut self, file: &VehicleFile) -> String {
        self.line("name", &Value::from(file.name.as_str()));
        self.line("description", &Value::from(file.description.as_str()));
        file.for_each_number(|entry, number| self.number(file, entry, number));
        self.text
    }

    fn line(&mut self, key: &str, value: &Value) {
        self.text.push_str(&format!("{key} = {value}\n"));
    }

    fn number(&mut self, file: &VehicleFile, entry: &Entry, number: &Sourced<f64>) {
        let (group, key) = entry.group_and_name();
        let table = Some((group.to_owned(), entry.rotor));
        if self.table != table {
            self.table = table;
            match entry.rotor.map(|k| &file.rotors[k]) {
                Some(rotor) => {
                    self.text.push_str(&format!("\n[[{group}]]\n"));
                    self.line("name", &Value::from(rotor.name.as_str()));
                    let spin = Value::try_from(rotor.spin).expect("a word is representable in TOML");
                    self.line("spin", &spin);
                }
                None => self.text.push_str(&format!("\n[{group}]\n")),
            }
        }
        if number.source == ABSENT {
            return;
        }
        let Some(axis) = entry.axis else {
            self.text.push_str(&format!("{key} = {}\n", sourced(number)));
            return;
        };
        self.vector.push(number.clone());
        if axis == 2 {
            let vector = std::mem::take(&mut self.vector);
            let text = match common(&vector) {
                Some(common) => sourced(&common),
                None => format!("[{}]", vector.iter().map(sourced).collect::<Vec<_>>().join(", ")),
            };
            self.text.push_str(&format!("{key} = {text}\n"));
        }
    }
}

/// A number or vector, with its source if that is stated.
fn sourced<T: Clone + Into<Value>>(number: &Sourced<T>) -> String {
    let value = number.value.clone().into();
    let mut parts = vec![format!("value = {value}")];
    if number.is_stated() {
        parts.push(format!("source = {}", Value::from(number.source.as_str())));
    }
    if let Some(error) = number.standard_error.clone() {
        parts.push(format!("standard_error = {}", error.into()));
    }
    match parts.as_slice() {
        [_] => value.to_string(),
        _ => format!("{{ {} }}", parts.join(", ")),
    }
}

/// A vector as one number; `None` if it has no common source, or errors of some components only.
fn common(vector: &[Sourced<f64>]) -> Option<Sourced<Vec<f64>>> {
    let source = &vector.first()?.source;
    let errors: Vec<f64> = vector.iter().filter_map(|n| n.standard_error).collect();
    let whole = errors.is_empty() || errors.len() == vector.len();
    (whole && vector.iter().all(|n| n.source == *source)).then(|| Sourced {
        value: vector.iter().map(|n| n.value).collect(),
        source: source.clone(),
        standard_error: (!errors.is_empty()).then_some(errors),
    })
}
