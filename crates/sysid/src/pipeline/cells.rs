//! The load cells of the thrust stand: calibrated first, then every reading goes through their lines.
//!
//! A line's error is common to all readings of a run, and no repetition shows it. A number θ computed from the readings has
//!
//! ```text
//! var θ = var_noise θ + Σ_k (θ(line k one standard error off) − θ)²
//! ```
//!
//! over height and slope of both lines, independent of each other: to first order in the lines' errors. A third term of each cell is its
//! bow: what a data sheet's non-linearity δ allows, a parabola of height within ±δ of capacity, all heights as likely, has the
//! standard uncertainty `δ/√3`; the calibration's line has taken part of it, and the rest stays. Transfer functions do not
//! change when an output is shifted or scaled, so that rotor dynamics has no such terms.
//!
//! Assumptions: exact weights; cells that depart from a line by no more than their data sheets say.
//! Source: Joint Committee for Guides in Metrology, *Guide to the expression of uncertainty in measurement*, 4.3.7 and 5.1.

use crate::estimate::{Estimate, Warning};
use crate::load_cell::{Calibration, Conversion, LoadCellError, Sample, calibrate};
use crate::rotor_dynamics::DynamicSample;
use crate::rotor_static::{StaticError, StaticSample};
use serde::{Deserialize, Serialize};

/// The calibration of a cell as it was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct CellTest {
    /// Capacity of the cell, N or N m.
    pub capacity: f64,
    /// Non-linearity δ of its data sheet: largest departure from a straight line as a share of the capacity; 0 if it does not matter.
    pub non_linearity: f64,
    /// Loads and readings in the order in which they were taken.
    pub samples: Vec<Sample>,
}

/// One steady reading of the stand, forces in volts; a row of a CSV with these columns.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StaticReading {
    /// Raw PWM duty ū.
    pub duty: f64,
    /// Battery voltage, V.
    pub battery_voltage_v: f64,
    /// Thrust cell, V.
    pub thrust_cell_v: f64,
    /// Torque cell, V.
    pub torque_cell_v: f64,
    /// Rotor speed, rad/s.
    pub speed_rad_s: f64,
}

/// One reading of the stand in motion, forces in volts; a row of a CSV with these columns.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DynamicReading {
    /// Time, s.
    pub time_s: f64,
    /// Raw PWM duty ū, held from this reading to the next.
    pub duty: f64,
    /// Battery voltage, V.
    pub battery_voltage_v: f64,
    /// Thrust cell, V.
    pub thrust_cell_v: f64,
    /// Torque cell, V.
    pub torque_cell_v: f64,
    /// Rotor speed, rad/s.
    pub speed_rad_s: f64,
}

/// The calibrated cells.
#[derive(Clone, Debug, PartialEq)]
pub struct Cells {
    /// Thrust.
    pub thrust: Calibration,
    /// Torque.
    pub torque: Calibration,
    bows: [Bow; 2],
}

/// What a bow of one standard uncertainty leaves of itself when a line has been drawn through it over the calibration's loads:
/// `b(x) = c (x² − x̄² − k (x − x̄))`, with the mean of squares `x̄²`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Bow {
    /// c, per N or N m.
    curvature: f64,
    mean: f64,
    mean_of_squares: f64,
    /// Slope k of the line through x².
    slope: f64,
}

impl Bow {
    /// No bow.
    const NONE: Self = Self {
        curvature: 0.0,
        mean: 0.0,
        mean_of_squares: 0.0,
        slope: 0.0,
    };

    /// A parabola `4 δ/√3 x (1 − x/X)`, of which the line takes all but the square.
    fn of(test: &CellTest) -> Self {
        let n = test.samples.len() as f64;
        let mean_of = |f: &dyn Fn(f64) -> f64| test.samples.iter().map(|s| f(s.load)).sum::<f64>() / n;
        let (mean, mean_of_squares) = (mean_of(&|x| x), mean_of(&|x| x * x));
        let spread = mean_of(&|x| (x - mean).powi(2));
        Self {
            curvature: 4.0 * test.non_linearity / 3_f64.sqrt() / test.capacity,
            mean,
            mean_of_squares,
            slope: mean_of(&|x| x * x * (x - mean)) / spread,
        }
    }

    fn at(&self, load: f64) -> f64 {
        self.curvature * (load * load - self.mean_of_squares - self.slope * (load - self.mean))
    }
}

/// How readings become thrust and torque.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Lines {
    thrust: Conversion,
    torque: Conversion,
    /// What is added to thrust and torque for a bow.
    bows: [Bow; 2],
}

impl Lines {
    fn thrust(&self, reading_v: f64) -> f64 {
        let load = self.thrust.load(reading_v);
        load + self.bows[0].at(load)
    }

