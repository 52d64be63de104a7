//! What is refused, with which exit code, and how it is said.

use crate::support::{Folder, ready};
use quad_dynamics::vehicle::builtin::CRAZYFLIE_TOML;
use std::fs;

#[test]
fn exact_bad_scenarios_exit_with_2() {
    let folder = Folder::new("bad");
    folder
        .run(&["run", "missing.toml"])
        .exits(2)
        .says(&["missing.toml", "cannot be read"]);
    folder.write("typo.toml", "name = \"x\"\nduration = 1");
    folder.run(&["run", "typo.toml"]).exits(2).says(&[
        "typo.toml:2:1",
        "unknown key `duration`",
        "duration_s",
    ]);
    let set = |setting: &str| folder.run(&["run", "-q", "--no-output", &ready("hover"), "--set", setting]);
    set("duration_s=-1")
        .exits(2)
        .says(&["`duration_s` = -1", "must be positive"]);
    set("quadrotor.bravo.level=5")
        .exits(2)
        .says(&["no `bravo`", "alpha"]);
    set("quadrotor.alpha.levle=5").exits(2).says(&["levle", "level"]);
    set("quadrotor.alpha.vehicle=my-drone.toml")
        .exits(2)
        .says(&["my-drone.toml", "crazyflie"]);
    set("quadrotor.alpha.step_s=0.00033333333333")
        .exits(2)
        .says(&["nanoseconds"]);
    set("duration_s=1e300").exits(2).says(&["`duration_s` = 1e300"]);
    set("stop.outside={from_m=[1,-5,-5],to_m=[-1,5,0]}")
        .exits(2)
        .says(&["stop.outside: `from_m[0]` must be less than `to_m[0]`, got 1 and -1"]);
    set("level").exits(2).says(&["key=value"]);
    // A slow agent is reported, and flown.
    set("quadrotor.alpha.step_s=20")
        .exits(0)
        .says(&["note: \"alpha\" decides once and never moves"]);
    folder.run(&["fly"]).exits(2);
    // Machines get it as JSON.
    let ran = folder.run(&["run", "--json", "missing.toml"]).exits(2);
    assert_eq!(ran.json()["exit_code"], 2);
}

/// A vehicle of your own is one file beside the scenario.
#[test]
fn exact_an_own_drone_is_a_file() {
    let folder = Folder::new("own");
    let mine = CRAZYFLIE_TOML.replace("value = 0.027", "value = 0.035");
    folder.write("my-drone.toml", mine);
    let scenario = fs::read_to_string(ready("crazyflie")).unwrap();
    let scenario = scenario.replace("vehicle = \"crazyflie\"", "vehicle = \"my-drone.toml\"");
    let scenario: String = scenario
        .lines()
        .filter(|line| !line.starts_with("parameters"))
        .map(|line| format!("{line}\n"))
        .collect();
    folder.write("mine.toml", scenario);
    folder.run(&["run", "-q", "mine.toml"]).exits(0);
    let broken = fs::read_to_string(folder.path("my-drone.toml"))
        .unwrap()
        .replace("value = 0.035", "value = -0.035");
    folder.write("my-drone.toml", broken);
    folder
        .run(&["run", "-q", "mine.toml"])
        .exits(2)
        .says(&["my-drone.toml", "mass", "-0.035"]);
}

#[test]
fn exact_outputs_that_cannot_be_written_exit_with_3() {
    let folder = Folder::new("write");
    let out = |path: &str| folder.run(&["run", "-q", &ready("hover"), "--out", path]);
    out("no/such/folder/a.csv")
        .exits(3)
        .says(&["no/such/folder/a.csv", "cannot be written"]);
    folder
        .run(&["new", "no/such/folder/a.toml"])
        .exits(3)
        .says(&["cannot be written"]);
}

