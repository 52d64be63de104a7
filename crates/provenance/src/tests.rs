use crate::{
    Document, NOT_STATED, Place, Position, Quantity, RangeError, ReadError, Sourced, from_table, from_toml,
    from_toml_and_table,
};
use proptest::prelude::*;
use serde::Deserialize;

#[derive(Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
struct File {
    body: Body,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
struct Body {
    mass_kg: Sourced<f64>,
    #[serde(default)]
    centre_m: Option<Sourced<[f64; 3]>>,
}

fn read(text: &str) -> Result<File, ReadError> {
    from_toml(text, "f.toml")
}

fn at(line: usize, column: usize) -> Place {
    Place {
        origin: "f.toml".to_owned(),
        position: Some(Position { line, column }),
    }
}

#[test]
fn exact_tables_and_plain_values_are_numbers_with_sources() {
    let file = read(
        "[body]\nmass_kg = { value = 2, source = \"scale\", standard_error = 0.1 }\ncentre_m = [0, 0.5, -1e-3]",
    )
    .unwrap();
    assert_eq!(
        file.body.mass_kg,
        Sourced {
            value: 2.0,
            source: "scale".to_owned(),
            standard_error: Some(0.1)
        }
    );
    let centre = file.body.centre_m.unwrap();
    assert_eq!(centre, Sourced::new([0.0, 0.5, -1e-3], NOT_STATED));
    assert!(!centre.is_stated() && file.body.mass_kg.is_stated());
    let half_stated = read("[body]\nmass_kg = { value = 2.0 }").unwrap();
    assert_eq!(half_stated.body.mass_kg, Sourced::new(2.0, NOT_STATED));
}

#[test]
fn exact_errors_name_line_column_and_key() {
    let cases = [
        ("body = = 2", at(1, 8), None, "not valid TOML"),
        (
            "\n[body]\n",
            at(2, 1),
            Some("body.mass_kg"),
            "missing key `body.mass_kg`",
        ),
        (
            "[body]\nmass_kg = 1\nmas = 1",
            at(3, 1),
            Some("body.mas"),
            "unknown key `body.mas`; expected mass_kg or centre_m",
        ),
        (
            "[body]\nmass_kg = \"heavy\"",
            at(2, 11),
            Some("body.mass_kg"),
            "expected f64",
        ),
        (
            "[body]\nmass_kg = { value = 1.0, source = \" \" }",
            at(2, 35),
            Some("body.mass_kg.source"),
            "the source is empty",
        ),
        (
            "[body]\nmass_kg = { source = \"scale\" }",
            at(2, 11),
            Some("body.mass_kg.value"),
            "missing key",
        ),
        (
            "[body]\nmass_kg = { value = 1.0, sauce = \"x\" }",
            at(2, 26),
            Some("body.mass_kg.sauce"),
            "expected one of value, source, standard_error",
        ),
    ];
    for (text, place, key, words) in cases {
        let error = read(text).unwrap_err();
        assert_eq!((error.place(), error.key()), (&place, key), "{error}");
        assert!(error.to_string().contains(words), "{error}");
    }
}

#[test]
fn agree_table_and_text_are_one_file() {
    let text = "[body]\nmass_kg = 2.0";
    let (file, table) = from_toml_and_table::<File>(text, "f.toml").unwrap();
    assert_eq!(file, from_table(&table, "f.toml").unwrap());
    let error = from_table::<File>(&toml::Table::new(), "f.toml").unwrap_err();
    assert_eq!(error.to_string(), "f.toml: missing key `body`");
}

#[test]
fn exact_documents_know_places() {
    let text = "a = 1\n[b]\nc = [1, \"x\"]\n";
    let document = Document::parse(text, "f.toml").unwrap();
    let unknown: Vec<_> = document.unknown(document.root(), "", &["a"]).collect();
    assert_eq!(unknown.len(), 1);
    assert_eq!((unknown[0].place(), unknown[0].key()), (&at(2, 2), Some("b")));
    let b = document.root()["b"].get_ref().as_table().unwrap();
    let error = document.typed::<[f64; 2]>(&b["c"], "b.c").unwrap_err();
    assert_eq!((error.place(), error.key()), (&at(3, 9), Some("b.c[1]")));
}

#[test]
fn exact_ranges_are_closed() {
    let mass = Quantity::new("body.mass_kg", "kg", 1e-3, 1e3, "is this in grams?");
    assert!(mass.check(1e-3).is_ok() && mass.check(1e3).is_ok());
    assert_eq!(
        mass.check(1400.0).unwrap_err().to_string(),
        "1400 kg is outside 0.001 to 1000 kg; is this in grams?"
    );
    let above = mass.within((0.5, f64::MAX), "");
    assert_eq!(
        above.check(0.1).unwrap_err().to_string(),
        "0.1 kg is below 0.5 kg"
    );
    assert!(matches!(mass.check(f64::NAN), Err(RangeError::NotFinite { .. })));
    assert_eq!((mass.default, mass.or_zero().default), (None, Some(0.0)));
}

proptest! {
    #[test]
    fn prop_any_text_is_read_without_panic(text in "\\PC{0,200}") {
        let _ = read(&text);
        let _ = read(&format!("[body]\nmass_kg = {text}"));
    }
}
