//! Flights saved and resumed.

use crate::support::{Folder, ready};
use quad_dynamics::vehicle::builtin::CRAZYFLIE_TOML;
use std::fs;

/// A CSV recording without its two lines of head: units and names.
pub(crate) fn rows(csv: &str) -> &str {
    let after = |text| str::split_once(text, '\n').map_or("", |(_, rest)| rest);
    after(after(csv))
}

/// Two parts recorded one after the other are, byte for byte, the recording of the whole flight: with an estimator in the loop, with gusts,
/// with stations that track, and with steps that don't divide the instant of saving.
#[test]
fn exact_two_parts_are_the_whole() {
    for name in [
        "estimator-in-the-loop",
        "gust",
        "two-quadrotors",
        "level-change",
        "wrong-start",
    ] {
        let folder = Folder::new(&format!("saved-{name}"));
        let scenario = ready(name);
        let fly = |end_s: &str, more: &[&str]| {
            let end = format!("duration_s={end_s}");
            let mut arguments = vec!["run", "-q", &scenario, "--set", &end];
            arguments.extend(more);
            folder.run(&arguments)
        };
        fly("2.5", &["-o", "whole.csv"]).exits(0);
        let first = fly("1.2345", &["-o", "first.csv", "--save", "flight.json"]).exits(0);
        assert!(first.text().contains("saved in flight.json"), "{name}");
        fly("2.5", &["-o", "second.csv", "--resume", "flight.json"]).exits(0);
        let read = |name: &str| fs::read_to_string(folder.path(name)).unwrap();
        let (first, second) = (read("first.csv"), read("second.csv"));
        let rows = rows(&second);
        assert!(rows.lines().count() > 10, "{name}");
        assert!(format!("{first}{rows}") == read("whole.csv"), "{name}");
    }
}

#[test]
fn exact_what_can_not_go_on_is_told() {
    let folder = Folder::new("saved-badly");
    let hover = ready("hover");
    folder
        .run(&["run", "-q", &hover, "-o", "a.csv", "--save", "flight.json"])
        .exits(0);
    let on = |more: &[&str]| {
        let mut arguments = vec!["run", "-q", &hover, "--resume"];
        arguments.extend(more);
        folder.run(&arguments)
    };
    on(&["flight.json", "--no-output"])
        .exits(2)
        .says(&["flight.json", "set a later `duration_s`"]);
    let later = ["--set", "duration_s=100"];
    on(&[&["flight.json", "-o", "a.csv"], &later[..]].concat())
        .exits(2)
        .says(&["a.csv: already exists", "--out"]);
    on(&[&["a.csv", "--no-output"], &later[..]].concat())
        .exits(2)
        .says(&["a.csv: not a saved flight"]);
    on(&[&["nowhere.json", "--no-output"], &later[..]].concat())
        .exits(2)
        .says(&["nowhere.json: cannot be read"]);
    let other = ready("two-quadrotors");
    folder
        .run(&["run", "-q", &other, "--no-output", "--resume", "flight.json"])
        .exits(2)
        .says(&["can't be resumed in this scenario"]);
    // Before the flight, not after it.
    folder
        .run(&["run", "-q", &hover, "-o", "b.csv", "--save", "no/folder.json"])
        .exits(3)
        .says(&["no/folder.json: cannot be written"]);
    assert!(!folder.path("b.csv").exists());
}

/// Agents resume from their saved states; a level that the scenario gives for the start is reported as ignored.
#[test]
fn exact_a_level_of_the_start_is_reported() {
    let folder = Folder::new("saved-level");
    let hover = ready("hover");
    let fly = |more: &[&str]| folder.run(&[&["run", "-q", &hover], more].concat()).exits(0);
    fly(&[
        "-o",
        "a.csv",
        "--save",
        "a.json",
        "--set",
        "quadrotor.alpha.level=3",
    ]);
    let on = ["-o", "b.csv", "--resume", "a.json", "--set", "duration_s=11"];
    fly(&on).says(&["\"alpha\" resumes at level 3, its saved level; `level = 5` applies to the start only"]);
}

/// Another vehicle, other agents, a changed number, another format: nothing is flown.
#[test]
fn exact_what_the_flight_was_not_saved_from_is_refused() {
    let folder = Folder::new("saved-tampered");
    folder.write("drone.toml", CRAZYFLIE_TOML);
    let hover = ready("hover");
    folder.write("s.toml", fs::read_to_string(&hover).unwrap());
    let vehicle = "quadrotor.alpha.vehicle=\"drone.toml\"";
    let fly = |more: &[&str]| {
        let common = ["run", "-q", "s.toml", "--no-output", "--set", vehicle, "--set"];
        folder.run(&[&common[..], more].concat())
    };
    fly(&["duration_s=0.5", "--save", "flight.json"]).exits(0);
    let on = |more: &[&str]| fly(&[&["duration_s=1", "--resume", "flight.json"], more].concat());
    on(&[]).exits(0);
    on(&["--set", "quadrotor.alpha.reference.position_m=[1, 0, -2]"])
        .exits(2)
        .says(&["flight.json", "can't be resumed in this scenario", "its agents"]);
    folder.write("drone.toml", CRAZYFLIE_TOML.replace("0.027", "0.028"));
    on(&[]).exits(2).says(&["drone.toml has changed"]);
    folder.write("drone.toml", CRAZYFLIE_TOML);
    let whole = fs::read_to_string(folder.path("flight.json")).unwrap();
    let later = whole.replace("\"time_ns\":500000000", "\"time_ns\":600000000");
    assert_ne!(later, whole);
    folder.write("flight.json", later);
    on(&[]).exits(2).says(&["its check sum differs"]);
    folder.write("flight.json", whole.replace("flight\":1", "flight\":2"));
    on(&[]).exits(2).says(&["this version reads format 1"]);
}
