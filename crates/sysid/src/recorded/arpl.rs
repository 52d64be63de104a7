//! The ARPL Crazyflie flights: inertial unit and motor commands at 1 kHz.
//!
//! | column | unit, frame | from |
//! | --- | --- | --- |
//! | `t[s]` | s, since the start of the vehicle | header |
//! | `acc_x[g]`, `acc_y[g]`, `acc_z[g]` | specific force, g, forward-left-up | header; +1 in z at rest |
//! | `gyro_x[deg/s]`, ... | rates, deg/s, forward-left-up | header |
//! | `m1[0..65535]`, `m2`, `m3`, `m4` | motor commands, 65535 for full duty; 1 front right, 2 rear right, 3 rear left, 4 front left | header; order after the firmware's `power_distribution_quadrotor.c` |
//!
//! Source: J. Eschmann, D. Albani, G. Loianno, *Data-driven system identification of quadrotors subject to motor delays*,
//! arXiv:2404.07837, 2024.

use super::frames::half_turn;
use super::{FULL_COMMAND, InertialLog, STANDARD_GRAVITY};
use crate::measurement::{Column, Layout, ReadError, read};
use nalgebra::Vector3;
use std::io::Read;

/// Ranges of the inertial unit (Bosch BMI088 at ±24 g and ±2000 deg/s) and of the commands.
const COLUMNS: [Column; 11] = [
    Column::new("t[s]", "s", 0.0, 1e6),
    Column::new("acc_x[g]", "g", -24.0, 24.0),
    Column::new("acc_y[g]", "g", -24.0, 24.0),
    Column::new("acc_z[g]", "g", -24.0, 24.0),
    Column::new("gyro_x[deg/s]", "deg/s", -2000.0, 2000.0),
    Column::new("gyro_y[deg/s]", "deg/s", -2000.0, 2000.0),
    Column::new("gyro_z[deg/s]", "deg/s", -2000.0, 2000.0),
    Column::commanded("m1[0..65535]", "of 65535", 0.0, FULL_COMMAND),
    Column::commanded("m2", "of 65535", 0.0, FULL_COMMAND),
    Column::commanded("m3", "of 65535", 0.0, FULL_COMMAND),
    Column::commanded("m4", "of 65535", 0.0, FULL_COMMAND),
];

/// Two lost samples at 1 kHz.
const LONGEST_STEP: f64 = 3.5e-3;

/// Reads one flight of the set.
///
/// # Errors
/// As [`read`].
pub fn read_arpl(input: impl Read) -> Result<InertialLog, ReadError> {
    let table = read(input, &Layout::timed(&COLUMNS, LONGEST_STEP))?;
    let vector =
        |first: usize, k: usize| half_turn(Vector3::from_fn(|axis, _| table.column(first + axis)[k]));
    let rows = 0..table.rows();
    Ok(InertialLog {
        time: table.column(0).to_vec(),
        specific_force: rows.clone().map(|k| vector(1, k) * STANDARD_GRAVITY).collect(),
        body_rates: rows.clone().map(|k| vector(4, k).map(f64::to_radians)).collect(),
        commands: rows
            .map(|k| std::array::from_fn(|i| table.column(7 + i)[k] / FULL_COMMAND))
            .collect(),
        remarks: table.remarks,
    })
}
