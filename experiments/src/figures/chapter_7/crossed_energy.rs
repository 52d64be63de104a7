//! Crossings on a grid over the box of two variables, and the optima of *Φ*, judged by energy at several shares of the light.

use super::energy::{Energy, Supply};
use super::optimisations::{Case, Effort, Solved};
use super::solutions::{SEARCHED, every};
use crate::data::DataTable;
use crate::figures::sweep;
use crate::item::ItemError;

/// Shares of the light below which the laser is switched off; 0: never.
pub(super) const SHARES: [f64; 12] = [0.0, 0.5, 0.7, 0.8, 0.85, 0.9, 0.93, 0.95, 0.97, 0.98, 0.99, 0.995];
/// Energy missed that the quadrature over the receiver no longer resolves, of the laser's: its accuracy up to 50° of incidence
/// (`ets::power`), to which the light neglected beyond 2.8 beam radii contributes 4e-8.
const RESOLVED: f64 = 1e-7;

/// A crossing.
pub(super) struct Crossing {
    /// The decision.
    pub(super) x: Vec<f64>,
    /// Its powers.
    pub(super) supply: Supply,
}

/// Crossings in 20 s at level 5.
pub(super) struct Study {
    /// All of the grid.
    pub(super) grid: Vec<Crossing>,
    /// The minimum of *Φ* of two variables.
    pub(super) two: Crossing,
    /// The minimum of *Φ* of four variables.
    pub(super) four: Crossing,
    /// Energy that leaves the laser in a crossing, J.
    pub(super) emitted: f64,
    /// Energy missed up to which differences are the quadrature's, J.
    pub(super) floor: f64,
}

impl Study {
    /// Flies them; intervals of the grid along each variable.
    pub(super) fn of(effort: Effort, intervals: u32) -> Result<Self, ItemError> {
        let problem = &at_level_5(Case::TwoIn20, effort)?.problem;
        let [first, second] = problem.decisions() else {
            return Err(ItemError::new("the grid needs two variables"));
        };
        let row = |a: f64| {
            let row = sweep(second.lower, second.upper, intervals).into_iter();
            row.map(move |b| vec![a, b])
        };
        let decisions: Vec<Vec<f64>> = sweep(first.lower, first.upper, intervals)
            .into_iter()
            .flat_map(row)
            .collect();
        let supplies = Supply::of_all(problem, &decisions, every(problem))?;
        let grid = decisions.into_iter().zip(supplies);
        let mission = problem.mission();
        let emitted = mission.station.beam.power * mission.duration_s;
        Ok(Self {
            grid: grid.map(|(x, supply)| Crossing { x, supply }).collect(),
            two: optimum(Case::TwoIn20, effort)?,
            four: optimum(Case::Four, effort)?,
            emitted,
            floor: RESOLVED * emitted,
        })
    }

    /// Energies of a crossing as far as they are resolved.
    pub(super) fn energy(&self, crossing: &Crossing, share: f64) -> Energy {
        crossing.supply.energy(share).resolved(self.floor)
    }

    /// Energies of the whole grid with the laser switched off below the shares that are wanted.
    pub(super) fn energies(&self, wanted: impl Fn(f64) -> bool) -> Vec<Energy> {
        let shares = SHARES.into_iter().filter(|share| wanted(*share));
        let at = |share| self.grid.iter().map(move |c| self.energy(c, share));
        shares.flat_map(at).collect()
    }

    /// Sum over the grid, resolved or not.
    pub(super) fn total(&self, share: f64) -> Energy {
        let energies = self.grid.iter().map(|c| c.supply.energy(share));
        energies.fold(Energy::NONE, |sum, e| Energy {
            delivered: sum.delivered + e.delivered,
            missed: sum.missed + e.missed,
        })
    }

    /// Energies of the grid at every share.
    pub(super) fn table(&self) -> DataTable {
        let mut data = DataTable::new(["x_0_m", "x_f_m", "share", "delivered_j", "missed_j"]);
        for crossing in &self.grid {
            for share in SHARES {
                let e = self.energy(crossing, share);
                let [x_0, x_f] = [crossing.x[0], crossing.x[1]];
                data.push([
                    x_0.into(),
                    x_f.into(),
                    share.into(),
                    e.delivered.into(),
                    e.missed.into(),
                ]);
            }
        }
        data
    }

    /// Energies of both optima at every share.
    pub(super) fn optima_table(&self) -> DataTable {
        let mut optima =
            DataTable::new(["variables", "share", "delivered_j", "missed_j"]).with_tolerance(SEARCHED);
        for (name, crossing) in [("two", &self.two), ("four", &self.four)] {
            for share in SHARES {
                let e = self.energy(crossing, share);
                optima.push([name.into(), share.into(), e.delivered.into(), e.missed.into()]);
            }
        }
        optima
    }
}

fn at_level_5(case: Case, effort: Effort) -> Result<&'static Solved, ItemError> {
    let last = case.solved(effort)?.last();
    last.ok_or_else(|| ItemError::new("no level was searched"))
}

/// The Φ-optimum of a case at level 5.
fn optimum(case: Case, effort: Effort) -> Result<Crossing, ItemError> {
    let solved = at_level_5(case, effort)?;
    let x = solved.first().best().to_vec();
    let supply = Supply::of(&solved.problem, &x, every(&solved.problem))?;
    Ok(Crossing { x, supply })
}

/// The front as stairs, from no energy delivered to `end`: between two of its points nothing better than the left one is known.
pub(super) fn stairs(front: &[Energy], end: f64) -> Vec<(f64, f64)> {
    let mut stairs = Vec::new();
    let mut delivered = 0.0;
    for point in front {
        stairs.push((point.missed, delivered));
        stairs.push((point.missed, point.delivered));
        delivered = point.delivered;
    }
    stairs.push((end, delivered));
    stairs
}
