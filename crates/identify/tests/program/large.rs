//! Files larger than memory should be asked to hold go through the program.

use std::io::Write;
use std::process::{Child, Command, Stdio};

/// Bytes sent: 60 MB, in rows of 3 kB of which two columns are wanted.
const ROWS: usize = 20_000;
const NOTE: usize = 3_000;
/// What the program may have held at its most, kB: itself and its libraries (5 MB), and 20 000 rows of two numbers and
/// their line (0.5 MB); the text would be 60 MB.
const MOST_KB: u64 = 20_000;

/// The largest resident memory so far of a running process, kB, where the system tells.
fn peak_kb(child: &Child) -> Option<u64> {
    let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}

/// Sixty megabytes through a pipe, never on a disk: read to the end, identified, and not held.
#[test]
fn exact_a_large_stream_is_identified_in_bounded_memory() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_identify"))
        .args(["load-cell", "-", "--capacity-n", "16", "--json"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = child.stdin.take().unwrap();
    let note = "n".repeat(NOTE);
    writeln!(input, "note,load_n,reading_v").unwrap();
    for k in 0..ROWS {
        // 1 V + 0.5 V/N, one millivolt to either side by turns at each load.
        let load = (k / 2 % 5) as f64;
        let noise = if k % 2 == 0 { 1e-3 } else { -1e-3 };
        writeln!(input, "{note},{load},{}", 1.0 + 0.5 * load + noise).unwrap();
    }
    input.flush().unwrap();
    let peak = peak_kb(&child);
    drop(input);
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    let (slope, _) = super::number(&output, "sensitivity");
    // Rounding.
    assert!((slope - 0.5).abs() < 1e-12, "{slope}");
    match peak {
        Some(kilobytes) => assert!(kilobytes < MOST_KB, "{kilobytes} kB"),
        None => println!("this system does not tell the memory of a process: only the result was tested"),
    }
}

/// A log of eight hours of which sixteen seconds are asked for: what follows is neither held nor read to its end.
#[test]
fn exact_a_part_of_a_long_log_gives_what_its_own_file_gives() {
    let template = super::identify(&["template", "flight"]);
    let short = String::from_utf8(template.stdout).unwrap();
    let data = super::file("part.csv", short.as_bytes());
    let flight = |path: &str| {
        let part = [
            "--from",
            "1.5",
            "--to",
            "15",
            "--json",
            "--vehicle",
            super::NOMINAL,
        ];
        let mut command = Command::new(env!("CARGO_BIN_EXE_identify"));
        command.args([&["flight", path], &part[..]].concat());
        command
    };
    let alone = flight(data.to_str().unwrap()).output().unwrap();
    assert_eq!(alone.status.code(), Some(0), "{}", super::said(&alone));

    let mut child = flight("-")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = child.stdin.take().unwrap();
    input.write_all(short.as_bytes()).unwrap();
    let mut sent = 0;
    // 100 rows a second; the program closes the pipe 10 s after the part.
    for k in 1..2_880_000 {
        let time_s = 16.0 + 0.01 * f64::from(k);
        let row = format!("{time_s:.2},0,0,-9.8,0,0,0,0.074,0.075,0.075,0.074,10.3\n");
        if input.write_all(row.as_bytes()).is_err() {
            break;
        }
        sent += row.len();
    }
    drop(input);
    let output = child.wait_with_output().unwrap();
    assert!(sent < 10_000_000, "{sent} bytes were taken");
    for key in [
        "airframe.inertia_xx_kg_m2",
        "linear_rotor.thrust_gain_n",
        "motor lag",
    ] {
        let ((a, _), (b, _)) = (super::number(&alone, key), super::number(&output, key));
        // The rows behind the part are within the margin that is kept; the fit looks at the part alone.
        assert!((a / b - 1.0).abs() < 1e-6, "{key}: {a} and {b}");
    }
}
