//! The built program, run as a user runs it: good data from the virtual laboratory, and every kind of bad data.

mod flight;
mod large;
mod outputs;
mod templates;

use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::{Command, Output};
use std::sync::Once;
use sysid::laboratory::generator;
use sysid::laboratory::pendulum::{Axis, PendulumRig};

/// A file of the test's own with this content.
fn file(name: &str, content: &[u8]) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, content).unwrap();
    path
}

/// The project's nominal vehicle.
const NOMINAL: &str = concat!(env!("CARGO_TARGET_TMPDIR"), "/nominal.toml");

/// The program with these arguments.
fn identify(arguments: &[&str]) -> Output {
    static WRITTEN: Once = Once::new();
    WRITTEN.call_once(|| {
        file(
            "nominal.toml",
            quad_dynamics::vehicle::builtin::QBALL_X4_TOML.as_bytes(),
        );
    });
    Command::new(env!("CARGO_BIN_EXE_identify"))
        .args(arguments)
        .output()
        .unwrap()
}

/// What it said on standard error.
fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A number of the answer in JSON, with its standard error.
fn number(output: &Output, key: &str) -> (f64, f64) {
    let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let numbers = answer["numbers"].as_array().unwrap();
    let found = numbers.iter().find(|n| n["key"] == key).unwrap();
    let of = |name: &str| found[name].as_f64().unwrap();
    (of("value"), of("standard_error"))
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
    let out = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("good.toml");
    let output = pendulum(
        &data,
        &["--json", "--vehicle", NOMINAL, "--out", out.to_str().unwrap()],
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
    let file = quad_dynamics::vehicle::VehicleFile::parse(&text, "out").unwrap();
    let inertia = &file.airframe.inertia.m11;
    assert_eq!((inertia.value, inertia.standard_error), (value, Some(error)));
    assert_eq!(inertia.source, "identified: identify pendulum good.csv");
    // All other lines of the user's file, comments too, are unchanged.
    let old = quad_dynamics::vehicle::builtin::QBALL_X4_TOML;
    let changed = old.lines().zip(text.lines()).filter(|(a, b)| a != b).count();
    assert_eq!((changed, text.lines().count()), (1, old.lines().count()));
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
        ("kind.csv", vec![0x89, b'P', b'N', b'G', 0, 255], "not a CSV file"),
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

/// What the reader noticed is said although the fit is refused, since it may be the reason.
#[test]
fn exact_remarks_of_the_reader_are_said_with_a_refusal() {
    let text = "load_n,reading_v\n".to_owned() + &"0,1\n1,1\n2,1\n".repeat(10);
    let data = file("stuck.csv", text.as_bytes());
    let output = identify(&["load-cell", data.to_str().unwrap(), "--capacity-n", "16"]);
    let message = said(&output);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        message.contains("warning:") && message.contains("\"reading_v\" is 1 V throughout"),
        "{message}"
    );
    assert!(message.contains("error: all 30 data points are 1"), "{message}");
}

/// A potentiometer that ends at ±0.5 rad, and an amplifier that ends at 2 V.
#[test]
fn exact_a_saturated_sensor_is_told() {
    let mut text = String::new();
    for line in swing().lines() {
        let cell = line
            .split_once(',')
            .and_then(|(t, x)| Some((t, x.parse::<f64>().ok()?)));
        let _ = match cell {
            Some((t, angle)) => writeln!(text, "{t},{}", angle.clamp(-0.3, 0.3)),
            None => writeln!(text, "{line}"),
        };
    }
    let message = said(&pendulum(&file("clipped.csv", text.as_bytes()), &[]));
    assert!(
        message.contains("column \"angle_rad\" stays at its extreme 0.3 rad"),
        "{message}"
    );
    let mut text = "load_n,reading_v\n".to_owned();
    for k in 0..40 {
        // Steps of 0.1 N at 0.5 V/N over 1 V, and a millivolt to either side by turns.
        let noise = if k % 2 == 0 { 1e-3 } else { -1e-3 };
        let load = 0.1 * f64::from(k / 2);
        let _ = writeln!(text, "{load},{}", (1.0 + 0.5 * load + noise).min(1.8));
    }
    let data = file("amplifier.csv", text.as_bytes());
    let output = identify(&["load-cell", data.to_str().unwrap(), "--capacity-n", "16"]);
    assert_eq!(output.status.code(), Some(0));
    let message = said(&output);
    assert!(
        message.contains("are at the end of the sensor's range (1.8)"),
        "{message}"
    );
}

/// The duty of a pseudo-random sequence holds its two values for long: no sensor at its end.
#[test]
fn exact_a_commanded_column_is_not_called_saturated() {
    let template = identify(&["template", "rotor-response"]);
    let data = file("prbs.csv", &template.stdout);
    let message = said(&identify(&["rotor-response", data.to_str().unwrap()]));
    assert!(!message.contains("stays at its extreme"), "{message}");
}

/// The slowest pole of the second-order transfer function, the vehicle file's definition: 14.4653 rad/s at hover. A fit of first
/// order would give 11.3.
#[test]
fn exact_the_bandwidth_is_the_slowest_pole() {
    let template = identify(&["template", "rotor-response"]);
    let data = file("response.csv", &template.stdout);
    let output = identify(&["rotor-response", data.to_str().unwrap(), "--json"]);
    let (bandwidth, error) = number(&output, "linear_rotor.bandwidth_rad_s");
    // Four standard errors (0.3): one seed in 16000 misses; 11.3 is ten away.
    assert!(
        (bandwidth - 14.4653).abs() < 4.0 * error && error < 0.5,
        "{bandwidth} ± {error}"
    );
}

#[test]
fn exact_exit_codes_of_usage_and_missing_files() {
    let refused = identify(&["load-cell", "x.csv", "--capacity-n", "1", "--capacity-n-m", "1"]);
    assert_eq!(refused.status.code(), Some(2));
    let refused = identify(&["rotor-response", "x.csv", "--plot", "picture.jpeg"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(said(&refused).contains(".svg or .png"));
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
