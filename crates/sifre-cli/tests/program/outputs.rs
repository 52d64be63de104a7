//! Outputs: never an input under any name, never two at one place, complete or as they were, and an exit code where they can't be written.

use crate::support::{Folder, ready};
use quad_dynamics::vehicle::builtin::CRAZYFLIE_TOML;
use std::fs;
use std::path::Path;

/// Ways in which an output's name leads to an input.
#[derive(Clone, Copy, Debug)]
enum Way {
    Same,
    Spelled,
    Hard,
    Soft,
    SoftToSoft,
}

const WAYS: [Way; 5] = [Way::Same, Way::Spelled, Way::Hard, Way::Soft, Way::SoftToSoft];

/// A name for an output with this ending that leads to the input of this name; nothing where the input's own ending is another.
fn leads_to(folder: &Folder, input: &str, ending: &str, way: Way) -> Option<String> {
    let link = folder.path(&format!("link.{ending}"));
    let between = folder.path("between");
    for old in [&link, &between] {
        let _ = fs::remove_file(old);
    }
    let is_own = input.ends_with(&format!(".{ending}"));
    match way {
        Way::Same => return is_own.then(|| input.to_owned()),
        Way::Spelled => return is_own.then(|| format!("./{input}")),
        Way::Hard => fs::hard_link(folder.path(input), &link).unwrap(),
        Way::Soft => soft(Path::new(input), &link),
        Way::SoftToSoft => {
            soft(Path::new(input), &between);
            soft(Path::new("between"), &link);
        }
    }
    Some(format!("link.{ending}"))
}

#[cfg(unix)]
fn soft(to: &Path, link: &Path) {
    std::os::unix::fs::symlink(to, link).unwrap();
}

#[cfg(not(unix))]
fn soft(to: &Path, link: &Path) {
    std::os::windows::fs::symlink_file(to, link).unwrap();
}

/// A folder with an input of every kind.
fn inputs(test: &str) -> Folder {
    let folder = Folder::new(test);
    let hover = fs::read_to_string(ready("hover")).unwrap();
    folder.write(
        "s.toml",
        hover.replace("path = \"hover.csv\"", "channels = [\"*.position.*\"]"),
    );
    folder.write("s.csv", fs::read(folder.path("s.toml")).unwrap());
    folder.write("drone.toml", CRAZYFLIE_TOML);
    fs::copy(ready("optimise-transmission"), folder.path("best.toml")).unwrap();
    folder.write("room.toml", folder.run(&["cameras", "--template"]).text());
    folder
        .run(&[
            "run",
            "-q",
            "s.toml",
            "-o",
            "r.csv",
            "--save",
            "flight.json",
            "--set",
            "duration_s=0.1",
        ])
        .exits(0);
    folder
}