/// An input is never written over, and what to write is never guessed.
#[test]
fn exact_outputs_that_are_inputs_or_no_recordings_exit_with_2() {
    let folder = Folder::new("inputs");
    let hover = fs::read_to_string(ready("hover")).unwrap();
    let own = hover.replace("path = \"hover.csv\"", "path = \"own.toml\"\nformat = \"csv\"");
    folder.write("own.toml", &own);
    folder.write("drone.toml", CRAZYFLIE_TOML);
    folder
        .run(&["run", "-q", "own.toml"])
        .exits(2)
        .says(&["own.toml is an input and would be overwritten"]);
    let vehicle = "quadrotor.alpha.vehicle=\"drone.toml\"";
    let outputs: [&[&str]; 2] = [
        &["--set", "output.path=\"./drone.toml\""],
        &["--no-output", "--save", "drone.toml"],
    ];
    for output in outputs {
        let arguments = ["run", "-q", "own.toml", "--set", vehicle];
        folder
            .run(&[&arguments[..], output].concat())
            .exits(2)
            .says(&["drone.toml", "would be overwritten"]);
    }
    assert_eq!(fs::read_to_string(folder.path("own.toml")).unwrap(), own);
    assert_eq!(
        fs::read_to_string(folder.path("drone.toml")).unwrap(),
        CRAZYFLIE_TOML
    );
    folder
        .run(&["run", "-q", "own.toml", "--out", "flight.json"])
        .exits(2)
        .says(&["flight.json", ".csv, .parquet or .jsonl"]);
    // Without an ending it is CSV.
    folder.run(&["run", "-q", "own.toml", "--out", "flight"]).exits(0);
    folder.run(&["plot", "flight"]).exits(0);
}

/// Nobody listens: no panic, and the exit code of the flight.
#[test]
fn exact_closed_streams_are_no_panics() {
    let folder = Folder::new("closed");
    let low = ready("hover");
    for (arguments, code) in [
        (
            &[
                "run",
                "-q",
                &low,
                "--no-output",
                "--set",
                "stop.ground_height_m=5",
            ][..],
            1,
        ),
        (&["run", "missing.toml"], 2),
        (&["completions", "bash"], 0),
    ] {
        let mut command = folder.command(arguments);
        let closed = || {
            let (reader, writer) = std::io::pipe().expect("a pipe");
            drop(reader);
            writer
        };
        let status = command.stdout(closed()).stderr(closed()).status();
        assert_eq!(
            status.expect("the program starts").code(),
            Some(code),
            "{arguments:?}"
        );
    }
}

/// `/dev/full` is a disk that is always full.
#[cfg(target_os = "linux")]
#[test]
fn exact_a_full_disk_exits_with_3() {
    let folder = Folder::new("full");
    for form in ["csv", "jsonl", "parquet"] {
        let set = format!("output.format={form}");
        let ran = folder.run(&[
            "run",
            "-q",
            &ready("hover"),
            "--set",
            "output.path=/dev/full",
            "--set",
            &set,
        ]);
        ran.exits(3).says(&["No space left on device"]);
    }
}

#[test]
fn exact_damaged_recordings_are_drawn_as_far_as_they_are_whole() {
    let folder = Folder::new("damaged");
    folder
        .run(&[
            "run",
            "-q",
            &ready("hover"),
            "-o",
            "a.csv",
            "--set",
            "duration_s=1",
        ])
        .exits(0);
    let whole = fs::read(folder.path("a.csv")).unwrap();
    folder.write("cut.csv", &whole[..whole.len() - 30]);
    let ran = folder
        .run(&["plot", "--json", "cut.csv"])
        .exits(0)
        .says(&["cut off", "50 rows"]);
    assert_eq!(ran.json()["rows"], 50);
    folder.write("not.csv", "a,b\n1,2\n");
    folder
        .run(&["plot", "not.csv"])
        .exits(2)
        .says(&["not.csv", "not a recording"]);
    folder.write("not.parquet", &whole);
    folder
        .run(&["plot", "not.parquet"])
        .exits(2)
        .says(&["not.parquet", "not a recording"]);
}
