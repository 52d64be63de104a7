//! Chores of the repository. `cargo xtask reproduce-figures --help` explains the first one.

mod features;

use std::env;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

const USAGE: &str = "\
usage: cargo xtask <chore> [arguments]

chores:
  features            check that the programs share the builds of their dependencies
  identify            measure, identify and fly the vehicle of the virtual laboratory (--help for its arguments)
  reproduce-figures   draw the figures and tables and check their claims (--help for its arguments)
";

/// Printed before the figure program is built for the first time.
const FIRST_BUILD: &str =
    "building the figure program; this takes some minutes the first time (see README, build times)";

/// Exit code for bad usage.
const BAD_USAGE: u8 = 2;
/// Exit code when a chore could not be started or was killed.
const BROKEN: u8 = 1;

fn main() -> ExitCode {
    let mut arguments = env::args_os().skip(1);
    let chore = arguments.next().unwrap_or_default();
    match chore.to_str() {
        Some("reproduce-figures") => experiments(arguments.collect()),
        Some(identify @ "identify") => {
            let chore = OsString::from(identify);
            experiments(std::iter::once(chore).chain(arguments).collect())
        }
        Some("features") => features::check(&workspace()),
        Some("help" | "--help" | "-h") => {
            print!("{USAGE}");
            ExitCode::SUCCESS
        }
        Some("") => {
            eprint!("error: no chore given\n\n{USAGE}");
            ExitCode::from(BAD_USAGE)
        }
        _ => {
            eprint!("error: unknown chore {chore:?}\n\n{USAGE}");
            ExitCode::from(BAD_USAGE)
        }
    }
}

/// The workspace's manifest: that of the checkout that Cargo runs this in, which may share its build folder with others.
fn workspace() -> PathBuf {
    let xtask = env::var_os("CARGO_MANIFEST_DIR").unwrap_or_else(|| env!("CARGO_MANIFEST_DIR").into());
    Path::new(&xtask).join("../Cargo.toml")
}

/// Whether the figure program has been built.
fn is_built(manifest: &Path) -> bool {
    let target =
        env::var_os("CARGO_TARGET_DIR").map_or_else(|| manifest.with_file_name("target"), PathBuf::from);
    let name = format!("experiments{}", env::consts::EXE_SUFFIX);
    target.join("debug").join(name).exists()
}

/// Builds and runs the package `experiments`, with the same arguments and the same exit code.
fn experiments(arguments: Vec<OsString>) -> ExitCode {
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    if !is_built(&workspace()) {
        eprintln!("{FIRST_BUILD}");
    }
    let status = Command::new(cargo)
        .args(["run", "--package", "experiments", "--manifest-path"])
        .arg(workspace())
        .arg("--")
        .args(arguments)
        .status();
    match status.map(|status| status.code()) {
        Ok(Some(code)) => ExitCode::from(u8::try_from(code).unwrap_or(BROKEN)),
        Ok(None) => ExitCode::from(BROKEN),
        Err(error) => {
            eprintln!("error: cannot run cargo: {error}");
            ExitCode::from(BROKEN)
        }
    }
}
