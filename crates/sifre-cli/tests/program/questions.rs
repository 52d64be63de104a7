//! `select-level` and `attribute`: which level is enough, and which phenomenon makes the difference.

use crate::support::{Folder, ready};
use serde_json::Value;
use std::fs;

/// A metric that all levels have.
const METRIC: &str = "position_error_rms_m";

/// Long enough for levels to part.
const SHORT: &str = "duration_s=1.5";

fn select(folder: &Folder, arguments: &[&str]) -> crate::support::Ran {
    let step = ready("horizontal-step");
    let given = [
        "select-level",
        &step,
        "--json",
        "--repeats",
        "1",
        "--set",
        SHORT,
        "--metric",
        METRIC,
    ];
    folder.run(&[&given, arguments].concat())
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn list<'a>(json: &'a Value, key: &str) -> &'a Vec<Value> {
    json[key]
        .as_array()
        .unwrap_or_else(|| panic!("no list {key} in {json}"))
}

#[test]
fn exact_tolerances_decide() {
    let folder = Folder::new("select");
    let json = select(&folder, &["--tolerance", "1e-15", "--plot", "a.svg"])
        .exits(0)
        .json();
    assert_eq!((&json["dependable"], &json["cheapest"]), (&5.into(), &5.into()));
    let levels = list(&json, "levels");
    let value = |k: usize| number(&levels[k]["values"][0]);
    for (k, level) in levels.iter().enumerate() {
        assert_eq!(number(&level["difference"]), (value(k) - value(4)).abs());
        assert_eq!(level["agrees"], k == 4);
        assert!(number(&level["price_s_per_s"]) > 0.0);
    }
    // The command that explains it is one that works.
    let hint = json["attribute"].as_str().unwrap();
    let arguments: Vec<&str> = hint
        .split(' ')
        .skip(1)
        .map(|word| word.trim_matches('\''))
        .collect();
    folder.run(&arguments).exits(0);
    assert!(fs::read_to_string(folder.path("a.svg")).unwrap().contains("<svg"));
    // With everything allowed everything agrees; what is cheapest is the clock's to say.
    let json = select(&folder, &["--relative", "1e9"]).exits(0).json();
    assert!(list(&json, "levels").iter().all(|level| level["agrees"] == true));
    assert_eq!(json["dependable"], json["cheapest"]);
}

#[test]
fn exact_every_case_is_asked() {
    let folder = Folder::new("cases");
    let cases = "quadrotor.alpha.parameters.airframe.mass_kg=1.4,1.5";
    let ran = select(&folder, &["--tolerance", "1e-15", "--set", cases, "--why"]);
    let json = ran.exits(0).json();
    let masses: Vec<f64> = list(&json, "cases")
        .iter()
        .map(|case| number(&case["settings"]["quadrotor.alpha.parameters.airframe.mass_kg"]))
        .collect();
    assert_eq!(masses, [1.4, 1.5]);
    assert_eq!(list(&json["levels"][0], "values").len(), 2);
    let pair = &json["why"]["pairs"][0];
    assert_eq!((&pair["from"], &pair["to"]), (&4.into(), &5.into()));
    let text = folder
        .run(&[
            "select-level",
            &ready("hover"),
            "--metric",
            METRIC,
            "--tolerance",
            "1",
            "--repeats",
            "1",
            "--set",
            "duration_s=0.1",
        ])
        .exits(0)
        .text();
    assert!(text.contains("cheapest level that agrees"), "{text}");
}

/// What lies between neighbours adds up to what lies between the first and the last.
#[test]
fn agree_attributed_differences_are_those_of_the_levels() {
    let folder = Folder::new("attribute");
    let levels = select(&folder, &["--tolerance", "1"]).exits(0).json();
    let value = |k: usize| number(&levels["levels"][k]["values"][0]);
    let step = ready("horizontal-step");
    let given = ["attribute", &step, "--metric", METRIC, "--set", SHORT, "--json"];
    let json = folder
        .run(&[&given[..], &["--plot", "a.svg"]].concat())
        .exits(0)
        .json();
    let pairs = list(&json, "pairs");
    assert_eq!(pairs.len(), 4);
    for (k, pair) in pairs.iter().enumerate() {
        // Sums of at most eight numbers of some metres.
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-13, "{a} and {b} in {pair}");
        near(number(&pair["difference"]), value(k + 1) - value(k));
        let shares = list(pair, "shares").iter().map(|share| number(&share["shapley"]));
        near(shares.sum::<f64>(), number(&pair["top"]) - number(&pair["base"]));
    }
    // One part alone: all three answers are the same.
    let lag = &pairs[1]["shares"][0];
    assert_eq!(lag["phenomenon"], "rotor lag");
    assert_eq!(lag["from_below"], lag["from_above"]);
    // From level 3 on the controller is c3.
    assert!(pairs[0]["controllers"].is_object() && pairs[2]["controllers"].is_null());
    assert!(
        fs::read_to_string(folder.path("a.svg"))
            .unwrap()
            .contains("rotor lag")
    );
}

#[test]
fn exact_questions_without_an_answer_are_refused() {
    let folder = Folder::new("no-answer");
    let hover = ready("hover");
    let ask = |arguments: &[&str]| folder.run(&[&["select-level", &hover], arguments].concat());
    ask(&["--metric", METRIC]).exits(2).says(&["--tolerance"]);
    ask(&["--metric", METRIC, "--tolerance", "-1"]).exits(2);
    ask(&["--metric", METRIC, "--tolerance=-1"])
        .exits(2)
        .says(&["not negative"]);
    ask(&["--metric", METRIC, "--tolerance", "nan"])
        .exits(2)
        .says(&["finite"]);
    ask(&["--metric", "speed", "--tolerance", "1", "--set", "duration_s=0.1"])
        .exits(2)
        .says(&["--metric", "`speed`", "alpha.position_error_rms_m"]);
    ask(&["--metric", METRIC, "--tolerance", "1", "--plot", "a.gif"])
        .exits(2)
        .says(&[".svg or .png"]);
    // Level 5 falls: there is nothing to agree with, nothing to explain.
    let falls = "quadrotor.alpha.command_offsets=[{ from_s = 0, duty = [-1, -1, -1, -1] }]";
    let given = ["--metric", METRIC, "--set", falls];
    ask(&[&given[..], &["--tolerance", "1", "--repeats", "1"]].concat())
        .exits(1)
        .says(&["level 5 has no position_error_rms_m", "height"]);
    folder
        .run(&[&["attribute", &hover, "--from", "4"], &given[..]].concat())
        .exits(1);
    let attribute = |arguments: &[&str]| {
        let given = ["attribute", &hover, "--metric", METRIC];
        folder.run(&[&given[..], arguments].concat())
    };
    attribute(&["--from", "3", "--to", "2"])
        .exits(2)
        .says(&["above --from 3, got 2"]);
    attribute(&["--from", "6"]).exits(2);
    attribute(&["--to", "3"]).exits(2);
}
