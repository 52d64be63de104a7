//! The optimum of one level, by moves to the minimum of the corrected lowest level within a trust region.

use super::ladder::Ladder;
use super::{LevelOptimum, MultiFidelityError, MultiFidelitySettings};
use crate::{
    Candidate, Evaluation, Limits, NelderMead, SetupError, SimplexSettings, StopReason, Variable, minimise,
};

/// Agreement of predicted and true gain below which the region shrinks, and above which it may grow.
const POOR: f64 = 0.25;
const GOOD: f64 = 0.75;
/// Factors of the radius.
const SHRINK: f64 = 0.5;
const GROW: f64 = 2.0;
/// Largest radius: the whole box from its middle.
const LARGEST: f64 = 0.5;
/// Share of the radius that counts as its edge.
const EDGE: f64 = 0.9;
/// Evaluations of the surrogate per variable and move.
const SURROGATE_CALLS: u64 = 100;

/// A move under way.
struct Region<'l, 'a> {
    ladder: &'l mut Ladder<'a>,
    level: usize,
    x: Vec<f64>,
    cost: f64,
    radius: f64,
    calls: u64,
    interrupted: bool,
}

/// The optimum of `level`, from `start`.
pub(super) fn optimum(
    ladder: &mut Ladder<'_>,
    level: usize,
    start: Vec<f64>,
    settings: &MultiFidelitySettings,
) -> Result<LevelOptimum, MultiFidelityError> {
    let Some(cost) = ladder.climb(level, &start) else {
        let values = start;
        return Err(MultiFidelityError::Failed { level, values });
    };
    let mut region = Region {
        interrupted: ladder.report(level, cost),
        ladder,
        level,
        x: start,
        cost,
        radius: settings.radius,
        calls: 1,
    };
    region.explore(settings);
    let stop = region.descend(settings)?;
    Ok(LevelOptimum {
        level,
        values: region.x,
        cost: region.cost,
        stop,
    })
}

impl Region<'_, '_> {
    /// Flies a point at this level; takes it if it is better.
    fn fly(&mut self, x: &[f64]) -> Option<f64> {
        let cost = self.ladder.climb(self.level, x);
        self.calls += 1;
        if let Some(cost) = cost.filter(|&c| c < self.cost) {
            self.cost = cost;
            self.x = x.to_vec();
        }
        self.interrupted |= self.ladder.report(self.level, self.cost);
        cost
    }

    fn is_over(&self, settings: &MultiFidelitySettings) -> bool {
        self.interrupted || self.calls >= settings.calls
    }

    /// A step along each variable, towards the farther bound, for the slopes of the corrections.
    fn explore(&mut self, settings: &MultiFidelitySettings) {
        let centre = self.x.clone();
        for i in 0..centre.len() {
            if self.is_over(settings) {
                return;
            }
            let v = &self.ladder.space.variables()[i];
            let step = self.radius * self.ladder.space.width(i);
            let inwards = v.upper - centre[i] >= centre[i] - v.lower;
            let mut x = centre.clone();
            x[i] += if inwards { step } else { -step };
            self.fly(&x);
        }
    }

    fn descend(&mut self, settings: &MultiFidelitySettings) -> Result<StopReason, SetupError> {
        let mut cost_spread = 0.0;
        while self.radius >= settings.least_radius {
            if self.interrupted {
                return Ok(StopReason::Interrupted);
            }
            if self.calls >= settings.calls {
                return Ok(StopReason::Budget {
                    evaluations: self.calls,
                });
            }
            self.ladder.correct(self.level, &self.x);
            let least = settings.gain * self.cost.abs();
            let predicted = self.predict(least)?;
            let (before, from) = (self.cost, self.x.clone());
            cost_spread = before - predicted.cost;
            if cost_spread <= least {
                break;
            }
            let to = predicted.candidate.values;
            let gained = self.fly(&to).map_or(f64::NEG_INFINITY, |cost| before - cost);
            self.resize(gained / cost_spread, self.step(&from, &to));
        }
        Ok(StopReason::Converged {
            spread: self.radius,
            cost_spread,
        })
    }

    /// The largest component of a step, as a share of the width.
    fn step(&self, from: &[f64], to: &[f64]) -> f64 {
        let space = &self.ladder.space;
        let component = |(i, (a, b)): (usize, (&f64, &f64))| (a - b).abs() / space.width(i);
        from.iter().zip(to).enumerate().map(component).fold(0.0, f64::max)
    }

    fn resize(&mut self, agreement: f64, step: f64) {
        if agreement < POOR {
            // A step well inside the region says that the region must shrink below it.
            self.radius = SHRINK * self.radius.min(2.0 * step);
        } else if agreement > GOOD && step > EDGE * self.radius {
            self.radius = (GROW * self.radius).min(LARGEST);
        }
    }

    /// The minimum of the surrogate within the region, to a tenth of the gain that matters.
    fn predict(&self, least: f64) -> Result<Evaluation, SetupError> {
        let around = |(v, x): (Variable, &f64)| {
            let reach = self.radius * (v.upper - v.lower);
            Variable {
                lower: v.lower.max(x - reach),
                upper: v.upper.min(x + reach),
                ..v
            }
        };
        let variables = self.ladder.variables().into_iter().zip(&self.x).map(around);
        let settings = SimplexSettings {
            step: 0.25,
            spread: 0.05,
            cost_spread: 0.1 * least,
            restarts: 1,
            ..SimplexSettings::default()
        };
        let mut search = NelderMead::new(variables.collect(), &self.x, settings)?;
        let limits = Limits::evaluations(SURROGATE_CALLS * self.x.len() as u64);
        let cost = |x: &[f64]| self.ladder.surrogate(x).unwrap_or(f64::NAN);
        let report = minimise(&mut search, cost, limits);
        // The centre's surrogate is finite, since every level was there; without it there is nothing to gain.
        Ok(report.map_or_else(
            |_| Evaluation {
                candidate: Candidate {
                    id: 0,
                    values: self.x.clone(),
                },
                cost: self.cost,
            },
            |report| report.best,
        ))
    }
}
