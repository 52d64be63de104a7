//! Vehicles within the standard errors of a file: one at chosen deviations, or drawn at random.
//!
//! ```text
//! p_k = p̂_k + σ_k z_k        p̂_k the value in the file, σ_k its standard error, z_k the deviation in standard errors
//! ```
//!
//! Assumptions: errors are normal and, since a file has no correlations, independent. Only
//! `torque_c2_per_s2` and `torque_c4_per_s2`, equal by definition (the steady gain is one), move together as one number. Numbers without a standard error stay. What a vehicle derives from its file (a hub relative to the centre of
//! mass) is derived from the moved numbers, by the same reader and with the same checks. A draw that is no valid vehicle is drawn
//! again, so that where the checks bite the distribution is cut off there.
//!
//! Not known to the file, and so not respected: that estimates of one experiment are correlated (line and zero of a thrust curve,
//! terms of a polynomial). The spread of what depends on their sum is then overstated or understated.

use serde::Deserialize;
use toml::Value;

use super::{Vehicle, VehicleError, VehicleFile};

/// Numbers that are one by definition: the steady gain of the reaction torque is one.
const ONE_NUMBER: [&str; 2] = [
    "rotor_dynamics.torque_c4_per_s2",
    "rotor_dynamics.torque_c2_per_s2",
];

/// Draws before a file is given up: at one valid vehicle in ten, three files in 10⁵ are given up wrongly.
pub const MOST_TRIES: usize = 100;

/// A number of a vehicle file with a standard error.
#[derive(Debug, Clone, PartialEq)]
pub struct UncertainNumber {
    /// Path of its key; rotors by their names, vectors by their axes: `rotors.rear.hub_position_m.x`.
    pub key: String,
    /// Its value p̂, in the unit that ends the key.
    pub value: f64,
    /// Its standard error σ, in the same unit, positive.
    pub standard_error: f64,
}

/// A vehicle drawn within standard errors.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawn {
    /// Its file; drawn numbers say so in their sources and have no standard errors any more.
    pub file: VehicleFile,
    /// The vehicle.
    pub vehicle: Vehicle,
    /// Deviation of each number z, in standard errors, in the order of [`UncertainVehicle::numbers`].
    pub deviations: Vec<f64>,
}

/// Why nothing could be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DrawError {
    /// Every draw was refused.
    #[error(
        "{origin}: none of {tries} vehicles drawn within the standard errors is valid; the last one: {last}. \
         Standard errors that large say little about the vehicle: check them, or identify it better"
    )]
    NoneValid {
        /// Name of the file.
        origin: String,
        /// Vehicles drawn.
        tries: usize,
        /// What is wrong with the last one.
        last: Box<VehicleError>,
    },
}

/// A vehicle whose file says how well its numbers are known.
#[derive(Debug, Clone, PartialEq)]
pub struct UncertainVehicle {
    nominal: Vehicle,
    origin: String,
    file: Value,
    numbers: Vec<UncertainNumber>,
    /// Where each of the numbers stands, its own place first.
    places: Vec<Vec<Place>>,
}

/// Where a number stands in a file: the table that has `value`, and the element if that is a vector.
#[derive(Debug, Clone, PartialEq)]
struct Place {
    table: Vec<Step>,
    element: Option<usize>,
}

#[derive(Debug, Clone, PartialEq)]
enum Step {
    Key(String),
    Entry(usize),
}

impl UncertainVehicle {
    /// The vehicle of a file; `origin` is the file's name in messages.
    ///
    /// # Errors
    /// As [`Vehicle::from_file`].
    pub fn of(file: &VehicleFile, origin: &str) -> Result<Self, VehicleError> {
        let nominal = Vehicle::from_file(file, origin)?;
        let file = Value::try_from(file).expect("numbers, texts and tables are all representable in TOML");
        let mut found = Vec::new();
        walk(&file, "", &[], &mut found);
        // Tables may be kept sorted or as written: the order of the draws must not depend on it.
        found.sort_by(|a, b| a.0.key.cmp(&b.0.key));
        let (numbers, places) = found
            .into_iter()
            .map(|(number, place)| (number, vec![place]))
            .unzip();
        let mut vehicle = Self {
            nominal,
            origin: origin.to_owned(),
            file,
            numbers,
            places,
        };
        vehicle.join();
        Ok(vehicle)
    }

    /// Makes one of the numbers that are one.
    fn join(&mut self) {
        let [first, second] = ONE_NUMBER;
        let of = |numbers: &[UncertainNumber], key: &str| numbers.iter().position(|n| n.key == key);
        let (leader, other) = match of(&self.numbers, first) {
            Some(leader) => (leader, second),
            None => match of(&self.numbers, second) {
                Some(leader) => (leader, first),
                None => return,
            },
        };
        self.places[leader].push(Place {
            table: other.split('.').map(|key| Step::Key(key.to_owned())).collect(),
            element: None,
        });
        if let Some(k) = of(&self.numbers, other) {
            self.numbers.remove(k);
            self.places.remove(k);
        }
    }

    /// The vehicle as its file has it.
    #[must_use]
    pub fn nominal(&self) -> &Vehicle {
        &self.nominal
    }

