//! The gusts about one quadrotor as they continue: velocity and rotation of the air.
//!
//! Gusts lie along and across the horizontal mean wind, to the north in still air, and turn the air about these axes; their
//! field is flown through at the airspeed against the mean wind. Step n draws from stream n of a ChaCha8 generator: a
//! pure function of the seed and the step, so the filters' state is all that a snapshot needs. The rotation has streams of
//! its own, so that the velocity is the same with and without it.

use super::air::{Gusts, Turbulence, Wind, random, step_number};
use crate::agent::Moment;
use nalgebra::Vector3;
use quad_dynamics::{
    Dryden, DrydenNoise, DrydenRotation, DrydenRotationNoise, DrydenRotationState, DrydenState, Flight,
    GustStep, Phenomenon, PhenomenonSet, Vehicle,
};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Horizontal mean wind below which there is no direction to speak of, m/s.
const STILL_M_S: f64 = 1e-6;

/// Marks the streams of the process noise, so that one seed for both makes no twins.
pub(super) const PROCESS_NOISE_STREAM: u64 = 1 << 63;
/// Marks the streams of the rotation.
const ROTATION_STREAM: u64 = 1 << 61;

/// How many numbers the air remembers.
pub(super) const MEMORY: usize = 8;

/// The air as it is about one quadrotor: the state of its gusts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Air {
    /// State of the shaping filters.
    gusts: DrydenState<f64>,
    /// State of those of the rotation.
    rotation: DrydenRotationState<f64>,
    /// Span of the vehicle, m.
    span: f64,
}

/// What a model meets.
#[derive(Clone, Copy, Debug)]
pub(super) struct Met {
    /// Velocity of the air in W, m/s.
    pub(super) velocity: Vector3<f64>,
    /// Its rotation about the axes of W, rad/s.
    pub(super) rates: Vector3<f64>,
}

impl Met {
    /// A wind that does not turn.
    pub(super) fn steady(velocity: Vector3<f64>) -> Self {
        let rates = Vector3::zeros();
        Self { velocity, rates }
    }
}

/// The turbulence at the height of a flight.
fn turbulence_at(turbulence: &Turbulence, height_m: f64) -> Dryden<f64> {
    Dryden::low_altitude(height_m, turbulence.w20_m_s)
}

impl Air {
    /// The air at the start of a vehicle at some height above the ground, m: stationary turbulence.
    pub(super) fn new(wind: &Wind, vehicle: &Vehicle, height_m: f64) -> Self {
        let seed = wind.turbulence.map_or(0, |t| t.seed);
        // The last streams before those of the process noise and the rotation; no run has that many steps.
        let noise = Normals::of_step(seed, PROCESS_NOISE_STREAM - 1).dryden();
        let own = Normals::of_step(seed, ROTATION_STREAM - 1).rotation();
        let span = vehicle.span();
        // The filters are of unit size: the wind does not matter.
        let rotation = Dryden::low_altitude(height_m, 1.0).rotation(span);
        Self {
            gusts: DrydenState::stationary(&noise),
            rotation: rotation.stationary(&noise, &own),
            span,
        }
    }

    /// The air as a model with these phenomena meets it: `mean` is the wind at the reference height.
    pub(super) fn met(
        &self,
        wind: &Wind,
        mean: Vector3<f64>,
        flight: &Flight<f64>,
        on: &PhenomenonSet,
    ) -> Met {
        let mean = sheared(wind, mean, flight, on);
        match wind.turbulence {
            Some(turbulence) if on.contains(Phenomenon::Turbulence) => {
                let dryden = turbulence_at(&turbulence, -flight.position.z);
                let rates = match turbulence.gusts {
                    Gusts::All => self.dryden_rotation(&dryden).rates(&self.rotation, &self.gusts),
                    Gusts::Linear => Vector3::zeros(),
                };
                Met {
                    velocity: mean + along(&mean, dryden.gust(&self.gusts)),
                    rates: along(&mean, rates),
                }
            }
            _ => Met::steady(mean),
        }
    }

    /// The gusts continue over the step that begins at this instant.
    pub(super) fn advance(
        &mut self,
        wind: &Wind,
        mean: Vector3<f64>,
        flight: &Flight<f64>,
        on: &PhenomenonSet,
        now: &Moment<'_>,
    ) {
        let Some(turbulence) = wind.turbulence else {
            return;
        };
        let airspeed = (flight.velocity - sheared(wind, mean, flight, on)).norm();
        let dryden = turbulence_at(&turbulence, -flight.position.z);
        let step = step_number(now);
        let noise = Normals::of_step(turbulence.seed, step).dryden();
        if turbulence.gusts == Gusts::All {
            let own = Normals::of_step(turbulence.seed, ROTATION_STREAM | step).rotation();
            let gusts = GustStep {
                before: &self.gusts,
                noise: &noise,
                way: airspeed * now.step_s,
            };
            self.rotation = self.dryden_rotation(&dryden).step(&self.rotation, &gusts, &own);
        }
        self.gusts = dryden.step(&self.gusts, airspeed, now.step_s, &noise);
    }

    fn dryden_rotation(&self, dryden: &Dryden<f64>) -> DrydenRotation<f64> {
        dryden.rotation(self.span)
    }

    /// What it must remember, as numbers.
    pub(super) fn memory(&self) -> [f64; MEMORY] {
        let DrydenState { along, across, down } = self.gusts;
        let DrydenRotationState {
            roll,
            lagged_down,
            lagged_across,
        } = self.rotation;
        let [a, b, c, d] = [across[0], across[1], down[0], down[1]];
        [along, a, b, c, d, roll, lagged_down, lagged_across]
    }

    /// Resumes from its memory.
    pub(super) fn recall(&mut self, memory: [f64; MEMORY]) {
        let [along, a, b, c, d, roll, lagged_down, lagged_across] = memory;
        self.gusts = DrydenState {
            along,
            across: [a, b],
            down: [c, d],
        };
        self.rotation = DrydenRotationState {
            roll,
            lagged_down,
            lagged_across,
        };
    }
}

fn sheared(wind: &Wind, mean: Vector3<f64>, flight: &Flight<f64>, on: &PhenomenonSet) -> Vector3<f64> {
    match &wind.shear {
        Some(shear) if on.contains(Phenomenon::WindShear) => mean * shear.gain(-flight.position.z),
        _ => mean,
    }
}

/// A vector along, across to the right of, and below a mean wind, in W.
fn along(mean: &Vector3<f64>, gust: Vector3<f64>) -> Vector3<f64> {
    let speed = mean.x.hypot(mean.y);
    let (c, s) = if speed > STILL_M_S {
        (mean.x / speed, mean.y / speed)
    } else {
        (1.0, 0.0)
    };
    Vector3::new(c * gust.x - s * gust.y, s * gust.x + c * gust.y, gust.z)
}

/// Standard normal numbers of one step.
pub(super) struct Normals(ChaCha8Rng);

impl Normals {
    pub(super) fn of_step(seed: u64, stream: u64) -> Self {
        Self(random(seed, stream))
    }

    fn next(&mut self) -> f64 {
        StandardNormal.sample(&mut self.0)
    }

    pub(super) fn vector(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.next())
    }

    fn dryden(&mut self) -> DrydenNoise<f64> {
        DrydenNoise {
            along: self.next(),
            across: [self.next(), self.next()],
            down: [self.next(), self.next()],
        }
    }

    fn rotation(&mut self) -> DrydenRotationNoise<f64> {
        DrydenRotationNoise {
            roll: self.next(),
            pitch: self.next(),
            yaw: self.next(),
        }
    }
}
