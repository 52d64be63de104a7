//! A scenario flown to its end, and what is kept of it.

use crate::cost::{Judged, StationCost};
use crate::error::ScenarioError;
use crate::file::Scenario;
use crate::library::Files;
use crate::metrics::{Metric, MetricError, MetricsBox, find};
use crate::run::{End, Ending, Run};
use sifre::black_box::MemoryBox;
use sifre::{Event, Observer, RecorderId, Recording, StepSize};
use std::time::Instant;
use wpt_optim::{CostBox, Span};

/// What is kept of a flight beside how it ends and what happens on the way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Keep {
    /// Metrics, the costs Φ among them.
    pub metrics: bool,
    /// Costs Φ of the stations with their terms.
    pub costs: bool,
    /// Rows of all channels in memory, so far apart; none are kept without it.
    pub rows: Option<StepSize>,
}

impl Keep {
    /// Only how the flight ends.
    pub const NOTHING: Self = Self {
        metrics: false,
        costs: false,
        rows: None,
    };
    /// Metrics.
    pub const METRICS: Self = Self {
        metrics: true,
        ..Self::NOTHING
    };
    /// Costs Φ with their terms.
    pub const COSTS: Self = Self {
        costs: true,
        ..Self::NOTHING
    };

    /// Rows in memory, so far apart.
    #[must_use]
    pub const fn rows(step: StepSize) -> Self {
        Self {
            rows: Some(step),
            ..Self::NOTHING
        }
    }
}

/// What became of a flight.
#[derive(Debug)]
pub struct Flown {
    /// How it ended.
    pub ending: Ending,
    /// What happened, in order of time.
    pub events: Vec<Event>,
    /// Warnings for the user.
    pub notes: Vec<String>,
    /// Its metrics; empty if they were not [kept](Keep).
    pub metrics: Vec<Metric>,
    /// The costs of its stations; empty if they were not kept.
    pub costs: Vec<StationCost>,
    /// Its rows; none if they were not kept.
    pub recording: Recording,
    /// When the flight began, s: 0 unless it was resumed.
    pub from_s: f64,
    /// Time that the flight took to compute, s.
    pub wall_s: f64,
}

impl Flown {
    /// A metric by its name, or by its name without its agent's where only one agent has it. NaN if the flight ended early.
    ///
    /// # Errors
    /// A name that this flight has no metric of, or several.
    pub fn metric(&self, name: &str) -> Result<f64, MetricError> {
        match (find(&self.metrics, name), self.ending.end) {
            (Ok(metric), End::Done) => Ok(metric.value),
            (Err(error @ MetricError::Ambiguous { .. }), _) | (Err(error), End::Done) => Err(error),
            // Metrics of a step are missing where the flight ended before it.
            (Ok(_) | Err(MetricError::Unknown { .. }), _) => Ok(f64::NAN),
        }
    }
}

impl Scenario {
    /// Flies the scenario. Files that it names are read by `files`; give `&()` if it names none.
    ///
    /// To watch the flight, stop it, resume it or record it in black boxes of your own, use [`Scenario::build`],
    /// [`Built::start`](crate::Built::start) and [`Run::fly`].
    ///
    /// # Errors
    /// A scenario that can't be flown; whatever happens during the flight is an [`Ending`] instead.
    pub fn fly(&self, files: &dyn Files, keep: &Keep) -> Result<Flown, ScenarioError> {
        self.build(files)?.start()?.fly(keep, &mut ())
    }
}

impl Run {
    /// Flies to the scenario's end, or to whatever ends it before.
    ///
    /// # Errors
    /// An end that the clock doesn't have; a cost that can't be summed up; a run that is in the middle of an agent's step. Whatever happens
    /// during the flight is an [`Ending`] instead.
    pub fn fly(&mut self, keep: &Keep, observer: &mut (dyn Observer + Send)) -> Result<Flown, ScenarioError> {
        let sums = match keep.metrics {
            true => Some(
                self.simulation
                    .attach(self.metrics_step(), MetricsBox::default())?,
            ),
            false => None,
        };
        let rows = match keep.rows {
            Some(step) => Some(self.simulation.attach(step, MemoryBox::default())?),
            None => None,
        };
        let mut boxes = Vec::new();
        for judged in self.judged.iter().filter(|_| keep.metrics || keep.costs) {
            boxes.push(self.simulation.attach(judged.step, judged.black_box()?)?);
        }
        let (begin, from_s) = (Instant::now(), self.simulation.now_s());
        let ending = self.run(observer)?;
        let wall_s = begin.elapsed().as_secs_f64();
        let sums = sums.and_then(|id| self.detached::<MetricsBox>(id));
        let rows = rows.and_then(|id| self.detached::<MemoryBox>(id));
        let costs: Vec<StationCost> = (0..boxes.len())
            .filter_map(|k| {
                let cost = self.detached::<CostBox>(boxes[k])?;
                Some(self.judged[k].outcome(&cost, ending.end, self.duration_s))
            })
            .collect();
        let mut metrics = sums.map_or_else(Vec::new, |sums| sums.metrics());
        if keep.metrics {
            metrics.extend(costs.iter().map(|cost| Metric {
                name: format!("{}.phi", cost.pair.station),
                value: cost.outcome.cost,
            }));
        }
        Ok(Flown {
            ending,
            events: self.simulation.events().to_vec(),
            notes: self.notes.clone(),
            metrics,
            costs: if keep.costs { costs } else { Vec::new() },
            recording: rows.unwrap_or_default().recording,
            from_s,
            wall_s,
        })
    }

    /// A black box that was attached; nothing can fail in memory.
    fn detached<B: sifre::BlackBox>(&mut self, id: RecorderId) -> Option<B> {
        self.simulation.detach::<B>(id).and_then(Result::ok)
    }
}

impl Judged {
    /// What the flight came to.
    fn outcome(&self, cost: &CostBox, end: End, duration_s: f64) -> StationCost {
        let is_complete = end == End::Done && !cost.has_failed();
        let span = match is_complete {
            true => Span::Recorded,
            false => Span::Planned(duration_s),
        };
        StationCost {
            pair: self.pair.clone(),
            outcome: cost.outcome(span),
            is_complete,
        }
    }
}
