//! The NanoBench flights: a Crazyflie 2.1 under motion capture at 100 Hz.
//!
//! What is read, and what was found out about it (each line has a test on the flights):
//!
//! | column | unit, frame | from |
//! | --- | --- | --- |
//! | `t` | s, Unix time; becomes time since the first row | value |
//! | `px py pz`, `vx vy vz` | m, m/s, world with z up | height at flight; velocity is the derivative of position |
//! | `qx qy qz qw` | attitude of forward-left-up against the world, scalar last, `v_world = q ⊗ v_body ⊗ q*` | gyroscope; specific force turned by it gives the measured acceleration |
//! | `wx_vicon ..` | rad/s, body axes forward-left-up, smoothed | derivative of the attitude: correlation 0.99 with the body components, 0.89 with the world's in yaw |
//! | `imu_acc_x ..` | g, forward-left-up, specific force: +1 in z at rest | at rest |
//! | `imu_gyro_x ..` | rad/s, forward-left-up | derivative of the attitude |
//! | `motor_motor_m1 ..` | 65535 for full duty; order as for ARPL | torque against angular acceleration |
//! | `sp_ctrltarget_x ..` | m, world with z up; zero before take-off and after landing | course |
//! | `pwr_pm_vbat` | V | value |
//!
//! Not read: `roll`, `pitch`, `yaw` repeat the quaternion (Z-Y-X, rad, forward-left-up). `att_stateEstimate_*` is in
//! degrees, and its pitch has the opposite sign of its own quaternion's. `est_stateEstimate_ax ..` is in g without
//! gravity. `sp_ctrltarget_yaw` is zero while flying, so that its unit does not show.
//!
//! The telemetry came by radio in packets of its own rates and was interpolated to 100 Hz by the set's authors: motor
//! commands and inertial unit are samples without anti-aliasing, off by up to some 20 ms against motion capture.
//!
//! Source: S.I. Ullah, J. Baca, *NanoBench*, <https://github.com/syediu/nanobench-iros2026>, 2026.

use super::frames::{half_turn, half_turned_attitude};
use super::{FULL_COMMAND, InertialLog, STANDARD_GRAVITY};
use crate::measurement::{Column, Layout, ReadError, Table, read};
use nalgebra::Vector3;
use quad_kinematics::Quaternion;
use std::io::Read;

/// A room's size, a small vehicle's speed, the ranges of the inertial unit and of a lithium-polymer cell.
const COLUMNS: [Column; 28] = [
    Column::new("t", "s", 0.0, 1e10),
    Column::new("px", "m", -50.0, 50.0),
    Column::new("py", "m", -50.0, 50.0),
    Column::new("pz", "m", -5.0, 50.0),
    Column::new("vx", "m/s", -30.0, 30.0),
    Column::new("vy", "m/s", -30.0, 30.0),
    Column::new("vz", "m/s", -30.0, 30.0),
    Column::new("qx", "-", -1.001, 1.001),
    Column::new("qy", "-", -1.001, 1.001),
    Column::new("qz", "-", -1.001, 1.001),
    Column::new("qw", "-", -1.001, 1.001),
    Column::new("wx_vicon", "rad/s", -100.0, 100.0),
    Column::new("wy_vicon", "rad/s", -100.0, 100.0),
    Column::new("wz_vicon", "rad/s", -100.0, 100.0),
    Column::new("imu_acc_x", "g", -24.0, 24.0),
    Column::new("imu_acc_y", "g", -24.0, 24.0),
    Column::new("imu_acc_z", "g", -24.0, 24.0),
    Column::new("imu_gyro_x", "rad/s", -35.0, 35.0),
    Column::new("imu_gyro_y", "rad/s", -35.0, 35.0),
    Column::new("imu_gyro_z", "rad/s", -35.0, 35.0),
    Column::commanded("motor_motor_m1", "of 65535", 0.0, FULL_COMMAND),
    Column::commanded("motor_motor_m2", "of 65535", 0.0, FULL_COMMAND),
    Column::commanded("motor_motor_m3", "of 65535", 0.0, FULL_COMMAND),
    Column::commanded("motor_motor_m4", "of 65535", 0.0, FULL_COMMAND),
    Column::commanded("sp_ctrltarget_x", "m", -50.0, 50.0),
    Column::commanded("sp_ctrltarget_y", "m", -50.0, 50.0),
    Column::commanded("sp_ctrltarget_z", "m", -5.0, 50.0),
    Column::new("pwr_pm_vbat", "V", 2.0, 5.0),
];

/// One lost sample at 100 Hz is bridged by the set itself; more is a gap.
const LONGEST_STEP: f64 = 0.025;

/// How far a quaternion's length may be from 1: interpolated between samples, a fast turn costs a hundredth.
const UNIT_TOLERANCE: f64 = 0.02;

/// A flight under motion capture: world W north-east-down, body B forward-right-down. North is the laboratory's x.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionCaptureFlight {
    /// Inertial unit and motors; its time, s since the first row, is everybody's.
    pub inertial: InertialLog,
    /// Battery voltage, V.
    pub voltage: Vec<f64>,
    /// Position in W, m, by motion capture.
    pub position: Vec<Vector3<f64>>,
    /// Velocity in W, m/s, by motion capture.
    pub velocity: Vec<Vector3<f64>>,
    /// Attitude of B against W by motion capture.
    pub attitude: Vec<Quaternion<f64>>,
    /// Body rates in B, rad/s, by motion capture, smoothed.
    pub captured_rates: Vec<Vector3<f64>>,
    /// Commanded position in W, m; zero when there is no command.
    pub set_point: Vec<Vector3<f64>>,
}

/// Reads one flight of the set.
///
/// # Errors
/// As [`read`]; a quaternion that is no attitude.
pub fn read_nanobench(input: impl Read) -> Result<MotionCaptureFlight, ReadError> {
    let table = read(input, &Layout::timed(&COLUMNS, LONGEST_STEP))?;
    let vectors = |first: usize, scale: f64| -> Vec<Vector3<f64>> {
        let vector = |k: usize| Vector3::from_fn(|axis, _| table.column(first + axis)[k]);
        (0..table.rows()).map(|k| half_turn(vector(k)) * scale).collect()
    };
    let start = table.column(0)[0];
    Ok(MotionCaptureFlight {
        position: vectors(1, 1.0),
        velocity: vectors(4, 1.0),
        attitude: (0..table.rows())
            .map(|k| attitude(&table, k))
            .collect::<Result<_, _>>()?,
        captured_rates: vectors(11, 1.0),
        set_point: vectors(24, 1.0),
        voltage: table.column(27).to_vec(),
        inertial: InertialLog {
            time: table.column(0).iter().map(|t| t - start).collect(),
            specific_force: vectors(14, STANDARD_GRAVITY),
            body_rates: vectors(17, 1.0),
            commands: (0..table.rows())
                .map(|k| std::array::from_fn(|i| table.column(20 + i)[k] / FULL_COMMAND))
                .collect(),
            remarks: table.remarks.clone(),
        },
    })
}

fn attitude(table: &Table, k: usize) -> Result<Quaternion<f64>, ReadError> {
    let v = Vector3::from_fn(|axis, _| table.column(7 + axis)[k]);
    let w = table.column(10)[k];
    let length = (w * w + v.norm_squared()).sqrt();
    if (length - 1.0).abs() > UNIT_TOLERANCE {
        return Err(ReadError::NoAttitude {
            line: table.line(k),
            length,
        });
    }
    Ok(half_turned_attitude(w, v))
}
