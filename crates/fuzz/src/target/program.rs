//! Readers inside the programs: each case is a run of a program that must end by itself with an exit code of its own.

use super::Target;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use std::{env, fs, thread};

/// Longest run of a program.
const LONGEST: Duration = Duration::from_secs(20);

/// Exit codes of programs that ended as they mean to.
const MEANT: [i32; 4] = [0, 1, 2, 3];

/// A scenario of which the journal of a sweep is read.
const SWEPT: &str = "name = \"s\"\nduration_s = 0.01\n[[target]]\nname = \"t\"\npath = { kind = \"fixed\", position_m = [0, 0, -1] }\n";

pub(super) fn all() -> Vec<Target> {
    let target = |name, seeds, read| Target {
        name,
        seeds,
        read,
        is_program: true,
    };
    vec![
        target("ulog", vec![log()], ulog),
        target("journal", vec![journal()], journal_of),
    ]
}

/// The programs are built into the folder of this one.
fn built(name: &str) -> PathBuf {
    let here = env::current_exe().unwrap_or_default();
    let folder = here.ancestors().find(|folder| folder.join(name).is_file());
    folder.map_or_else(|| name.into(), |folder| folder.join(name))
}

/// A folder for the files of this process.
fn folder() -> PathBuf {
    let folder = env::temp_dir().join(format!("fuzz-{}", std::process::id()));
    drop(fs::create_dir_all(&folder));
    folder
}

/// Runs a program in the folder.
fn run(name: &str, arguments: &[&str]) -> Result<(), String> {
    let mut child = Command::new(built(name))
        .args(arguments)
        .current_dir(folder())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .map_err(|error| format!("{name} can't be started, build it before: {error}"))?;
    let begun = Instant::now();
    loop {
        match child.try_wait().map_err(|error| error.to_string())? {
            Some(status) if status.code().is_some_and(|code| MEANT.contains(&code)) => return Ok(()),
            Some(status) => return Err(format!("{name} ended with {status}")),
            None if begun.elapsed() > LONGEST => {
                drop(child.kill());
                drop(child.wait());
                return Err(format!("{name} did not end within {LONGEST:?}"));
            }
            None => thread::sleep(Duration::from_micros(200)),
        }
    }
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), String> {
    fs::write(path, bytes).map_err(|error| format!("{}: {error}", path.display()))
}

fn ulog(file: &[u8]) -> Result<(), String> {
    write(&folder().join("case.ulg"), file)?;
    write(&folder().join("v.toml"), scenario::VEHICLES[2].1.as_bytes())?;
    run("identify", &["flight", "case.ulg", "--vehicle", "v.toml"])
}

fn journal_of(file: &[u8]) -> Result<(), String> {
    write(&folder().join("s.toml"), SWEPT.as_bytes())?;
    write(&folder().join("t.csv.journal"), file)?;
    sweep("0.01:0.02:3")
}

fn sweep(range: &str) -> Result<(), String> {
    let range = format!("duration_s={range}");
    run("sifre", &["sweep", "s.toml", "--range", &range, "--out", "t.csv"])
}

/// A head and a line as a journal has them; without the right check sums, which a mutation would break anyway.
fn journal() -> Vec<u8> {
    let lines = [
        "af63dc4c8601ec8c {\"sifre_sweep\":\"85944171f73967e8\"}",
        "cbf29ce484222325 {\"run\":0,\"end\":\"completed\",\"exit_code\":0,\"time_s\":0.01,\"metrics\":[]}",
    ];
    lines.join("\n").into_bytes()
}

/// A log of a second as PX4 writes one: definitions, subscriptions, samples at 100 Hz.
fn log() -> Vec<u8> {
    let mut bytes = b"ULog\x01\x12\x35\x01".to_vec();
    bytes.extend(0_u64.to_le_bytes());
    let mut message = |kind: u8, payload: &[u8]| {
        bytes.extend((payload.len() as u16).to_le_bytes());
        bytes.push(kind);
        bytes.extend(payload);
    };
    message(b'B', &[0; 40]);
    let formats = [
        "sensor_combined:uint64_t timestamp;float[3] gyro_rad;float[3] accelerometer_m_s2;",
        "actuator_motors:uint64_t timestamp;float[4] control;",
        "battery_status:uint64_t timestamp;float voltage_v;",
    ];
    formats.iter().for_each(|format| message(b'F', format.as_bytes()));
    for (id, format) in (0_u16..).zip(formats) {
        let name = format.split(':').next().unwrap_or_default();
        let [low, high] = id.to_le_bytes();
        message(b'A', &[&[0, low, high], name.as_bytes()].concat());
    }
    for k in 0..100_u64 {
        for (id, count) in [(2_u16, 1), (1, 4), (0, 6)] {
            let numbers = (0..count).flat_map(|i| (0.5 + 0.01 * (i as f32) * (k as f32).sin()).to_le_bytes());
            let payload = id
                .to_le_bytes()
                .into_iter()
                .chain((k * 10_000).to_le_bytes())
                .chain(numbers);
            message(b'D', &payload.collect::<Vec<u8>>());
        }
    }
    bytes
}
