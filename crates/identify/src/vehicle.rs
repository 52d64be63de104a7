//! The vehicle file with the identified numbers: what else the user's file says, comments too, stays as it is.

use crate::output::{Answer, Found};
use quad_dynamics::Vehicle;
use quad_dynamics::vehicle::VehicleFile;
use std::error::Error;
use std::path::Path;
use toml_edit::{Array, DocumentMut, InlineTable, Item, Table, TableLike, Value};

/// The text of a file, with its name in the error.
fn text(path: &Path) -> Result<String, Box<dyn Error>> {
    output::read_text(path, output::TEXT_LIMIT).map_err(|e| format!("{}: {e}", path.display()).into())
}

/// Reads a vehicle file; warns where its numbers state no source.
pub(crate) fn read(path: &Path, answer: &mut Answer) -> Result<VehicleFile, Box<dyn Error>> {
    let file = VehicleFile::parse(&text(path)?, &path.display().to_string())?;
    answer.warn(file.unstated_warning().as_slice());
    Ok(file)
}

/// The text of the vehicle file `vehicle` with the identified numbers.
pub(crate) fn completed(
    vehicle: &Path,
    found: &[Found],
    source: impl Fn(&Found) -> String,
) -> Result<String, Box<dyn Error>> {
    updated(&text(vehicle)?, &vehicle.display().to_string(), found, source)
}

/// A vehicle file's text with the identified numbers in the place of the old ones, checked to be a vehicle.
fn updated(
    text: &str,
    origin: &str,
    found: &[Found],
    source: impl Fn(&Found) -> String,
) -> Result<String, Box<dyn Error>> {
    VehicleFile::parse(text, origin)?;
    let mut document: DocumentMut = text.parse()?;
    for number in found {
        let Found { key, estimate, .. } = number;
        let Some((group, name)) = key.split_once('.') else {
            continue;
        };
        let (name, index) = match name.split_once('[') {
            Some((name, rest)) => (name, rest.trim_end_matches(']').parse::<usize>().ok()),
            None => (name, None),
        };
        let (entry, index) = entry(&mut document, group, name, index).ok_or_else(|| {
            format!("{origin}: `{group}.{name}` must be a number, or a table with value and source")
        })?;
        let numbers = [
            ("value", estimate.value),
            ("standard_error", estimate.standard_error),
        ];
        for (key, number) in numbers {
            match index {
                None => set(entry, key, number.into()),
                Some(i) => set_component(entry, key, i, number),
            }
        }
        set(entry, "source", source(number).into());
        entry.fmt();
    }
    let text = document.to_string();
    let file = VehicleFile::parse(&text, origin)?;
    Vehicle::from_file(&file, origin)?;
    Ok(text)
}

/// The table of a number, and of which of its components; group and number are made if they are not there.
fn entry<'a>(
    document: &'a mut DocumentMut,
    group: &str,
    name: &str,
    index: Option<usize>,
) -> Option<(&'a mut dyn TableLike, Option<usize>)> {
    let group = document
        .entry(group)
        .or_insert_with(|| Item::Table(Table::new()))
        .as_table_like_mut()?;
    let made = || Item::Value(Value::InlineTable(InlineTable::new()));
    let number = group.entry(name).or_insert_with(made);
    // Each component with a source of its own.
    let of_its_own = |array: &Array| array.iter().all(Value::is_inline_table);
    if let (Some(k), true) = (index, number.as_array().is_some_and(of_its_own)) {
        let component = number.as_array_mut()?.get_mut(k)?.as_inline_table_mut()?;
        return Some((component, None));
    }
    // A plain value makes room for its source.
    let plain = number.as_value().filter(|value| !value.is_inline_table());
    if let Some(plain) = plain.cloned() {
        let mut table = InlineTable::new();
        table.insert("value", plain);
        *number = Item::Value(Value::InlineTable(table));
    }
    Some((number.as_table_like_mut()?, index))
}

/// Sets a value in its place, or at the end.
fn set(entry: &mut dyn TableLike, key: &str, value: Value) {
    if let Some(old) = entry.get_mut(key).and_then(Item::as_value_mut) {
        *old = value;
    } else {
        entry.insert(key, Item::Value(value));
    }
}

