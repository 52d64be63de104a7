//! Nelder and Mead's simplex.
//!
//! The worst of n + 1 vertices `x_{n+1}` is replaced by a point on the line through it and the centroid `x̄` of the others:
//!
//! ```text
//! reflection   x_r = (1 + ρ) x̄ − ρ x_{n+1}          contraction outside  x_c = (1 + ψρ) x̄ − ψρ x_{n+1}
//! expansion    x_e = (1 + ρχ) x̄ − ρχ x_{n+1}        contraction inside   x_cc = (1 − ψ) x̄ + ψ x_{n+1}
//! shrinking    x_i ← x_1 + σ (x_i − x_1)
//! ```
//!
//! with ρ, χ, ψ, σ = 1, 2, ½, ½, or those of Gao and Han for many variables: χ = 1 + 2/n, ψ = ¾ − 1/2n, σ = 1 − 1/n.
//! Candidates are clipped to the bounds. A simplex may go flat against a bound or in a valley: a restart puts
//! a fresh one about the best vertex, and the search ends when a restart gains less than the tolerance.
//! Local: it ends in the valley it started in. From about 20 variables it stalls on curved valleys.
//!
//! Sources: Nelder and Mead 1965; acceptance rules of Lagarias, Reeds, Wright and Wright 1998, SIAM J. Optim. 9; Gao and Han
//! 2012, Comput. Optim. Appl. 51. Operations are in SciPy's order, so that simplices agree with its bit for bit.

use crate::{Next, Rule, SetupError, Space, Stepwise, StopReason, Variable, Vertex};
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;

/// Coefficients of the moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Coefficients {
    /// Nelder and Mead's.
    Standard,
    /// Gao and Han's, which depend on the number of variables; for two they are the standard ones.
    Adaptive,
}

/// Settings of [`NelderMead`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SimplexSettings {
    /// Edge of the first simplex, as a share of each variable's width.
    pub step: f64,
    /// Converged when no vertex is farther from the best along any variable, as a share of its width ...
    pub spread: f64,
    /// ... and no vertex costs more than the best by this, in the cost's unit.
    pub cost_spread: f64,
    /// Coefficients of the moves.
    pub coefficients: Coefficients,
    /// How many fresh simplices may follow the first one.
    pub restarts: u32,
}

/// A tenth of the box, to 1e-6 of it and 1e-8 of the cost, without restarts.
impl Default for SimplexSettings {
    fn default() -> Self {
        Self {
            step: 0.1,
            spread: 1e-6,
            cost_spread: 1e-8,
            coefficients: Coefficients::Standard,
            restarts: 0,
        }
    }
}

/// The last question.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum Move {
    /// Every vertex that has no cost yet.
    Fill,
    Reflect,
    Expand {
        reflected: Vertex,
    },
    ContractOutside {
        reflected: Vertex,
    },
    ContractInside,
}

/// The simplex and its moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Simplex {
    settings: SimplexSettings,
    vertices: Vec<Vertex>,
    last: Move,
    iterations: u64,
    restarts: u32,
    cost_at_restart: Option<f64>,
}

/// Nelder-Mead as an [`Optimiser`](crate::Optimiser).
pub type NelderMead = Stepwise<Simplex>;

impl Stepwise<Simplex> {
    /// A simplex with one vertex at `start` and one a step away along each variable, away from the nearer bound where
    /// the step would leave the box.
    ///
    /// # Errors
    /// Bad variables, a start outside the bounds, settings out of range.
    pub fn new(
        variables: Vec<Variable>,
        start: &[f64],
        settings: SimplexSettings,
    ) -> Result<Self, SetupError> {
        let space = Space::new(variables)?;
        space.admit(start)?;
        let mut vertices = vec![start.to_vec()];
        vertices.extend(around(&space, start, settings.step));
        Self::from_simplex(space.into(), vertices, settings)
    }

    /// A simplex of these n + 1 vertices.
    ///
    /// # Errors
    /// Bad variables, a vertex outside the bounds, a wrong number of them, settings out of range.
    pub fn from_simplex(
        variables: Vec<Variable>,
        vertices: Vec<Vec<f64>>,
        settings: SimplexSettings,
    ) -> Result<Self, SetupError> {
        let space = Space::new(variables)?;
        let (variables, found) = (space.dimension(), vertices.len());
        if found != variables + 1 {
            return Err(SetupError::SimplexSize { variables, found });
        }
        let step = settings.step;
        SetupError::unless(step > 0.0 && step <= 0.5, "step", step, "above 0 and at most 0.5")?;
        for (name, value) in [("spread", settings.spread), ("cost_spread", settings.cost_spread)] {
            SetupError::unless(value >= 0.0, name, value, "zero or more")?;
        }
        let simplex = Simplex {
            settings,
            vertices: Vec::new(),
            last: Move::Fill,
            iterations: 0,
            restarts: 0,
            cost_at_restart: None,
        };
        Self::start(space, simplex, vertices)
    }
}

/// A vertex a step away from `x` along each variable, inwards where the step would leave the box.
fn around(space: &Space, x: &[f64], step: f64) -> impl Iterator<Item = Vec<f64>> {
    (0..space.dimension()).map(move |i| {
        let mut vertex = x.to_vec();
        let length = step * space.width(i);
        let inside = vertex[i] + length <= space.variables()[i].upper;
        vertex[i] += if inside { length } else { -length };
        vertex
    })
}

impl Simplex {
    /// Its vertices, the best one first once all have costs.
    pub fn vertices(&self) -> &[Vertex] {
        &self.vertices
    }

    /// Moves completed.
    pub fn iterations(&self) -> u64 {
        self.iterations
    }

