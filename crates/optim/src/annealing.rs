//! Simulated annealing.
//!
//! A walker tries steps along one variable at a time, `x_h' = x_h + c v_h`, c from Cauchy's distribution, reflected at the bounds. A better
//! cost is accepted, a worse one with probability `exp(−Δf / T)`. After each set of cycles the steps `v_h` are adapted so that about
//! half of them are accepted, and after several adaptations the temperature falls geometrically, `T ← r_T T`, and
//! the walker returns to the best point. It ends when the cost at the end of several temperatures in a row has
//! changed little and lies as little above the best.
//! Corana's steps are uniform in ±v_h; those lock the walker in its valley as soon as they have shrunk to it, while some of
//! Cauchy's stay long (of 40 searches on Rastrigin's function in two variables 40 find the origin, with uniform steps 27).
//! The first temperature is, unless given, the standard deviation of the cost over random points (White 1984).
//!
//! Source: Kirkpatrick, Gelatt and Vecchi 1983; steps, cooling and end of Corana, Marchesi, Martini and Ridella 1987,
//! ACM TOMS 13; Cauchy's steps of Szu and Hartley 1987, Phys. Lett. A 122.

use crate::answer::NO_COST;
use crate::draws::Draws;
use crate::{FAILED_COST, Next, Rule, SetupError, Space, Stepwise, StopReason, Variable, Vertex};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Corana's `c_u`: how fast steps are adapted.
const ADAPTATION: f64 = 2.0;
/// Accepted shares between which steps are left alone.
const ACCEPTED: [f64; 2] = [0.4, 0.6];
/// Temperatures over which the cost must be still at the end: Corana's `N_ε`.
const STILL: usize = 4;
/// Stream of the first random points; the walk's streams count up from zero.
const SAMPLE_STREAM: u64 = u64::MAX;
/// Random points per variable that set the first temperature.
const SAMPLE_PER_VARIABLE: usize = 10;

/// Settings of [`Annealing`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AnnealingSettings {
    /// First temperature, in the cost's unit; `None`: the standard deviation over random points.
    pub temperature: Option<f64>,
    /// Temperature over the one before, `r_T`, between 0 and 1.
    pub cooling: f64,
    /// Cycles (one step along each variable) between adaptations of the steps, `N_S`; at least 1.
    pub cycles: u32,
    /// Adaptations per temperature, `N_T`; at least 1.
    pub adaptations: u32,
    /// Change of the cost that counts as none, `ε`, in the cost's unit.
    pub gain: f64,
    /// Most temperatures; at least 1.
    pub temperatures: u32,
    /// Seed of everything random.
    pub seed: u64,
}

/// Corana's cycles with fewer adaptations and a faster cooling, which take a third of the evaluations: about 3000 per variable.
impl Default for AnnealingSettings {
    fn default() -> Self {
        Self {
            temperature: None,
            cooling: 0.8,
            cycles: 20,
            adaptations: 2,
            gain: 1e-6,
            temperatures: 100,
            seed: 0,
        }
    }
}

/// The walker.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Walk {
    settings: AnnealingSettings,
    temperature: Option<f64>,
    here: Vertex,
    best: Vertex,
    steps: Vec<f64>,
    accepted: Vec<u32>,
    moves: u64,
    axis: usize,
    cycle: u32,
    adaptation: u32,
    cooled: u32,
    ends: Vec<f64>,
}

/// Simulated annealing as an [`Optimiser`](crate::Optimiser).
pub type Annealing = Stepwise<Walk>;

impl Stepwise<Walk> {
    /// An annealing from `start`.
    ///
    /// # Errors
    /// Bad variables, a start outside the bounds, settings out of range.
    pub fn new(
        variables: Vec<Variable>,
        start: &[f64],
        settings: AnnealingSettings,
    ) -> Result<Self, SetupError> {
        let s = settings;
        let t = s.temperature.unwrap_or(1.0);
        SetupError::unless(t > 0.0 && t.is_finite(), "temperature", t, "positive")?;
        SetupError::unless(
            s.cooling > 0.0 && s.cooling < 1.0,
            "cooling",
            s.cooling,
            "between 0 and 1",
        )?;
        SetupError::unless(s.gain >= 0.0, "gain", s.gain, "zero or more")?;
        for (name, count) in [
            ("cycles", s.cycles),
            ("adaptations", s.adaptations),
            ("temperatures", s.temperatures),
        ] {
            SetupError::unless(count >= 1, name, f64::from(count), "at least 1")?;
        }
        let space = Space::new(variables)?;
        let n = space.dimension();
        let here = Vertex {
            values: start.to_vec(),
            answer: NO_COST,
        };
        let walk = Walk {
            settings,
            temperature: s.temperature,
            best: here.clone(),
            here,
            steps: (0..n).map(|i| 0.5 * space.width(i)).collect(),
            accepted: vec![0; n],
            moves: 0,
            axis: 0,
            cycle: 0,
            adaptation: 0,
            cooled: 0,
            ends: Vec::new(),
        };
        let mut first = vec![start.to_vec()];
        if s.temperature.is_none() {
            let mut draws = Draws::new(s.seed, SAMPLE_STREAM);
            let mut point = || space.at_shares(&(0..n).map(|_| draws.share()).collect::<Vec<f64>>());
            first.extend((0..SAMPLE_PER_VARIABLE * n).map(|_| point()));
        }
        Self::start(space, walk, first)
    }
}

