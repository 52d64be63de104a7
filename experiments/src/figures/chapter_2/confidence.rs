//! Confidence in a level: how well its accelerations agree with those of level 5 along level 5's flight.
//!
//! ```text
//! confidence = 1 − U,   U = rms(ŷ − y) / (rms y + rms ŷ)      Theil's coefficient, mean of the axes
//! ```
//!
//! with y the change of velocity (W) and body rates (B) over a step at level 5 and ŷ that of the level from the same body
//! state under the same commands. Rotor states are the level's own, run open loop from hover.

use crate::figures::{flight_settings, path_waypoints};
use crate::item::ItemError;
use quad_dynamics::{AnyQuadrotor, Level, Resolution, Snapshot, Vehicle};
use quad_math::FixedStep;
use quad_ndi::{AnyController, C1, Reference, TiltLaw, Trajectory};
use sysid::validation::Agreement;

/// Names of the axes compared: velocity north, east, down; roll, pitch and yaw rates.
pub(super) const AXES: [&str; 6] = ["north", "east", "down", "roll", "pitch", "yaw"];
/// Step, s.
const STEP_S: f64 = 2e-3;
/// Time flown, s: the trajectory and two seconds.
const DURATION_S: f64 = 14.0;
/// Evaluations of the derivative by RK4.
const EVALUATIONS: f64 = 4.0;

/// What was found of a level.
pub(super) struct Confidence {
    pub(super) level: Level,
    pub(super) features: usize,
    pub(super) states: usize,
    /// Theil's coefficient of each axis.
    pub(super) theil: [f64; 6],
}

impl Confidence {
    /// One less the mean of Theil's coefficients: 1 perfect, 0 worst.
    pub(super) fn confidence(&self) -> f64 {
        1.0 - self.theil.iter().sum::<f64>() / 6.0
    }

    /// Numbers integrated in a second of flight: states times evaluations times steps.
    pub(super) fn cost(&self) -> f64 {
        self.states as f64 * EVALUATIONS / STEP_S
    }
}

/// Velocity along W and body rates.
fn motion(quadrotor: &AnyQuadrotor<f64>) -> [f64; 6] {
    let flight = quadrotor.flight();
    let (v, w) = (flight.velocity, flight.body_rates);
    [v.x, v.y, v.z, w.x, w.y, w.z]
}

/// All levels against level 5.
pub(super) fn of_family(vehicle: &Vehicle) -> Result<Vec<Confidence>, ItemError> {
    let hovering = |level: Level| {
        AnyQuadrotor::<f64>::hovering(
            level,
            vehicle,
            &level.phenomena(),
            nalgebra::Vector3::zeros(),
            0.0,
        )
    };
    let path = Trajectory::through(&path_waypoints()?)?;
    let mut pilot = AnyController::<f64>::C1(C1::new(vehicle, &flight_settings()?)?.into());
    let mut truth = hovering(Level::Five)?;
    let mut levels = Level::ALL
        .map(hovering)
        .into_iter()
        .collect::<Result<Vec<_>, _>>()?;
    let mut changes: Vec<[Vec<f64>; 6]> = vec![Default::default(); levels.len()];
    let steps = (DURATION_S / STEP_S) as u32;
    for k in 0..steps {
        let time = f64::from(k) * STEP_S;
        let reference = Reference::following(
            path.flat_output(time),
            vehicle.environment.gravity,
            TiltLaw::SmallAngle,
        );
        let mut input = truth.hover_input();
        input.commands = pilot.update(&truth.flight(), &reference, STEP_S);
        let body = truth.snapshot(&input).body;
        for (i, quadrotor) in levels.iter_mut().enumerate() {
            let own = quadrotor.snapshot(&input);
            quadrotor.adopt(&Snapshot { body, ..own }, &input);
            let before = motion(quadrotor);
            quadrotor.step(FixedStep::Rk4, &input, STEP_S);
            let after = motion(quadrotor);
            for (axis, series) in changes[i].iter_mut().enumerate() {
                series.push(after[axis] - before[axis]);
            }
        }
        truth.step(FixedStep::Rk4, &input, STEP_S);
    }
    let fifth = changes[4].clone();
    let of_level = |(i, series): (usize, &[Vec<f64>; 6])| -> Result<Confidence, ItemError> {
        let resolution = Resolution::of(Level::ALL[i], &Level::ALL[i].phenomena());
        let mut theil = [0.0; 6];
        for axis in 0..6 {
            theil[axis] = Agreement::of(&fifth[axis], &series[axis])?.theil;
        }
        Ok(Confidence {
            level: resolution.level,
            features: resolution.features.len(),
            states: resolution.states,
            theil,
        })
    };
    changes.iter().enumerate().map(of_level).collect()
}
