//! `optimise`: what it finds, what it leaves, what it refuses.

use crate::support::{Folder, Ran, ready};
use serde_json::Value;
use std::fs;

/// The ready scenario, cut short.
const SHORT: [&str; 2] = ["--set", "duration_s=1"];

fn optimise(folder: &Folder, out: &str, arguments: &[&str]) -> Ran {
    let scenario = ready("optimise-transmission");
    let given = ["optimise", &scenario, "--json", "--out", out];
    folder.run(&[&given[..], &SHORT, arguments].concat())
}

fn table(folder: &Folder, name: &str) -> Vec<Vec<String>> {
    let text = fs::read_to_string(folder.path(name)).unwrap();
    let rows = text
        .lines()
        .map(|line| line.split(',').map(str::to_owned).collect());
    rows.collect()
}

fn cost(found: &Value) -> f64 {
    found["found"][0]["cost"].as_f64().unwrap()
}

/// The best is the least of what was flown; its scenario flies, and costs what it cost.
#[test]
fn exact_the_best_of_what_was_flown_is_kept() {
    let folder = Folder::new("optimise");
    // From farther away than the optimum, so that there is something to gain.
    let far = ["--set", "quadrotor.alpha.reference.x_0_m=8"];
    let seven = ["--set", "optimise.budget=7"];
    let found = optimise(&folder, "a", &[far, seven].concat()).exits(0).json();
    assert_eq!(found["found"][0]["flights"], 7);
    assert!(found["found"][0]["stop"].as_str().unwrap().contains("budget"));
    let history = table(&folder, "a/history-level-3.csv");
    assert_eq!(history.len(), 8);
    let costs: Vec<f64> = history[1..].iter().map(|row| row[3].parse().unwrap()).collect();
    assert_eq!(costs.iter().copied().fold(f64::INFINITY, f64::min), cost(&found));
    assert!(cost(&found) < costs[0], "it is better than the start");
    for name in ["best-level-3.svg", "history-level-3.svg", "best-level-3.csv"] {
        assert!(folder.path(&format!("a/{name}")).exists(), "{name}");
    }
    folder
        .run(&["run", "-q", "--no-output", "a/best-level-3.toml"])
        .exits(0);
    let again = folder
        .run(&[
            "optimise",
            "a/best-level-3.toml",
            "--json",
            "--out",
            "again",
            "--set",
            "optimise.budget=1",
        ])
        .exits(0)
        .json();
    assert_eq!(cost(&again), cost(&found));
}

/// A search in two pieces is the search in one piece.
#[test]
fn exact_a_resumed_search_is_the_one_that_was_not_interrupted() {
    let folder = Folder::new("resumed-search");
    for algorithm in ["nelder-mead", "evolution"] {
        let algorithm_key = format!("optimise.algorithm={algorithm}");
        let run = |out: &str, budget: &str, more: &[&str]| {
            let given = ["--set", &algorithm_key, "--set", budget];
            optimise(&folder, out, &[&given[..], more].concat())
        };
        let (whole, pieces) = (format!("whole-{algorithm}"), format!("pieces-{algorithm}"));
        run(&whole, "optimise.budget=12", &[]).exits(0);
        run(&pieces, "optimise.budget=5", &[]).exits(0);
        run(&pieces, "optimise.budget=12", &[])
            .exits(2)
            .says(&["--resume"]);
        run(&pieces, "optimise.budget=12", &["--resume"]).exits(0);
        let history = |out: &str| table(&folder, &format!("{out}/history-level-3.csv"));
        assert_eq!(history(&whole), history(&pieces), "{algorithm}");
    }
    // Another question is another search.
    let other = [
        "--resume",
        "--set",
        "optimise.algorithm=nelder-mead",
        "--set",
        "optimise.weights.spot=2",
    ];
    optimise(&folder, "pieces-nelder-mead", &other)
        .exits(2)
        .says(&["another scenario"]);
    optimise(&folder, "nowhere", &["--resume"])
        .exits(2)
        .says(&["state.json"]);
}

/// A flight into the ground costs its share of a failure: finite, more than any sound one, and counted.
#[test]
fn exact_failed_flights_are_counted_and_the_search_goes_on() {
    let folder = Folder::new("failures");
    let variables = "optimise.variables=[{ key = \"quadrotor.alpha.reference.z_0_m\", lower = -3, upper = 3, start = -3 }]";
    let found = optimise(
        &folder,
        "a",
        &[
            "--set",
            variables,
            "--set",
            "optimise.algorithm=line-search",
            "--set",
            "optimise.budget=12",
        ],
    )
    .exits(0)
    .json();
    let failed = found["found"][0]["failed"].as_u64().unwrap();
    assert!((3..12).contains(&failed), "{failed}");
    let history = table(&folder, "a/history-level-3.csv");
    let is_failure = |row: &&Vec<String>| !row[4].is_empty();
    let failures: Vec<_> = history[1..].iter().filter(is_failure).collect();
    assert_eq!(failures.len() as u64, failed);
    for row in failures {
        let value: f64 = row[2].parse().unwrap();
        assert!(value.is_finite() && value > cost(&found), "{row:?}");
    }
}

#[test]
fn exact_bad_problems_exit_with_2() {
    let folder = Folder::new("bad-problems");
    let refuses = |setting: &str, parts: &[&str]| {
        drop(optimise(&folder, "a", &["--set", setting]).exits(2).says(parts));
        assert!(!folder.path("a").exists(), "nothing was begun by {setting}");
    };
    let variable = |text: &str| format!("optimise.variables=[{{ {text} }}]");
    let key = "key = \"quadrotor.alpha.reference.x_0_m\"";
    refuses("optimise.variables=[]", &["at least one variable"]);
    refuses(
        &variable(&format!("{key}, lower = 9, upper = 1")),
        &["x_0_m", "lower < upper, got [9, 1]"],
    );
    refuses(
        &variable(&format!("{key}, lower = 1, upper = 1")),
        &["x_0_m", "[1, 1]"],
    );
    refuses(
        &variable(&format!("{key}, lower = 6, upper = 9")),
        &["x_0_m", "[6, 9], got 5"],
    );
    refuses(
        &variable("key = \"quadrotor.alpha.reference.x_9_m\", lower = 1, upper = 9"),
        &["x_9_m", "check the key"],
    );
    refuses(
        &variable("key = \"quadrotor.alpha.referense.x_0_m\", lower = 1, upper = 9, start = 5"),
        &["referense"],
    );
    refuses(
        &variable("key = \"quadrotor.bravo.reference.x_0_m\", lower = 1, upper = 9, start = 5"),
        &["optimise.variables", "no `bravo`", "alpha"],
    );
    refuses("optimise.budget=0", &["optimise.budget must be at least 1"]);
    refuses("optimise.station=nobody", &["nobody", "station"]);
    refuses("optimise.quadrotor=station", &["unknown quadrotor \"station\""]);
    refuses("optimise.weights.range=-1", &["range"]);
    refuses("optimise.weights.charm=1", &["charm"]);
    folder
        .run(&["optimise", &ready("hover")])
        .exits(2)
        .says(&["the table [optimise] is missing"]);
    // Every flight falls at once.
    let falls = "quadrotor.alpha.command_offsets=[{ from_s = 0, duty = [-1, -1, -1, -1] }]";
    optimise(
        &folder,
        "falls",
        &[
            "--set",
            falls,
            "--set",
            "optimise.budget=4",
            "--set",
            "quadrotor.alpha.reference.z_0_m=-1.5",
        ],
    )
    .exits(2)
    .says(&["all 4 flights failed"]);
}