/// The standard deviation of the costs without failures; 1 where it is zero.
fn deviation(told: &[Vertex]) -> f64 {
    let costs: Vec<f64> = told
        .iter()
        .map(Vertex::cost)
        .filter(|&c| c < FAILED_COST)
        .collect();
    let count = costs.len().max(1) as f64;
    let mean = costs.iter().sum::<f64>() / count;
    let variance = costs.iter().map(|c| (c - mean).powi(2)).sum::<f64>() / count;
    if variance > 0.0 && variance.is_finite() {
        variance.sqrt()
    } else {
        1.0
    }
}

impl Walk {
    /// The temperature now, in the cost's unit; `None` before the first costs.
    pub fn temperature(&self) -> Option<f64> {
        self.temperature
    }

    /// A step along the variable whose turn it is.
    fn step(&self, space: &Space) -> Next {
        let mut draws = Draws::new(self.settings.seed, self.moves);
        let (axis, v) = (self.axis, &space.variables()[self.axis]);
        let mut x = self.here.values.clone();
        let cauchy = (PI * (draws.share() - 0.5)).tan();
        // Reflected as often as need be: a triangular wave of twice the width. The clip is for its rounding.
        let width = space.width(axis);
        let along = (x[axis] - v.lower + cauchy * self.steps[axis]).rem_euclid(2.0 * width);
        x[axis] = v.lower + along.min(2.0 * width - along);
        Next::Ask(vec![space.clipped(x)])
    }

    /// Metropolis' criterion; draws the second number of the move's stream.
    fn accepts(&self, cost: f64) -> bool {
        let mut draws = Draws::new(self.settings.seed, self.moves);
        draws.share();
        let temperature = self.temperature.unwrap_or(f64::MIN_POSITIVE);
        let rise = cost - self.here.cost();
        rise <= 0.0 || draws.share() < (-rise / temperature).exp()
    }

    fn consider(&mut self, vertex: Vertex) {
        if self.accepts(vertex.cost()) {
            self.accepted[self.axis] += 1;
            if vertex.cost() < self.best.cost() {
                self.best = vertex.clone();
            }
            self.here = vertex;
        }
        self.moves += 1;
    }

    /// Longer steps where most are accepted, shorter ones where few are (Corana's equation for `v'`).
    fn adapt(&mut self, space: &Space) {
        let [few, many] = ACCEPTED;
        for (i, step) in self.steps.iter_mut().enumerate() {
            let share = f64::from(self.accepted[i]) / f64::from(self.settings.cycles);
            let longer = 1.0 + ADAPTATION * (share - many) / (1.0 - many);
            let shorter = 1.0 / (1.0 + ADAPTATION * (few - share) / few);
            let factor = if share > many {
                longer
            } else if share < few {
                shorter
            } else {
                1.0
            };
            *step = (*step * factor).min(space.width(i));
            self.accepted[i] = 0;
        }
    }

    /// Cools, or ends where the costs are still or the schedule is over.
    fn cool(&mut self, space: &Space) -> Option<StopReason> {
        let end = self.here.cost();
        let still = self.ends.iter().rev().take(STILL);
        let change = still.clone().map(|e| (e - end).abs()).fold(0.0, f64::max);
        let above = end - self.best.cost();
        let quiet = still.count() == STILL && change <= self.settings.gain && above <= self.settings.gain;
        self.ends.push(end);
        self.cooled += 1;
        if quiet {
            let steps = self.steps.iter().enumerate();
            return Some(StopReason::Converged {
                spread: steps.map(|(i, step)| step / space.width(i)).fold(0.0, f64::max),
                cost_spread: change.max(above),
            });
        }
        if self.cooled == self.settings.temperatures {
            return Some(StopReason::ScheduleDone);
        }
        self.temperature = self.temperature.map(|t| self.settings.cooling * t);
        self.here = self.best.clone();
        None
    }

    /// Counts the loops: variables within cycles within adaptations within temperatures.
    fn count(&mut self, space: &Space) -> Option<StopReason> {
        self.axis += 1;
        if self.axis < space.dimension() {
            return None;
        }
        self.axis = 0;
        self.cycle += 1;
        if self.cycle < self.settings.cycles {
            return None;
        }
        self.cycle = 0;
        self.adapt(space);
        self.adaptation += 1;
        if self.adaptation < self.settings.adaptations {
            return None;
        }
        self.adaptation = 0;
        self.cool(space)
    }
}

impl Rule for Walk {
    fn next(&mut self, space: &Space, mut told: Vec<Vertex>) -> Next {
        // Before the first move every cost is the sample's.
        if self.here.cost() == NO_COST {
            self.temperature.get_or_insert(deviation(&told));
            self.here = told.swap_remove(0);
            self.best = self.here.clone();
            return self.step(space);
        }
        if let Some(vertex) = told.pop() {
            self.consider(vertex);
        }
        match self.count(space) {
            Some(reason) => Next::Stop(reason),
            None => self.step(space),
        }
    }
}
