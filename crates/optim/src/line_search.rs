//! Line search along one variable after the other, over a box that is then narrowed.
//!
//! Along a variable the box is scanned at equal distances, so that the deepest of several valleys is found, and the
//! interval about the best point is cut by the golden section, `1/φ = (√5 − 1)/2`, until it is narrow. A sweep does so
//! for every variable; sweeps repeat until one gains less than the tolerance. A round narrows the box about the
//! best point, and the scan is finer by as much.
//! Exact for separable costs, slow along valleys that are oblique to the axes.
//!
//! Source: golden section by Kiefer 1953, Proc. AMS 4; cyclic coordinate search as in Bazaraa, Sherali and Shetty,
//! Nonlinear Programming, section 8.5; narrowed boxes are the study's (tables 7.4 to 7.7).

use crate::answer::NO_COST;
use crate::{Next, Rule, SetupError, Space, Stepwise, StopReason, Variable, Vertex};
use serde::{Deserialize, Serialize};

/// `1/φ`: the share of an interval that a golden section keeps.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Settings of [`LineSearch`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LineSearchSettings {
    /// Points of a scan, bounds included; at least 3.
    pub scan: usize,
    /// A golden section ends when the interval is this share of the variable's width.
    pub spread: f64,
    /// Sweeps end when one gains no more than this, in the cost's unit.
    pub gain: f64,
    /// Most sweeps of one round; at least 1.
    pub sweeps: u32,
    /// Number of boxes searched, including the full one; at least 1.
    pub rounds: u32,
    /// Width of a box over that of the one before, between 0 and 1.
    pub narrowing: f64,
}

/// Scans of 11, to 1e-6 of the box, one narrowing to a quarter.
impl Default for LineSearchSettings {
    fn default() -> Self {
        Self {
            scan: 11,
            spread: 1e-6,
            gain: 1e-8,
            sweeps: 20,
            rounds: 2,
            narrowing: 0.25,
        }
    }
}

/// An interval of one variable.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Interval {
    lower: f64,
    upper: f64,
}

impl Interval {
    fn width(self) -> f64 {
        self.upper - self.lower
    }
}

/// A value of the variable that is searched along, with its cost.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Probe {
    value: f64,
    cost: f64,
}

/// The last question.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum Stage {
    Start,
    Scan,
    /// Both interior points of the interval.
    Section {
        within: Interval,
    },
    /// The one interior point that is new; `kept` is the other.
    Cut {
        within: Interval,
        kept: Probe,
    },
}

/// The lines searched and the box they lie in.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lines {
    settings: LineSearchSettings,
    space_now: Vec<Interval>,
    best: Vec<f64>,
    cost: f64,
    stage: Stage,
    axis: usize,
    sweep: u32,
    round: u32,
    cost_before_sweep: f64,
}

/// The line search as an [`Optimiser`](crate::Optimiser).
pub type LineSearch = Stepwise<Lines>;

impl Stepwise<Lines> {
    /// A line search from `start`.
    ///
    /// # Errors
    /// Bad variables, a start outside the bounds, settings out of range.
    pub fn new(
        variables: Vec<Variable>,
        start: &[f64],
        settings: LineSearchSettings,
    ) -> Result<Self, SetupError> {
        let s = settings;
        SetupError::unless(s.scan >= 3, "scan", s.scan as f64, "at least 3")?;
        SetupError::unless(
            s.spread > 0.0 && s.spread < 1.0,
            "spread",
            s.spread,
            "between 0 and 1",
        )?;
        SetupError::unless(s.gain >= 0.0, "gain", s.gain, "zero or more")?;
        SetupError::unless(s.sweeps >= 1, "sweeps", f64::from(s.sweeps), "at least 1")?;
        SetupError::unless(s.rounds >= 1, "rounds", f64::from(s.rounds), "at least 1")?;
        let narrows = s.narrowing > 0.0 && s.narrowing < 1.0;
        SetupError::unless(narrows, "narrowing", s.narrowing, "between 0 and 1")?;
        let space = Space::new(variables)?;
        let whole = |v: &Variable| Interval {
            lower: v.lower,
            upper: v.upper,
        };
        let lines = Lines {
            settings,
            space_now: space.variables().iter().map(whole).collect(),
            best: start.to_vec(),
            cost: NO_COST,
            stage: Stage::Start,
            axis: 0,
            sweep: 0,
            round: 0,
            cost_before_sweep: NO_COST,
        };
        Self::start(space, lines, vec![start.to_vec()])
    }
}

