//! The built program, run as a user runs it: good data from the virtual laboratory, and every kind of bad data.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::{Command, Output};
use sysid::laboratory::generator;
use sysid::laboratory::pendulum::{Axis, PendulumRig};

/// A file of the test's own with this content.
fn file(name: &str, content: &[u8]) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, content).unwrap();
    path
}

/// A swing about the roll axis of the nominal vehicle, 0.03 kg m².
fn swing() -> String {
    let vehicle = quad_dynamics::Vehicle::qball_x4();
    let samples = PendulumRig::default()
        .swing(&vehicle, Axis::Roll, &mut generator(5))
        .unwrap();
    let mut text = "# bifilar pendulum, roll\ntime_s,angle_rad\n".to_owned();
    for s in samples {
        let _ = writeln!(text, "{},{}", s.time_s, s.angle_rad);
    }
    text
}

/// The pendulum's command on a file, with more arguments.
fn pendulum(data: &PathBuf, more: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_identify"))
        .arg("pendulum")
        .arg(data)
        .args([
            "--axis",
            "roll",
            "--mass-kg",
            "1.4",
            "--half-spacing-m",
            "0.2",
            "--length-m",
            "0.7",
        ])
        .args(more)
        .output()
        .unwrap()
}

fn error_of(name: &str, content: &[u8]) -> String {
    let output = pendulum(&file(name, content), &[]);
    let text = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{name}: {text}");
    assert!(
        output.stdout.is_empty(),
        "{name}: nothing is printed as if it were identified"
    );
    text
}

#[test]
fn exact_a_good_swing_is_identified_and_written() {
    let data = file("good.csv", swing().as_bytes());
    let nominal = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/vehicles/qball-x4.toml");
    let out = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("good.toml");
    let output = pendulum(
        &data,
        &["--json", "--vehicle", nominal, "--out", out.to_str().unwrap()],
    );
    assert_eq!(output.status.code(), Some(0));
    let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let number = &answer["numbers"][0];
    let (value, error) = (
        number["value"].as_f64().unwrap(),
        number["standard_error"].as_f64().unwrap(),
    );
    // Four standard errors: one seed in 16000 misses.
    assert!((value - 0.03).abs() < 4.0 * error, "{value} ± {error}");
    let text = std::fs::read_to_string(out).unwrap();
    let file = quad_dynamics::vehicle::file::VehicleFile::from_toml_str(&text, "out").unwrap();
    let inertia = file.airframe.inertia_xx_kg_m2;
    assert_eq!((inertia.value, inertia.standard_error), (value, Some(error)));
    assert!(inertia.source.starts_with("identified"));
}

#[test]
fn exact_bad_files_are_refused_with_the_line() {
    let good = swing();
    let lines: Vec<&str> = good.lines().collect();
    let with = |line: usize, text: &str| {
        let mut changed = lines.clone();
        changed[line - 1] = text;
        changed.join("\n").into_bytes()
    };
    for (name, content, words) in [
        ("column.csv", with(2, "time_s,angle_deg"), "angle_rad"),
        ("unit.csv", with(9, "0.12,40.1"), "line 9"),
        ("backwards.csv", with(9, "0.01,0.6"), "line 9"),
        ("nan.csv", with(9, "0.12,NaN"), "line 9"),
        ("empty.csv", Vec::new(), "empty"),
        (
            "kind.csv",
            vec![0x89, b'P', b'N', b'G', 0, 255],
            "no comma-separated table",
        ),
        (
            "constant.csv",
            b"time_s,angle_rad\n0,0.1\n0.02,0.1\n0.04,0.1\n0.06,0.1\n".to_vec(),
            "no oscillation",
        ),
    ] {
        let message = error_of(name, &content);
        assert!(message.contains(words), "{name}: {message}");
    }
}

#[test]
fn exact_a_gap_is_told_with_its_line() {
    let text: Vec<String> = swing().lines().map(str::to_owned).collect();
    let gap: Vec<String> = [&text[..100], &text[120..]].concat();
    let output = pendulum(&file("gap.csv", gap.join("\n").as_bytes()), &[]);
    assert_eq!(output.status.code(), Some(0));
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(
        message.contains("gaps in time") && message.contains("line 101"),
        "{message}"
    );
}

#[test]
fn exact_exit_codes_of_usage_and_missing_files() {
    let no_axis = Command::new(env!("CARGO_BIN_EXE_identify"))
        .arg("pendulum")
        .arg("x.csv")
        .output()
        .unwrap();
    assert_eq!(no_axis.status.code(), Some(2));
    let missing = pendulum(&PathBuf::from("no-such-file.csv"), &[]);
    assert_eq!(missing.status.code(), Some(1));
    assert!(
        String::from_utf8(missing.stderr)
            .unwrap()
            .contains("no-such-file.csv")
    );
}

#[test]
fn exact_a_load_cell_line_by_hand() {
    // Readings 1 V + 0.5 V/N times the load, one millivolt to either side by turns, which leaves the slope.
    let text = "load_n,reading_v\n0,1.001\n0,0.999\n2,2.001\n2,1.999\n4,3.001\n4,2.999\n";
    let output = Command::new(env!("CARGO_BIN_EXE_identify"))
        .arg("load-cell")
        .arg(file("loads.csv", text.as_bytes()))
        .args(["--capacity-n", "16", "--json"])
        .output()
        .unwrap();
    let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let number = |i: usize| answer["numbers"][i]["value"].as_f64().unwrap();
    // Rounding.
    assert!(
        (number(0) - 1.0).abs() < 1e-12 && (number(1) - 0.5).abs() < 1e-12,
        "{answer}"
    );
}

/// The example of a command's file goes through the command.
#[test]
fn agree_every_template_is_identified() {
    let nominal = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/vehicles/qball-x4.toml");
    let swing = [
        "--axis",
        "yaw",
        "--mass-kg",
        "1.4",
        "--half-spacing-m",
        "0.2",
        "--length-m",
        "0.7",
    ];
    let program = || Command::new(env!("CARGO_BIN_EXE_identify"));
    for (kind, more) in [
        ("centre-of-mass", &[][..]),
        ("pendulum", &swing[..]),
        ("load-cell", &["--capacity-n", "16"]),
        ("thrust-stand", &["--vehicle", nominal]),
        ("rotor-response", &[]),
    ] {
        let template = program().args(["template", kind]).output().unwrap();
        assert_eq!(template.status.code(), Some(0), "{kind}");
        let data = file(&format!("template-{kind}.csv"), &template.stdout);
        let output = program()
            .arg(kind)
            .arg(&data)
            .args(more)
            .arg("--json")
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{kind}: {said}");
        let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let numbers = answer["numbers"].as_array().unwrap();
        assert!(!numbers.is_empty(), "{kind}");
        for number in numbers {
            let error = number["standard_error"].as_f64().unwrap();
            assert!(error.is_finite() && error > 0.0, "{kind}: {number}");
        }
    }
}
