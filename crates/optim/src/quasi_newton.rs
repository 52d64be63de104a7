//! Projected BFGS: a local method that uses gradients.
//!
//! In shares of the box, `u = (x − l)/w`, with `g = ∂f/∂u` and an estimate `H` of the inverse Hessian:
//!
//! ```text
//! d = −H g,   u(α) = P(u + α d),   f(u(α)) ≤ f + c₁ g·(u(α) − u),   α = 1, β, β², ...
//! H ← (I − s yᵀ/sᵀy) H (I − y sᵀ/sᵀy) + s sᵀ/sᵀy,   s = Δu,  y = Δg
//! ```
//!
//! P clips to the box. Variables at a bound that the gradient pushes against are held: their rows and columns of H count as the
//! identity's. An update with `sᵀy ≤ 0` is left out. Ends when the projected gradient `‖P(u − g) − u‖∞` is small; needs a
//! cost with a continuous gradient, which a closed loop has between the kinks of its saturations.
//! Gradients come from dual numbers through the cost's own text: [`gradient_by_dual_numbers`].
//!
//! Source: Bertsekas 1982, SIAM J. Control Optim. 20; first scaling of H after Nocedal and Wright 2006, equation (6.20).

use crate::{CostAndGradient, Next, Rule, SetupError, Space, Stepwise, StopReason, Variable, Vertex};
use nalgebra::{DMatrix, DVector};
use quad_math::{Dual, jacobian};
use serde::{Deserialize, Serialize};
use std::cell::Cell;

/// Share of the predicted decrease that a step must bring (Armijo's c₁).
const SUFFICIENT: f64 = 1e-4;
/// Shortening of a step that doesn't, β.
const SHORTER: f64 = 0.5;
/// Shortenings after which the direction is given up.
const SHORTENINGS: u32 = 30;
/// First step, as a share of the box along the steepest variable.
const FIRST_STEP: f64 = 0.1;
/// Steps without a gain of the cost after which rounding is all that is left.
const PATIENCE: u64 = 3;

/// Settings of [`QuasiNewton`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct QuasiNewtonSettings {
    /// Largest component of the projected gradient at the end, in the cost's unit per width of the box.
    pub gradient: f64,
    /// Gain of one step, as a share of the cost, that counts as none.
    pub gain: f64,
}

/// A projected gradient of 1e-6; gains of 1e-14.
impl Default for QuasiNewtonSettings {
    fn default() -> Self {
        Self {
            gradient: 1e-6,
            gain: 1e-14,
        }
    }
}

/// The point, the estimate of the inverse Hessian and the step under way. All in shares of the box.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProjectedBfgs {
    settings: QuasiNewtonSettings,
    here: Option<Point>,
    /// Rows of H; empty: the identity, scaled by the first step.
    inverse_hessian: Vec<Vec<f64>>,
    direction: Vec<f64>,
    length: f64,
    shortenings: u32,
    iterations: u64,
    idle: u64,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Point {
    u: Vec<f64>,
    cost: f64,
    g: Vec<f64>,
}

/// Projected BFGS, for answers with [`CostAndGradient`].
pub type QuasiNewton = Stepwise<ProjectedBfgs, CostAndGradient>;

impl Stepwise<ProjectedBfgs, CostAndGradient> {
    /// A quasi-Newton search from `start`.
    ///
    /// # Errors
    /// Bad variables, a start outside the bounds, settings out of range.
    pub fn new(
        variables: Vec<Variable>,
        start: &[f64],
        settings: QuasiNewtonSettings,
    ) -> Result<Self, SetupError> {
        for (name, value) in [("gradient", settings.gradient), ("gain", settings.gain)] {
            SetupError::unless(value >= 0.0, name, value, "zero or more")?;
        }
        let rule = ProjectedBfgs {
            settings,
            here: None,
            inverse_hessian: Vec::new(),
            direction: Vec::new(),
            length: 1.0,
            shortenings: 0,
            iterations: 0,
            idle: 0,
        };
        Self::start(Space::new(variables)?, rule, vec![start.to_vec()])
    }
}

