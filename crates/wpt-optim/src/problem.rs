//! The problem: a mission, a level, decision variables, and what a decision costs.

use crate::condition::Condition;
use crate::cost::{Cost, Penalties, Terms, Weights};
use crate::decision::{self, Decision};
use crate::error::ProblemError;
use crate::fleet::Fleet;
use crate::mission::{Mission, Timing};
use crate::outcome::{Histories, History, Outcome};
use crate::path::Path;
use crate::rollout::Tally;
use nalgebra::SimdValue;
use num_dual::Dual64;
use optim::Variable;
use quad_dynamics::Level;
use quad_math::{F64x4, Real};
use std::num::NonZeroU64;

/// How many decisions are flown side by side.
pub const LANES: usize = 4;

/// A trajectory optimisation at one level.
///
/// Posed once, asked often, from any thread: evaluating is a pure function of the decision vector.
#[derive(Clone, Debug)]
pub struct Problem {
    mission: Mission,
    level: Level,
    decisions: Vec<Decision>,
    pub(crate) cost: Cost<f64>,
    pub(crate) timing: Timing,
    pub(crate) fleet: Fleet<f64>,
    lanes: Fleet<F64x4>,
}

/// A cost and how it changes with the decision.
#[derive(Clone, Debug, PartialEq)]
pub struct Gradient {
    /// The cost Φ.
    pub cost: f64,
    /// `∂Φ/∂X_i`, in the order of the variables.
    pub gradient: Vec<f64>,
}

impl Problem {
    /// Poses a problem.
    ///
    /// # Errors
    /// Variables: none, one twice, bounds that enclose nothing, a start outside. Weights or limits that are negative or no
    /// numbers. A duration that is no multiple of the steps, a camera with noise, a vehicle that can't fly at the level.
    pub fn new(
        mission: Mission,
        level: Level,
        decisions: Vec<Decision>,
        weights: &Weights,
        penalties: &Penalties,
    ) -> Result<Self, ProblemError> {
        decision::check(&decisions)?;
        mission.check_ends()?;
        let timing = mission.timing()?;
        let cost = Cost::new(&mission.station, &mission.vehicle, weights, penalties)?;
        Ok(Self {
            fleet: Fleet::build(&mission, level, &cost)?,
            lanes: Fleet::build(&mission, level, &cost)?,
            mission,
            level,
            decisions,
            cost,
            timing,
        })
    }

    /// The same problem at another level.
    ///
    /// # Errors
    /// A vehicle that can't fly at the level.
    pub fn at_level(&self, level: Level) -> Result<Self, ProblemError> {
        Ok(Self {
            fleet: Fleet::build(&self.mission, level, &self.cost)?,
            lanes: Fleet::build(&self.mission, level, &self.cost)?,
            level,
            ..self.clone()
        })
    }

    /// The same problem with other variables, bounds or starts.
    ///
    /// # Errors
    /// As of [`Problem::new`], of variables.
    pub fn deciding(&self, decisions: Vec<Decision>) -> Result<Self, ProblemError> {
        decision::check(&decisions)?;
        Ok(Self {
            decisions,
            ..self.clone()
        })
    }

    /// The mission.
    pub fn mission(&self) -> &Mission {
        &self.mission
    }

    /// The level of the model.
    pub fn level(&self) -> Level {
        self.level
    }

    /// The decision variables.
    pub fn decisions(&self) -> &[Decision] {
        &self.decisions
    }

    /// The decision variables as optimisers know them.
    pub fn variables(&self) -> Vec<Variable> {
        self.decisions.iter().map(Decision::variable).collect()
    }

    /// Where a local search starts: X0.
    pub fn start(&self) -> Vec<f64> {
        self.decisions.iter().map(|d| d.start).collect()
    }

    /// Checks the length of a decision vector, and that it is one of numbers.
    pub(crate) fn check(&self, x: &[f64]) -> Result<(), ProblemError> {
        let (expected, found) = (self.decisions.len(), x.len());
        if found != expected {
            return Err(ProblemError::WrongLength { expected, found });
        }
        let bad = self.decisions.iter().zip(x).find(|(_, value)| !value.is_finite());
        match bad {
            Some((decision, &value)) => Err(ProblemError::NotFinite {
                condition: decision.condition,
                value,
            }),
            None => Ok(()),
        }
    }