/// Sets a component of a triple that may not be there yet.
fn set_component(entry: &mut dyn TableLike, key: &str, index: usize, number: f64) {
    if entry.get(key).and_then(Item::as_array).is_none() {
        set(entry, key, Value::Array(Array::from_iter([0.0; 3])));
    }
    if let Some(component) = entry
        .get_mut(key)
        .and_then(Item::as_array_mut)
        .and_then(|array| array.get_mut(index))
    {
        let decor = component.decor().clone();
        *component = number.into();
        *component.decor_mut() = decor;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sysid::Estimate;

    const NOMINAL: &str = quad_dynamics::vehicle::builtin::QBALL_X4_TOML;

    #[test]
    fn exact_only_the_identified_lines_change() {
        let mut answer = Answer::default();
        answer.push("airframe.inertia_xx_kg_m2", "kg m²", Estimate::known(0.031, 2e-4));
        answer.push("airframe.centre_of_mass_m[1]", "m", Estimate::known(0.002, 1e-4));
        answer.push("weight", "N", Estimate::known(13.0, 0.1));
        let text = updated(NOMINAL, "nominal", &answer.found, |_| {
            "identified: by hand".to_owned()
        })
        .unwrap();
        let changed: Vec<(&str, &str)> = NOMINAL
            .lines()
            .zip(text.lines())
            .filter(|(a, b)| a != b)
            .collect();
        assert_eq!(text.lines().count(), NOMINAL.lines().count());
        assert_eq!(
            changed.iter().map(|pair| pair.1).collect::<Vec<_>>(),
            [
                "inertia_xx_kg_m2 = { value = 0.031, source = \"identified: by hand\", standard_error = 0.0002 }",
                "centre_of_mass_m = { value = [0.0, 0.002, 0.0], source = \"identified: by hand\", \
                 standard_error = [0.0, 0.0001, 0.0] }",
            ]
        );
    }

    /// A plain number and a plain vector become tables; components that were not identified keep their values.
    #[test]
    fn exact_plain_numbers_get_a_source() {
        let plain: String = NOMINAL
            .lines()
            .map(|line| match line.split_once(" = ").map(|(key, _)| key) {
                Some("inertia_xx_kg_m2") => "inertia_xx_kg_m2 = 0.03\n".to_owned(),
                Some("centre_of_mass_m") => "centre_of_mass_m = [0.001, 0.0, 0.003]\n".to_owned(),
                _ => format!("{line}\n"),
            })
            .collect();
        let mut answer = Answer::default();
        answer.push("airframe.inertia_xx_kg_m2", "kg m²", Estimate::known(0.031, 2e-4));
        answer.push("airframe.centre_of_mass_m[1]", "m", Estimate::known(0.002, 1e-4));
        let text = updated(&plain, "plain", &answer.found, |_| "by hand".to_owned()).unwrap();
        let file = VehicleFile::parse(&text, "new").unwrap();
        let inertia = &file.airframe.inertia.m11;
        assert_eq!((inertia.value, inertia.source.as_str()), (0.031, "by hand"));
        let centre = file.airframe.centre_of_mass.map(|number| number.value);
        assert_eq!(centre.as_slice(), [0.001, 0.002, 0.003]);
    }

    #[test]
    fn exact_a_missing_group_is_made_and_half_a_group_is_refused() {
        let start = NOMINAL.find("[rotor_dynamics]").unwrap();
        let end = NOMINAL.find("[polynomial_rotor]").unwrap();
        let without = format!("{}{}", &NOMINAL[..start], &NOMINAL[end..]);
        let file = VehicleFile::parse(NOMINAL, "nominal").unwrap();
        let old = file.rotor_dynamics.unwrap();
        let mut answer = Answer::default();
        for (key, value) in [
            ("thrust_c1_per_s", old.thrust_c1.value),
            ("thrust_c2_per_s2", old.thrust_c2.value),
            ("torque_c1_per_s", old.torque_c1.value),
            ("torque_c2_per_s2", old.torque_c2.value),
            ("torque_c3_per_s", old.torque_c3.value),
            ("torque_c4_per_s2", old.torque_c4.value),
        ] {
            answer.push(
                &format!("rotor_dynamics.{key}"),
                "1/s",
                Estimate::known(value, 0.1),
            );
        }
        let text = updated(&without, "without", &answer.found, |_| "identified".to_owned()).unwrap();
        let new = VehicleFile::parse(&text, "new").unwrap();
        assert_eq!(new.rotor_dynamics.unwrap().torque_c1.value, old.torque_c1.value);
        answer.found.truncate(3);
        assert!(updated(&without, "without", &answer.found, |_| "identified".to_owned()).is_err());
    }
}
