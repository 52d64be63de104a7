//! Where the recorded flights are, and what to do when they are not there.
//!
//! The folder that `QUAD_DATA` names, else `data/external/`. Where nothing names a folder and neither exists, a test says
//! that it was skipped. A folder that was named, or exists, must hold the file: its absence fails the test, so
//! that a build server with the data can't skip unnoticed.

use std::fs::File;
use std::path::PathBuf;

/// The file, or `None` with a printed line when there are no recorded flights on this machine.
pub(crate) fn open(relative: &str) -> Option<File> {
    let own = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/external"));
    let folder = std::env::var_os("QUAD_DATA").map(PathBuf::from);
    let Some(folder) = folder.or_else(|| own.is_dir().then_some(own)) else {
        println!("skipped: no recorded flights (set QUAD_DATA or fill data/external/): {relative}");
        return None;
    };
    let path = folder.join(relative);
    let file = File::open(&path);
    Some(file.unwrap_or_else(|error| panic!("{} should be there: {error}", path.display())))
}

macro_rules! reader {
    ($(#[$doc:meta])* $name:ident, $read:path => $type:ty) => {
        $(#[$doc])*
        pub(crate) fn $name(relative: &str) -> Option<$type> {
            open(relative).map(|file| $read(file).unwrap_or_else(|error| panic!("{relative}: {error}")))
        }
    };
}

reader!(arpl, sysid::recorded::read_arpl => sysid::recorded::InertialLog);
reader!(nanobench, sysid::recorded::read_nanobench => sysid::recorded::MotionCaptureFlight);

pub(crate) const ARPL_THRUST: &str = "arpl_crazyflie_sysid/log10.csv";
pub(crate) const ARPL_ROLL_PITCH: &str = "arpl_crazyflie_sysid/log15.csv";
pub(crate) const ARPL_YAW: &str = "arpl_crazyflie_sysid/log16.csv";
pub(crate) const NANOBENCH: [&str; 3] = [
    "nanobench/B2_circle_slow_rep1.csv",
    "nanobench/B3_figure8_slow_rep1.csv",
    "nanobench/B3_figure8_fast_rep1.csv",
];
