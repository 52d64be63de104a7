//! The CSV files: their columns, units, and the ranges in which a number is physically possible; and what was commanded.

use crate::output::Answer;
use nalgebra::Vector3;
use std::error::Error;
use std::fs::File;
use std::io::{self, Read};
use std::ops::ControlFlow;
use std::path::Path;
use sysid::centre_of_mass::Placing;
use sysid::load_cell::Sample;
use sysid::measurement::{Column, Layout, Table, read, scan};
use sysid::pendulum::AngleSample;
use sysid::recorded::InertialLog;
use sysid::rotor_dynamics::DynamicSample;
use sysid::rotor_static::StaticSample;

const TIME: Column = Column::new("time_s", "s", 0.0, 1e6);
const STAND: [Column; 5] = [
    Column::commanded("duty", "1", 0.0, 1.0),
    Column::new("battery_voltage_v", "V", 0.1, 100.0),
    Column::new("thrust_n", "N", -50.0, 500.0),
    Column::new("torque_n_m", "N m", -10.0, 50.0),
    Column::new("speed_rad_s", "rad/s", 0.0, 1e4),
];
const SWING: [Column; 2] = [TIME, Column::new("angle_rad", "rad", -3.2, 3.2)];
const READING: Column = Column::new("reading_v", "V", -100.0, 100.0);
const FORCES: [Column; 2] = [Column::commanded("load_n", "N", -1e4, 1e4), READING];
const TORQUES: [Column; 2] = [Column::commanded("load_n_m", "N m", -1e3, 1e3), READING];
/// Twenty times the standard gravity, and faster than any gyroscope on a chip.
const FLIGHT: [Column; 12] = [
    TIME,
    Column::new("force_x_m_s2", "m/s²", -200.0, 200.0),
    Column::new("force_y_m_s2", "m/s²", -200.0, 200.0),
    Column::new("force_z_m_s2", "m/s²", -200.0, 200.0),
    Column::new("rate_x_rad_s", "rad/s", -70.0, 70.0),
    Column::new("rate_y_rad_s", "rad/s", -70.0, 70.0),
    Column::new("rate_z_rad_s", "rad/s", -70.0, 70.0),
    Column::commanded("duty_1", "1", 0.0, 1.0),
    Column::commanded("duty_2", "1", 0.0, 1.0),
    Column::commanded("duty_3", "1", 0.0, 1.0),
    Column::commanded("duty_4", "1", 0.0, 1.0),
    Column::new("battery_voltage_v", "V", 0.1, 100.0),
];
const PLACINGS: [Column; 13] = [
    Column::commanded("orientation", "1", 0.0, 1000.0),
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

/// What a file says in place of a path for standard input.
const STANDARD_INPUT: &str = "-";

type Samples<T> = Result<Vec<T>, Box<dyn Error>>;

/// Whether a path stands for standard input.
pub(crate) fn is_standard(path: &Path) -> bool {
    path.as_os_str() == STANDARD_INPUT
}

fn open(path: &Path) -> io::Result<Box<dyn Read>> {
    if is_standard(path) {
        Ok(Box::new(io::stdin().lock()))
    } else {
        Ok(Box::new(File::open(path)?))
    }
}

/// The wanted columns of a file; what the reader noticed goes to the answer at once, since a fit may be refused for it.
fn table(path: &Path, layout: &Layout<'_>, answer: &mut Answer) -> Result<Table, Box<dyn Error>> {
    let named = |e: &dyn std::fmt::Display| format!("{}: {e}", path.display());
    let table = read(open(path).map_err(|e| named(&e))?, layout).map_err(|e| named(&e))?;
    answer
        .warnings
        .extend(table.remarks.iter().map(|remark| named(remark)));
    Ok(table)
}

fn rows<T>(
    path: &Path,
    layout: &Layout<'_>,
    answer: &mut Answer,
    row: impl Fn(&dyn Fn(usize) -> f64) -> T,
) -> Samples<T> {
    let table = table(path, layout, answer)?;
    Ok((0..table.rows())
        .map(|i| row(&|column| table.column(column)[i]))
        .collect())
}

pub(crate) fn placings(path: &Path, answer: &mut Answer) -> Samples<Placing> {
    rows(path, &Layout::table(&PLACINGS), answer, |at| Placing {
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

pub(crate) fn swing(path: &Path, answer: &mut Answer) -> Samples<AngleSample> {
    let layout = Layout::timed(&SWING, LONGEST_STEP_S);
    rows(path, &layout, answer, |at| AngleSample {
        time_s: at(0),
        angle_rad: at(1),
    })
}

pub(crate) fn sweep(path: &Path, answer: &mut Answer) -> Samples<StaticSample> {
    rows(path, &Layout::table(&STAND), answer, |at| StaticSample {
        duty: at(0),
        battery_voltage_v: at(1),
        thrust_n: at(2),
        torque_n_m: at(3),
        speed_rad_s: at(4),
    })
}

pub(crate) fn response(path: &Path, answer: &mut Answer) -> Samples<DynamicSample> {
    let columns = [TIME, STAND[0], STAND[1], STAND[2], STAND[3], STAND[4]];
    let layout = Layout::timed(&columns, LONGEST_STEP_S);
    rows(path, &layout, answer, |at| DynamicSample {
        time_s: at(0),
        duty: at(1),
        battery_voltage_v: at(2),
        thrust_n: at(3),
        torque_n_m: at(4),
        speed_rad_s: at(5),
    })
}

/// What a load cell measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Cell {
    Force,
    Torque,
}

pub(crate) fn loads(path: &Path, cell: Cell, answer: &mut Answer) -> Samples<Sample> {
    let columns = match cell {
        Cell::Force => &FORCES,
        Cell::Torque => &TORQUES,
    };
    rows(path, &Layout::table(columns), answer, |at| Sample {
        load: at(0),
        reading_v: at(1),
    })
}

/// A flight as its file gives it.
pub(crate) struct Recorded {
    /// Inertial unit and commands.
    pub(crate) log: InertialLog,
    /// Battery voltage at each sample, V, if the file has it.
    pub(crate) voltage: Option<Vec<f64>>,
}

/// The part of a flight that is kept, s on the file's clock.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Part {
    from_s: f64,
    to_s: f64,
}

/// What is kept before the part and after it, s: the lag's memory of what was before is a hundred of its time constants long at most.
const MARGIN_S: f64 = 10.0;

/// Most rows of a part: half an hour at 1 kHz, 0.2 GB.
const MOST_ROWS: usize = 2_000_000;

impl Part {
    /// From one time to another, s, with what is to be known around them; all where there is none.
    pub(crate) fn of(from_s: Option<f64>, to_s: Option<f64>) -> Self {
        Self {
            from_s: from_s.map_or(f64::NEG_INFINITY, |from_s| from_s - MARGIN_S),
            to_s: to_s.map_or(f64::INFINITY, |to_s| to_s + MARGIN_S),
        }
    }

    /// Whether a row at this time, s, is kept beside so many others; a break where none is from here on.
    ///
    /// # Errors
    /// More rows than are kept.
    pub(crate) fn keeps(&self, time_s: f64, others: usize) -> ControlFlow<Result<(), String>, bool> {
        if time_s > self.to_s {
            return ControlFlow::Break(Ok(()));
        }
        if time_s < self.from_s {
            return ControlFlow::Continue(false);
        }
        if others >= MOST_ROWS {
            return ControlFlow::Break(Err(format!(
                "the part has more than {MOST_ROWS} rows: choose a shorter one with --from and --to"
            )));
        }
        ControlFlow::Continue(true)
    }
}

/// The part of a flight from a CSV file, its commands as raw duty. Rows outside it are read and checked, not held; those after it are not read.
pub(crate) fn flight(path: &Path, part: Part, answer: &mut Answer) -> Result<Recorded, Box<dyn Error>> {
    let named = |e: &dyn std::fmt::Display| format!("{}: {e}", path.display());
    let mut log = InertialLog {
        time: Vec::new(),
        specific_force: Vec::new(),
        body_rates: Vec::new(),
        commands: Vec::new(),
        remarks: Vec::new(),
    };
    let (mut voltage, mut end) = (Vec::new(), Ok(()));
    let mut seen: Option<(f64, f64)> = None;
    let layout = Layout::timed(&FLIGHT, LONGEST_STEP_S);
    let scan = scan(open(path).map_err(|e| named(&e))?, &layout, |row| {
        let v = row.values;
        seen = Some((seen.map_or(v[0], |(first, _)| first), v[0]));
        match part.keeps(v[0], log.time.len()) {
            ControlFlow::Break(why) => {
                end = why;
                return ControlFlow::Break(());
            }
            ControlFlow::Continue(false) => return ControlFlow::Continue(()),
            ControlFlow::Continue(true) => {}
        }
        log.time.push(v[0]);
        log.specific_force.push(Vector3::new(v[1], v[2], v[3]));
        log.body_rates.push(Vector3::new(v[4], v[5], v[6]));
        log.commands.push([v[7], v[8], v[9], v[10]]);
        voltage.push(v[11]);
        ControlFlow::Continue(())
    })
    .map_err(|e| named(&e))?;
    end.map_err(|why| named(&why))?;
    answer
        .warnings
        .extend(scan.remarks.iter().map(|remark| named(remark)));
    if log.time.is_empty() {
        let (first, last) = seen.unwrap_or_default();
        let why = format!("no row is within --from and --to; rows read have times from {first} to {last} s");
        return Err(named(&why).into());
    }
    Ok(Recorded {
        log,
        voltage: Some(voltage),
    })
}
