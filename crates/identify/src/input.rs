//! The CSV files: their columns, units, and the ranges in which a number is physically possible.

use crate::output::Answer;
use std::error::Error;
use std::fs::{self, File};
use std::path::Path;
use sysid::centre_of_mass::Placing;
use sysid::load_cell::Sample;
use sysid::measurement::{Column, Layout, Table, read};
use sysid::pendulum::AngleSample;
use sysid::rotor_dynamics::DynamicSample;
use sysid::rotor_static::StaticSample;

const TIME: Column = Column::new("time_s", "s", 0.0, 1e6);
const STAND: [Column; 5] = [
    Column::new("duty", "1", 0.0, 1.0),
    Column::new("battery_voltage_v", "V", 0.1, 100.0),
    Column::new("thrust_n", "N", -50.0, 500.0),
    Column::new("torque_n_m", "N m", -10.0, 50.0),
    Column::new("speed_rad_s", "rad/s", 0.0, 1e4),
];
const SWING: [Column; 2] = [TIME, Column::new("angle_rad", "rad", -3.2, 3.2)];
const LOADS: [Column; 2] = [
    Column::new("load_n", "N", -1e4, 1e4),
    Column::new("reading_v", "V", -100.0, 100.0),
];
const PLACINGS: [Column; 13] = [
    Column::new("orientation", "1", 0.0, 1000.0),
    Column::new("x_1_m", "m", -20.0, 20.0),
    Column::new("y_1_m", "m", -20.0, 20.0),
    Column::new("z_1_m", "m", -20.0, 20.0),
    Column::new("force_1_n", "N", 0.0, 1e5),
    Column::new("x_2_m", "m", -20.0, 20.0),
    Column::new("y_2_m", "m", -20.0, 20.0),
    Column::new("z_2_m", "m", -20.0, 20.0),
    Column::new("force_2_n", "N", 0.0, 1e5),
    Column::new("x_3_m", "m", -20.0, 20.0),
    Column::new("y_3_m", "m", -20.0, 20.0),
    Column::new("z_3_m", "m", -20.0, 20.0),
    Column::new("force_3_n", "N", 0.0, 1e5),
];
/// Longest step of a record that is no gap, s: twice the slowest sampling that makes sense, 20 Hz.
const LONGEST_STEP_S: f64 = 0.1;

type Read<T> = Result<(Vec<T>, Answer), Box<dyn Error>>;

/// The text of a file, with its name in the error.
pub(crate) fn text(path: &Path) -> Result<String, Box<dyn Error>> {
    fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()).into())
}

fn rows<T>(path: &Path, layout: &Layout<'_>, row: impl Fn(&dyn Fn(usize) -> f64) -> T) -> Read<T> {
    let named = |e: &dyn std::fmt::Display| format!("{}: {e}", path.display());
    let table: Table = read(File::open(path).map_err(|e| named(&e))?, layout).map_err(|e| named(&e))?;
    let samples = (0..table.rows())
        .map(|i| row(&|column| table.column(column)[i]))
        .collect();
    let answer = Answer {
        warnings: table.remarks.iter().map(|remark| named(remark)).collect(),
        ..Answer::default()
    };
    Ok((samples, answer))
}

pub(crate) fn placings(path: &Path) -> Read<Placing> {
    rows(path, &Layout::table(&PLACINGS), |at| Placing {
        orientation: at(0) as u32,
        x_1_m: at(1),
        y_1_m: at(2),
        z_1_m: at(3),
        force_1_n: at(4),
        x_2_m: at(5),
        y_2_m: at(6),
        z_2_m: at(7),
        force_2_n: at(8),
        x_3_m: at(9),
        y_3_m: at(10),
        z_3_m: at(11),
        force_3_n: at(12),
    })
}

pub(crate) fn swing(path: &Path) -> Read<AngleSample> {
    rows(path, &Layout::timed(&SWING, LONGEST_STEP_S), |at| AngleSample {
        time_s: at(0),
        angle_rad: at(1),
    })
}

pub(crate) fn sweep(path: &Path) -> Read<StaticSample> {
    rows(path, &Layout::table(&STAND), |at| StaticSample {
        duty: at(0),
        battery_voltage_v: at(1),
        thrust_n: at(2),
        torque_n_m: at(3),
        speed_rad_s: at(4),
    })
}

pub(crate) fn response(path: &Path) -> Read<DynamicSample> {
    let columns = [TIME, STAND[0], STAND[1], STAND[2], STAND[3], STAND[4]];
    rows(path, &Layout::timed(&columns, LONGEST_STEP_S), |at| {
        DynamicSample {
            time_s: at(0),
            duty: at(1),
            battery_voltage_v: at(2),
            thrust_n: at(3),
            torque_n_m: at(4),
            speed_rad_s: at(5),
        }
    })
}

pub(crate) fn loads(path: &Path) -> Read<Sample> {
    rows(path, &Layout::table(&LOADS), |at| Sample {
        load: at(0),
        reading_v: at(1),
    })
}
