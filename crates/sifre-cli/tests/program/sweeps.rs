//! Sweeps.

use crate::support::{Folder, ready};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use std::fs::{self, File};

/// The columns of a CSV table by name.
fn column(text: &str, name: &str) -> Vec<String> {
    let mut table = csv::Reader::from_reader(text.as_bytes());
    let place = table.headers().unwrap().iter().position(|header| header == name);
    let place = place.unwrap_or_else(|| panic!("no column {name} in {text}"));
    table
        .records()
        .map(|record| record.unwrap()[place].to_owned())
        .collect()
}

const STEP: [&str; 2] = ["--set", "duration_s=0.2"];

/// A grid in order, the last axis fastest; `agree` with `run` of the same keys.
#[test]
fn agree_a_sweep_with_single_runs() {
    let folder = Folder::new("grid");
    let mass = "quadrotor.alpha.parameters.airframe.mass_kg";
    let (levels, masses) = (
        "quadrotor.alpha.level=3,5".to_owned(),
        format!("{mass}=1.3:1.5:3"),
    );
    let hover = ready("hover");
    let sweep = [
        "sweep", &hover, "--set", &levels, "--range", &masses, "-o", "a.csv",
    ];
    folder.run(&[&sweep[..], &STEP].concat()).exits(0);
    let text = fs::read_to_string(folder.path("a.csv")).unwrap();
    assert_eq!(
        column(&text, "quadrotor.alpha.level"),
        ["3.0", "3.0", "3.0", "5.0", "5.0", "5.0"]
    );
    assert_eq!(column(&text, mass), ["1.3", "1.4", "1.5", "1.3", "1.4", "1.5"]);
    let one = folder
        .run(&[
            "run",
            "--json",
            "--no-output",
            &hover,
            "--set",
            "duration_s=0.2",
            "--set",
            &format!("{mass}=1.5"),
        ])
        .exits(0)
        .json();
    let name = "alpha.position_error_rms_m";
    let swept: f64 = column(&text, name)[5].parse().unwrap();
    assert_eq!(one["metrics"][name].as_f64(), Some(swept), "bit for bit");
}

/// Random sweeps are the same on any number of threads, another with another seed, and the seed is the scenario's too.
#[test]
fn prop_draws_depend_on_the_seed_alone() {
    let folder = Folder::new("draws");
    let hover = ready("hover");
    let draws = |seed: &str, jobs: &str, out: &str| {
        let sweep = [
            "sweep",
            &hover,
            "--runs",
            "12",
            "--seed",
            seed,
            "--jobs",
            jobs,
            "-o",
            out,
            "--normal",
            "quadrotor.alpha.parameters.airframe.mass_kg=1.4:0.05",
            "--uniform",
            "quadrotor.alpha.reference.yaw_deg=-90:90",
        ];
        folder.run(&[&sweep[..], &STEP].concat()).exits(0);
        fs::read_to_string(folder.path(out)).unwrap()
    };
    let (one, four, other) = (
        draws("1", "1", "a.csv"),
        draws("1", "4", "b.csv"),
        draws("2", "2", "c.csv"),
    );
    assert_eq!(one, four);
    assert_ne!(one, other);
    let yaw = column(&one, "quadrotor.alpha.reference.yaw_deg");
    let yaw: Vec<f64> = yaw.iter().map(|text| text.parse().unwrap()).collect();
    assert!(yaw.iter().all(|yaw| yaw.abs() <= 90.0) && yaw.iter().any(|yaw| *yaw < 0.0));
}

#[test]
fn exact_parquet_tables() {
    let folder = Folder::new("parquet");
    let hover = ready("hover");
    let sweep = [
        "sweep",
        &hover,
        "--set",
        "quadrotor.alpha.vehicle=qball-x4,crazyflie",
        "-o",
        "a.parquet",
        "--json",
    ];
    let json = folder.run(&[&sweep[..], &STEP].concat()).exits(0).json();
    assert_eq!((json["runs"].as_u64(), json["done"].as_u64()), (Some(2), Some(2)));
    let reader = SerializedFileReader::new(File::open(folder.path("a.parquet")).unwrap()).unwrap();
    let rows: Vec<_> = reader.get_row_iter(None).unwrap().map(Result::unwrap).collect();
    let cell = |row: usize, name: &str| {
        let found = rows[row]
            .get_column_iter()
            .find(|(column, _)| column.as_str() == name);
        found.unwrap_or_else(|| panic!("no column {name}")).1.clone()
    };
    assert_eq!(
        cell(1, "quadrotor.alpha.vehicle"),
        Field::Str("crazyflie".to_owned())
    );
    assert_eq!(cell(0, "end"), Field::Str("completed".to_owned()));
    assert_eq!(cell(0, "time_s"), Field::Double(0.2));
    assert_eq!(cell(1, "run"), Field::Long(1));
}

#[test]
fn exact_what_can_not_be_flown_is_a_row_and_all_of_it_an_error() {
    let folder = Folder::new("refused");
    let hover = ready("hover");
    let sweep = |levels: &str| {
        let levels = format!("quadrotor.alpha.level={levels}");
        let c3 = "quadrotor.alpha.controller.kind=c3";
        folder.run(&[
            "sweep",
            &hover,
            "--set",
            c3,
            "--set",
            &levels,
            "-o",
            "a.csv",
            "--set",
            "duration_s=0.1",
        ])
    };
    sweep("2,3").exits(0);
    let text = fs::read_to_string(folder.path("a.csv")).unwrap();
    assert_eq!(column(&text, "exit_code"), ["2", "0"]);
    assert!(column(&text, "end")[0].contains("alpha"));
    sweep("1,2").exits(2).says(&["no run could be flown"]);
    // Before anything is flown.
    sweep("7").exits(2).says(&["level"]);
    folder
        .run(&["sweep", &hover, "-o", "a.xlsx"])
        .exits(2)
        .says(&[".csv or .parquet"]);
    folder
        .run(&["sweep", &hover, "--range", "duration_s=1:2"])
        .exits(2)
        .says(&["LOW:HIGH:N"]);
    folder
        .run(&["sweep", &hover, "--normal", "duration_s=1:-2"])
        .exits(2);
    folder
        .run(&["sweep", &hover, "--range", "duration=1:2:3"])
        .exits(2)
        .says(&["unknown key `duration`"]);
}

#[test]
fn exact_a_journal_of_another_sweep_is_not_taken() {
    let folder = Folder::new("journal");
    let head = "{\"sifre_sweep\":\"another\"}";
    folder.write(
        "a.csv.journal",
        format!("{} {head}\n", output::checksum(head.as_bytes())),
    );
    let hover = ready("hover");
    let sweep = ["sweep", &hover, "-o", "a.csv"];
    folder
        .run(&[&sweep[..], &STEP].concat())
        .exits(2)
        .says(&["another sweep", "--restart"]);
    folder.run(&[&sweep[..], &["--restart"], &STEP].concat()).exits(0);
}
