//! Ctrl-C: what was recorded stays readable, and the exit code reports it.
#![cfg(unix)]

use crate::saved::rows;
use crate::support::{Folder, Ran, ready};
use quad_dynamics::vehicle::builtin::QBALL_X4_TOML;
use sifre::Recording;
use std::fs::{self, File};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// What ends a test that hangs, polls of 10 ms.
const PATIENCE: u32 = 3000;

/// Waits until a file has some bytes.
fn wait_for(path: &Path, bytes: u64) {
    for _ in 0..PATIENCE {
        if fs::metadata(path).is_ok_and(|file| file.len() >= bytes) {
            return;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    panic!("{} does not grow", path.display());
}

/// Sends Ctrl-C, and waits for the end.
fn interrupt(child: Child) -> Ran {
    let signal = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(signal.expect("kill is there").success());
    Ran(child.wait_with_output().expect("it ends"))
}

fn start(folder: &Folder, arguments: &[&str]) -> Child {
    let mut command = folder.command(arguments);
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command.spawn().expect("the program starts")
}

#[test]
fn exact_an_interrupted_flight_is_readable() {
    let folder = Folder::new("interrupted");
    for (form, grows) in [("csv", 20_000), ("jsonl", 20_000), ("parquet", 4)] {
        let (out, path) = (format!("a.{form}"), folder.path(&format!("a.{form}")));
        let child = start(
            &folder,
            &[
                "run",
                "-q",
                &ready("hover"),
                "-o",
                &out,
                "--set",
                "duration_s=100000",
                "--set",
                "output.step_s=0.01",
            ],
        );
        wait_for(&path, grows);
        interrupt(child).exits(130).says(&["interrupted"]);
        let file = File::open(&path).unwrap();
        let recording = match form {
            "csv" => Recording::from_csv(file),
            "jsonl" => Recording::from_json_lines(file),
            _ => Recording::from_parquet(file),
        };
        let recording = recording.unwrap();
        assert!(!recording.is_empty());
        // Whole from the start on, nothing left out.
        assert!(
            (0..)
                .zip(recording.times_ns())
                .all(|(k, ns)| *ns == k * 10_000_000)
        );
    }
}

/// A flight interrupted anywhere continues to the same bytes.
#[test]
fn exact_an_interrupted_flight_goes_on() {
    let folder = Folder::new("interrupted-saved");
    let (scenario, end) = (ready("gust"), "duration_s=100000");
    let arguments = ["run", "-q", &scenario, "-o", "first.csv", "--save", "flight.json"];
    let child = start(&folder, &[&arguments[..], &["--set", end]].concat());
    wait_for(&folder.path("first.csv"), 20_000);
    interrupt(child).exits(130).says(&["interrupted"]);
    let read = |name: &str| fs::read_to_string(folder.path(name)).unwrap();
    let saved: serde_json::Value = serde_json::from_str(&read("flight.json")).unwrap();
    let now_s = saved["flight"]["time_ns"].as_u64().unwrap() as f64 * 1e-9;
    let end = format!("duration_s={}", now_s.ceil() + 1.0);
    let fly = |more: &[&str]| {
        let arguments = ["run", "-q", &scenario, "--set", &end];
        folder.run(&[&arguments[..], more].concat()).exits(0);
    };
    fly(&["-o", "second.csv", "--resume", "flight.json"]);
    fly(&["-o", "whole.csv"]);
    let (first, second) = (read("first.csv"), read("second.csv"));
    assert!(format!("{first}{}", rows(&second)) == read("whole.csv"));
}

/// An interrupted sweep resumes where it stopped, and its table is that of one that was not interrupted.
#[test]
fn exact_an_interrupted_sweep_goes_on() {
    let folder = Folder::new("resumed");
    let scenario = ready("hover");
    let arguments = |out: &'static str| {
        [
            "sweep",
            &scenario,
            "--range",
            "quadrotor.alpha.reference.position_m.2=-3:-1:5",
            "--runs",
            "8",
            "--normal",
            "quadrotor.alpha.parameters.airframe.mass_kg=1.4:0.02",
            "--seed",
            "3",
            "--out",
            out,
        ]
        .map(str::to_owned)
    };
    let run = |out| {
        let arguments = arguments(out);
        folder.run(&arguments.each_ref().map(String::as_str))
    };
    run("whole.csv").exits(0);
    let pieces = arguments("pieces.csv");
    let child = start(&folder, &pieces.each_ref().map(String::as_str));
    // The heading is some thousand bytes long, a row some two hundred.
    wait_for(&folder.path("pieces.csv.journal"), 500);
    let ran = interrupt(child);
    // On a fast machine it may be done by now; the table must be the same all the same.
    if ran.0.status.code() != Some(0) {
        let ran = ran.exits(130).says(&["runs left"]);
        assert!(!folder.path("pieces.csv").exists());
        drop(ran);
        run("pieces.csv").exits(0);
    }
    let read = |name: &str| fs::read_to_string(folder.path(name)).unwrap();
    assert_eq!(read("pieces.csv"), read("whole.csv"));
    assert!(!folder.path("pieces.csv.journal").exists());
}

/// Ctrl-C keeps what was flown, and the search resumes from it.
#[test]
fn exact_an_interrupted_optimisation_goes_on() {
    let folder = Folder::new("interrupted-search");
    let scenario = ready("optimise-transmission");
    let given = ["optimise", &scenario, "--json", "--set", "duration_s=1", "--set"];
    let long = ["optimise.budget=1000000", "--set", "optimise.algorithm=annealing"];
    let child = start(&folder, &[&given[..], &long].concat());
    wait_for(&folder.path("optimum/state.json"), 500);
    interrupt(child).exits(130).says(&["--resume"]);
    let flown = || {
        let text = fs::read_to_string(folder.path("optimum/state.json")).unwrap();
        let state: serde_json::Value = serde_json::from_str(&text).unwrap();
        state["courses"][0]["rows"].as_array().unwrap().len()
    };
    let before = flown();
    assert!(before > 0);
    let budget = format!("optimise.budget={}", before + 3);
    let short = [
        budget.as_str(),
        "--set",
        "optimise.algorithm=annealing",
        "--resume",
    ];
    folder.run(&[&given[..], &short].concat()).exits(0);
    assert_eq!(flown(), before + 3);
}

/// A vehicle file that changed in between is another problem, though the scenario is the same.
#[test]
fn exact_a_search_does_not_go_on_with_another_vehicle() {
    let folder = Folder::new("another-vehicle");
    fs::copy(ready("optimise-transmission"), folder.path("mine.toml")).unwrap();
    let vehicle = QBALL_X4_TOML;
    fs::write(folder.path("drone.toml"), vehicle).unwrap();
    let search = |last: &[&str]| {
        let given = [
            "optimise",
            "mine.toml",
            "--set",
            "quadrotor.alpha.vehicle=drone.toml",
            "--set",
            "duration_s=0.2",
            "--set",
            "optimise.budget=4",
        ];
        folder.run(&[&given[..], last].concat())
    };
    search(&[]).exits(0);
    search(&["--resume"]).exits(0);
    let heavier = vehicle.replacen("mass_kg = { value = 1.4", "mass_kg = { value = 1.5", 1);
    assert_ne!(heavier, vehicle);
    fs::write(folder.path("drone.toml"), heavier).unwrap();
    search(&["--resume"])
        .exits(2)
        .says(&["another scenario or vehicle"]);
}
