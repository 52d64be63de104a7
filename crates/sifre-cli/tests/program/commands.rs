//! Each command does what it says.

use crate::support::{Folder, ready};
use sifre::Recording;
use std::fs::{self, File};

#[test]
fn exact_run_records_in_every_form() {
    let folder = Folder::new("run");
    let read = |name: &str| {
        folder
            .run(&[
                "run",
                "--quiet",
                &ready("hover"),
                "--out",
                name,
                "--set",
                "duration_s=0.1",
            ])
            .exits(0);
        let file = File::open(folder.path(name)).unwrap();
        match name {
            "a.csv" => Recording::from_csv(file),
            "a.jsonl" => Recording::from_json_lines(file),
            _ => Recording::from_parquet(file),
        }
        .unwrap()
    };
    let csv = read("a.csv");
    // Every 20 ms from 0 to 0.1 s.
    assert_eq!(csv.len(), 6);
    assert_eq!(csv, read("a.jsonl"));
    assert_eq!(csv, read("a.parquet"));
}

#[test]
fn exact_run_speaks_json_and_obeys_its_options() {
    let folder = Folder::new("json");
    let ran = folder.run(&[
        "run",
        "--json",
        &ready("gust"),
        "--no-output",
        "--set",
        "quadrotor.alpha.level=3",
    ]);
    let json = ran.exits(0).says(&["is not affected by it"]).json();
    assert_eq!(
        (json["exit_code"].as_u64(), json["time_s"].as_f64()),
        (Some(0), Some(12.0))
    );
    // Level 3 has no drag: the gust is not felt, and that is said.
    assert!(json["metrics"]["alpha.position_error_max_m"].as_f64().unwrap() < 1e-9);
    assert_eq!(json["notes"].as_array().unwrap().len(), 1);
    assert_eq!(
        fs::read_dir(folder.path(".")).unwrap().count(),
        0,
        "nothing was recorded"
    );
}

#[test]
fn exact_channels_are_selected() {
    let folder = Folder::new("channels");
    let select = |channels: &str| {
        let channels = format!("output.channels={channels}");
        folder.run(&[
            "run",
            "-q",
            &ready("hover"),
            "-o",
            "a.csv",
            "--set",
            "duration_s=0.1",
            "--set",
            &channels,
        ])
    };
    select("[\"*.position.z\"]").exits(0);
    let recording = Recording::from_csv(File::open(folder.path("a.csv")).unwrap()).unwrap();
    let names: Vec<_> = recording
        .channels()
        .iter()
        .map(|channel| channel.name.as_str())
        .collect();
    assert_eq!(names, ["alpha.position.z", "alpha.reference.position.z"]);
    fs::remove_file(folder.path("a.csv")).unwrap();
    select("[\"bravo.*\"]")
        .exits(2)
        .says(&["bravo.*", "alpha.position.x"]);
    assert!(
        !folder.path("a.csv").exists(),
        "no file for a recording of nothing"
    );
}

#[test]
fn exact_a_crash_ends_early_and_is_recorded() {
    let folder = Folder::new("crash");
    let ran = folder.run(&[
        "run",
        "-q",
        &ready("hover"),
        "-o",
        "a.csv",
        "--set",
        "quadrotor.alpha.command_offsets=[{ from_s = 0.5, duty = [-1, -1, -1, -1] }]",
    ]);
    let text = ran.exits(1).says(&["\"alpha\" is at a height of -"]).text();
    assert!(text.contains("recorded in a.csv"), "{text}");
    let recording = Recording::from_csv(File::open(folder.path("a.csv")).unwrap()).unwrap();
    let lowest = recording
        .column("alpha.position.z")
        .unwrap()
        .fold(f64::MIN, f64::max);
    // A millisecond at some six metres per second below the ground at most.
    assert!((1.8..2.5).contains(&(lowest + 2.0)), "{lowest}");
}

#[test]
fn exact_a_new_scenario_flies_as_it_is() {
    let folder = Folder::new("new");
    folder.run(&["new", "mine.toml"]).exits(0);
    // The first flight shows all that there is: its station keeps the laser on the receiver.
    let flight = folder.run(&["run", "--json", "mine.toml"]).exits(0).json();
    let energy = |key: &str| flight["metrics"][key].as_f64().unwrap();
    assert!(energy("station.received_energy_j") > 100.0 * energy("station.missed_energy_j"));
    folder
        .run(&["new", "mine.toml"])
        .exits(2)
        .says(&["mine.toml", "--force"]);
    folder
        .run(&["new", "mine.toml", "--force", "--from", "template"])
        .exits(0);
    folder.run(&["run", "-q", "mine.toml"]).exits(0);
    let hover = folder.run(&["new", "--from", "hover"]).exits(0).text();
    assert!(hover.contains("name = \"hover\""));
    folder
        .run(&["new", "--from", "nothing"])
        .exits(2)
        .says(&["template", "hover"]);
}

/// Every key that is explained behind a `#` in the template is one that there is, with a value that it may have.
#[test]
fn agree_the_template_explains_keys_that_exist() {
    let folder = Folder::new("template");
    let text = folder.run(&["new"]).exits(0).text();
    let is_key = |line: &str| {
        line.split_once(" = ")
            .is_some_and(|(key, _)| key.chars().all(|c| c.is_ascii_lowercase() || c == '_'))
    };
    // The text at the top is prose.
    let (head, text) = text.split_at(text.find("name = ").unwrap());
    let mut found = 0;
    let uncommented: Vec<String> = text
        .lines()
        .map(|line| match line.strip_prefix("# ") {
            Some(rest) if is_key(rest) && !rest.starts_with("kind") && !rest.starts_with("path = {") => {
                found += 1;
                rest.to_owned()
            }
            _ => line.to_owned(),
        })
        .collect();
    assert!(found > 25, "{found}");
    folder.write("all.toml", format!("{head}{}", uncommented.join("\n")));
    // Level 4 from 5 s on has the drag that the gusts are felt through: it flies to the end.
    folder
        .run(&["run", "-q", "all.toml", "--set", "stop.arrived_within_m=1e-9"])
        .exits(0);
}

