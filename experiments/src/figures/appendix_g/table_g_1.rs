//! Table G.1: properties of the Qball-X4, from its parameter files.

use crate::data::DataTable;
use crate::drawing::{DisplayTable, Drawing};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::vehicle::NOMINAL_VEHICLE;
use std::collections::BTreeMap;

/// The table.
pub(super) const ITEM: Item = Item {
    id: "table-G.1",
    title: "Properties of the Qball-X4",
    description: "Every number of the nominal parameter file with its unit in the key and its source, beside the vendor's \
                  value where the vendor gives one. The thesis measured its own values, which are not available; these \
                  are the project's.",
    kind: Kind::Table,
    origin: Origin::Derived,
    claims: &[],
    make: Make::Draw(draw),
};

const VENDOR_VEHICLE: &str = "vehicles/qball-x4-vendor.toml";

/// Value and source of each key of a vehicle file, by its path.
fn entries(context: &Context, file: &str) -> Result<Vec<(String, String, String)>, ItemError> {
    let text = std::fs::read_to_string(context.data(file))?;
    // Validate first: a table of a wrong file helps nobody.
    quad_dynamics::Vehicle::from_toml_str(&text, file)?;
    let mut found = Vec::new();
    collect("", &toml::Value::Table(text.parse::<toml::Table>()?), &mut found);
    Ok(found)
}

/// Path, value and source of each number below a value of a parameter file.
pub(super) fn collect(path: &str, value: &toml::Value, found: &mut Vec<(String, String, String)>) {
    let below = |key: &str| {
        if path.is_empty() {
            key.to_owned()
        } else {
            format!("{path}.{key}")
        }
    };
    match value {
        toml::Value::Table(table) => {
            if let (Some(value), Some(toml::Value::String(source))) =
                (table.get("value"), table.get("source"))
            {
                found.push((path.to_owned(), value.to_string(), source.clone()));
                return;
            }
            for (key, value) in table {
                collect(&below(key), value, found);
            }
        }
        toml::Value::Array(list) => {
            for (i, value) in list.iter().enumerate() {
                collect(&format!("{path}[{}]", i + 1), value, found);
            }
        }
        _ => {}
    }
}

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let vendor: BTreeMap<String, String> = entries(context, VENDOR_VEHICLE)?
        .into_iter()
        .map(|(key, value, _)| (key, value))
        .collect();
    let mut shown = DisplayTable::new(["Property", "Nominal", "Vendor", "Source of the nominal value"]);
    let mut data = DataTable::new(["property", "nominal", "vendor", "source"]);
    for (key, value, source) in entries(context, NOMINAL_VEHICLE)? {
        let by_vendor = vendor.get(&key).cloned().unwrap_or_default();
        data.push([
            key.as_str().into(),
            value.as_str().into(),
            by_vendor.as_str().into(),
            source.as_str().into(),
        ]);
        shown.push([escaped(&key), value, by_vendor, escaped(&source)]);
    }
    Ok(Drawing::table(shown).data(data))
}

/// Words that are not rich text: asterisks, carets and underscores stand for themselves.
pub(in crate::figures) fn escaped(words: &str) -> String {
    let mut escaped = String::with_capacity(words.len());
    for sign in words.chars() {
        if matches!(sign, '*' | '_' | '^' | '\\') {
            escaped.push('\\');
        }
        escaped.push(sign);
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::escaped;
    use crate::plot::text;

    #[test]
    fn prop_escaped_words_stand_for_themselves() {
        let words = r"B3_figure8_slow.csv, 2*3^4, C:\data";
        assert_eq!(text::plain(&escaped(words)), words);
        assert_eq!(text::html(&escaped("a_b")), "a_b");
    }
}