impl Lines {
    /// Boxes searched before this one.
    pub fn round(&self) -> u32 {
        self.round
    }

    /// The best point with another value of the variable searched along.
    fn at(&self, value: f64) -> Vec<f64> {
        let mut point = self.best.clone();
        point[self.axis] = value;
        point
    }

    fn probe(&self, vertex: &Vertex) -> Probe {
        Probe {
            value: vertex.values[self.axis],
            cost: vertex.cost(),
        }
    }

    fn keep_best(&mut self, told: &[Vertex]) {
        for vertex in told {
            if vertex.cost() < self.cost {
                self.cost = vertex.cost();
                self.best.clone_from(&vertex.values);
            }
        }
    }

    fn scan(&mut self) -> Next {
        let within = self.space_now[self.axis];
        let last = self.settings.scan - 1;
        let point = |k: usize| match k == last {
            // Not beyond the bound by rounding.
            true => within.upper,
            false => within.lower + within.width() * k as f64 / last as f64,
        };
        self.stage = Stage::Scan;
        Next::Ask((0..=last).map(|k| self.at(point(k))).collect())
    }

    /// The interval of a scan's spacing on both sides of the best value.
    fn bracket(&self) -> Interval {
        let within = self.space_now[self.axis];
        let spacing = within.width() / (self.settings.scan - 1) as f64;
        let value = self.best[self.axis];
        Interval {
            lower: (value - spacing).max(within.lower),
            upper: (value + spacing).min(within.upper),
        }
    }

    fn section(&mut self) -> Next {
        let within = self.bracket();
        let (low, high) = (
            within.upper - GOLDEN * within.width(),
            within.lower + GOLDEN * within.width(),
        );
        self.stage = Stage::Section { within };
        Next::Ask(vec![self.at(low), self.at(high)])
    }

    /// Keeps the part of the interval with the cheaper interior point.
    fn cut(&mut self, space: &Space, within: Interval, a: Probe, b: Probe) -> Next {
        let (low, high) = if a.value <= b.value { (a, b) } else { (b, a) };
        let (within, kept, new) = if low.cost <= high.cost {
            let within = Interval {
                upper: high.value,
                ..within
            };
            (within, low, within.upper - GOLDEN * within.width())
        } else {
            let within = Interval {
                lower: low.value,
                ..within
            };
            (within, high, within.lower + GOLDEN * within.width())
        };
        if within.width() <= self.settings.spread * space.width(self.axis) {
            return self.next_axis(space);
        }
        self.stage = Stage::Cut { within, kept };
        Next::Ask(vec![self.at(new)])
    }

    fn next_axis(&mut self, space: &Space) -> Next {
        self.axis += 1;
        if self.axis < space.dimension() {
            return self.scan();
        }
        self.axis = 0;
        self.sweep += 1;
        let gained = self.cost_before_sweep - self.cost;
        self.cost_before_sweep = self.cost;
        // The first sweep starts from the start's cost; one variable needs no second sweep.
        let over = gained <= self.settings.gain || space.dimension() == 1;
        if !over && self.sweep < self.settings.sweeps {
            return self.scan();
        }
        self.next_round(over, gained)
    }

    fn next_round(&mut self, converged: bool, gained: f64) -> Next {
        self.round += 1;
        if self.round == self.settings.rounds {
            return Next::Stop(match converged {
                true => StopReason::Converged {
                    spread: self.settings.spread,
                    cost_spread: gained.max(0.0),
                },
                false => StopReason::ScheduleDone,
            });
        }
        self.sweep = 0;
        for (interval, &x) in self.space_now.iter_mut().zip(&self.best) {
            let half = 0.5 * self.settings.narrowing * interval.width();
            *interval = Interval {
                lower: (x - half).max(interval.lower),
                upper: (x + half).min(interval.upper),
            };
        }
        self.scan()
    }
}

impl Rule for Lines {
    fn next(&mut self, space: &Space, told: Vec<Vertex>) -> Next {
        self.keep_best(&told);
        match (self.stage.clone(), told.as_slice()) {
            (Stage::Scan, _) => self.section(),
            (Stage::Section { within }, [a, b]) => self.cut(space, within, self.probe(a), self.probe(b)),
            (Stage::Cut { within, kept }, [new]) => self.cut(space, within, kept, self.probe(new)),
            _ => {
                self.cost_before_sweep = self.cost;
                self.scan()
            }
        }
    }
}