/// The cost at `x` and its gradient by forward automatic differentiation: one pass through the cost's text.
pub fn gradient_by_dual_numbers<const N: usize>(
    cost: impl Fn(&[Dual<N>; N]) -> Dual<N>,
    x: [f64; N],
) -> CostAndGradient {
    let value = Cell::new(f64::NAN);
    let row = jacobian(
        |x| {
            let y = cost(x);
            value.set(y.re);
            [y]
        },
        x,
    );
    CostAndGradient {
        cost: value.get(),
        gradient: row.iter().copied().collect(),
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

impl Point {
    fn new(space: &Space, vertex: Vertex<CostAndGradient>) -> Self {
        let g = vertex.answer.gradient.iter().enumerate();
        Self {
            u: space.shares(&vertex.values),
            cost: vertex.answer.cost,
            g: g.map(|(i, g)| g * space.width(i)).collect(),
        }
    }

    /// Whether variable `i` is at a bound and the gradient pushes against it.
    fn is_held(&self, i: usize) -> bool {
        (self.u[i] <= 0.0 && self.g[i] > 0.0) || (self.u[i] >= 1.0 && self.g[i] < 0.0)
    }

    /// `‖P(u − g) − u‖∞`.
    fn projected_gradient(&self) -> f64 {
        let component = |(u, g): (&f64, &f64)| ((u - g).clamp(0.0, 1.0) - u).abs();
        self.u.iter().zip(&self.g).map(component).fold(0.0, f64::max)
    }
}

impl ProjectedBfgs {
    /// Steps completed.
    pub fn iterations(&self) -> u64 {
        self.iterations
    }

    /// `d = −H g` in the free variables; down the gradient where H has nothing to say or doesn't point down.
    fn aim(&mut self, here: &Point) {
        let n = here.u.len();
        let free = |i: &usize| !here.is_held(*i);
        let mut d = vec![0.0; n];
        if !self.inverse_hessian.is_empty() {
            for i in (0..n).filter(free) {
                let row = &self.inverse_hessian[i];
                d[i] = -(0..n).filter(free).map(|j| row[j] * here.g[j]).sum::<f64>();
            }
        }
        if dot(&d, &here.g) >= 0.0 {
            self.inverse_hessian.clear();
            let steepest = (0..n)
                .filter(free)
                .map(|i| here.g[i].abs())
                .fold(f64::MIN_POSITIVE, f64::max);
            for i in (0..n).filter(free) {
                d[i] = -here.g[i] * FIRST_STEP / steepest;
            }
        }
        self.direction = d;
        self.length = 1.0;
        self.shortenings = 0;
    }

    fn trial(&self, space: &Space, here: &Point) -> Next {
        let step = here.u.iter().zip(&self.direction);
        let u: Vec<f64> = step.map(|(u, d)| (u + self.length * d).clamp(0.0, 1.0)).collect();
        Next::Ask(vec![space.at_shares(&u)])
    }

    /// The BFGS update by a step from `from` to `to`.
    fn update(&mut self, from: &Point, to: &Point) {
        let n = from.u.len();
        let s = DVector::from_vec(difference(&to.u, &from.u));
        let y = DVector::from_vec(difference(&to.g, &from.g));
        let sy = s.dot(&y);
        if sy <= f64::EPSILON * s.norm() * y.norm() {
            return;
        }
        let before = if self.inverse_hessian.is_empty() {
            DMatrix::identity(n, n) * (sy / y.norm_squared())
        } else {
            DMatrix::from_fn(n, n, |i, j| self.inverse_hessian[i][j])
        };
        let left = DMatrix::identity(n, n) - &s * y.transpose() / sy;
        let after = &left * before * left.transpose() + &s * s.transpose() / sy;
        self.inverse_hessian = after.row_iter().map(|r| r.iter().copied().collect()).collect();
    }

    fn refused(&mut self, space: &Space, here: Point) -> Next {
        self.shortenings += 1;
        self.length *= SHORTER;
        if self.shortenings > SHORTENINGS {
            if self.inverse_hessian.is_empty() {
                return Next::Stop(StopReason::Stalled {
                    iterations: u64::from(SHORTENINGS),
                });
            }
            self.inverse_hessian.clear();
            self.aim(&here);
        }
        let next = self.trial(space, &here);
        self.here = Some(here);
        next
    }
}

impl Rule<CostAndGradient> for ProjectedBfgs {
    fn next(&mut self, space: &Space, mut told: Vec<Vertex<CostAndGradient>>) -> Next {
        let Some(vertex) = told.pop() else {
            return Next::Stop(StopReason::ScheduleDone);
        };
        let to = Point::new(space, vertex);
        if let Some(from) = self.here.take() {
            let step = difference(&to.u, &from.u);
            let enough = from.cost + SUFFICIENT * dot(&from.g, &step);
            if to.cost > enough {
                return self.refused(space, from);
            }
            self.update(&from, &to);
            self.iterations += 1;
            let gained = from.cost - to.cost > self.settings.gain * from.cost.abs();
            self.idle = if gained { 0 } else { self.idle + 1 };
        }
        let cost_spread = to.projected_gradient();
        if cost_spread <= self.settings.gradient {
            return Next::Stop(StopReason::Converged {
                spread: self.length * self.direction.iter().fold(0.0, |m: f64, d| m.max(d.abs())),
                cost_spread,
            });
        }
        if self.idle >= PATIENCE {
            return Next::Stop(StopReason::Stalled {
                iterations: self.idle,
            });
        }
        self.aim(&to);
        let next = self.trial(space, &to);
        self.here = Some(to);
        next
    }
}
