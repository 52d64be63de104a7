//! What a quadrotor is asked to do, in a scenario file.

use quad_ndi::Waypoint;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a quadrotor is asked to do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum ReferenceFile {
    /// Stay at a place.
    Hold {
        /// Position (north, east, down), m.
        position_m: [f64; 3],
        /// Heading, degrees clockwise from north.
        #[serde(default)]
        yaw_deg: f64,
    },
    /// Jump from set point to set point.
    Steps {
        /// The set points in order of time; the first holds from the start.
        steps: Vec<SetPoint>,
    },
    /// Fly smoothly through points, at rest before the first and after the last.
    Waypoints {
        /// The points in order of time.
        waypoints: Vec<Point>,
    },
    /// Fly one polynomial per axis between boundary conditions, and rest at its end.
    Polynomial(Box<Polynomial>),
    /// Fly a circle, or a helix.
    Circle(Circle),
    /// Keep an offset from another agent.
    Follow {
        /// Name of the agent.
        agent: String,
        /// Offset from it (north, east, down), m.
        offset_m: [f64; 3],
        /// Heading, degrees clockwise from north.
        #[serde(default)]
        yaw_deg: f64,
    },
}

/// From this time on, this set point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SetPoint {
    /// From when, s.
    pub from_s: f64,
    /// Position (north, east, down), m.
    pub position_m: [f64; 3],
    /// Heading, degrees clockwise from north.
    #[serde(default)]
    pub yaw_deg: f64,
}

/// A point that is passed at a given time, unaccelerated.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Point {
    /// When, s.
    pub time_s: f64,
    /// Position (north, east, down), m.
    pub position_m: [f64; 3],
    /// Velocity (north, east, down), m/s.
    #[serde(default)]
    pub velocity_m_s: [f64; 3],
    /// Heading, degrees clockwise from north; not wrapped, so a full turn is 360 away.
    #[serde(default)]
    pub yaw_deg: f64,
}

/// Boundary conditions at time 0 (`_0`) and at the end (`_f`). Acceleration, jerk and snap are zero at both.
///
/// Every condition is a key of its own, so that a sweep or an optimiser can vary any of them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Polynomial {
    /// From start to end, s.
    pub duration_s: f64,
    /// North at the start, m.
    pub x_0_m: f64,
    /// East at the start, m.
    pub y_0_m: f64,
    /// Down at the start, m: -3 is a height of 3 m.
    pub z_0_m: f64,
    /// North at the end, m.
    pub x_f_m: f64,
    /// East at the end, m.
    pub y_f_m: f64,
    /// Down at the end, m.
    pub z_f_m: f64,
    /// Velocity north at the start, m/s.
    #[serde(default)]
    pub x_dot_0_m_s: f64,
    /// Velocity east at the start, m/s.
    #[serde(default)]
    pub y_dot_0_m_s: f64,
    /// Velocity down at the start, m/s.
    #[serde(default)]
    pub z_dot_0_m_s: f64,
    /// Velocity north at the end, m/s.
    #[serde(default)]
    pub x_dot_f_m_s: f64,
    /// Velocity east at the end, m/s.
    #[serde(default)]
    pub y_dot_f_m_s: f64,
    /// Velocity down at the end, m/s.
    #[serde(default)]
    pub z_dot_f_m_s: f64,
    /// Heading at the start, degrees clockwise from north.
    #[serde(default)]
    pub yaw_0_deg: f64,
    /// Heading at the end, degrees clockwise from north; not wrapped.
    #[serde(default)]
    pub yaw_f_deg: f64,
}

/// A circle at constant speed, clockwise seen from above, or a helix.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Circle {
    /// Centre at the start (north, east, down), m.
    pub centre_m: [f64; 3],
    /// Radius, m.
    pub radius_m: f64,
    /// Time of a turn, s; negative turns counter-clockwise.
    pub period_s: f64,
    /// Speed upwards, m/s; zero is a circle.
    #[serde(default)]
    pub climb_m_s: f64,
    /// Direction from the centre at the start, degrees clockwise from north.
    #[serde(default)]
    pub bearing_deg: f64,
    /// Heading, degrees clockwise from north.
    #[serde(default)]
    pub yaw_deg: f64,
}

impl Polynomial {
    /// Every condition with its key.
    pub(crate) fn conditions(&self) -> Vec<(String, f64)> {
        let table = toml::Table::try_from(self).unwrap_or_default();
        let number = |(key, value): (String, toml::Value)| Some((key, value.as_float()?));
        table.into_iter().filter_map(number).collect()
    }

    /// The two ends as waypoints.
    pub(crate) fn waypoints(&self) -> [Waypoint; 2] {
        [
            Waypoint {
                time_s: 0.0,
                position_m: [self.x_0_m, self.y_0_m, self.z_0_m],
                velocity_m_s: [self.x_dot_0_m_s, self.y_dot_0_m_s, self.z_dot_0_m_s],
                yaw_rad: self.yaw_0_deg.to_radians(),
                yaw_rate_rad_s: 0.0,
            },
            Waypoint {
                time_s: self.duration_s,
                position_m: [self.x_f_m, self.y_f_m, self.z_f_m],
                velocity_m_s: [self.x_dot_f_m_s, self.y_dot_f_m_s, self.z_dot_f_m_s],
                yaw_rad: self.yaw_f_deg.to_radians(),
                yaw_rate_rad_s: 0.0,
            },
        ]
    }
}

impl From<&Point> for Waypoint {
    fn from(point: &Point) -> Self {
        Self {
            time_s: point.time_s,
            position_m: point.position_m,
            velocity_m_s: point.velocity_m_s,
            yaw_rad: point.yaw_deg.to_radians(),
            yaw_rate_rad_s: 0.0,
        }
    }
}
