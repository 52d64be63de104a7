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

use super::{Entry, Vehicle, VehicleError, VehicleFile};

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
    file: VehicleFile,
    numbers: Vec<UncertainNumber>,
}

impl UncertainVehicle {
    /// The vehicle of a file; `origin` is the file's name in messages.
    ///
    /// # Errors
    /// As [`Vehicle::from_file`].
    pub fn of(file: &VehicleFile, origin: &str) -> Result<Self, VehicleError> {
        let mut numbers: Vec<UncertainNumber> = Vec::new();
        file.for_each_number(|entry, number| {
            if let Some(standard_error) = number.standard_error.filter(|&error| error > 0.0) {
                numbers.push(UncertainNumber {
                    key: named(file, entry),
                    value: number.value,
                    standard_error,
                });
            }
        });
        let [leader, follower] = ONE_NUMBER;
        if numbers.iter().any(|number| number.key == leader) {
            numbers.retain(|number| number.key != follower);
        }
        numbers.sort_by(|a, b| a.key.cmp(&b.key));
        Ok(Self {
            nominal: Vehicle::from_file(file, origin)?,
            origin: origin.to_owned(),
            file: file.clone(),
            numbers,
        })
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
        let moved = |key: &str| {
            let k = self.numbers.iter().position(|number| number.key == key)?;
            let deviation = *deviations.get(k)?;
            let number = &self.numbers[k];
            let moved = number.value + deviation * number.standard_error;
            (deviation != 0.0).then_some((moved, number.value))
        };
        let mut file = self.file.clone();
        file.for_each_number_mut(|entry, number| {
            let key = named(&self.file, entry);
            let partner = ONE_NUMBER
                .iter()
                .position(|&one| one == key)
                .map(|k| ONE_NUMBER[1 - k]);
            let value = match (moved(&key), partner.and_then(moved)) {
                (Some((value, _)), _) => value,
                // Equal to printed digits only: their ratio stays.
                (None, Some((value, before))) => number.value * value / before,
                (None, None) => return,
            };
            number.value = value;
            if number.standard_error.take().is_some() {
                number.source = format!("moved within the standard error of: {}", number.source);
            }
        });
        file
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

/// Path of a number; rotors by their names, vectors by their axes.
fn named(file: &VehicleFile, entry: &Entry) -> String {
    let (group, name) = entry.group_and_name();
    let key = match entry.rotor {
        Some(k) => format!("{group}.{}.{name}", file.rotors[k].name),
        None => format!("{group}.{name}"),
    };
    match entry.axis {
        Some(axis) => format!("{key}.{}", ["x", "y", "z"][axis]),
        None => key,
    }
}