/// Every command with every output that leads to every input, in every way: exit code 2, and the input is as it was.
#[test]
fn prop_no_output_is_an_input_by_any_link() {
    let folder = inputs("prop_no_output_is_an_input_by_any_link");
    let metric = "position_error_rms_m";
    let flown_by = "quadrotor.alpha.vehicle=\"drone.toml\"";
    let cases: [(&str, &str, &[&str]); 19] = [
        ("s.toml", "csv", &["run", "s.toml", "-o"]),
        ("s.csv", "csv", &["run", "s.csv", "-o"]),
        ("s.toml", "json", &["run", "s.toml", "--no-output", "--save"]),
        ("drone.toml", "jsonl", &["run", "s.toml", "--set", flown_by, "-o"]),
        (
            "drone.toml",
            "toml",
            &["run", "s.toml", "--no-output", "--set", flown_by, "--save"],
        ),
        (
            "flight.json",
            "json",
            &[
                "run",
                "s.toml",
                "--no-output",
                "--resume",
                "flight.json",
                "--save",
            ],
        ),
        (
            "flight.json",
            "csv",
            &["run", "s.toml", "--resume", "flight.json", "-o"],
        ),
        ("s.toml", "svg", &["levels", "s.toml", "--plot"]),
        (
            "drone.toml",
            "png",
            &["levels", "s.toml", "--set", flown_by, "--plot"],
        ),
        (
            "s.toml",
            "svg",
            &["attribute", "s.toml", "--metric", metric, "--plot"],
        ),
        (
            "s.toml",
            "svg",
            &[
                "select-level",
                "s.toml",
                "--metric",
                metric,
                "--tolerance",
                "1",
                "--plot",
            ],
        ),
        ("s.csv", "csv", &["sweep", "s.csv", "--out"]),
        (
            "drone.toml",
            "parquet",
            &["sweep", "s.toml", "--set", flown_by, "--out"],
        ),
        (
            "room.toml",
            "csv",
            &["cameras", "room.toml", "--no-search", "--out"],
        ),
        (
            "room.toml",
            "svg",
            &["cameras", "room.toml", "--no-search", "--plot"],
        ),
        ("r.csv", "svg", &["plot", "r.csv", "--out"]),
        ("s.toml", "toml", &["animate", "s.toml", "-o"]),
        ("r.csv", "html", &["animate", "r.csv", "-o"]),
        (
            "s.toml",
            "toml",
            &["animate", "r.csv", "--scenario", "s.toml", "-o"],
        ),
    ];
    for (input, ending, command) in cases {
        let before = fs::read(folder.path(input)).unwrap();
        for way in WAYS {
            let Some(output) = leads_to(&folder, input, ending, way) else {
                continue;
            };
            let arguments = [command, &[output.as_str()]].concat();
            folder
                .run(&arguments)
                .exits(2)
                .says(&["would be overwritten", "give the output another name"]);
            assert_eq!(
                fs::read(folder.path(input)).unwrap(),
                before,
                "{arguments:?} {way:?}"
            );
        }
    }
    // Outputs whose names are not given.
    let before = fs::read(folder.path("best.toml")).unwrap();
    folder
        .run(&[
            "optimise",
            "best.toml",
            "--out",
            ".",
            "--set",
            "optimise.levels=[]",
        ])
        .exits(2)
        .says(&["best.toml is the input", "another name"]);
    assert_eq!(fs::read(folder.path("best.toml")).unwrap(), before);
    let before = fs::read(folder.path("s.toml")).unwrap();
    fs::hard_link(folder.path("s.toml"), folder.path("t.csv.journal")).unwrap();
    folder
        .run(&["sweep", "s.toml", "--out", "t.csv"])
        .exits(2)
        .says(&["would be overwritten"]);
    fs::hard_link(folder.path("r.csv"), folder.path("r.svg")).unwrap();
    folder
        .run(&["plot", "r.csv"])
        .exits(2)
        .says(&["would be overwritten"]);
    assert_eq!(fs::read(folder.path("s.toml")).unwrap(), before);
}

#[test]
fn exact_two_outputs_are_two_files() {
    let folder = inputs("exact_two_outputs_are_two_files");
    let outputs: [&[&str]; 3] = [
        &["run", "s.toml", "-o", "k.csv", "--save", "k.csv"],
        &["run", "s.toml", "-o", "k.csv", "--save", "./k.csv"],
        &[
            "cameras",
            "room.toml",
            "--no-search",
            "--out",
            "k.svg",
            "--plot",
            "k.svg",
        ],
    ];
    for command in outputs {
        folder.run(command).exits(2).says(&["are the same file"]);
    }
    assert!(!folder.path("k.csv").exists() && !folder.path("k.svg").exists());
}

/// Names that programs take for temporary files are somebody's files: none of them is touched.
#[test]
fn exact_a_neighbour_is_never_touched() {
    let folder = inputs("exact_a_neighbour_is_never_touched");
    for (command, neighbour) in [
        (
            &["run", "-q", "s.json.new", "--no-output", "--save", "s.json"][..],
            "s.json.new",
        ),
        (
            &["cameras", "room.csv.new", "--no-search", "--out", "room.csv"],
            "room.csv.new",
        ),
    ] {
        let input = if neighbour.starts_with("room") {
            "room.toml"
        } else {
            "s.toml"
        };
        fs::copy(folder.path(input), folder.path(neighbour)).unwrap();
        folder.run(command).exits(0);
        assert_eq!(
            fs::read(folder.path(neighbour)).unwrap(),
            fs::read(folder.path(input)).unwrap()
        );
    }
}

