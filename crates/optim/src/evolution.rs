//! Differential evolution: the global method annealing is compared with.
//!
//! Each member `x_i` of a population meets a trial `u`: the mutant `v = x_best + F (x_r1 − x_r2)` in variables drawn with probability
//! CR and in one drawn variable always, `x_i` elsewhere (best/1/bin). The better of the two survives. The mutation
//! F is drawn anew for each generation ('dither'); values that leave the bounds are drawn anew within them. The first population is a
//! Latin hypercube. It ends when the standard deviation of the costs is below `absolute + relative |mean|`.
//! A generation's trials are independent, so they can be evaluated side by side. It finds a global minimum with high
//! probability, not with certainty.
//!
//! Source: Storn and Price 1997, J. Global Optim. 11; defaults and end as in SciPy's `differential_evolution`
//! with deferred updating.

use crate::draws::Draws;
use crate::{Next, Rule, SetupError, Space, Stepwise, StopReason, Variable, Vertex};
use serde::{Deserialize, Serialize};

/// Most members per variable: far beyond any use.
const MOST_MEMBERS: usize = 10_000;

/// Settings of [`Evolution`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EvolutionSettings {
    /// Members per variable; with fewer than 5 members in all, 5 are taken.
    pub members_per_variable: usize,
    /// Least and largest mutation F, between 0 and 2.
    pub mutation: [f64; 2],
    /// Probability CR that a variable comes from the mutant, 0 to 1.
    pub crossover: f64,
    /// Relative tolerance of the costs' standard deviation.
    pub relative: f64,
    /// Absolute tolerance of the costs' standard deviation, in the cost's unit.
    pub absolute: f64,
    /// Most generations; at least 1.
    pub generations: u32,
    /// Seed of everything random.
    pub seed: u64,
}

/// SciPy's defaults (15 members per variable, F in 0.5 to 1, CR = 0.7, relative tolerance 0.01), and 1e-8 absolute.
impl Default for EvolutionSettings {
    fn default() -> Self {
        Self {
            members_per_variable: 15,
            mutation: [0.5, 1.0],
            crossover: 0.7,
            relative: 0.01,
            absolute: 1e-8,
            generations: 1000,
            seed: 0,
        }
    }
}

/// The population.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Population {
    settings: EvolutionSettings,
    members: Vec<Vertex>,
    generation: u32,
}

/// Differential evolution as an [`Optimiser`](crate::Optimiser).
pub type Evolution = Stepwise<Population>;

impl Stepwise<Population> {
    /// A population over the whole box.
    ///
    /// # Errors
    /// Bad variables, settings out of range.
    pub fn new(variables: Vec<Variable>, settings: EvolutionSettings) -> Result<Self, SetupError> {
        let s = settings;
        let [least, most] = s.mutation;
        SetupError::unless(
            least > 0.0 && least <= most,
            "mutation, least",
            least,
            "positive and at most the largest",
        )?;
        SetupError::unless(most < 2.0, "mutation, largest", most, "below 2")?;
        let share = (0.0..=1.0).contains(&s.crossover);
        SetupError::unless(share, "crossover", s.crossover, "between 0 and 1")?;
        for (name, value) in [("relative", s.relative), ("absolute", s.absolute)] {
            SetupError::unless(value >= 0.0, name, value, "zero or more")?;
        }
        SetupError::unless(
            s.generations >= 1,
            "generations",
            f64::from(s.generations),
            "at least 1",
        )?;
        let space = Space::new(variables)?;
        SetupError::unless(
            s.members_per_variable <= MOST_MEMBERS,
            "members per variable",
            s.members_per_variable as f64,
            "at most 10 000",
        )?;
        let count = (s.members_per_variable * space.dimension()).max(5);
        let first = latin_hypercube(&space, count, s.seed);
        let population = Population {
            settings,
            members: Vec::new(),
            generation: 0,
        };
        Self::start(space, population, first)
    }
}

