//! The mission: cross the station's field in a given time, from boundary conditions to boundary conditions.
//!
//! Per axis a polynomial of degree 9 meets position, velocity, acceleration, jerk and snap (zero) at both ends
//! ([`quad_ndi::Leg`]); the heading follows the station ([`quad_ndi::FlatOutput::facing`]), because the receiver looks forward.
//! Source: thesis 7.4, appendix A.

use crate::condition::{Condition, Side};
use crate::error::ProblemError;
use ets::{FrameClock, Station};
use nalgebra::Vector3;
use quad_dynamics::Vehicle;
use quad_math::{Real, TimeGrid, constant};
use quad_ndi::{Boundary, Leg, Settings};
use serde::{Deserialize, Serialize};
use sifre::{StepSize, steps};
use std::sync::Arc;

/// Boundary conditions at one end of the trajectory, in W.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ends {
    /// Position, m; height is `−z`.
    pub position_m: [f64; 3],
    /// Velocity, m/s.
    #[serde(default)]
    pub velocity_m_s: [f64; 3],
    /// Acceleration, m/s².
    #[serde(default)]
    pub acceleration_m_s2: [f64; 3],
    /// Jerk, m/s³.
    #[serde(default)]
    pub jerk_m_s3: [f64; 3],
}

/// Everything about the flight but the model's level and the variables.
#[derive(Clone, Debug)]
pub struct Mission {
    /// Duration T, s.
    pub duration_s: f64,
    /// Conditions at the start, where no decision variable says otherwise.
    pub start: Ends,
    /// Conditions at the end, where no decision variable says otherwise.
    pub finish: Ends,
    /// The vehicle.
    pub vehicle: Arc<Vehicle>,
    /// The station and the receiver that the vehicle carries.
    pub station: Station,
    /// What the controllers are asked to achieve.
    pub settings: Settings,
    /// Step of vehicle and controller.
    pub step: StepSize,
    /// Step of the station: a multiple of the vehicle's. The cost is sampled at its instants.
    pub station_step: StepSize,
}

impl Ends {
    /// At rest at a position in W, m.
    pub fn at_rest(position_m: [f64; 3]) -> Self {
        Self {
            position_m,
            ..Self::default()
        }
    }

    fn rows(&self) -> [[f64; 3]; 4] {
        [
            self.position_m,
            self.velocity_m_s,
            self.acceleration_m_s2,
            self.jerk_m_s3,
        ]
    }

    /// The value of a condition; which end is not asked.
    pub fn value(&self, condition: Condition) -> f64 {
        self.rows()[condition.order.index()][condition.axis.index()]
    }
}

/// The grids of a mission: vehicle and station.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Timing {
    /// The vehicle's instants.
    pub(crate) grid: TimeGrid,
    /// Steps of the vehicle per step of the station.
    pub(crate) ratio: u64,
    /// The camera's frames on the station's steps.
    pub(crate) clock: FrameClock,
}

impl Mission {
    /// A crossing with the declared step sizes (table G.4).
    pub fn new(duration_s: f64, start: Ends, finish: Ends, vehicle: Arc<Vehicle>, station: Station) -> Self {
        Self {
            duration_s,
            start,
            finish,
            vehicle,
            station,
            settings: Settings::default(),
            step: steps::QUADROTOR.step,
            station_step: steps::ETS.step,
        }
    }

    /// The conditions at one end.
    pub fn ends(&self, side: Side) -> &Ends {
        match side {
            Side::Start => &self.start,
            Side::Finish => &self.finish,
        }
    }

    /// The grids, checked.
    pub(crate) fn timing(&self) -> Result<Timing, ProblemError> {
        let (step_ns, station_ns) = (self.step.ns(), self.station_step.ns());
        if !station_ns.is_multiple_of(step_ns) {
            return Err(ProblemError::StationStep { step_ns, station_ns });
        }
        let grid = TimeGrid::from_seconds(self.step.seconds(), self.duration_s)?;
        let ratio = station_ns / step_ns;
        if !grid.steps().is_multiple_of(ratio) {
            let (duration_s, step_s) = (self.duration_s, self.station_step.seconds());
            return Err(ProblemError::Duration { duration_s, step_s });
        }
        let frames = &self.station.frames;
        if frames.noise != 0.0 {
            let noise_px = frames.noise;
            return Err(ProblemError::NoisyCamera { noise_px });
        }
        let clock = FrameClock::new(self.station_step.seconds(), frames.rate, frames.latency)?;
        Ok(Timing { grid, ratio, clock })
    }

    /// Every boundary number finite.
    pub(crate) fn check_ends(&self) -> Result<(), ProblemError> {
        for condition in Condition::all() {
            let value = self.ends(condition.side).value(condition);
            if !value.is_finite() {
                return Err(ProblemError::BoundaryNotFinite { condition, value });
            }
        }
        Ok(())
    }

    /// The trajectory with the values of the variables in the place of the mission's own.
    ///
    /// # Errors
    /// A duration that is not positive; a boundary value that is not finite.
    pub fn trajectory<R: Real>(
        &self,
        values: impl Iterator<Item = (Condition, R)>,
    ) -> Result<Leg<R>, ProblemError> {
        let boundary = |ends: &Ends| {
            let [p, v, a, j] = ends.rows().map(|row| Vector3::from(row).map(constant));
            Boundary {
                position: [p, v, a, j, Vector3::zeros()],
                yaw: [R::zero(); 4],
            }
        };
        let (mut start, mut finish) = (boundary(&self.start), boundary(&self.finish));
        for (condition, value) in values {
            let end = match condition.side {
                Side::Start => &mut start,
                Side::Finish => &mut finish,
            };
            end.position[condition.order.index()][condition.axis.index()] = value;
        }
        Ok(Leg::between(&start, &finish, self.duration_s)?)
    }
}
