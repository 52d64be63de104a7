//! Centre of mass from the forces on three supports, in several orientations.
//!
//! The airframe stands on three level supports. Their forces balance the weight, so the resultant acts through the centre
//! of pressure c in the plane of the supports, and the centre of mass lies straight above it:
//!
//! ```text
//! c = Σ F_i p_i / Σ F_i,   n = (p_2 − p_1) × (p_3 − p_1) / |…|,   (1 − n nᵀ)(r − c) = 0
//! ```
//!
//! along airframe axes. One orientation gives a line; lines of two or more orientations meet in the centre of mass, in the
//! sense of least squares over the distances to all lines:
//!
//! ```text
//! e_1 = (p_2 − p_1)/|p_2 − p_1|,  e_2 = n × e_1:   e_k · r = e_k · c + error,   k = 1, 2
//! ```
//!
//! Assumptions: the three supports are level, so that gravity is along n; the supports carry forces along gravity; errors
//! of the distances are independent from placing to placing and about equal. So the airframe is placed anew for each
//! repetition and its support points are measured anew; an error that never changes (an origin of the airframe axes
//! that is off) is in no interval. With one placing in each of two orientations the method works, but one degree of
//! freedom is left, and the interval shows it.
//!
//! Source: thesis, section 4.3 (method); the equations are elementary statics.

use crate::estimate::{Estimate, Goodness, Warning};
use crate::lack_of_fit::LackOfFit;
use crate::regression::{FitError, Row, linear};
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

/// One placing of the airframe on its three supports: a row of a CSV file.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Placing {
    /// Number of the orientation: placings on the same three points of the airframe share it.
    pub orientation: u32,
    /// First support, along `x_B` (forward), airframe axes, m.
    pub x_1_m: f64,
    /// First support, along `y_B` (right), m.
    pub y_1_m: f64,
    /// First support, along `z_B` (down), m.
    pub z_1_m: f64,
    /// Force of the first support on the airframe, up, N.
    pub force_1_n: f64,
    /// Second support, along `x_B`, m.
    pub x_2_m: f64,
    /// Second support, along `y_B`, m.
    pub y_2_m: f64,
    /// Second support, along `z_B`, m.
    pub z_2_m: f64,
    /// Force of the second support, N.
    pub force_2_n: f64,
    /// Third support, along `x_B`, m.
    pub x_3_m: f64,
    /// Third support, along `y_B`, m.
    pub y_3_m: f64,
    /// Third support, along `z_B`, m.
    pub z_3_m: f64,
    /// Force of the third support, N.
    pub force_3_n: f64,
}

impl Placing {
    /// A placing from its support points, m along airframe axes, and their forces, N.
    pub fn new(orientation: u32, points: &[Vector3<f64>; 3], forces: &[f64; 3]) -> Self {
        let [a, b, c] = points;
        Self {
            orientation,
            x_1_m: a.x,
            y_1_m: a.y,
            z_1_m: a.z,
            force_1_n: forces[0],
            x_2_m: b.x,
            y_2_m: b.y,
            z_2_m: b.z,
            force_2_n: forces[1],
            x_3_m: c.x,
            y_3_m: c.y,
            z_3_m: c.z,
            force_3_n: forces[2],
        }
    }

    /// The support points, m along airframe axes.
    pub fn points(&self) -> [Vector3<f64>; 3] {
        [
            Vector3::new(self.x_1_m, self.y_1_m, self.z_1_m),
            Vector3::new(self.x_2_m, self.y_2_m, self.z_2_m),
            Vector3::new(self.x_3_m, self.y_3_m, self.z_3_m),
        ]
    }

    /// The forces of the supports, N, up.
    pub fn forces(&self) -> [f64; 3] {
        [self.force_1_n, self.force_2_n, self.force_3_n]
    }

    /// Weight: the sum of the forces, N.
    pub fn weight(&self) -> f64 {
        self.forces().iter().sum()
    }

    /// The line of this placing that contains the centre of mass; `index` names the placing in errors.
    ///
    /// # Errors
    /// Numbers that are not finite or of another unit, a support that pulls, supports in a row.
    pub fn line(&self, index: usize) -> Result<Line, CentreOfMassError> {
        let (points, forces) = (self.points(), self.forces());
        let finite = points
            .iter()
            .flat_map(|p| p.iter())
            .chain(&forces)
            .all(|v| v.is_finite());
        if !finite {
            return Err(CentreOfMassError::NotFinite { index });
        }
        if let Some(place_m) = points.iter().map(|p| p.amax()).find(|m| *m > FARTHEST_M) {
            return Err(CentreOfMassError::Position { index, place_m });
        }
        if let Some(support) = forces.iter().position(|f| *f < 0.0) {
            return Err(CentreOfMassError::Pulls {
                index,
                support: support + 1,
                force_n: forces[support],
            });
        }
        let weight_n = self.weight();
        if !(WEIGHTS_N.0..=WEIGHTS_N.1).contains(&weight_n) {
            return Err(CentreOfMassError::Weight { index, weight_n });
        }
        let (a, b) = (points[1] - points[0], points[2] - points[0]);
        let normal = a.cross(&b);
        let sine = normal.norm() / (a.norm() * b.norm());
        // NaN where two points coincide.
        if sine.is_nan() || sine <= LEAST_SINE {
            return Err(CentreOfMassError::InARow { index, sine });
        }
        let centre_of_pressure =
            (points[0] * forces[0] + points[1] * forces[1] + points[2] * forces[2]) / weight_n;
        let direction = normal.normalize();
        let along = a.normalize();
        Ok(Line {
            centre_of_pressure,
            direction,
            across: [along, direction.cross(&along)],
        })
    }
}

