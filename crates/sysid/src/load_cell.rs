//! Calibration of a load cell: the line from load to reading, whether it is one, and back from readings to loads.
//!
//! ```text
//! y = a + s x + noise,   u = x − x̄:   y = a' + s u,   is q of y = a'' + s u + q u² significant?
//! x̂ = (ȳ_0 − a) / s,   g = t² σ² / (s² S_xx)
//! interval:  x̂ + (g (x̂ − x̄) ± (t σ / s) √((1/m + 1/n)(1 − g) + (x̂ − x̄)²/S_xx)) / (1 − g)        (Fieller)
//! ```
//!
//! with loads x known (dead weights, on an arm for torque), m readings of mean ȳ_0, σ the residual standard deviation, t of
//! Student's distribution. Assumptions: noise independent from reading to reading, of equal variance; weights exact (a
//! common error of all weights is in no interval). Where weights are uncertain: [`crate::regression::total`].
//! Source: Draper and Smith, *Applied Regression Analysis*, section on inverse regression; Fieller, *Some problems in interval
//! estimation*, Journal of the Royal Statistical Society B 16, 1954. Thesis, appendix E.1 (that cells are calibrated by lines).

use crate::estimate::{CONFIDENCE, Estimate, Fit, Interval, Warning};
use crate::lack_of_fit::LackOfFit;
use crate::regression::{FitError, Row, linear};
use crate::residual::CORRELATED_BELOW;
use serde::{Deserialize, Serialize};

/// A sample of a thrust cell: a row of a CSV file.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ThrustSample {
    /// Load, N, positive as thrust is.
    pub load_n: f64,
    /// Reading, V.
    pub reading_v: f64,
}

/// A sample of a torque cell: a row of a CSV file.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TorqueSample {
    /// Load, N m, positive clockwise seen from above.
    pub load_n_m: f64,
    /// Reading, V.
    pub reading_v: f64,
}

impl From<Sample> for ThrustSample {
    fn from(sample: Sample) -> Self {
        Self {
            load_n: sample.load,
            reading_v: sample.reading_v,
        }
    }
}

impl From<Sample> for TorqueSample {
    fn from(sample: Sample) -> Self {
        Self {
            load_n_m: sample.load,
            reading_v: sample.reading_v,
        }
    }
}

/// A load, N or N m, and the reading, V.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Load, N or N m.
    pub load: f64,
    /// Reading, V.
    pub reading_v: f64,
}

impl From<ThrustSample> for Sample {
    fn from(sample: ThrustSample) -> Self {
        Self {
            load: sample.load_n,
            reading_v: sample.reading_v,
        }
    }
}

impl From<TorqueSample> for Sample {
    fn from(sample: TorqueSample) -> Self {
        Self {
            load: sample.load_n_m,
            reading_v: sample.reading_v,
        }
    }
}

/// A calibrated cell.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    /// Zero a, V, and sensitivity s, V per N or N m, with their intervals; residuals in V.
    pub line: Fit<2>,
    /// Whether the line is one.
    pub linearity: Linearity,
    /// Smallest load, N or N m.
    pub smallest_load: f64,
    /// Largest load, N or N m.
    pub largest_load: f64,
    /// Mean load x̄ and `S_xx = Σ (x − x̄)²`.
    mean_load: f64,
    spread: f64,
}

/// Two tests of a straight line.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Linearity {
    /// Quadratic term q, V per squared load.
    pub quadratic: Estimate,
    /// Probability of a quadratic term as large by chance if the cell is linear.
    pub p_value: f64,
    /// Largest departure of the parabola from the line over the loads, as a share of the span of the readings.
    pub departure: f64,
    /// Whether loads miss the line by more than repeated readings scatter; `None` without repetitions.
    pub lack_of_fit: Option<LackOfFit>,
}

impl Linearity {
    /// Whether neither test rejects the line, at the level of one false alarm in a thousand each.
    pub fn is_straight(&self) -> bool {
        let fits = self.lack_of_fit.is_none_or(|test| !test.is_significant());
        self.p_value >= CORRELATED_BELOW && fits
    }
}

/// From readings to loads along a line, `x = x̄ + (y − ȳ)/s`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conversion {
    /// Load x̄, N or N m, in the middle of the calibration.
    pub mean_load: f64,
    /// Reading ȳ at this load, V.
    pub mean_reading_v: f64,
    /// Sensitivity s, V per N or N m.
    pub sensitivity: f64,
}

impl Conversion {
    /// The load, N or N m, under a reading, V.
    pub fn load(&self, reading_v: f64) -> f64 {
        self.mean_load + (reading_v - self.mean_reading_v) / self.sensitivity
    }
}

