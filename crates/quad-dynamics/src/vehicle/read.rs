//! From the text of a vehicle file to its numbers; all mistakes are found before one is reported.

use super::file::{ABSENT, standard_error};
use super::{
    Airframe, ArmParameters, BatteryParameters, Entry, Environment, LinearRotorParameters,
    PolynomialRotorParameters, PropellerParameters, PwmRange, RotorMount, Sourced, Spin, Vehicle,
    VehicleError, VehicleFile,
};
use crate::{Drag, ROTORS};
use nalgebra::{Matrix3, Vector3};
use provenance::{Document, NOT_STATED, Place, ReadError};
use quad_rotor::{Motor, RotorDynamics};
use serde::de::DeserializeOwned;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The list of the rotors.
const ROTOR_LIST: &str = "rotors";
/// Keys at the top of a file that are no group of numbers.
const TEXTS: [&str; 2] = ["name", "description"];
/// Keys of a rotor that are no numbers.
const ROTOR_TEXTS: [&str; 2] = ["name", "spin"];

/// A vehicle with every group and no numbers.
pub(super) fn template() -> Vehicle<()> {
    let vector = Vector3::from_element(());
    let mount = || RotorMount {
        name: String::new(),
        hub_position: vector,
        spin: Spin::Clockwise,
    };
    Vehicle {
        name: String::new(),
        description: String::new(),
        environment: Environment::default(),
        airframe: Airframe {
            mass: (),
            inertia: Matrix3::from_element(()),
            arm_length: (),
            centre_of_mass: vector,
        },
        rotors: std::array::from_fn(|_| mount()),
        pwm: PwmRange::default(),
        linear_rotor: LinearRotorParameters::default(),
        rotor_dynamics: Some(RotorDynamics::default()),
        polynomial_rotor: Some(PolynomialRotorParameters::default()),
        propeller: Some(PropellerParameters::default()),
        motor: Some(Motor::default()),
        battery: Some(BatteryParameters::default()),
        drag: Some(Drag {
            quadratic: vector,
            rate_damping: vector,
        }),
        arms: Some(ArmParameters::default()),
    }
}

/// Keeps the optional groups that `has` wants.
pub(super) fn retain_groups<N>(vehicle: &mut Vehicle<N>, has: impl Fn(&str) -> bool) {
    fn keep<G>(group: &mut Option<G>, wanted: bool) {
        if !wanted {
            *group = None;
        }
    }
    keep(&mut vehicle.rotor_dynamics, has("rotor_dynamics"));
    keep(&mut vehicle.polynomial_rotor, has("polynomial_rotor"));
    keep(&mut vehicle.propeller, has("propeller"));
    keep(&mut vehicle.motor, has("motor"));
    keep(&mut vehicle.battery, has("battery"));
    keep(&mut vehicle.drag, has("drag"));
    keep(&mut vehicle.arms, has("arms"));
}

/// Reads the text of a vehicle file.
pub(super) fn vehicle_file(text: &str, origin: &str) -> Result<VehicleFile, VehicleError> {
    let document = Document::parse(text, origin)?;
    let mut reader = Reader {
        document: &document,
        faults: Vec::new(),
        vector: None,
    };
    let file = reader.file();
    VehicleError::all(reader.faults)?;
    Ok(file)
}

/// Takes numbers from the tables of a file, and keeps what is wrong; what could not be read is NaN.
struct Reader<'d, 'a> {
    document: &'d Document<'a>,
    faults: Vec<VehicleError>,
    /// The vector whose components are being read.
    vector: Option<[Sourced<f64>; 3]>,
}

impl<'d, 'a> Reader<'d, 'a> {
    fn file(&mut self) -> VehicleFile {
        let root = self.document.root();
        let groups = self.unknown_keys();
        let mut present = template();
        present.name = self.text(root, "", "name", &(0..0)).unwrap_or_default();
        present.description = self.text(root, "", "description", &(0..0)).unwrap_or_default();
        retain_groups(&mut present, |group| self.table(group, None).is_some());
        for group in groups {
            if template_requires(group) && !root.contains_key(group) {
                self.faults.push(self.document.missing(&(0..0), "", group).into());
            }
        }
        self.mounts(&mut present);
        present.map_numbers(|entry, ()| self.number(entry))
    }

