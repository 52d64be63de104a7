//! The NTNU motor measurements: steps of the speed's set point at 50 Hz, and a static table. No header in either.
//!
//! | file | columns |
//! | --- | --- |
//! | steps | time, s; set point; speed; both in one unit that the source does not state |
//! | table | speed, force, torque, in units that the source does not state (2105, 4, 0.45 suggests rpm, gram-force or N, N cm) |
//!
//! Only ratios and time constants may be taken from them. Source: <https://github.com/ntnu-arl/aerial_gym_simulator>.

use crate::measurement::{Column, Layout, ReadError, Remark, read};
use std::io::Read;

const STEPS: [Column; 3] = [
    Column::new("time", "s", 0.0, 1e6),
    Column::commanded("set point", "(not stated)", -1e5, 1e5),
    Column::new("speed", "(not stated)", -1e5, 1e5),
];
const TABLE: [Column; 3] = [
    Column::new("speed", "(not stated)", 0.0, 1e5),
    Column::new("force", "(not stated)", -1e4, 1e4),
    Column::new("torque", "(not stated)", -1e4, 1e4),
];

/// Two lost samples at 50 Hz.
const LONGEST_STEP: f64 = 0.065;

/// Responses of a motor's speed to steps.
#[derive(Clone, Debug, PartialEq)]
pub struct MotorSteps {
    /// Time, s.
    pub time: Vec<f64>,
    /// Set point of the speed, unit not stated.
    pub set_point: Vec<f64>,
    /// Speed, same unit.
    pub speed: Vec<f64>,
    /// What the reader noticed.
    pub remarks: Vec<Remark>,
}

/// Static force and torque of a motor with propeller.
#[derive(Clone, Debug, PartialEq)]
pub struct MotorTable {
    /// Speed, unit not stated.
    pub speed: Vec<f64>,
    /// Force, unit not stated.
    pub force: Vec<f64>,
    /// Torque, unit not stated.
    pub torque: Vec<f64>,
}

/// Reads the step responses.
///
/// # Errors
/// As [`read`].
pub fn read_motor_steps(input: impl Read) -> Result<MotorSteps, ReadError> {
    let table = read(input, &Layout::timed(&STEPS, LONGEST_STEP).unnamed())?;
    Ok(MotorSteps {
        time: table.column(0).to_vec(),
        set_point: table.column(1).to_vec(),
        speed: table.column(2).to_vec(),
        remarks: table.remarks,
    })
}

/// Reads the static table.
///
/// # Errors
/// As [`read`].
pub fn read_motor_table(input: impl Read) -> Result<MotorTable, ReadError> {
    let table = read(input, &Layout::table(&TABLE).unnamed())?;
    Ok(MotorTable {
        speed: table.column(0).to_vec(),
        force: table.column(1).to_vec(),
        torque: table.column(2).to_vec(),
    })
}
