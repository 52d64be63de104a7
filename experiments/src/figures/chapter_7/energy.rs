//! Trajectories judged by energy: delivered to the receiver's cells, and missed past them, which is the hazard.
//!
//! ```text
//! E_el(γ) = ∫ g η P_in dt,   E_miss(γ) = ∫ g P_miss dt,   g = 1 where P_in ≥ γ P_arriving, else 0
//! ```
//!
//! γ = 0 keeps the laser on all the time, a larger γ switches it off while the receiver catches less than this share. A point is on
//! the front if no other delivers as much and misses less, or misses as little and delivers more.

use ets::{Ets, GimbalState};
use nalgebra::Vector3;
use quad_kinematics::EulerAngles;
use rayon::prelude::*;
use std::num::NonZeroU64;
use wpt_optim::{History, Problem, ProblemError};

/// Power at an instant, W.
#[derive(Clone, Copy, Debug)]
struct Power {
    time_s: f64,
    /// Optical, at the receiver's range.
    arriving: f64,
    /// Optical, on the receiver.
    received: f64,
    /// Electrical.
    electrical: f64,
    /// Past the receiver.
    missed: f64,
}

/// The powers of a flight.
pub(super) struct Supply(Vec<Power>);

/// Energy of a flight, J.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Energy {
    /// Electrical energy delivered.
    pub(super) delivered: f64,
    /// Optical energy that passes the receiver.
    pub(super) missed: f64,
}

impl Energy {
    /// None.
    pub(super) const NONE: Self = Self {
        delivered: 0.0,
        missed: 0.0,
    };

    /// The same with the energy missed at a floor, J, below which differences are the quadrature's and not the flight's.
    pub(super) fn resolved(self, floor: f64) -> Self {
        Self {
            missed: self.missed.max(floor),
            ..self
        }
    }

    /// Whether it is at least as good in both and better in one.
    pub(super) fn dominates(&self, other: &Self) -> bool {
        self.delivered >= other.delivered && self.missed <= other.missed && self != other
    }
}

fn power(ets: &Ets<f64>, h: &History) -> Power {
    let [roll, pitch, yaw] = h.attitude_rad;
    let r_wb = EulerAngles::new(roll, pitch, yaw).rotation().matrix;
    let face = ets.receiver.on(&Vector3::from(h.position_m), &r_wb);
    let gimbal = GimbalState::at_rest(h.gimbal_rad[0], h.gimbal_rad[1]);
    let power = ets.link(&gimbal, &face).power;
    Power {
        time_s: h.time_s,
        arriving: power.transmitted,
        received: power.received,
        electrical: power.electrical,
        missed: power.missed,
    }
}

impl Supply {
    /// Of a decision.
    pub(super) fn of(problem: &Problem, x: &[f64], every: NonZeroU64) -> Result<Self, ProblemError> {
        let ets = Ets::new(&problem.mission().station);
        let histories = problem.histories(x, every)?;
        Ok(Self(histories.instants.iter().map(|h| power(&ets, h)).collect()))
    }

    /// Of many decisions, on all cores.
    pub(super) fn of_all(
        problem: &Problem,
        decisions: &[Vec<f64>],
        every: NonZeroU64,
    ) -> Result<Vec<Self>, ProblemError> {
        decisions
            .par_iter()
            .map(|x| Self::of(problem, x, every))
            .collect()
    }

    /// Energy with the laser on where the receiver catches at least this share; trapezoidal rule.
    pub(super) fn energy(&self, share: f64) -> Energy {
        let mut energy = Energy::NONE;
        for pair in self.0.windows(2) {
            let half = 0.5 * (pair[1].time_s - pair[0].time_s);
            for p in pair.iter().filter(|p| p.received >= share * p.arriving) {
                energy.delivered += half * p.electrical;
                energy.missed += half * p.missed;
            }
        }
        energy
    }
}

/// Those that no other dominates, by rising missed energy.
pub(super) fn front(energies: &[Energy]) -> Vec<Energy> {
    let free = |e: &&Energy| !energies.iter().any(|other| other.dominates(e));
    let mut front: Vec<Energy> = energies.iter().filter(free).copied().collect();
    front.sort_by(|a, b| a.missed.total_cmp(&b.missed));
    front.dedup();
    front
}

#[cfg(test)]
mod tests {
    use super::*;

    fn energies(pairs: &[(f64, f64)]) -> Vec<Energy> {
        pairs
            .iter()
            .map(|&(delivered, missed)| Energy { delivered, missed })
            .collect()
    }

    #[test]
    fn exact_front_of_five_points() {
        let all = energies(&[(3.0, 3.0), (1.0, 1.0), (2.0, 3.0), (2.0, 2.0), (0.5, 1.0)]);
        assert_eq!(front(&all), energies(&[(1.0, 1.0), (2.0, 2.0), (3.0, 3.0)]));
    }

    #[test]
    fn exact_differences_below_the_floor_are_ties() {
        let all = energies(&[(3.0, 4e-6), (2.0, 2e-6), (4.0, 1e-3)]);
        let resolved: Vec<Energy> = all.iter().map(|e| e.resolved(1e-5)).collect();
        assert_eq!(front(&resolved), energies(&[(3.0, 1e-5), (4.0, 1e-3)]));
    }

    #[test]
    fn exact_energy_of_a_gated_supply() {
        let at = |time_s: f64, received: f64| Power {
            time_s,
            arriving: 2.0,
            received,
            electrical: 0.5 * received,
            missed: 2.0 - received,
        };
        let supply = Supply(vec![at(0.0, 1.0), at(1.0, 2.0), at(3.0, 2.0)]);
        // Trapezoids: electrical 0.5·(0.5 + 1) + 2·1, missed 0.5·(1 + 0); gated: the first instant contributes nothing.
        assert_eq!(
            supply.energy(0.0),
            Energy {
                delivered: 2.75,
                missed: 0.5
            }
        );
        assert_eq!(
            supply.energy(0.9),
            Energy {
                delivered: 2.5,
                missed: 0.0
            }
        );
    }
}