/// A load found from readings.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundLoad {
    /// Load, N or N m, with its standard error to first order: of the line and of the readings together.
    pub load: Estimate,
    /// The 95 % interval by Fieller, not symmetric about the load where the slope is uncertain.
    pub interval: Interval,
    /// What a reader must know before using the numbers.
    pub warnings: Vec<Warning>,
}

/// Why a calibration or a load was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LoadCellError {
    /// Too few different loads for a line and a test of it.
    #[error(
        "a calibration needs at least 3 different loads (better 5) to distinguish a line from a curve, got {loads}"
    )]
    TooFewLoads {
        /// How many there are.
        loads: usize,
    },
    /// A load beyond the cell.
    #[error(
        "sample {index} (counted from 0): the load must be within the cell's capacity, {capacity}, got {load}; is it in grams?"
    )]
    Overload {
        /// Place in the order of the data.
        index: usize,
        /// The load, N or N m.
        load: f64,
        /// Capacity of the cell, N or N m.
        capacity: f64,
    },
    /// The cell hardly answers.
    #[error(
        "the readings do not follow the load: a sensitivity of {sensitivity} ± {half_width} V per unit is not distinct from zero; is \
         the cell connected?"
    )]
    NoResponse {
        /// Slope, V per N or N m.
        sensitivity: f64,
        /// Half of its 95 % interval.
        half_width: f64,
    },
    /// No reading, or one that is not finite.
    #[error("a load needs at least one reading, and finite readings only")]
    NoReading,
    /// An invalid capacity.
    #[error("a cell's capacity must be positive and finite, got {capacity}")]
    Capacity {
        /// The value given, N or N m.
        capacity: f64,
    },
    /// The fit was refused.
    #[error(transparent)]
    Fit(#[from] FitError),
}

/// Overload that a cell is believed to bear.
const OVERLOAD: f64 = 1.5;
/// Lags of the whiteness test.
const LAGS: usize = 8;

/// Calibrates a cell from samples in the order in which they were taken (a drift shows in their residuals).
///
/// # Errors
/// See [`LoadCellError`].
pub fn calibrate(samples: &[Sample], capacity: f64) -> Result<Calibration, LoadCellError> {
    if !(capacity.is_finite() && capacity > 0.0) {
        return Err(LoadCellError::Capacity { capacity });
    }
    if let Some(index) = samples
        .iter()
        .position(|s| !(s.load.is_finite() && s.reading_v.is_finite()))
    {
        return Err(FitError::NotFinite { index }.into());
    }
    if let Some(index) = samples.iter().position(|s| s.load.abs() > OVERLOAD * capacity) {
        return Err(LoadCellError::Overload {
            index,
            load: samples[index].load,
            capacity,
        });
    }
    let mut loads: Vec<f64> = samples.iter().map(|s| s.load).collect();
    loads.sort_unstable_by(f64::total_cmp);
    loads.dedup();
    let (Some(&smallest_load), Some(&largest_load), 3..) = (loads.first(), loads.last(), loads.len()) else {
        return Err(LoadCellError::TooFewLoads { loads: loads.len() });
    };
    let rows = |s: &Sample| Row {
        regressors: [1.0, s.load],
        y: s.reading_v,
    };
    let mut line = linear(&samples.iter().map(rows).collect::<Vec<_>>())?.with_whiteness_checked(LAGS);
    let slope = line.parameters[1];
    if slope.interval().contains(0.0) {
        return Err(LoadCellError::NoResponse {
            sensitivity: slope.value,
            half_width: slope.half_width(),
        });
    }
    let mean_load = samples.iter().map(|s| s.load).sum::<f64>() / samples.len() as f64;
    let linearity = linearity(samples, &line, mean_load, smallest_load..=largest_load)?;
    if !linearity.is_straight() {
        line.warnings.push(Warning::NotStraight {
            departure: linearity.departure,
        });
    }
    line.warnings.extend(saturated(samples));
    Ok(Calibration {
        line,
        linearity,
        smallest_load,
        largest_load,
        mean_load,
        spread: samples.iter().map(|s| (s.load - mean_load).powi(2)).sum(),
    })
}

fn linearity(
    samples: &[Sample],
    line: &Fit<2>,
    mean_load: f64,
    range: std::ops::RangeInclusive<f64>,
) -> Result<Linearity, LoadCellError> {
    let rows = |s: &Sample| {
        let u = s.load - mean_load;
        Row {
            regressors: [1.0, u, u * u],
            y: s.reading_v,
        }
    };
    let parabola = linear(&samples.iter().map(rows).collect::<Vec<_>>())?;
    let quadratic = parabola.parameters[2];
    let [zero, slope] = line.values();
    let [a, b, c] = parabola.values();
    let departure = |x: f64| {
        let u = x - mean_load;
        (a + b * u + c * u * u - zero - slope * x).abs()
    };
    // A parabola departs most from a line at the ends or where its slope is the line's.
    let touching = mean_load + (slope - b) / (2.0 * c);
    let places = [*range.start(), *range.end(), touching];
    let inside = places.into_iter().filter(|x| range.contains(x));
    let span = (slope * (range.end() - range.start())).abs();
    let loads: Vec<f64> = samples.iter().map(|s| s.load).collect();
    Ok(Linearity {
        quadratic,
        p_value: quadratic.p_value_of_zero(),
        departure: inside.map(departure).fold(0.0, f64::max) / span,
        lack_of_fit: LackOfFit::test(&line.residuals, &loads, 2),
    })
}

