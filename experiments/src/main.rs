//! Draws the figures and tables of the study and checks their claims; see `experiments --help`.

use std::process::ExitCode;

fn main() -> ExitCode {
    experiments::cli::main()
}