/// A scenario of somebody else's names an output: it replaces recordings only.
#[test]
fn exact_a_scenario_replaces_no_file_of_another_kind() {
    let folder = inputs("exact_a_scenario_replaces_no_file_of_another_kind");
    folder.write("letter.csv", "Dear reader,");
    let flown = |more: &[&str]| {
        let arguments = ["run", "-q", "s.toml", "--set", "duration_s=0.1"];
        folder.run(&[&arguments[..], more].concat())
    };
    flown(&["--set", "output.path=letter.csv"])
        .exits(2)
        .says(&["letter.csv: already exists and is not a recording"]);
    assert_eq!(
        fs::read_to_string(folder.path("letter.csv")).unwrap(),
        "Dear reader,"
    );
    flown(&["--set", "output.path=r.csv"]).exits(0);
    flown(&["-o", "letter.csv"]).exits(0);
}

/// `/dev/full` is a disk that is always full.
#[cfg(target_os = "linux")]
#[test]
fn exact_a_full_standard_output_exits_with_3() {
    let folder = inputs("exact_a_full_standard_output_exits_with_3");
    for arguments in [
        &["schema"][..],
        &["new"],
        &["completions", "bash"],
        &["cameras", "--template"],
        &["--help"],
        &["run", "--help"],
        &[
            "run",
            "-q",
            "--json",
            "s.toml",
            "--no-output",
            "--set",
            "duration_s=0.1",
        ],
        &["run", "-q", "s.toml", "--no-output", "--set", "duration_s=0.1"],
    ] {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let status = folder.command(arguments).stdout(full).status().unwrap();
        assert_eq!(status.code(), Some(3), "{arguments:?}");
    }
}