    fn conditions(&self) -> impl Iterator<Item = Condition> {
        self.decisions.iter().map(|d| d.condition)
    }

    /// The path of a decision as it is flown by a fleet over some scalar.
    fn path<R: Real>(&self, fleet: &Fleet<R>, x: impl Iterator<Item = R>) -> Result<Path<R>, ProblemError> {
        let leg = self.mission.trajectory(self.conditions().zip(x))?;
        Ok(fleet.path(leg, self.mission.vehicle.environment.gravity))
    }

    /// The path of a decision: what the vehicle is asked to do.
    ///
    /// # Errors
    /// A decision vector of another length, or with a number that isn't finite.
    pub fn path_of(&self, x: &[f64]) -> Result<Path<f64>, ProblemError> {
        self.check(x)?;
        self.path(&self.fleet, x.iter().copied())
    }

    /// Flies a decision: what it costs and why.
    ///
    /// Bounds are the optimiser's business: a decision outside is flown like any other.
    ///
    /// # Errors
    /// A decision vector of another length, or with a number that isn't finite. A flight that fails is no error:
    /// [`Outcome::failure`].
    pub fn evaluate(&self, x: &[f64]) -> Result<Outcome, ProblemError> {
        let path = self.path_of(x)?;
        Ok(self.outcome(&self.fleet.fly(&self.timing, &path, &mut |_| ())))
    }

    /// Flies a decision and keeps every `every`-th instant of the station, the first and the last.
    ///
    /// # Errors
    /// As [`Problem::evaluate`].
    pub fn histories(&self, x: &[f64], every: NonZeroU64) -> Result<Histories, ProblemError> {
        let path = self.path_of(x)?;
        let count = self.timing.grid.steps() / self.timing.ratio;
        let (mut n, mut instants) = (0, Vec::with_capacity((count / every) as usize + 2));
        let tally = self.fleet.fly(&self.timing, &path, &mut |instant| {
            if n % every == 0 || n == count {
                instants.push(History::of(
                    instant,
                    &path,
                    self.cost.weighted(&instant.glance.terms),
                ));
            }
            n += 1;
        });
        Ok(Histories {
            outcome: self.outcome(&tally),
            instants,
        })
    }

    /// Flies four decisions side by side, one per SIMD lane; agrees with [`Problem::evaluate`] to rounding.
    ///
    /// # Errors
    /// As [`Problem::evaluate`], of the first decision that is wrong.
    pub fn evaluate_lanes(&self, decisions: [&[f64]; LANES]) -> Result<[Outcome; LANES], ProblemError> {
        for x in decisions {
            self.check(x)?;
        }
        let component = |i: usize| F64x4::from(decisions.map(|x| x[i]));
        let path = self.path(&self.lanes, (0..self.decisions.len()).map(component))?;
        let tally = self.lanes.fly(&self.timing, &path, &mut |_| ());
        Ok(std::array::from_fn(|lane| {
            self.outcome(&Tally {
                cost: tally.cost.extract(lane),
                means: Terms::from_array(tally.means.array().map(|term| term.extract(lane))),
                failed: tally.failed.extract(lane),
            })
        }))
    }

    /// Cost and gradient, by dual numbers through the whole flight, one flight per variable.
    ///
    /// Where a kink is crossed (a lost target's moment, a frame that just misses it) the gradient is that of the side
    /// flown on.
    ///
    /// # Errors
    /// As [`Problem::evaluate`].
    pub fn gradient(&self, x: &[f64]) -> Result<Gradient, ProblemError> {
        self.check(x)?;
        let fleet = Fleet::<Dual64>::build(&self.mission, self.level, &self.cost)?;
        let (mut cost, mut gradient) = (0.0, Vec::with_capacity(x.len()));
        for varied in 0..x.len() {
            let seeded = x.iter().enumerate().map(|(i, &value)| {
                let rate = if i == varied { 1.0 } else { 0.0 };
                Dual64::new(value, rate)
            });
            let path = self.path(&fleet, seeded)?;
            let tally = fleet.fly(&self.timing, &path, &mut |_| ());
            cost = tally.cost.re;
            gradient.push(tally.cost.eps);
        }
        Ok(Gradient { cost, gradient })
    }

    fn outcome(&self, tally: &Tally<f64>) -> Outcome {
        Outcome::of(tally, self.mission.duration_s)
    }
}