/// A line that contains the centre of mass, in airframe axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Centre of pressure c, in the plane of the supports, m.
    pub centre_of_pressure: Vector3<f64>,
    /// Unit vector n square to that plane, along gravity or against it by the order of the supports.
    pub direction: Vector3<f64>,
    /// Two unit vectors in the plane: from support 1 to 2, and square to it.
    across: [Vector3<f64>; 2],
}

impl Line {
    /// From a point to the nearest point of the line, m.
    pub fn offset_from(&self, point: &Vector3<f64>) -> Vector3<f64> {
        let to = self.centre_of_pressure - point;
        to - self.direction * self.direction.dot(&to)
    }

    /// Acute angle to another line, rad.
    pub fn angle_to(&self, other: &Self) -> f64 {
        let cross = self.direction.cross(&other.direction).norm();
        cross.atan2(self.direction.dot(&other.direction).abs())
    }
}

/// The centre of mass and how well the lines agree on it.
#[derive(Clone, Debug, PartialEq)]
pub struct CentreOfMass {
    /// Position r along airframe axes (forward, right, down), m.
    pub position: [Estimate; 3],
    /// Covariance of the position, m².
    pub covariance: Matrix3<f64>,
    /// Weight, N: the mean over the placings, its standard error from their scatter.
    pub weight: Estimate,
    /// The lines, in the order of the placings.
    pub lines: Vec<Line>,
    /// From the centre of mass to each line, m.
    pub residuals: Vec<Vector3<f64>>,
    /// Of the distances, m; without R², which depends on the origin.
    pub goodness: Goodness,
    /// Largest angle between two lines, rad.
    pub angle_rad: f64,
    /// Condition number of the intersection: large where lines are nearly parallel.
    pub condition_number: f64,
    /// Whether orientations miss each other by more than placings within an orientation scatter.
    pub lack_of_fit: Option<LackOfFit>,
    /// What a reader must know before using the numbers.
    pub warnings: Vec<Warning>,
}

impl CentreOfMass {
    /// The position as a vector, m.
    pub fn point(&self) -> Vector3<f64> {
        Vector3::from(self.position.map(|p| p.value))
    }
}

/// Why the centre of mass cannot be found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CentreOfMassError {
    /// A number is NaN or infinite.
    #[error("placing {index} (counted from 0) contains a non-finite number")]
    NotFinite {
        /// Place in the order of the data.
        index: usize,
    },
    /// A support point far outside any airframe.
    #[error("placing {index}: a support at {place_m} m from the origin; is this in millimetres?")]
    Position {
        /// Place in the order of the data.
        index: usize,
        /// Largest coordinate, m.
        place_m: f64,
    },
    /// A support cannot pull.
    #[error(
        "placing {index}: support {support} reads {force_n} N, but a support cannot pull: subtract the reading of the unloaded \
         scale, or the airframe was about to tip"
    )]
    Pulls {
        /// Place in the order of the data.
        index: usize,
        /// Support, 1 to 3.
        support: usize,
        /// Its force, N.
        force_n: f64,
    },
    /// A weight that no vehicle of this kind has.
    #[error(
        "placing {index}: the forces sum to {weight_n} N; are they in newtons, and was the airframe on all three supports?"
    )]
    Weight {
        /// Place in the order of the data.
        index: usize,
        /// Sum of the forces, N.
        weight_n: f64,
    },
    /// The supports lie in a row and span no plane.
    #[error(
        "placing {index}: the supports are nearly collinear (sine of the angle at the first {sine:.4}): spread them"
    )]
    InARow {
        /// Place in the order of the data.
        index: usize,
        /// Sine of the angle at the first support.
        sine: f64,
    },
    /// One orientation gives a line, not a point.
    #[error(
        "the centre of mass needs at least two orientations, got {orientations}: support the airframe at other points as well"
    )]
    TooFewOrientations {
        /// How many different ones there are.
        orientations: usize,
    },
    /// The lines hardly meet.
    #[error(
        "the lines are nearly parallel: {:.2}° between the two that differ most (condition number {condition_number:.1}), \
         at least {:.0}° are needed: tilt the airframe further",
        angle_rad.to_degrees(),
        LEAST_ANGLE_RAD.to_degrees()
    )]
    NearlyParallel {
        /// Largest angle between two lines, rad.
        angle_rad: f64,
        /// Condition number of the intersection, `1/sin(angle/2)` for two lines.
        condition_number: f64,
    },
    /// The least-squares problem was refused.
    #[error(transparent)]
    Fit(#[from] FitError),
}