/// `count` random points of which every variable has one in each of `count` equal parts of its width.
fn latin_hypercube(space: &Space, count: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut draws = Draws::new(seed, 0);
    let columns: Vec<Vec<f64>> = (0..space.dimension())
        .map(|_| {
            let order = draws.permutation(count);
            let mut share = |cell: usize| (cell as f64 + draws.share()) / count as f64;
            order.into_iter().map(&mut share).collect()
        })
        .collect();
    let row = |k: usize| columns.iter().map(|c| c[k]).collect::<Vec<f64>>();
    (0..count).map(|k| space.at_shares(&row(k))).collect()
}

impl Population {
    /// Members of the last complete generation.
    pub fn members(&self) -> &[Vertex] {
        &self.members
    }

    /// Complete generations, the first population included.
    pub fn generation(&self) -> u32 {
        self.generation
    }

    fn survive(&mut self, told: Vec<Vertex>) {
        self.generation += 1;
        if self.members.is_empty() {
            self.members = told;
            return;
        }
        for (member, trial) in self.members.iter_mut().zip(told) {
            if trial.cost() <= member.cost() {
                *member = trial;
            }
        }
    }

    /// One trial for each member.
    fn trials(&self, space: &Space) -> Vec<Vec<f64>> {
        let mut draws = Draws::new(self.settings.seed, u64::from(self.generation));
        let [least, most] = self.settings.mutation;
        let mutation = least + draws.share() * (most - least);
        let best = (0..self.members.len())
            .min_by(|&a, &b| self.members[a].cost().total_cmp(&self.members[b].cost()))
            .unwrap_or(0);
        (0..self.members.len())
            .map(|i| self.trial(space, i, best, mutation, &mut draws))
            .collect()
    }

    fn trial(&self, space: &Space, i: usize, best: usize, mutation: f64, draws: &mut Draws) -> Vec<f64> {
        let n = space.dimension();
        let [first, second] = two_others(draws, self.members.len(), i);
        let always = draws.index(n);
        let mut trial = self.members[i].values.clone();
        for (k, value) in trial.iter_mut().enumerate() {
            let crosses = draws.share() < self.settings.crossover;
            let anew = draws.share();
            if !crosses && k != always {
                continue;
            }
            let at = |member: usize| self.members[member].values[k];
            let v = &space.variables()[k];
            *value = at(best) + mutation * (at(first) - at(second));
            if !(v.lower..=v.upper).contains(value) {
                *value = (v.lower + anew * space.width(k)).min(v.upper);
            }
        }
        trial
    }

    /// Standard deviation and mean of the costs.
    fn deviation(&self) -> (f64, f64) {
        let count = self.members.len() as f64;
        let mean = self.members.iter().map(|m| m.cost() / count).sum::<f64>();
        let square = |m: &Vertex| (m.cost() - mean).powi(2) / count;
        (self.members.iter().map(square).sum::<f64>().sqrt(), mean)
    }

    /// Largest distance between members along a variable, as a share of its width.
    fn spread(&self, space: &Space) -> f64 {
        let width = |i: usize| {
            let values = || self.members.iter().map(|m| m.values[i]);
            let least = values().fold(f64::INFINITY, f64::min);
            (values().fold(f64::NEG_INFINITY, f64::max) - least) / space.width(i)
        };
        (0..space.dimension()).map(width).fold(0.0, f64::max)
    }
}

/// Two different members that are not member `i`.
fn two_others(draws: &mut Draws, members: usize, i: usize) -> [usize; 2] {
    let skip = |k: usize, taken: usize| if k >= taken { k + 1 } else { k };
    let first = skip(draws.index(members - 1), i);
    let (low, high) = (first.min(i), first.max(i));
    [first, skip(skip(draws.index(members - 2), low), high)]
}

impl Rule for Population {
    fn next(&mut self, space: &Space, told: Vec<Vertex>) -> Next {
        self.survive(told);
        let (deviation, mean) = self.deviation();
        if deviation <= self.settings.absolute + self.settings.relative * mean.abs() {
            return Next::Stop(StopReason::Converged {
                spread: self.spread(space),
                cost_spread: deviation,
            });
        }
        // The first population counts as no generation of the schedule.
        if self.generation > self.settings.generations {
            return Next::Stop(StopReason::ScheduleDone);
        }
        Next::Ask(self.trials(space))
    }
}
