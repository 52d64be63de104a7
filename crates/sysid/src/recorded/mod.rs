//! Readers of three public data sets, into the project's frames and SI units.
//!
//! | set | reader | gives |
//! | --- | --- | --- |
//! | `arpl_crazyflie_sysid` | [`read_arpl`] | [`InertialLog`]: 1 kHz accelerometer, gyroscope, motor commands |
//! | `nanobench` | [`read_nanobench`] | [`MotionCaptureFlight`]: 100 Hz, the same with motion capture, set points, battery |
//! | `ntnu_motor` | [`read_motor_steps`], [`read_motor_table`] | speed of one motor, forces and torques |
//!
//! Both Crazyflie sets use body axes forward-left-up and, NanoBench, a world with z up. The project's are B
//! forward-right-down and W with z down, so vectors and rates change the sign of y and z, and an attitude becomes
//! `R_WB = D R D` with `D = diag(1, −1, −1)`, which is `[w, x, −y, −z]` for a quaternion ([`frames`]).
//!
//! Where each column's frame and unit come from is said beside its reader; `tests/recorded` holds them to it on the
//! recorded flights (accelerometer at rest, gyroscope against the derivative of the motion capture's attitude, torque of
//! the motors against the angular acceleration). Files and licences: `data/README.md`.

mod arpl;
pub mod frames;
mod nanobench;
mod ntnu;

pub use arpl::read_arpl;
pub use nanobench::{MotionCaptureFlight, read_nanobench};
pub use ntnu::{MotorSteps, MotorTable, read_motor_steps, read_motor_table};

use crate::measurement::Remark;
use nalgebra::Vector3;
use std::ops::Range;

/// What the accelerometers' unit g stands for, m/s²: the value that the reference identification of the ARPL flights and
/// the Crazyflie's firmware (`GRAVITY_MAGNITUDE`) use.
pub const STANDARD_GRAVITY: f64 = 9.81;

/// The full range of the Crazyflie's motor commands, which becomes a duty of 1.
const FULL_COMMAND: f64 = 65535.0;

/// What the inertial unit and the motors of a flight recorded, body axes B (forward, right, down).
#[derive(Clone, Debug, PartialEq)]
pub struct InertialLog {
    /// Time, s; rises from sample to sample.
    pub time: Vec<f64>,
    /// Specific force along B, m/s²: `[0, 0, −g]` at rest on level ground.
    pub specific_force: Vec<Vector3<f64>>,
    /// Body rates `[p, q, r]`, rad/s.
    pub body_rates: Vec<Vector3<f64>>,
    /// Motor commands as duty, 0 to 1, in the order of the vehicle file: front right, rear right, rear left, front left.
    pub commands: Vec<[f64; 4]>,
    /// What the reader noticed.
    pub remarks: Vec<Remark>,
}

impl InertialLog {
    /// The samples with `from ≤ time < to`, s.
    pub fn window(&self, from: f64, to: f64) -> Range<usize> {
        let place = |t: f64| self.time.partition_point(|&s| s < t);
        place(from)..place(to).max(place(from))
    }
}

#[cfg(test)]
mod tests;