    /// Names and spins of the rotors, as many as a quadrotor has.
    fn mounts(&mut self, vehicle: &mut Vehicle<()>) {
        let root = self.document.root();
        let Some(list) = root.get(ROTOR_LIST) else {
            return;
        };
        let count = list.get_ref().as_array().map_or(0, |rotors| rotors.len());
        if list.get_ref().as_array().is_some() && count != ROTORS {
            self.faults.push(VehicleError::RotorCount {
                origin: self.document.origin().to_owned(),
                count,
            });
        }
        for (k, mount) in vehicle.rotors.iter_mut().enumerate() {
            let Some((table, span)) = self.table(ROTOR_LIST, Some(k)) else {
                continue;
            };
            let path = format!("{ROTOR_LIST}[{k}]");
            mount.name = self.text(table, &path, "name", &span).unwrap_or_default();
            mount.spin = self.text(table, &path, "spin", &span).unwrap_or(mount.spin);
        }
    }

    /// Reports keys that are not known and groups that are no tables; gives the groups of a vehicle.
    fn unknown_keys(&mut self) -> Vec<&'static str> {
        let mut tables: Vec<(&str, Vec<&str>)> = Vec::new();
        template().for_each_number(|entry, ()| {
            let (group, key) = entry.group_and_name();
            match tables.iter_mut().find(|(name, _)| *name == group) {
                Some((_, keys)) if keys.contains(&key) => {}
                Some((_, keys)) => keys.push(key),
                None => tables.push((group, vec![key])),
            }
        });
        let (document, root) = (self.document, self.document.root());
        let groups: Vec<&str> = tables.iter().map(|(group, _)| *group).collect();
        let top = [&TEXTS[..], &groups].concat();
        let unknown = document.unknown(root, "", &top);
        self.faults.extend(unknown.map(VehicleError::from));
        for (group, keys) in &tables {
            let Some(value) = root.get(*group) else {
                continue;
            };
            let is_list = *group == ROTOR_LIST;
            let (kind, right) = if is_list {
                ("a list of tables `[[rotors]]`", value.get_ref().is_array())
            } else {
                ("a table", value.get_ref().is_table())
            };
            if !right {
                self.faults.push(wrong(document, value, group, kind));
                continue;
            }
            let entries = if is_list { ROTORS } else { 1 };
            for k in 0..entries {
                let (index, path, known) = if is_list {
                    let known = [&ROTOR_TEXTS[..], keys].concat();
                    (Some(k), format!("{group}[{k}]"), known)
                } else {
                    (None, (*group).to_owned(), keys.clone())
                };
                if let Some((table, _)) = self.table(group, index) {
                    let unknown = document.unknown(table, &path, &known);
                    self.faults.extend(unknown.map(VehicleError::from));
                }
            }
        }
        groups
    }

    /// A group's table, or that of a rotor, and where it begins.
    fn table(&self, group: &str, rotor: Option<usize>) -> Option<(&'d DeTable<'a>, Range<usize>)> {
        let value: &'d Spanned<DeValue<'a>> = self.document.root().get(group)?;
        let value = match rotor {
            Some(k) => value.get_ref().as_array()?.get(k)?,
            None => value,
        };
        Some((value.get_ref().as_table()?, value.span()))
    }

    /// A text of a table, or a word of a few.
    fn text<T: DeserializeOwned>(
        &mut self,
        table: &'d DeTable<'a>,
        path: &str,
        key: &str,
        span: &Range<usize>,
    ) -> Option<T> {
        let read = match table.get(key) {
            Some(value) => {
                let key = if path.is_empty() {
                    key.to_owned()
                } else {
                    format!("{path}.{key}")
                };
                self.document.typed(value, &key)
            }
            None => Err(self.document.missing(span, path, key)),
        };
        self.kept(read)
    }

    fn kept<T>(&mut self, read: Result<T, ReadError>) -> Option<T> {
        read.map_err(|error| self.faults.push(error.into())).ok()
    }

    fn number(&mut self, entry: &Entry) -> Sourced<f64> {
        let number = match entry.axis {
            None => match (self.value(entry), entry.quantity.default) {
                (Value::Is(value), _) => self.typed(value, entry),
                (Value::Absent(_), Some(default)) => Some(Sourced::new(default, ABSENT)),
                (Value::Absent(missing), None) => self.kept(Err(missing)),
                (Value::NoTable, _) => None,
            },
            Some(axis) => {
                if axis == 0 {
                    self.vector = match self.value(entry) {
                        // Each component with a source of its own, or none.
                        Value::Is(value) if value.get_ref().is_array() => self.typed(value, entry),
                        Value::Is(value) => self.typed(value, entry).map(components),
                        Value::Absent(missing) => self.kept(Err(missing)),
                        Value::NoTable => None,
                    };
                }
                self.vector.as_ref().map(|vector| vector[axis].clone())
            }
        };
        let Some(number) = number else {
            return Sourced::new(f64::NAN, NOT_STATED);
        };
        self.in_range(entry, &number);
        number
    }

    fn typed<T: DeserializeOwned>(&mut self, value: &Spanned<DeValue<'a>>, entry: &Entry) -> Option<T> {
        let read = self.document.typed(value, &entry.key());
        self.kept(read)
    }

    /// What the file has at a number's key.
    fn value(&self, entry: &Entry) -> Value<'d, 'a> {
        let (group, name) = entry.group_and_name();
        let Some((table, span)) = self.table(group, entry.rotor) else {
            return Value::NoTable;
        };
        match table.get(name) {
            Some(value) => Value::Is(value),
            None => {
                let key = entry.key();
                let table = key.rsplit_once('.').map_or("", |(table, _)| table);
                Value::Absent(self.document.missing(&span, table, name))
            }
        }
    }

    fn in_range(&mut self, entry: &Entry, number: &Sourced<f64>) {
        let place = match self.value(entry) {
            Value::Is(value) => self.document.place(&value.span()),
            Value::Absent(_) | Value::NoTable => Place::somewhere(self.document.origin()),
        };
        let range = entry.quantity.check(number.value);
        let range = range.map_err(VehicleError::range(place.clone(), entry.path()));
        self.faults.extend(range.err());
        self.faults.extend(standard_error(entry, number, &place).err());
    }
}

/// Every vehicle has these groups.
fn template_requires(group: &str) -> bool {
    let mut bare = template();
    retain_groups(&mut bare, |_| false);
    let mut required = false;
    bare.for_each_number(|entry, ()| {
        required |= entry.group_and_name().0 == group;
    });
    required
}

/// The error of a value that is of another kind.
fn wrong<'a>(document: &Document<'a>, value: &Spanned<DeValue<'a>>, key: &str, kind: &str) -> VehicleError {
    let message = format!("found {}, expected {kind}", value.get_ref().type_str());
    let place = document.place(&value.span());
    let key = key.to_owned();
    ReadError::Value { place, key, message }.into()
}

/// What a file has at a key.
enum Value<'d, 'a> {
    /// A value.
    Is(&'d Spanned<DeValue<'a>>),
    /// A table without the key.
    Absent(ReadError),
    /// Not even the table, which is reported once.
    NoTable,
}

/// The components of a vector, each with the source of the whole.
fn components(vector: Sourced<[f64; 3]>) -> [Sourced<f64>; 3] {
    std::array::from_fn(|axis| Sourced {
        value: vector.value[axis],
        source: vector.source.clone(),
        standard_error: vector.standard_error.map(|errors| errors[axis]),
    })
}