    fn torque(&self, reading_v: f64) -> f64 {
        let load = self.torque.load(reading_v);
        load + self.bows[1].at(load)
    }
}

/// Part of a calibrated span by which a load may lie beyond it: noise of a rotor at rest.
const BEYOND: f64 = 0.01;

impl Cells {
    /// Calibrates both cells.
    ///
    /// # Errors
    /// As [`calibrate`].
    pub fn calibrated(thrust: &CellTest, torque: &CellTest) -> Result<Self, LoadCellError> {
        Ok(Self {
            thrust: calibrate(&thrust.samples, thrust.capacity)?,
            torque: calibrate(&torque.samples, torque.capacity)?,
            bows: [Bow::of(thrust), Bow::of(torque)],
        })
    }

    fn lines(&self) -> Lines {
        Lines {
            thrust: self.thrust.conversion(),
            torque: self.torque.conversion(),
            bows: [Bow::NONE; 2],
        }
    }

    /// Steady readings as thrust, N, and torque, N m.
    pub fn steady(&self, readings: &[StaticReading]) -> Vec<StaticSample> {
        converted(readings, &self.lines())
    }

    /// Readings in motion as thrust, N, and torque, N m.
    pub fn moving(&self, readings: &[DynamicReading]) -> Vec<DynamicSample> {
        let lines = self.lines();
        let sample = |r: &DynamicReading| DynamicSample {
            time_s: r.time_s,
            duty: r.duty,
            battery_voltage_v: r.battery_voltage_v,
            thrust_n: lines.thrust(r.thrust_cell_v),
            torque_n_m: lines.torque(r.torque_cell_v),
            speed_rad_s: r.speed_rad_s,
        };
        readings.iter().map(sample).collect()
    }

    /// Adds the errors of the lines to numbers found from steady readings, which are computed anew with each line a standard
    /// error off.
    pub(super) fn with_errors<const N: usize>(
        &self,
        estimates: [Estimate; N],
        readings: &[StaticReading],
        again: impl Fn(&[StaticSample]) -> Result<[Estimate; N], StaticError>,
    ) -> Result<[Estimate; N], StaticError> {
        let lines = self.lines();
        let [thrust_bow, torque_bow] = self.bows;
        let freedom = |cell: &Calibration| cell.line.goodness.degrees_of_freedom;
        let mut off: Vec<(Lines, f64)> = Vec::with_capacity(6);
        for thrust in self.thrust.one_error_off() {
            off.push((Lines { thrust, ..lines }, freedom(&self.thrust)));
        }
        for torque in self.torque.one_error_off() {
            off.push((Lines { torque, ..lines }, freedom(&self.torque)));
        }
        for bows in [[thrust_bow, Bow::NONE], [Bow::NONE, torque_bow]] {
            off.push((Lines { bows, ..lines }, f64::INFINITY));
        }
        let found = estimates.map(|e| e.value);
        let mut estimates = estimates;
        for (lines, freedom) in off {
            let changed = again(&converted(readings, &lines))?;
            for ((estimate, found), changed) in estimates.iter_mut().zip(found).zip(changed) {
                *estimate = estimate.with_error((changed.value - found).abs(), freedom);
            }
        }
        Ok(estimates)
    }

    /// What must be known of the calibrations, and of steady loads beyond them.
    pub(super) fn warnings(&self, samples: &[StaticSample]) -> Vec<Warning> {
        let column = |load: fn(&StaticSample) -> f64| samples.iter().map(load);
        let beyond = [
            beyond(&self.thrust, column(|s| s.thrust_n)),
            beyond(&self.torque, column(|s| s.torque_n_m)),
        ];
        let lines = [&self.thrust, &self.torque].map(|cell| cell.line.warnings.clone());
        lines
            .concat()
            .into_iter()
            .chain(beyond.into_iter().flatten())
            .collect()
    }
}

fn converted(readings: &[StaticReading], lines: &Lines) -> Vec<StaticSample> {
    let sample = |r: &StaticReading| StaticSample {
        duty: r.duty,
        battery_voltage_v: r.battery_voltage_v,
        thrust_n: lines.thrust(r.thrust_cell_v),
        torque_n_m: lines.torque(r.torque_cell_v),
        speed_rad_s: r.speed_rad_s,
    };
    readings.iter().map(sample).collect()
}

/// The load farthest beyond the calibrated range.
fn beyond(cell: &Calibration, loads: impl Iterator<Item = f64>) -> Option<Warning> {
    let (from, to) = (cell.smallest_load, cell.largest_load);
    let over = |load: f64| (from - load).max(load - to);
    let value = loads.max_by(|a, b| over(*a).total_cmp(&over(*b)))?;
    (over(value) > BEYOND * (to - from)).then_some(Warning::Extrapolated { value, from, to })
}
