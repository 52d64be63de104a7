//! Closed-loop flights as the figures need them: a scenario that says everything, and its logs.

use crate::item::{Context, ItemError};
use nalgebra::Vector3;
use quad_dynamics::{AnyQuadrotor, CommandLimits, Level, Phenomenon, PhenomenonSet, Vehicle};
use quad_math::TimeGrid;
pub use quad_ndi::Law;
use quad_ndi::{
    FlightLog, FlightPlan, FlightStatus, Flyer, LoopDesign, PidSettings, Reference, Settings, Trajectory,
    Waypoint,
};
use serde::Serialize;
use std::num::NonZeroU64;

/// The vehicle of the figures.
pub const NOMINAL_VEHICLE: &str = "vehicles/qball-x4.toml";

/// What the vehicle is asked to do.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Task {
    /// Step from hover at the origin to this position in W, m, and heading, rad.
    Step {
        /// Position in W, m.
        position_m: [f64; 3],
        /// Heading, rad.
        yaw_rad: f64,
    },
    /// Follow the smooth trajectory through these waypoints, its derivatives fed forward.
    Follow {
        /// The waypoints.
        waypoints: Vec<Waypoint>,
    },
}

/// Everything that determines a flight but the level.
#[derive(Clone, Debug, Serialize)]
pub struct Scenario {
    /// Parameter file below `data/`.
    pub vehicle: &'static str,
    /// The controller.
    pub controller: Law,
    /// What its loops are asked to achieve (inversions).
    pub settings: Settings,
    /// Its gains (PID).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pid: Option<PidSettings>,
    /// Whether commands are limited to the vehicle's PWM range, in the controller and in every model.
    pub input_limits: bool,
    /// Whether level 5's battery voltage sags; otherwise it is nominal.
    pub voltage_sag: bool,
    /// Step of controller and integrator (RK4), s.
    pub step_s: f64,
    /// Duration, s.
    pub duration_s: f64,
    /// Every how many steps the flight is recorded.
    pub record_every: u64,
    /// The task.
    pub task: Task,
}

impl Scenario {
    /// A controller on the nominal vehicle, unlimited, constant voltage, 1 ms steps.
    pub fn new(controller: Law, settings: Settings, task: Task, duration_s: f64) -> Self {
        Self {
            vehicle: NOMINAL_VEHICLE,
            controller,
            settings,
            pid: None,
            input_limits: false,
            voltage_sag: false,
            step_s: 1e-3,
            duration_s,
            record_every: 5,
            task,
        }
    }

    /// A unit step in height.
    pub fn height_step(controller: Law, settings: Settings, duration_s: f64) -> Self {
        Self::new(
            controller,
            settings,
            Task::Step {
                position_m: [0.0, 0.0, -1.0],
                yaw_rad: 0.0,
            },
            duration_s,
        )
    }

    /// A unit step in yaw.
    pub fn yaw_step(controller: Law, settings: Settings, duration_s: f64) -> Self {
        Self::new(
            controller,
            settings,
            Task::Step {
                position_m: [0.0; 3],
                yaw_rad: 1.0,
            },
            duration_s,
        )
    }

    /// A unit step in x.
    pub fn position_step(controller: Law, settings: Settings, duration_s: f64) -> Self {
        Self::new(
            controller,
            settings,
            Task::Step {
                position_m: [1.0, 0.0, 0.0],
                yaw_rad: 0.0,
            },
            duration_s,
        )
    }

    /// The phenomena of a level in this scenario.
    pub fn phenomena(&self, level: Level) -> PhenomenonSet {
        let own = level.phenomena();
        let own = if self.voltage_sag {
            own
        } else {
            own.without(Phenomenon::VoltageSag)
        };
        if self.input_limits {
            own.with(Phenomenon::InputLimits)
        } else {
            own.without(Phenomenon::InputLimits)
        }
    }

