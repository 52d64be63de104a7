//! Polynomial trajectories of the flat outputs through waypoints, with all derivatives.
//!
//! Between two waypoints each position axis is the polynomial of degree 9 that meets position to snap at
//! both ends, heading that of degree 7 (to jerk), so the whole is four times continuously differentiable
//! in position, three times in heading: as smooth as the attitude loops of every level need.

use crate::FlatOutput;
use nalgebra::Vector3;
use quad_math::{Real, Segment, SegmentError, constant};
use serde::{Deserialize, Serialize};

/// A point that a trajectory passes at a given time; acceleration and above are zero there.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Waypoint {
    /// When, s.
    pub time_s: f64,
    /// Position in W, m.
    pub position_m: [f64; 3],
    /// Velocity in W, m/s.
    #[serde(default)]
    pub velocity_m_s: [f64; 3],
    /// Heading ψ, rad; not wrapped, so a full turn is 2π away.
    #[serde(default)]
    pub yaw_rad: f64,
    /// ψ̇, rad/s.
    #[serde(default)]
    pub yaw_rate_rad_s: f64,
}

/// Why waypoints make no trajectory.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum TrajectoryError {
    /// Less than two waypoints.
    #[error("a trajectory needs at least 2 waypoints, got {count}")]
    TooFewWaypoints {
        /// How many there were.
        count: usize,
    },
    /// A waypoint not later than the one before.
    #[error("waypoint {index} must be later than the one before, at {previous_s} s, got {time_s} s")]
    TimeNotIncreasing {
        /// Index of the waypoint, from 0.
        index: usize,
        /// Its time, s.
        time_s: f64,
        /// The time before, s.
        previous_s: f64,
    },
    /// A leg can't be built: a number that isn't finite.
    #[error("from waypoint {index} to the next: {source}")]
    BadLeg {
        /// Index of the leg's first waypoint, from 0.
        index: usize,
        /// Why.
        source: SegmentError,
    },
}

/// Boundary conditions of one leg at one end, in W: position, velocity, acceleration, jerk, snap, and
/// heading with three derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Boundary<R: Real> {
    /// Position and its first four derivatives, m, m/s, … m/s⁴.
    pub position: [Vector3<R>; 5],
    /// Heading and its first three derivatives, rad, rad/s, … rad/s³.
    pub yaw: [R; 4],
}

/// A polynomial piece of a trajectory, from time 0 to its duration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg<R: Real> {
    position: [Segment<R, 10>; 3],
    yaw: Segment<R, 8>,
}

impl<R: Real> Boundary<R> {
    /// The boundary that a waypoint asks for.
    pub fn at(waypoint: &Waypoint) -> Self {
        let o = Vector3::zeros();
        let vector = |v: [f64; 3]| Vector3::from(v).map(constant);
        let (yaw, yaw_rate) = (constant(waypoint.yaw_rad), constant(waypoint.yaw_rate_rad_s));
        Self {
            position: [
                vector(waypoint.position_m),
                vector(waypoint.velocity_m_s),
                o,
                o,
                o,
            ],
            yaw: [yaw, yaw_rate, R::zero(), R::zero()],
        }
    }
}

impl<R: Real> Leg<R> {
    /// The leg between two boundaries in `duration_s` seconds.
    ///
    /// # Errors
    /// A duration that is not positive; a boundary value that is not finite.
    pub fn between(start: &Boundary<R>, end: &Boundary<R>, duration_s: f64) -> Result<Self, SegmentError> {
        let axis = |i: usize| {
            Segment::new(
                start.position.map(|v| v[i]),
                end.position.map(|v| v[i]),
                duration_s,
            )
        };
        Ok(Self {
            position: [axis(0)?, axis(1)?, axis(2)?],
            yaw: Segment::new(start.yaw, end.yaw, duration_s)?,
        })
    }

    /// Duration, s.
    pub fn duration_s(&self) -> f64 {
        self.yaw.duration_s()
    }

    /// The flat output at `t` seconds into the leg.
    pub fn flat_output(&self, t: R) -> FlatOutput<R> {
        let axes: [[R; 6]; 3] = self.position.map(|axis| axis.derivatives(t));
        let derivative = |k: usize| Vector3::from_fn(|i, _| axes[i][k]);
        let [yaw, yaw_rate, yaw_acceleration, yaw_jerk] = self.yaw.derivatives(t);
        FlatOutput {
            position: derivative(0),
            velocity: derivative(1),
            acceleration: derivative(2),
            jerk: derivative(3),
            snap: derivative(4),
            crackle: derivative(5),
            yaw,
            yaw_rate,
            yaw_acceleration,
            yaw_jerk,
        }
    }
}

/// A trajectory through waypoints.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    waypoints: Vec<Waypoint>,
    legs: Vec<Leg<f64>>,
}

