//! Outputs: never an input under any name, never two at one place, and an exit code where they can't be written.

use super::{NOMINAL, file, identify, said};
use std::path::{Path, PathBuf};

const LOADS: &str = "load_n,reading_v\n0,1.001\n0,0.999\n2,2.001\n2,1.999\n4,3.001\n4,2.999\n";

/// A folder of the test's own with measurements and a vehicle.
fn folder(test: &str) -> PathBuf {
    // Makes the nominal vehicle's file.
    identify(&["template", "load-cell"]);
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(test);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("lc.csv"), LOADS).unwrap();
    std::fs::copy(NOMINAL, folder.join("v.toml")).unwrap();
    folder
}

/// Runs the load cell's identification with these outputs.
fn calibrated(folder: &Path, outputs: &[&str]) -> std::process::Output {
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let (data, vehicle) = (path("lc.csv"), path("v.toml"));
    let outputs: Vec<String> = outputs
        .iter()
        .map(|word| {
            if word.starts_with("--") {
                (*word).to_owned()
            } else {
                path(word)
            }
        })
        .collect();
    let head = ["load-cell", &data, "--capacity-n", "16", "--vehicle", &vehicle];
    let outputs: Vec<&str> = outputs.iter().map(String::as_str).collect();
    identify(&[&head[..], &outputs].concat())
}

#[cfg(unix)]
#[test]
fn prop_no_output_is_an_input_by_any_link() {
    let folder = folder("outputs");
    for input in ["lc.csv", "v.toml"] {
        std::fs::hard_link(folder.join(input), folder.join(format!("hard-{input}.svg"))).unwrap();
        std::os::unix::fs::symlink(input, folder.join(format!("soft-{input}.svg"))).unwrap();
    }
    let cases: [&[&str]; 9] = [
        &["--out", "lc.csv"],
        &["--out", "./lc.csv"],
        &["--out", "hard-lc.csv.svg"],
        &["--out", "soft-lc.csv.svg"],
        &["--plot", "hard-lc.csv.svg"],
        &["--plot", "soft-lc.csv.svg"],
        &["--plot", "hard-v.toml.svg"],
        &["--plot", "soft-v.toml.svg"],
        &["--out", "new.svg", "--plot", "new.svg"],
    ];
    let before = std::fs::read(folder.join("v.toml")).unwrap();
    for outputs in cases {
        let refused = calibrated(&folder, outputs);
        assert_eq!(refused.status.code(), Some(2), "{outputs:?}: {}", said(&refused));
        assert!(
            said(&refused).contains("give the output another name"),
            "{outputs:?}"
        );
        assert!(refused.stdout.is_empty());
    }
    assert_eq!(std::fs::read_to_string(folder.join("lc.csv")).unwrap(), LOADS);
    assert_eq!(std::fs::read(folder.join("v.toml")).unwrap(), before);
    assert!(!folder.join("new.svg").exists());
    // The vehicle file is what --out completes: it may be the same.
    let completed = calibrated(&folder, &["--out", "v.toml"]);
    assert_eq!(completed.status.code(), Some(0), "{}", said(&completed));
}

#[cfg(target_os = "linux")]
#[test]
fn exact_full_disks_exit_with_3_and_closed_pipes_end_quietly() {
    let folder = folder("full");
    let data = folder.join("lc.csv");
    let run = |more: &[&str], to: std::process::Stdio| {
        std::process::Command::new(env!("CARGO_BIN_EXE_identify"))
            .args(["load-cell", data.to_str().unwrap(), "--capacity-n", "16"])
            .args(more)
            .stdout(to)
            .output()
            .unwrap()
    };
    let full = || std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    for more in [&[][..], &["--json"], &["--help"]] {
        let output = run(more, full().into());
        assert_eq!(output.status.code(), Some(3), "{more:?}: {}", said(&output));
    }
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let output = run(&[], writer.into());
    assert_eq!((output.status.code(), said(&output)), (Some(0), String::new()));
    let nowhere = calibrated(&folder, &["--plot", "no/folder.svg"]);
    assert_eq!(nowhere.status.code(), Some(3));
    assert!(nowhere.stdout.is_empty());
}

/// Logs on which the library panicked: each is an error, or is used as far as it goes.
#[test]
fn regress_damaged_logs_are_no_panics() {
    identify(&["template", "flight"]);
    for (name, log) in [
        ("m1.ulg", &include_bytes!("bad/m1.ulg")[..]),
        ("m2.ulg", include_bytes!("bad/m2.ulg")),
        ("m3.ulg", include_bytes!("bad/m3.ulg")),
    ] {
        let data = file(name, log);
        let output = identify(&["flight", data.to_str().unwrap(), "--vehicle", NOMINAL]);
        assert_eq!(output.status.code(), Some(1), "{name}: {}", said(&output));
        assert!(
            said(&output).contains(name) && !said(&output).contains("panicked"),
            "{}",
            said(&output)
        );
    }
}
