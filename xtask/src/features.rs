//! Whether programs and tests share the builds of their dependencies: one that two of them ask for with different features is built twice.

use super::BROKEN;
use std::collections::{BTreeMap, BTreeSet};
use std::env;
use std::path::Path;
use std::process::{Command, ExitCode};

/// What is built, by the arguments of `cargo tree`.
const TARGETS: [(&str, &[&str]); 4] = [
    ("experiments", &["--package", "experiments", "--edges", "normal"]),
    ("sifre", &["--package", "sifre-cli", "--edges", "normal"]),
    ("identify", &["--package", "identify", "--edges", "normal"]),
    ("the tests", &["--workspace", "--edges", "normal,dev"]),
];

/// The sets of features with which a package is built: usually one, two where it serves a procedural macro, too.
type Builds = BTreeMap<String, BTreeSet<String>>;

/// Prints every dependency that is built more than once, and succeeds if there is none.
pub(super) fn check(manifest: &Path) -> ExitCode {
    let trees: Result<Vec<String>, String> = TARGETS.iter().map(|target| tree(manifest, target)).collect();
    match trees {
        Ok(trees) => {
            let differences = differences(&trees.iter().map(|tree| builds(tree)).collect::<Vec<_>>());
            differences.iter().for_each(|line| eprintln!("error: {line}"));
            if differences.is_empty() {
                println!(
                    "{} share the builds of their dependencies",
                    TARGETS.map(|(name, _)| name).join(", ")
                );
                ExitCode::SUCCESS
            } else {
                eprintln!("add the missing features to crates/build-features/Cargo.toml");
                ExitCode::from(BROKEN)
            }
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(BROKEN)
        }
    }
}

/// A line for each dependency of a program, `name version|features`.
fn tree(manifest: &Path, (name, selection): &(&str, &[&str])) -> Result<String, String> {
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args([
            "tree",
            "--prefix",
            "none",
            "--no-dedupe",
            "--format",
            "{p}|{f}",
            "--manifest-path",
        ])
        .arg(manifest)
        .args(*selection)
        .output()
        .map_err(|error| format!("cannot run cargo: {error}"))?;
    if output.status.success() {
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    } else {
        Err(format!(
            "cargo tree of {name}: {}",
            String::from_utf8_lossy(&output.stderr).trim_end()
        ))
    }
}

fn builds(tree: &str) -> Builds {
    let mut builds = Builds::new();
    for (package, features) in tree.lines().filter_map(|line| line.split_once('|')) {
        builds
            .entry(package.to_owned())
            .or_default()
            .insert(features.to_owned());
    }
    builds
}

/// Packages that a later target has built with features with which no earlier one did, although an earlier one needs them, too.
fn differences(targets: &[Builds]) -> Vec<String> {
    let mut known = Builds::new();
    let mut lines = Vec::new();
    for ((name, _), builds) in TARGETS.iter().zip(targets) {
        for (package, sets) in builds {
            if let Some(others) = known.get(package)
                && others.is_disjoint(sets)
            {
                let words = |sets: &BTreeSet<String>| {
                    sets.iter()
                        .map(|set| format!("[{set}]"))
                        .collect::<Vec<_>>()
                        .join(" ")
                };
                lines.push(format!(
                    "{package}: {name} needs {}, build-features asks for {}",
                    words(sets),
                    words(others)
                ));
            }
        }
        for (package, sets) in builds {
            known
                .entry(package.clone())
                .or_default()
                .extend(sets.iter().cloned());
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_a_difference_in_features_is_found() {
        let first = builds("serde v1.0.0|alloc,std\nlibc v0.2.1|std\nsyn v2.0.0 (proc-macro)|full\n");
        let same = builds("serde v1.0.0|alloc,std\nserde v1.0.0|alloc,std\nrand v0.10.0|\n");
        let other = builds("libc v0.2.1|extra_traits,std\n");
        assert!(differences(&[first.clone(), same]).is_empty());
        let lines = differences(&[first, other]);
        assert_eq!(
            lines,
            ["libc v0.2.1: sifre needs [extra_traits,std], build-features asks for [std]"]
        );
    }
}