#[test]
fn exact_the_schema_is_one() {
    let schema = Folder::new("schema").run(&["schema"]).exits(0).json();
    assert_eq!(schema["title"], "sifre scenario");
    assert!(schema["properties"]["quadrotor"].is_object());
    assert!(schema["properties"]["optimise"].is_object());
}

#[test]
fn exact_the_doctor_finds_all_well() {
    let folder = Folder::new("doctor");
    let json = folder.run(&["doctor", "--json"]).exits(0).json();
    assert_eq!(json["sound"], true);
    let text = folder.run(&["doctor"]).exits(0).text();
    assert!(text.contains("all checks passed"), "{text}");
}

/// Level 5 differs from itself by nothing, and from the linear one by more than from level 4.
#[test]
fn prop_levels_are_compared() {
    let folder = Folder::new("levels");
    let json = folder
        .run(&[
            "levels",
            "--json",
            &ready("horizontal-step"),
            "--plot",
            "levels.svg",
            "--set",
            "duration_s=4",
        ])
        .exits(0)
        .json();
    let rows = json["rows"].as_array().unwrap();
    let of = |level: usize, what: &str| rows[level - 1][what].as_f64().unwrap();
    assert_eq!(rows.len(), 5);
    assert_eq!((of(5, "position_max_m"), of(5, "attitude_max_deg")), (0.0, 0.0));
    assert!(of(1, "position_rms_m") > 0.0 && of(4, "attitude_rms_deg") > 0.0);
    assert_eq!(rows[0]["law"], "c1");
    assert_eq!(rows[4]["law"], "c3");
    assert!(
        fs::read_to_string(folder.path("levels.svg"))
            .unwrap()
            .contains("<svg")
    );
    // A given controller stays where it may fly.
    let kept = folder
        .run(&[
            "levels",
            "--json",
            "--keep-controllers",
            &ready("horizontal-step"),
            "--set",
            "duration_s=0.1",
            "--set",
            "quadrotor.alpha.controller.kind=c2",
        ])
        .exits(0)
        .json();
    let laws: Vec<_> = kept["rows"]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| row["law"].clone())
        .collect();
    assert_eq!(laws, ["c1", "c2", "c2", "c2", "c2"]);
    let text = folder
        .run(&["levels", &ready("hover"), "--set", "duration_s=0.1"])
        .exits(0)
        .text();
    assert!(text.contains("position rms, m"), "{text}");
}

#[test]
fn exact_recordings_are_drawn() {
    let folder = Folder::new("plot");
    folder
        .run(&[
            "run",
            "-q",
            &ready("power-transmission-10s"),
            "-o",
            "a.csv",
            "--set",
            "duration_s=1",
        ])
        .exits(0);
    folder.run(&["plot", "a.csv"]).exits(0);
    let svg = fs::read_to_string(folder.path("a.svg")).unwrap();
    assert!(svg.contains("alpha") && svg.contains("station"));
    folder
        .run(&["plot", "a.csv", "--out", "a.png", "--agent", "alpha"])
        .exits(0);
    assert!(fs::read(folder.path("a.png")).unwrap().starts_with(b"\x89PNG"));
    folder
        .run(&["plot", "a.csv", "--agent", "bravo"])
        .exits(2)
        .says(&["bravo", "alpha, station"]);
    folder
        .run(&["plot", "a.csv", "--out", "a.gif"])
        .exits(2)
        .says(&[".svg or .png"]);
}

#[test]
fn exact_flights_become_pages() {
    let folder = Folder::new("animate");
    let scenario = ready("power-transmission-10s");
    folder.run(&["animate", &scenario, "-o", "flown.html"]).exits(0);
    folder
        .run(&["run", "-q", &scenario, "-o", "a.csv", "--set", "duration_s=1"])
        .exits(0);
    folder
        .run(&["animate", "a.csv", "--scenario", &scenario])
        .exits(0);
    // Without a name for it, where one works: not beside the ready scenario.
    // With the feature `mcap` a file for other viewers, without it a word about how to get one.
    let ran = folder.run(&["animate", &scenario, "-o", "flown.mcap"]);
    if cfg!(feature = "mcap") {
        ran.exits(0);
        assert!(
            fs::read(folder.path("flown.mcap"))
                .unwrap()
                .starts_with(b"\x89MCAP")
        );
    } else {
        ran.exits(2).says(&["--features mcap"]);
    }
    folder.run(&["animate", &scenario]).exits(0);
    for page in ["flown.html", "a.html", "power-transmission-10s.html"] {
        let text = fs::read_to_string(folder.path(page)).unwrap();
        assert!(text.contains("power transmission, 10 s") && text.contains("station"));
    }
    folder
        .run(&["animate", "missing.csv"])
        .exits(2)
        .says(&["missing.csv"]);
}

#[test]
fn exact_shells_are_served() {
    let folder = Folder::new("shells");
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        assert!(
            folder
                .run(&["completions", shell])
                .exits(0)
                .text()
                .contains("sifre")
        );
    }
    let help = folder.run(&["--help"]).exits(0).text();
    for code in ["0 ", "1 ", "2 ", "3 ", "130 "] {
        assert!(help.contains(&format!("\n  {code}")), "{help}");
    }
}
