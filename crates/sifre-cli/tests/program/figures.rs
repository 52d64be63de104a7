//! The scenario files of the figures, flown from the command line.

use crate::support::Folder;
use sifre::Recording;
use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};

fn experiments() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../experiments")
}

/// Names of the columns, and the rows.
type Table = (BTreeMap<String, usize>, Vec<Vec<f64>>);

fn table(path: &Path) -> Table {
    let mut file = csv::Reader::from_path(path).unwrap();
    let names = file
        .headers()
        .unwrap()
        .iter()
        .map(str::to_owned)
        .zip(0..)
        .collect();
    let rows = file
        .records()
        .map(|row| row.unwrap().iter().map(|x| x.parse().unwrap()).collect());
    (names, rows.collect())
}

/// Every row of the figure's reference data is a row of the recording of `sifre run`, the last ones among them.
///
/// The difference allowed is that of elementary functions between machines, which a stable loop does not amplify.
#[test]
fn agree_a_figures_scenario_flies_the_figures_data() {
    const ELEMENTARY_FUNCTIONS: f64 = 1e-9;
    let folder = Folder::new("figures");
    for (figure, column, channel, sign) in [
        ("6.8", "height_m", "position.z", -1.0),
        ("6.12", "yaw_rad", "attitude.yaw", 1.0),
        ("6.16", "x_m", "position.x", 1.0),
    ] {
        let scenario = experiments().join(format!("scenarios/{figure}.toml"));
        folder
            .run(&[
                "run",
                "-q",
                &scenario.display().to_string(),
                "--out",
                "flight.csv",
            ])
            .exits(0);
        let flown = Recording::from_csv(File::open(folder.path("flight.csv")).unwrap()).unwrap();
        let (columns, reference) = table(&experiments().join(format!("reference/{figure}.csv")));
        for level in 3..=5 {
            let wanted = columns[&format!("{column}_level_{level}")];
            let column = flown.column(&format!("level-{level}.{channel}")).unwrap();
            let flown: Vec<f64> = column.collect();
            for row in &reference {
                // The first column of a reference is the number of the row.
                let here = sign * flown[row[0] as usize];
                let apart = (here - row[wanted]).abs();
                assert!(
                    apart < ELEMENTARY_FUNCTIONS,
                    "figure {figure}, level {level}: {here} {}",
                    row[wanted]
                );
            }
        }
        let last = reference.last().unwrap()[0] as usize;
        assert_eq!(last + 1, flown.len(), "figure {figure}");
    }
}

/// Every file can be flown as it is.
#[test]
fn prop_scenarios_of_the_figures_are_valid() {
    let folder = Folder::new("figures-valid");
    let files = std::fs::read_dir(experiments().join("scenarios")).unwrap();
    for file in files.map(|file| file.unwrap().path()) {
        // This one names a vehicle that its figure identifies.
        if file.file_stem().is_some_and(|name| name == "4.10-flight") {
            continue;
        }
        let name = file.display().to_string();
        let (short, step) = ("duration_s=0.002", "output.step_s=0.001");
        folder
            .run(&["run", "-q", &name, "--set", short, "--set", step, "--no-output"])
            .exits(0);
    }
}