    /// The vehicle, read from its file.
    ///
    /// # Errors
    /// A file that can't be read or is not a valid vehicle.
    pub fn vehicle(&self, context: &Context) -> Result<Vehicle, ItemError> {
        load_vehicle(context, self.vehicle)
    }

    /// The limits of the vehicle's commands, if the scenario has them on.
    pub fn limits(&self, vehicle: &Vehicle) -> Option<CommandLimits<f64>> {
        self.input_limits.then(|| CommandLimits::of(vehicle))
    }

    /// Flies the scenario at a level.
    ///
    /// # Errors
    /// Whatever keeps the vehicle from taking off. A flight that diverges is a log that says so.
    pub fn fly(&self, context: &Context, level: Level) -> Result<FlightLog, ItemError> {
        self.fly_vehicle(&self.vehicle(context)?, level)
    }

    /// Flies the scenario with a vehicle at a level.
    ///
    /// # Errors
    /// Whatever keeps the vehicle from taking off. A flight that diverges is a log that says so.
    pub fn fly_vehicle(&self, vehicle: &Vehicle, level: Level) -> Result<FlightLog, ItemError> {
        self.fly_with(vehicle, level, &self.phenomena(level))
    }

    /// Flies the scenario with a vehicle at a level with these phenomena, whatever the scenario says of them.
    ///
    /// # Errors
    /// Whatever keeps the vehicle from taking off. A flight that diverges is a log that says so.
    pub fn fly_with(
        &self,
        vehicle: &Vehicle,
        level: Level,
        phenomena: &PhenomenonSet,
    ) -> Result<FlightLog, ItemError> {
        let design = LoopDesign {
            inversion: self.settings,
            pid: self.pid.unwrap_or_default(),
        };
        let controller = self.controller.build::<f64>(vehicle, &design)?;
        let (start, yaw, trajectory) = match &self.task {
            Task::Step { .. } => (Vector3::zeros(), 0.0, None),
            Task::Follow { waypoints } => {
                let trajectory = Trajectory::through(waypoints)?;
                let first = trajectory.flat_output(f64::NEG_INFINITY);
                (first.position, first.yaw, Some(trajectory))
            }
        };
        let quadrotor = AnyQuadrotor::hovering(level, vehicle, phenomena, start, yaw)?;
        let flyer = Flyer::new(vehicle, quadrotor, controller.with_limits(self.limits(vehicle)))?;
        let plan = FlightPlan {
            grid: TimeGrid::from_seconds(self.step_s, self.duration_s)?,
            record_every: NonZeroU64::new(self.record_every).unwrap_or(NonZeroU64::MIN),
        };
        let gravity = vehicle.environment.gravity;
        let tilt = self.controller.tilt_law();
        Ok(flyer.fly(&plan, |t| match (&self.task, &trajectory) {
            (Task::Step { position_m, yaw_rad }, _) => Reference::hold(Vector3::from(*position_m), *yaw_rad),
            (Task::Follow { .. }, Some(path)) => Reference::following(path.flat_output(t), gravity, tilt),
            (Task::Follow { .. }, None) => Reference::hold(start, yaw),
        }))
    }
}

/// A vehicle from its parameter file below `data/`.
///
/// # Errors
/// A file that can't be read or is not a valid vehicle.
pub fn load_vehicle(context: &Context, relative: &str) -> Result<Vehicle, ItemError> {
    let path = context.data(relative);
    let text =
        std::fs::read_to_string(&path).map_err(|e| ItemError::new(format!("{}: {e}", path.display())))?;
    Ok(Vehicle::from_toml_str(&text, relative)?)
}

/// A quantity of a log over time, `(t, value)`.
pub fn series(log: &FlightLog, value: impl Fn(&quad_ndi::Record) -> f64) -> Vec<(f64, f64)> {
    log.records.iter().map(|r| (r.time_s, value(r))).collect()
}

/// Whether a flight reached its end.
pub fn completed(log: &FlightLog) -> bool {
    log.status == FlightStatus::Completed
}