    /// The point `(1 + t) x̄ − t x_{n+1}`, clipped.
    fn along(&self, space: &Space, t: f64) -> Vec<f64> {
        let n = space.dimension();
        let others = &self.vertices[..n];
        let worst = &self.vertices[n].values;
        let point = (0..n).map(|i| {
            let centroid = others.iter().map(|v| v.values[i]).sum::<f64>() / n as f64;
            (1.0 + t) * centroid - t * worst[i]
        });
        space.clipped(point.collect())
    }

    fn chi(&self, n: f64) -> f64 {
        match self.settings.coefficients {
            Coefficients::Standard => 2.0,
            Coefficients::Adaptive => 1.0 + 2.0 / n,
        }
    }

    fn psi(&self, n: f64) -> f64 {
        match self.settings.coefficients {
            Coefficients::Standard => 0.5,
            Coefficients::Adaptive => 0.75 - 1.0 / (2.0 * n),
        }
    }

    fn sigma(&self, n: f64) -> f64 {
        match self.settings.coefficients {
            Coefficients::Standard => 0.5,
            // For one variable theirs would be nought, and every shrinkage the end.
            Coefficients::Adaptive if n < 2.0 => 0.5,
            Coefficients::Adaptive => 1.0 - 1.0 / n,
        }
    }

    fn replace_worst(&mut self, vertex: Vertex) {
        self.vertices.pop();
        self.vertices.push(vertex);
    }

    /// All vertices but the best half-way to it.
    fn shrunk(&mut self, space: &Space) -> Next {
        let sigma = self.sigma(space.dimension() as f64);
        let rest = self.vertices.split_off(1);
        let best = &self.vertices[0].values;
        let towards = |v: Vertex| {
            let point = best.iter().zip(&v.values).map(|(b, x)| b + sigma * (x - b));
            space.clipped(point.collect())
        };
        self.last = Move::Fill;
        Next::Ask(rest.into_iter().map(towards).collect())
    }

    /// What follows a reflection (Lagarias et al., steps 2 to 5).
    fn after_reflection(&mut self, space: &Space, reflected: Vertex) -> Option<Next> {
        let n = space.dimension();
        let cost = reflected.cost();
        let (chi, psi) = (self.chi(n as f64), self.psi(n as f64));
        if cost < self.vertices[0].cost() {
            self.last = Move::Expand { reflected };
            return Some(Next::Ask(vec![self.along(space, chi)]));
        }
        if cost < self.vertices[n - 1].cost() {
            self.replace_worst(reflected);
            return None;
        }
        if cost < self.vertices[n].cost() {
            self.last = Move::ContractOutside { reflected };
            return Some(Next::Ask(vec![self.along(space, psi)]));
        }
        self.last = Move::ContractInside;
        Some(Next::Ask(vec![self.along(space, -psi)]))
    }

    /// Applies the answers; returns a further question of the same iteration, if any.
    fn settle(&mut self, space: &Space, mut told: Vec<Vertex>) -> Option<Next> {
        match std::mem::replace(&mut self.last, Move::Reflect) {
            Move::Fill => self.vertices.append(&mut told),
            Move::Reflect => return self.after_reflection(space, told.pop()?),
            Move::Expand { reflected } => {
                let expanded = told.pop()?;
                let better = expanded.cost() < reflected.cost();
                self.replace_worst(if better { expanded } else { reflected });
            }
            Move::ContractOutside { reflected } => {
                let contracted = told.pop()?;
                if contracted.cost() > reflected.cost() {
                    return Some(self.shrunk(space));
                }
                self.replace_worst(contracted);
            }
            Move::ContractInside => {
                let contracted = told.pop()?;
                if contracted.cost() >= self.vertices[space.dimension()].cost() {
                    return Some(self.shrunk(space));
                }
                self.replace_worst(contracted);
            }
        }
        None
    }

    /// Largest distances from the best vertex: of a variable, as a share of its width, and of the costs.
    fn spreads(&self, space: &Space) -> (f64, f64) {
        let best = &self.vertices[0];
        let mut spreads = (0.0_f64, 0.0_f64);
        for vertex in &self.vertices[1..] {
            for (i, (x, b)) in vertex.values.iter().zip(&best.values).enumerate() {
                spreads.0 = spreads.0.max((x - b).abs() / space.width(i));
            }
            spreads.1 = spreads.1.max((vertex.cost() - best.cost()).abs());
        }
        spreads
    }

    /// A fresh simplex about the best vertex, or the end.
    fn restart_or_stop(&mut self, space: &Space, reason: StopReason) -> Next {
        let cost = self.vertices[0].cost();
        let gained = self
            .cost_at_restart
            .is_none_or(|before| before - cost > self.settings.cost_spread);
        if self.restarts == self.settings.restarts || !gained {
            return Next::Stop(reason);
        }
        self.restarts += 1;
        self.cost_at_restart = Some(cost);
        self.vertices.truncate(1);
        self.last = Move::Fill;
        Next::Ask(around(space, &self.vertices[0].values, self.settings.step).collect())
    }
}

impl Rule for Simplex {
    fn next(&mut self, space: &Space, told: Vec<Vertex>) -> Next {
        if let Some(question) = self.settle(space, told) {
            return question;
        }
        self.iterations += 1;
        let by_cost = |a: &Vertex, b: &Vertex| a.cost().partial_cmp(&b.cost()).unwrap_or(Ordering::Equal);
        self.vertices.sort_by(by_cost);
        let (spread, cost_spread) = self.spreads(space);
        if spread <= self.settings.spread && cost_spread <= self.settings.cost_spread {
            return self.restart_or_stop(space, StopReason::Converged { spread, cost_spread });
        }
        Next::Ask(vec![self.along(space, 1.0)])
    }
}
