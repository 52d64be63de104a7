//! The cost Φ of any flight in the engine, summed up while it is recorded.
//!
//! ```text
//! Φ = 1/T ∫ Σ w_i f(e_i²) + Σ p_j f(v_j²) dt        trapezium over the rows
//! ```
//!
//! The same terms as a rollout's, from the same function, taken from the channels of a quadrotor and of a station: so the cost does
//! not ask what the trajectory is made of, which wind blows or who else flies. Recorded at the station's step, a mission of a
//! [`crate::Problem`] costs what its rollout does, to rounding; but a row has the commands of the step that begins, so that saturation
//! is seen one of the vehicle's steps earlier. What a flight that fails has not flown costs [`FAILURE`] per share
//! of its time, from the last sound row on. Validity: as the rows, whose step must be small against the flight. Source: thesis 7.5.

use crate::cost::{Cost, FAILURE, Penalties, Terms, Weights};
use crate::error::ProblemError;
use crate::outcome::Outcome;
use crate::rollout::{Tally, goes_on};
use ets::{Ets, GimbalState, Station};
use nalgebra::Vector3;
use quad_dynamics::{Flight, Vehicle};
use quad_kinematics::EulerAngles;
use sifre::black_box::Channel;
use sifre::{BlackBox, BlackBoxError};

/// Whose flight is judged, and from where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pair {
    /// Name of the quadrotor, which carries the receiver.
    pub quadrotor: String,
    /// Name of the station.
    pub station: String,
}

/// The time that the mean is over.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Span {
    /// That of the rows: of a flight that came to its end.
    Recorded,
    /// That which was to be flown, s: of a flight that ended early.
    Planned(f64),
}

/// A black box that keeps the sums behind Φ instead of rows.
#[derive(Debug)]
pub struct CostBox {
    pair: Pair,
    ets: Ets<f64>,
    cost: Cost<f64>,
    columns: [usize; CHANNELS],
    integrals: [f64; 7],
    first_s: Option<f64>,
    last: Option<(f64, Terms<f64>)>,
    has_failed: bool,
}

/// Position, attitude, commands and gimbal.
const CHANNELS: usize = 12;

impl CostBox {
    /// The cost of a pair with the station's limits and these weights; attach it at the station's step.
    ///
    /// # Errors
    /// Limits, weights or a receiver that a cost can't be made of.
    pub fn new(
        pair: Pair,
        station: &Station,
        vehicle: &Vehicle,
        weights: &Weights,
        penalties: &Penalties,
    ) -> Result<Self, ProblemError> {
        Ok(Self {
            pair,
            ets: Ets::new(station),
            cost: Cost::new(station, vehicle, weights, penalties)?,
            columns: [0; CHANNELS],
            integrals: [0.0; 7],
            first_s: None,
            last: None,
            has_failed: false,
        })
    }

    /// What the flight came to.
    pub fn outcome(&self, span: Span) -> Outcome {
        let sound_s = match (self.first_s, &self.last) {
            (Some(first), Some((last, _))) => last - first,
            _ => 0.0,
        };
        let whole_s = match span {
            Span::Planned(planned_s) => planned_s.max(sound_s),
            Span::Recorded => sound_s,
        };
        // A flight that failed at once has no time to be a share of.
        let failed = if whole_s > 0.0 {
            1.0 - sound_s / whole_s
        } else {
            1.0
        };
        let means = Terms::from_array(
            self.integrals
                .map(|x| if whole_s > 0.0 { x / whole_s } else { 0.0 }),
        );
        let cost = self.cost.weighted(&means) + failed * FAILURE;
        Outcome::of(&Tally { cost, means, failed }, whole_s)
    }

    /// Whether a row was beyond all limits or no number; nothing after it counts. Take [`Span::Planned`] then.
    pub fn has_failed(&self) -> bool {
        self.has_failed
    }

    fn terms(&self, row: &[f64]) -> (Vector3<f64>, Terms<f64>) {
        let [x, y, z, roll, pitch, yaw, u1, u2, u3, u4, pan, tilt] = self.columns.map(|place| row[place]);
        let (position, attitude) = (Vector3::new(x, y, z), EulerAngles { roll, pitch, yaw });
        let flight = Flight {
            position,
            velocity: Vector3::zeros(),
            rotation: attitude.rotation(),
            attitude,
            body_rates: Vector3::zeros(),
            thrusts: None,
        };
        let gimbal = GimbalState {
            pan,
            tilt,
            pan_rate: 0.0,
            tilt_rate: 0.0,
        };
        let glance = self.cost.glance(&self.ets, &gimbal, &flight, &[u1, u2, u3, u4]);
        (position, glance.terms)
    }
}

impl BlackBox for CostBox {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), BlackBoxError> {
        let Pair { quadrotor, station } = &self.pair;
        let of_quadrotor = [
            "position.x",
            "position.y",
            "position.z",
            "attitude.roll",
            "attitude.pitch",
            "attitude.yaw",
            "command.1",
            "command.2",
            "command.3",
            "command.4",
        ];
        let names = of_quadrotor.iter().map(|what| format!("{quadrotor}.{what}"));
        let gimbal = ["pan", "tilt"]
            .iter()
            .map(|axis| format!("{station}.gimbal.{axis}"));
        for (place, name) in self.columns.iter_mut().zip(names.chain(gimbal)) {
            let found = channels.iter().position(|channel| channel.name == name);
            *place = found.ok_or_else(|| BlackBoxError::NothingSelected {
                pattern: name,
                known: channels
                    .iter()
                    .map(|channel| channel.name.as_str())
                    .collect::<Vec<_>>()
                    .join(", "),
            })?;
        }
        Ok(())
    }

    fn record(&mut self, time_ns: u64, row: &[f64]) -> Result<(), BlackBoxError> {
        if self.has_failed {
            return Ok(());
        }
        let time_s = time_ns as f64 * 1e-9;
        let (position, terms) = self.terms(row);
        if !goes_on(&position, &terms) {
            self.has_failed = true;
            return Ok(());
        }
        self.first_s.get_or_insert(time_s);
        if let Some((before_s, before)) = &self.last {
            let pairs = before.array().into_iter().zip(terms.array());
            for (integral, (a, b)) in self.integrals.iter_mut().zip(pairs) {
                *integral += 0.5 * (a + b) * (time_s - before_s);
            }
        }
        self.last = Some((time_s, terms));
        Ok(())
    }

    fn finish(&mut self) -> Result<(), BlackBoxError> {
        Ok(())
    }
}