/// Different loads with the same reading at an end of the readings: the amplifier's limit.
fn saturated(samples: &[Sample]) -> Option<Warning> {
    let limits = [f64::min, f64::max].map(|pick| samples.iter().map(|s| s.reading_v).reduce(pick));
    let at = |limit: f64| samples.iter().filter(move |s| s.reading_v == limit);
    let flat = |limit: &f64| {
        let mut loads = at(*limit).map(|s| s.load);
        loads.next().is_some_and(|first| loads.any(|load| load != first))
    };
    let limit = limits.into_iter().flatten().find(flat)?;
    Some(Warning::Saturated {
        samples: at(limit).count(),
        limit,
    })
}

impl Calibration {
    /// Zero a, V.
    pub fn zero(&self) -> Estimate {
        self.line.parameters[0]
    }

    /// Sensitivity s, V per N or N m.
    pub fn sensitivity(&self) -> Estimate {
        self.line.parameters[1]
    }

    /// Mean reading at a load, V, with the uncertainty of the line alone: the band of a plot.
    pub fn reading(&self, load: f64) -> Estimate {
        let [zero, slope] = self.line.values();
        self.line.propagated(zero + slope * load, &[1.0, load])
    }

    /// The line as it converts many readings, whose noise is judged elsewhere.
    pub fn conversion(&self) -> Conversion {
        let [zero, sensitivity] = self.line.values();
        Conversion {
            mean_load: self.mean_load,
            mean_reading_v: zero + sensitivity * self.mean_load,
            sensitivity,
        }
    }

    /// The line one standard error off, in height and in slope: `ȳ + σ/√n` and `s + σ/√S_xx`, which are independent.
    ///
    /// The error of the line is common to all readings that it converts. What is computed from them has, on top of their noise,
    /// the variance of its two changes when it is computed with these lines, squared and added. Degrees of freedom are the
    /// line's.
    pub fn one_error_off(&self) -> [Conversion; 2] {
        let line = self.conversion();
        let sigma = self.line.goodness.standard_deviation;
        let n = self.line.residuals.len() as f64;
        [
            Conversion {
                mean_reading_v: line.mean_reading_v + sigma / n.sqrt(),
                ..line
            },
            Conversion {
                sensitivity: line.sensitivity + sigma / self.spread.sqrt(),
                ..line
            },
        ]
    }

    /// The load under which these readings were taken, N or N m.
    ///
    /// # Errors
    /// No reading, or one that is not finite.
    pub fn load(&self, readings_v: &[f64]) -> Result<FoundLoad, LoadCellError> {
        let m = readings_v.len() as f64;
        let mean = readings_v.iter().sum::<f64>() / m;
        if !mean.is_finite() {
            return Err(LoadCellError::NoReading);
        }
        let [zero, slope] = self.line.values();
        let n = self.line.residuals.len() as f64;
        let sigma = self.line.goodness.standard_deviation;
        let load = (mean - zero) / slope;
        let from_mean = load - self.mean_load;
        let leverage = from_mean * from_mean / self.spread;
        let estimate = Estimate {
            value: load,
            standard_error: sigma / slope.abs() * (1.0 / m + 1.0 / n + leverage).sqrt(),
            degrees_of_freedom: n - 2.0,
        };
        let t = Estimate::quantile(0.5 + 0.5 * CONFIDENCE, n - 2.0);
        let g = (t * sigma / slope).powi(2) / self.spread;
        // g < 1: `calibrate` refuses a slope whose interval contains zero.
        let centre = load + from_mean * g / (1.0 - g);
        let half = t * sigma / slope.abs() * ((1.0 / m + 1.0 / n) * (1.0 - g) + leverage).sqrt() / (1.0 - g);
        let beyond = !(self.smallest_load..=self.largest_load).contains(&load);
        Ok(FoundLoad {
            load: estimate,
            interval: Interval {
                lower: centre - half,
                upper: centre + half,
            },
            warnings: beyond
                .then_some(Warning::Extrapolated {
                    value: load,
                    from: self.smallest_load,
                    to: self.largest_load,
                })
                .into_iter()
                .collect(),
        })
    }
}

#[cfg(test)]
mod tests;