impl Trajectory {
    /// The trajectory through two or more waypoints in order of time.
    ///
    /// # Errors
    /// Too few waypoints, times that don't increase, numbers that aren't finite.
    pub fn through(waypoints: &[Waypoint]) -> Result<Self, TrajectoryError> {
        if waypoints.len() < 2 {
            return Err(TrajectoryError::TooFewWaypoints {
                count: waypoints.len(),
            });
        }
        let leg = |(index, pair): (usize, &[Waypoint])| {
            let duration_s = pair[1].time_s - pair[0].time_s;
            if duration_s.is_nan() || duration_s <= 0.0 {
                let (time_s, previous_s) = (pair[1].time_s, pair[0].time_s);
                return Err(TrajectoryError::TimeNotIncreasing {
                    index: index + 1,
                    time_s,
                    previous_s,
                });
            }
            Leg::between(&Boundary::at(&pair[0]), &Boundary::at(&pair[1]), duration_s)
                .map_err(|source| TrajectoryError::BadLeg { index, source })
        };
        let legs = waypoints
            .windows(2)
            .enumerate()
            .map(leg)
            .collect::<Result<_, _>>()?;
        Ok(Self {
            waypoints: waypoints.to_vec(),
            legs,
        })
    }

    /// The waypoints.
    pub fn waypoints(&self) -> &[Waypoint] {
        &self.waypoints
    }

    /// Time of the last waypoint, s.
    pub fn end_s(&self) -> f64 {
        self.waypoints.last().map_or(0.0, |w| w.time_s)
    }

    /// The flat output at a time, s. Before the first and after the last waypoint: at rest there.
    pub fn flat_output(&self, time_s: f64) -> FlatOutput<f64> {
        let rest = |w: &Waypoint| FlatOutput::at_rest(Vector3::from(w.position_m), w.yaw_rad);
        // The first waypoint later than now ends the leg that we are on.
        match self.waypoints.iter().position(|w| w.time_s > time_s) {
            Some(0) => rest(&self.waypoints[0]),
            Some(next) => self.legs[next - 1].flat_output(time_s - self.waypoints[next - 1].time_s),
            None => rest(&self.waypoints[self.waypoints.len() - 1]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn loop_with_turn() -> Trajectory {
        let at = |time_s, position_m, velocity_m_s, yaw_rad| Waypoint {
            time_s,
            position_m,
            velocity_m_s,
            yaw_rad,
            yaw_rate_rad_s: 0.0,
        };
        let waypoints = [
            at(0.0, [0.0, 0.0, 0.0], [0.0; 3], 0.0),
            at(4.0, [2.0, 1.0, -1.0], [0.5, 0.2, 0.0], 1.0),
            at(7.0, [0.0, 2.0, -2.0], [0.0; 3], 3.0),
        ];
        Trajectory::through(&waypoints).expect("valid waypoints")
    }

    #[test]
    fn exact_waypoints_are_met() {
        let trajectory = loop_with_turn();
        for w in trajectory.waypoints() {
            let flat = trajectory.flat_output(w.time_s);
            // Rounding of degree-9 polynomials with coefficients up to some hundreds.
            assert_relative_eq!(flat.position, Vector3::from(w.position_m), epsilon = 1e-11);
            assert_relative_eq!(flat.yaw, w.yaw_rad, epsilon = 1e-11);
        }
        assert_relative_eq!(
            trajectory.flat_output(99.0).position,
            Vector3::new(0.0, 2.0, -2.0)
        );
    }

    #[test]
    fn prop_continuous_to_snap_across_waypoints() {
        let trajectory = loop_with_turn();
        let e = 1e-9;
        let (before, after) = (trajectory.flat_output(4.0 - e), trajectory.flat_output(4.0 + e));
        // Two nanoseconds times a derivative of at most some hundreds.
        for (a, b) in [
            (before.position, after.position),
            (before.velocity, after.velocity),
            (before.acceleration, after.acceleration),
            (before.jerk, after.jerk),
            (before.snap, after.snap),
        ] {
            assert_relative_eq!(a, b, epsilon = 1e-6);
        }
        assert_relative_eq!(before.yaw_jerk, after.yaw_jerk, epsilon = 1e-6);
    }

    #[test]
    fn exact_errors_for_bad_waypoints() {
        let good = loop_with_turn().waypoints().to_vec();
        assert_eq!(
            Trajectory::through(&good[..1]),
            Err(TrajectoryError::TooFewWaypoints { count: 1 })
        );
        let mut swapped = good.clone();
        swapped[1].time_s = 0.0;
        let error = TrajectoryError::TimeNotIncreasing {
            index: 1,
            time_s: 0.0,
            previous_s: 0.0,
        };
        assert_eq!(Trajectory::through(&swapped), Err(error));
        let mut bad = good;
        bad[2].position_m[1] = f64::NAN;
        assert!(matches!(
            Trajectory::through(&bad),
            Err(TrajectoryError::BadLeg { index: 1, .. })
        ));
    }
}
