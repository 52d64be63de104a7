//! The project's nominal problems: scenario-independent settings.
//!
//! The station stands at the origin; the vehicle crosses its field along y from −5 m to 5 m, 3 m high, in 10 s or 20 s; limits of range,
//! incidence and spot are 8 m, 40° and 0.15 m; all weights are 1. So set, the ideal cost ([`Problem::ideal`]) has two mirror
//! minima, north and south of the station, at 4.04 m (10 s) and 4.21 m (20 s), and a saddle between. A kinematic study put them near 3.5 m
//! and 4 m; with the receiver in the centre of mass they are at 3.80 m and 3.98 m, 0.2 m ahead of it a quarter of a metre further
//! out (`tools/ideal_crossing.py`). Two settings are the project's own:
//!
//! - The pedestal's zero pan looks east, along the crossing, so that the 20° that cables keep from the pan axis lie to the
//!   west and not across one of the two ways. Flights that start on one side of the station and pass it on the other do turn
//!   through the west: they lose the target, and cost some hundred.
//!   The station's file has the pedestal at 0°, with that stop in the south. A start within 10° of the west, |x_0| < 0.88 m at y = −5 m,
//!   is out of the beam's reach at first: it costs a moment's spot error, which optima of four and six variables put up with.
//! - Position loops settle in 5 s, as the trajectories of chapter 6 do.

use crate::condition::{Axis, Condition, Order, Side};
use crate::cost::{Penalties, Weights};
use crate::decision::Decision;
use crate::error::ProblemError;
use crate::mission::{Ends, Mission};
use crate::problem::Problem;
use ets::Station;
use quad_dynamics::{Level, Vehicle};
use quad_ndi::{LoopSettings, Settings};
use serde::{Deserialize, Serialize};
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

/// Half of the crossing's length along y, m.
pub const HALF_CROSSING_M: f64 = 5.0;
/// Height of the crossing, m.
pub const HEIGHT_M: f64 = 3.0;
/// Settling time of the horizontal position loop, s.
pub const POSITION_SETTLING_S: f64 = 5.0;

/// Which variables of the nominal mission are decided on, and from where.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Choice {
    /// `[x_0, x_f]`, from rest to rest.
    Two,
    /// `[x_0, x_dot_0, x_f, x_dot_f]` from `X0 = [5, 0, −5, 0]`.
    Four,
    /// The same from `X0 = [5, −1.5, −8, 1.5]`.
    FourMoving,
    /// The four and the end heights, `[x_0, x_dot_0, x_f, x_dot_f, z_0, z_f]` from `[5, 0, −5, 0, −3, −3]`.
    Six,
}

/// A variable along x or z.
const fn decision(axis: Axis, order: Order, side: Side, bounds: [f64; 2], start: f64) -> Decision {
    Decision {
        condition: Condition::new(axis, order, side),
        lower: bounds[0],
        upper: bounds[1],
        start,
    }
}

/// Bounds of x for two variables, m: the range limit.
const NEAR: [f64; 2] = [-8.0, 8.0];
/// Bounds of x for more variables, m: wide enough for a start at −8 m.
const WIDE: [f64; 2] = [-10.0, 10.0];
/// Bounds of velocities, m/s.
const SPEEDS: [f64; 2] = [-2.0, 2.0];
/// Bounds of z, m: heights of 1 m to 6 m. The lower height is for safety, and every optimum of six variables lies on it: a lower flight is
/// always nearer and less oblique to a station on the ground.
const DEPTHS: [f64; 2] = [-6.0, -1.0];

impl Choice {
    /// The variables with their bounds and starts.
    pub fn decisions(self) -> Vec<Decision> {
        use Axis::{X, Z};
        use Order::{Position, Velocity};
        use Side::{Finish, Start};
        let four = |x0: [f64; 4]| {
            vec![
                decision(X, Position, Start, WIDE, x0[0]),
                decision(X, Velocity, Start, SPEEDS, x0[1]),
                decision(X, Position, Finish, WIDE, x0[2]),
                decision(X, Velocity, Finish, SPEEDS, x0[3]),
            ]
        };
        match self {
            Self::Two => vec![
                decision(X, Position, Start, NEAR, 5.0),
                decision(X, Position, Finish, NEAR, 5.0),
            ],
            Self::Four => four([5.0, 0.0, -5.0, 0.0]),
            Self::FourMoving => four([5.0, -1.5, -8.0, 1.5]),
            Self::Six => {
                let mut six = four([5.0, 0.0, -5.0, 0.0]);
                six.push(decision(Z, Position, Start, DEPTHS, -HEIGHT_M));
                six.push(decision(Z, Position, Finish, DEPTHS, -HEIGHT_M));
                six
            }
        }
    }
}

impl Mission {
    /// The nominal crossing in this many seconds by the vehicle and station that the library brings along.
    pub fn nominal(duration_s: f64) -> Self {
        Self::crossing(duration_s, Arc::new(Vehicle::qball_x4()), Station::nominal())
    }

    /// The nominal crossing by a vehicle of a station's field; its pedestal is turned to the east.
    pub fn crossing(duration_s: f64, vehicle: Arc<Vehicle>, mut station: Station) -> Self {
        station.pedestal.heading = FRAC_PI_2;
        let at = |y| Ends::at_rest([HALF_CROSSING_M, y, -HEIGHT_M]);
        let (start, finish) = (at(-HALF_CROSSING_M), at(HALF_CROSSING_M));
        let position = LoopSettings {
            settling_time_s: POSITION_SETTLING_S,
            ..LoopSettings::default()
        };
        Self {
            settings: Settings {
                position,
                ..Settings::default()
            },
            ..Self::new(duration_s, start, finish, vehicle, station)
        }
    }
}

impl Problem {
    /// A nominal problem: the crossing in `duration_s` seconds at a level.
    ///
    /// # Errors
    /// A duration that is not a positive multiple of the station's 2 ms.
    pub fn nominal(choice: Choice, duration_s: f64, level: Level) -> Result<Self, ProblemError> {
        Self::new(
            Mission::nominal(duration_s),
            level,
            choice.decisions(),
            &Weights::default(),
            &Penalties::default(),
        )
    }
}