/// The second of two flights into one recording is refused, and the first's file is complete.
#[cfg(unix)]
#[test]
fn exact_two_flights_do_not_share_a_recording() {
    use std::io::Read;
    let folder = inputs("exact_two_flights_do_not_share_a_recording");
    // The first flight records into a pipe's neighbour for long enough: it is ended by the test.
    let arguments = [
        "run",
        "-q",
        "s.toml",
        "-o",
        "shared.csv",
        "--set",
        "duration_s=100000",
    ];
    let mut first = folder
        .command(&arguments)
        .stdout(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    while !fs::metadata(folder.path("shared.csv")).is_ok_and(|file| file.len() > 20_000) {
        assert!(first.try_wait().unwrap().is_none(), "the first flight ended");
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    let second = folder.run(&[
        "run",
        "-q",
        "s.toml",
        "-o",
        "shared.csv",
        "--set",
        "duration_s=0.1",
    ]);
    let signal = std::process::Command::new("kill")
        .args(["-INT", &first.id().to_string()])
        .status();
    assert!(signal.unwrap().success());
    let mut said = String::new();
    first.stdout.take().unwrap().read_to_string(&mut said).unwrap();
    assert_eq!(first.wait().unwrap().code(), Some(130), "{said}");
    second
        .exits(3)
        .says(&["shared.csv", "another program is writing it"]);
    folder.run(&["plot", "shared.csv"]).exits(0);
}

/// Starts a command, and stops it by Ctrl-C once a file has some bytes; the file's text.
#[cfg(unix)]
fn stopped(folder: &Folder, arguments: &[&str], file: &str, bytes: u64) -> String {
    use std::process::{Command, Stdio};
    let mut child = folder
        .command(arguments)
        .stderr(Stdio::null())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    while !fs::metadata(folder.path(file)).is_ok_and(|file| file.len() > bytes) {
        assert!(child.try_wait().unwrap().is_none(), "{file} is not written");
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    let signal = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(signal.unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    fs::read_to_string(folder.path(file)).unwrap()
}

/// A journal with lines that are not as they were written, or runs that the sweep does not have, is refused.
#[cfg(unix)]
#[test]
fn exact_tampered_journals_are_refused() {
    let folder = inputs("exact_tampered_journals_are_refused");
    let sweep = [
        "sweep",
        "s.toml",
        "--range",
        "duration_s=20:21:2001",
        "--out",
        "t.csv",
    ];
    let journal = stopped(&folder, &sweep, "t.csv.journal", 400);
    let row = |text: &str| format!("{} {text}\n", output::checksum(text.as_bytes()));
    let with = |run: u64, exit: u8| {
        let text = format!(
            "{{\"run\":{run},\"end\":\"completed\",\"exit_code\":{exit},\"time_s\":1.0,\"metrics\":[]}}"
        );
        (row(&text), text + "\n")
    };
    for (added, part) in [
        (with(7, 0).1, "is damaged"),
        (with(2001, 0).0, "has run 2001, but the sweep has 2001 runs"),
        (with(7, 90).0, "has the unknown exit code 90"),
    ] {
        let tampered = journal.clone() + &added;
        fs::write(folder.path("t.csv.journal"), &tampered).unwrap();
        folder
            .run(&sweep)
            .exits(2)
            .says(&["t.csv.journal", part, "--restart"]);
        assert_eq!(
            fs::read_to_string(folder.path("t.csv.journal")).unwrap(),
            tampered
        );
    }
    let changed = journal.replacen("\"exit_code\":", "\"exit_code\":1", 1);
    assert_ne!(changed, journal);
    fs::write(folder.path("t.csv.journal"), &changed).unwrap();
    folder.run(&sweep).exits(2).says(&["is damaged"]);
}

#[test]
fn exact_tampered_searches_are_refused() {
    let folder = inputs("exact_tampered_searches_are_refused");
    let search = [
        "optimise",
        "best.toml",
        "--out",
        "opt",
        "--set",
        "optimise.budget=3",
        "--set",
        "duration_s=0.2",
    ];
    folder.run(&search).exits(0);
    let state = folder.path("opt/state.json");
    let text = fs::read_to_string(&state).unwrap();
    let changed = text.replacen("\"cost\":", "\"cost\":1", 1);
    assert_ne!(text, changed);
    fs::write(&state, &changed).unwrap();
    folder
        .run(&[&search[..], &["--resume"]].concat())
        .exits(2)
        .says(&["state.json", "its check sum differs"]);
    assert_eq!(fs::read_to_string(&state).unwrap(), changed);
}

/// More runs than memory has room for are refused before the first.
#[test]
fn exact_counts_have_limits_that_can_be_raised() {
    let folder = inputs("exact_counts_have_limits_that_can_be_raised");
    for (arguments, parts) in [
        (
            &["sweep", "s.toml", "--range", "duration_s=1:2:99999999"][..],
            &["got 99999999", "--most-runs 99999999"][..],
        ),
        (
            &["sweep", "s.toml", "--runs", "4294967295"],
            &["got 4294967295", "--most-runs"],
        ),
        (
            &["uncertainty", "s.toml", "--runs", "4294967295"],
            &["got 4294967295", "--most-runs"],
        ),
    ] {
        folder.run(arguments).exits(2).says(parts);
    }
    let sweep = [
        "sweep",
        "s.toml",
        "--range",
        "duration_s=0.1:0.2:3",
        "--out",
        "t.csv",
        "--most-runs",
    ];
    folder
        .run(&[&sweep[..], &["2"]].concat())
        .exits(2)
        .says(&["at most 2 runs are allowed, got 3"]);
    folder.run(&[&sweep[..], &["3"]].concat()).exits(0);
    #[cfg(unix)]
    folder
        .run(&["run", "/dev/zero"])
        .exits(2)
        .says(&["/dev/zero", "longer than 16 MiB"]);
    let room = folder.run(&["cameras", "--template"]).text();
    for cameras in ["9223372036854775807", "65536"] {
        let line = room.lines().find(|line| line.starts_with("cameras =")).unwrap();
        folder.write("many.toml", room.replace(line, &format!("cameras = {cameras}")));
        folder
            .run(&["cameras", "many.toml"])
            .exits(2)
            .says(&["many.toml", "cameras", cameras]);
    }
}
