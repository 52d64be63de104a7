//! The ideal cost: the vehicle exactly on its trajectory, the beam exactly on the receiver.
//!
//! No dynamics: position and attitude follow from the polynomials alone (flatness), the spot's offset is zero. What a rollout adds
//! to it is the price of dynamics; where it has its minima is a matter of geometry.

use crate::cost::Terms;
use crate::error::ProblemError;
use crate::outcome::Outcome;
use crate::problem::Problem;
use crate::rollout::{Tally, aimed};
use quad_dynamics::Flight;

impl Problem {
    /// The ideal cost of a decision, sampled at the station's instants like a flight's.
    ///
    /// The gimbal points wherever the receiver is, within its travel; commands lie in the middle of their limits, so nothing saturates.
    ///
    /// # Errors
    /// As [`Problem::evaluate`].
    pub fn ideal(&self, x: &[f64]) -> Result<Outcome, ProblemError> {
        let path = self.path_of(x)?;
        let (grid, ratio) = (&self.timing.grid, self.timing.ratio);
        let count = grid.steps() / ratio;
        let ets = self.fleet.ets();
        let mut sums = [0.0; 7];
        for n in 0..=count {
            let body = path.body(grid.time_s(n * ratio));
            let rotation = body.attitude.rotation();
            let flight = Flight {
                position: body.position,
                velocity: rotation.matrix * body.velocity,
                attitude: rotation.euler_angles(),
                rotation,
                body_rates: body.body_rates,
                thrusts: None,
            };
            let receiver = ets.receiver.on(&flight.position, &flight.rotation.matrix);
            let station = aimed(ets, &receiver.centre);
            // Commands u within any limits.
            let glance = self
                .cost
                .glance(ets, &station.gimbal, &flight, &self.cost.midway());
            let half = if n == 0 || n == count { 0.5 } else { 1.0 };
            for (sum, term) in sums.iter_mut().zip(glance.terms.array()) {
                *sum += term * half / count as f64;
            }
        }
        let means = Terms::from_array(sums);
        let tally = Tally {
            cost: self.cost.weighted(&means),
            means,
            failed: 0.0,
        };
        Ok(Outcome::of(&tally, self.mission().duration_s))
    }
}