/// Farthest support point believed, m, and weights believed, N: those of a milligram toy and of a passenger drone.
const FARTHEST_M: f64 = 20.0;
const WEIGHTS_N: (f64, f64) = (1e-3, 1e5);
/// Least sine of the angle between two sides of the support triangle: below, a millimetre of error turns the normal by degrees.
const LEAST_SINE: f64 = 0.02;
/// Least angle between lines: below 5° an error across the lines grows more than elevenfold along them, and a millimetre
/// becomes a centimetre, the size of what is sought.
const LEAST_ANGLE_RAD: f64 = 5.0 * std::f64::consts::PI / 180.0;
/// Largest departure of one placing's weight from the median before it is called odd.
const ODD_WEIGHT: f64 = 0.03;

/// Finds the centre of mass from placings in at least two orientations.
///
/// # Errors
/// A placing that cannot be right, too few orientations, lines that are nearly parallel.
pub fn locate(placings: &[Placing]) -> Result<CentreOfMass, CentreOfMassError> {
    let lines = placings
        .iter()
        .enumerate()
        .map(|(index, placing)| placing.line(index))
        .collect::<Result<Vec<_>, _>>()?;
    let mut orientations: Vec<u32> = placings.iter().map(|p| p.orientation).collect();
    orientations.sort_unstable();
    orientations.dedup();
    if orientations.len() < 2 {
        return Err(CentreOfMassError::TooFewOrientations {
            orientations: orientations.len(),
        });
    }
    let angle_rad = largest_angle(&lines);
    if angle_rad < LEAST_ANGLE_RAD {
        return Err(CentreOfMassError::NearlyParallel {
            angle_rad,
            condition_number: 1.0 / (0.5 * angle_rad).sin(),
        });
    }
    let rows: Vec<Row<3>> = lines
        .iter()
        .flat_map(|line| line.across.map(|e| (e, e.dot(&line.centre_of_pressure))))
        .map(|(e, y)| Row {
            regressors: e.into(),
            y,
        })
        .collect();
    let fit = linear(&rows)?;
    let keys: Vec<(u32, usize)> = placings
        .iter()
        .flat_map(|p| [(p.orientation, 0), (p.orientation, 1)])
        .collect();
    let lack_of_fit = LackOfFit::test(&fit.residuals, &keys, 3);
    let point = Vector3::from(fit.values());
    let mut warnings = fit.warnings;
    warnings.extend(disagreement(lack_of_fit));
    warnings.extend(odd_weight(placings));
    Ok(CentreOfMass {
        position: fit.parameters,
        covariance: fit.covariance,
        weight: mean_weight(placings),
        residuals: lines.iter().map(|line| line.offset_from(&point)).collect(),
        lines,
        goodness: Goodness {
            r_squared: None,
            ..fit.goodness
        },
        angle_rad,
        condition_number: fit.condition_number,
        lack_of_fit,
        warnings,
    })
}

fn largest_angle(lines: &[Line]) -> f64 {
    let pairs = lines
        .iter()
        .enumerate()
        .flat_map(|(i, a)| lines[..i].iter().map(move |b| a.angle_to(b)));
    pairs.fold(0.0, f64::max)
}

fn mean_weight(placings: &[Placing]) -> Estimate {
    let n = placings.len() as f64;
    let value = placings.iter().map(Placing::weight).sum::<f64>() / n;
    let squares: f64 = placings.iter().map(|p| (p.weight() - value).powi(2)).sum();
    Estimate {
        value,
        standard_error: (squares / (n - 1.0) / n).sqrt(),
        degrees_of_freedom: n - 1.0,
    }
}

fn disagreement(lack_of_fit: Option<LackOfFit>) -> Option<Warning> {
    let test = lack_of_fit.filter(LackOfFit::is_significant)?;
    Some(Warning::GroupsDisagree {
        p_value: test.p_value,
    })
}

/// A placing whose weight is not that of the others: a scale at the end of its range, a fourth point that touched.
fn odd_weight(placings: &[Placing]) -> Option<Warning> {
    let mut weights: Vec<f64> = placings.iter().map(Placing::weight).collect();
    weights.sort_unstable_by(f64::total_cmp);
    let median = weights[weights.len() / 2];
    let departure = |p: &Placing| p.weight() / median - 1.0;
    let odd = placings.iter().enumerate().max_by(|a, b| {
        let [a, b] = [a.1, b.1].map(|p| departure(p).abs());
        a.total_cmp(&b)
    });
    odd.filter(|(_, p)| departure(p).abs() > ODD_WEIGHT)
        .map(|(index, p)| Warning::OddWeight {
            index,
            relative_departure: departure(p),
        })
}

#[cfg(test)]
mod tests;