    /// The numbers with a standard error, sorted by key; none if the file has no standard errors.
    #[must_use]
    pub fn numbers(&self) -> &[UncertainNumber] {
        &self.numbers
    }

    /// The file with each number moved by so many of its standard errors; those without a deviation stay.
    #[must_use]
    pub fn file_at(&self, deviations: &[f64]) -> VehicleFile {
        let mut file = self.file.clone();
        for ((number, places), &deviation) in self.numbers.iter().zip(&self.places).zip(deviations) {
            if deviation == 0.0 {
                continue;
            }
            let moved = number.value + deviation * number.standard_error;
            for (k, place) in places.iter().enumerate() {
                place.change(&mut file, |old| match k {
                    0 => moved,
                    // Equal to printed digits only: their ratio stays.
                    _ => old * moved / number.value,
                });
            }
        }
        VehicleFile::deserialize(file)
            .expect("only numbers and sources are other than in a file that was read")
    }

    /// The vehicle with each number moved by so many of its standard errors; those without a deviation stay.
    ///
    /// # Errors
    /// If that is no valid vehicle.
    pub fn at(&self, deviations: &[f64]) -> Result<Vehicle, VehicleError> {
        Vehicle::from_file(&self.file_at(deviations), &self.origin)
    }

    /// A vehicle drawn at random. `standard_normal` gives independent normal numbers of mean 0 and variance 1, from
    /// whatever generator and seed: the same numbers give the same vehicle.
    ///
    /// # Errors
    /// If [`MOST_TRIES`] draws in a row are no valid vehicles.
    pub fn draw(&self, standard_normal: &mut impl FnMut() -> f64) -> Result<Drawn, DrawError> {
        let mut tries = 1;
        loop {
            let deviations: Vec<f64> = self.numbers.iter().map(|_| standard_normal()).collect();
            let file = self.file_at(&deviations);
            match Vehicle::from_file(&file, &self.origin) {
                Ok(vehicle) => {
                    return Ok(Drawn {
                        file,
                        vehicle,
                        deviations,
                    });
                }
                Err(last) if tries == MOST_TRIES => {
                    return Err(DrawError::NoneValid {
                        origin: self.origin.clone(),
                        tries,
                        last: Box::new(last),
                    });
                }
                Err(_) => tries += 1,
            }
        }
    }
}

/// Finds the numbers with a standard error below a value of the file.
fn walk(value: &Value, key: &str, path: &[Step], found: &mut Vec<(UncertainNumber, Place)>) {
    let below = |name: &str| {
        if key.is_empty() {
            name.to_owned()
        } else {
            format!("{key}.{name}")
        }
    };
    let and = |step: Step| [path, &[step]].concat();
    match value {
        Value::Table(table) => match (table.get("value"), table.get("standard_error")) {
            (Some(value), Some(error)) => leaf(value, error, key, path, found),
            (Some(_), None) => {}
            (None, _) => {
                for (name, value) in table {
                    walk(value, &below(name), &and(Step::Key(name.clone())), found);
                }
            }
        },
        Value::Array(entries) => {
            for (k, entry) in entries.iter().enumerate() {
                let name = entry.get("name").and_then(Value::as_str);
                let name = name.map_or_else(|| (k + 1).to_string(), str::to_owned);
                walk(entry, &below(&name), &and(Step::Entry(k)), found);
            }
        }
        _ => {}
    }
}

/// A number, or the three of a vector.
fn leaf(value: &Value, error: &Value, key: &str, path: &[Step], found: &mut Vec<(UncertainNumber, Place)>) {
    let mut add = |key: String, value: &Value, error: &Value, element: Option<usize>| {
        if let (Some(value), Some(standard_error)) = (value.as_float(), error.as_float())
            && standard_error > 0.0
        {
            let number = UncertainNumber {
                key,
                value,
                standard_error,
            };
            let table = path.to_vec();
            found.push((number, Place { table, element }));
        }
    };
    match (value, error) {
        (Value::Array(values), Value::Array(errors)) => {
            let axes = ["x", "y", "z"].iter().enumerate();
            for ((k, axis), (value, error)) in axes.zip(values.iter().zip(errors)) {
                add(format!("{key}.{axis}"), value, error, Some(k));
            }
        }
        _ => add(key.to_owned(), value, error, None),
    }
}

impl Place {
    /// Puts another number here, and says so in its source.
    fn change(&self, file: &mut Value, to: impl FnOnce(f64) -> f64) {
        let table = self.table.iter().try_fold(file, |value, step| match step {
            Step::Key(key) => value.get_mut(key),
            Step::Entry(k) => value.get_mut(k),
        });
        let Some(Value::Table(table)) = table else {
            return;
        };
        let number = match (table.get_mut("value"), self.element) {
            (Some(Value::Array(values)), Some(k)) => values.get_mut(k),
            (number, _) => number,
        };
        if let Some(Value::Float(number)) = number {
            *number = to(*number);
        }
        // A vector comes here once for each axis.
        if table.remove("standard_error").is_some()
            && let Some(Value::String(source)) = table.get_mut("source")
        {
            *source = format!("moved within the standard error of: {source}");
        }
    }
}
