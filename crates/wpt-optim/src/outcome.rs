//! What a flight came to: its cost, the means behind it, and its history.

use crate::cost::Terms;
use crate::path::Path;
use crate::rollout::{Instant, Tally};
use serde::{Deserialize, Serialize};

/// What a decision costs and why.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// The cost Φ, penalties included. Always finite.
    pub cost: f64,
    /// Time means of the errors' and penalties' terms, not weighted.
    pub means: Terms<f64>,
    /// Whether the flight failed.
    pub failure: Option<Failure>,
}

/// A flight that went beyond all limits or became non-finite.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Failure {
    /// The instant of the station at which it was noticed, s, to half a step.
    pub time_s: f64,
}

/// A flight that was watched.
#[derive(Clone, Debug, PartialEq)]
pub struct Histories {
    /// What it came to.
    pub outcome: Outcome,
    /// Its instants, in order of time. After a failure, numbers may not be finite.
    pub instants: Vec<History>,
}

/// One instant of a flight.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct History {
    /// Time, s.
    pub time_s: f64,
    /// Position of the vehicle in W, m.
    pub position_m: [f64; 3],
    /// Where it should be, m.
    pub reference_m: [f64; 3],
    /// Velocity in W, m/s.
    pub velocity_m_s: [f64; 3],
    /// Attitude `[φ, θ, ψ]`, rad.
    pub attitude_rad: [f64; 3],
    /// Commands u of the step that ended now.
    pub commands: [f64; 4],
    /// Pan and tilt of the station, rad.
    pub gimbal_rad: [f64; 2],
    /// Range, m.
    pub range_m: f64,
    /// Incidence, rad.
    pub incidence_rad: f64,
    /// Spot offset, right and up, m.
    pub spot_m: [f64; 2],
    /// Terms of the cost, not weighted.
    pub terms: Terms<f64>,
    /// Their weighted sum: the integrand of Φ.
    pub cost: f64,
}

impl Outcome {
    pub(crate) fn of(tally: &Tally<f64>, duration_s: f64) -> Self {
        let failure = (tally.failed > 0.0).then_some(Failure {
            time_s: duration_s * (1.0 - tally.failed),
        });
        Self {
            cost: tally.cost,
            means: tally.means,
            failure,
        }
    }
}

impl History {
    pub(crate) fn of(instant: &Instant<'_, f64>, path: &Path<f64>, cost: f64) -> Self {
        let (flight, glance) = (instant.flight, instant.glance);
        Self {
            time_s: instant.time_s,
            position_m: flight.position.into(),
            reference_m: path.leg.flat_output(instant.time_s).position.into(),
            velocity_m_s: flight.velocity.into(),
            attitude_rad: flight.attitude.vector().into(),
            commands: *instant.commands,
            gimbal_rad: [instant.ets.gimbal.pan, instant.ets.gimbal.tilt],
            range_m: glance.range,
            incidence_rad: glance.incidence,
            spot_m: glance.spot.into(),
            terms: glance.terms,
            cost,
        }
    }
}
