//! `sifre uncertainty`: against flights with the numbers set by hand, first order against Monte Carlo, and bad input.

use crate::support::{Folder, ready};
use quad_dynamics::vehicle::builtin::QBALL_X4_VENDOR_TOML;
use serde_json::Value;

const SCENARIO: &str = r#"
name = "up"
duration_s = 6.0
[[quadrotor]]
name = "alpha"
level = 3
vehicle = "identified.toml"
reference = { kind = "steps", steps = [
    { from_s = 0, position_m = [0, 0, -2] },
    { from_s = 1, position_m = [0, 0, -3] },
] }
"#;

/// What the vehicle's height hangs on, by its controller without an integral: a mass that it has wrong.
const METRIC: &str = "alpha.z.steady_state_error_m";

/// A folder with a scenario and its vehicle, the mass with a standard error.
fn folder(test: &str) -> Folder {
    let folder = Folder::new(test);
    folder.write("up.toml", SCENARIO);
    let mut file: toml::Table = toml::from_str(QBALL_X4_VENDOR_TOML).unwrap();
    let number = file["airframe"]["mass_kg"].as_table_mut().unwrap();
    number.insert("standard_error".to_owned(), 0.01.into());
    folder.write("identified.toml", toml::to_string(&file).unwrap());
    folder
}

fn number(value: &Value, keys: &[&str]) -> f64 {
    let found = keys.iter().fold(value, |value, key| &value[key]);
    found.as_f64().unwrap_or_else(|| panic!("{keys:?} in {value:#}"))
}

/// A mass that is Δm more than c3 believes hangs below its set point. In steady state the thrust is the whole weight, which c3 takes
/// for an acceleration `â = −g Δm/m`, and asks for no jerk, `k_p e = k_a â`. By the poles of its loop, a double one at
/// `ω = 5.834/τ_s` and one at 20 ω, `k_a/k_p = 22/(20 ω²)`. Linear in the mass: first order is all there is, and draws spread by it.
#[test]
fn exact_effect_of_the_mass_on_the_height() {
    const DRAWS: u32 = 60;
    let folder = folder("uncertainty");
    let json = folder
        .run(&["uncertainty", "up.toml", "--runs", "60", "--json"])
        .exits(0)
        .json();
    assert_eq!(json["done"], DRAWS);
    let of = |key| number(&json, &["metrics", METRIC, key]);
    let frequency: f64 = 5.834 / 2.0;
    let expected = 22.0 / (20.0 * frequency.powi(2)) * 9.81 * 0.01 / 1.4;
    // Four digits of the constant, squared; what is left of the step after six seconds is 10⁻⁶ of it.
    let effect = of("first_order_standard_deviation");
    assert!((effect / expected - 1.0).abs() < 5e-4, "{effect} for {expected}");
    // The sample's own standard errors, four of each.
    let n = f64::from(DRAWS);
    assert!((of("standard_deviation") / effect - 1.0).abs() < 4.0 / (2.0 * n).sqrt());
    assert!((of("mean") - of("nominal")).abs() < 4.0 * effect / n.sqrt());
    let only = &json["metrics"][METRIC]["contributions"][0];
    assert_eq!(only["key"], "alpha.airframe.mass_kg");
    assert_eq!(only["share"], 1.0);
    // Set point minus height along down: more mass hangs below, which is further down.
    assert!(number(only, &["effect"]) < 0.0);
}

/// A draw is that of its number: threads change nothing, more draws leave the first ones as they were, a seed does change them.
#[test]
fn exact_draws_are_those_of_their_seed() {
    let folder = folder("uncertainty-seeds");
    let run = |more: &[&str]| {
        let arguments = [
            "uncertainty",
            "up.toml",
            "--runs",
            "4",
            "--json",
            "--set",
            "duration_s=1.5",
        ];
        folder.run(&[&arguments, more].concat()).exits(0).text()
    };
    let one = run(&["--jobs", "1"]);
    assert_eq!(one, run(&["--jobs", "2"]));
    assert_ne!(one, run(&["--seed", "1"]));
}

/// For people: a table that names the number that matters.
#[test]
fn exact_a_table_names_what_matters() {
    let folder = folder("uncertainty-text");
    let text = folder
        .run(&["uncertainty", "up.toml", "--runs", "2", "--set", "duration_s=1.5"])
        .exits(0)
        .text();
    assert!(
        text.contains("2 flown, 0 ended early") && text.contains("alpha.airframe.mass_kg 100 %"),
        "{text}"
    );
}

/// Nothing uncertain, whether the file has no errors or the scenario sets the number itself; a nominal flight that ends early.
#[test]
fn exact_refusals_tell_what_to_do() {
    let folder = folder("uncertainty-refused");
    let says = ["no number", "standard error", "identify"];
    let vendor = "quadrotor.alpha.vehicle=qball-x4-vendor";
    let mass = "quadrotor.alpha.parameters.airframe.mass_kg=1.5";
    for set in [vendor, mass] {
        folder
            .run(&["uncertainty", "up.toml", "--set", set])
            .exits(2)
            .says(&says);
    }
    let low = "stop.outside={ from_m = [-1, -1, -2.5], to_m = [1, 1, 0] }";
    folder
        .run(&["uncertainty", "up.toml", "--set", low])
        .exits(1)
        .says(&["the nominal flight must finish"]);
    folder.run(&["uncertainty", "up.toml", "--runs", "1"]).exits(2);
    folder
        .run(&["uncertainty", &ready("hover"), "--set", "quadrotor.alpha.level=9"])
        .exits(2);
}
