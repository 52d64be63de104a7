//! Driving an optimiser: its loop, its limits, its progress and its report.

use crate::{Answer, Candidate, Evaluation, FAILED_COST, Optimiser, RunError, StopReason};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// How far a run may go. Every limit is the run's own: a search that resumes from a saved state starts at zero again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Evaluations allowed; at least one.
    pub evaluations: u64,
    /// Time allowed. A run that it ends depends on the machine.
    pub time: Option<Duration>,
    /// A cost low enough to stop at.
    pub target: Option<f64>,
    /// Give up when so many evaluations have failed and none has succeeded.
    pub failures: u64,
}

impl Limits {
    /// So many evaluations, no limit of time, no target, 200 failures from the start.
    pub const fn evaluations(evaluations: u64) -> Self {
        Self {
            evaluations,
            time: None,
            target: None,
            failures: 200,
        }
    }
}

/// How far a run is, after each evaluation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress<'a> {
    /// Evaluations of this run so far.
    pub evaluations: u64,
    /// Of them, those without a finite cost.
    pub failed: u64,
    /// The best of the search so far.
    pub best: &'a Evaluation,
    /// Time since the run began.
    pub elapsed: Duration,
}

/// What a run found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// The best candidate and its cost.
    pub best: Evaluation,
    /// Evaluations of this run.
    pub evaluations: u64,
    /// Of them, those whose cost was not finite; the optimiser received [`FAILED_COST`] instead.
    pub failed: u64,
    /// How long it took.
    pub elapsed: Duration,
    /// Why it ended.
    pub stop: StopReason,
    /// The least cost of the search after each evaluation of this run.
    pub history: Vec<f64>,
}

/// Evaluates one candidate after the other until the search ends or a limit is met: [`run`] without an observer.
///
/// # Errors
/// A budget of zero; no candidate with a finite cost.
pub fn minimise<A: Answer>(
    search: &mut (impl Optimiser<A> + ?Sized),
    cost: impl FnMut(&[f64]) -> A,
    limits: Limits,
) -> Result<Report, RunError> {
    run(search, cost, limits, &mut |_| ControlFlow::Continue(()))
}

/// Evaluates one candidate after the other until the search ends, a limit is met, or `observe` breaks.
///
/// A cost that is not finite is counted as failed and replaced by [`FAILED_COST`], so that it is merely the worst.
///
/// # Errors
/// A budget of zero; no candidate with a finite cost.
pub fn run<A: Answer>(
    search: &mut (impl Optimiser<A> + ?Sized),
    mut cost: impl FnMut(&[f64]) -> A,
    limits: Limits,
    observe: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
) -> Result<Report, RunError> {
    drive(search, limits, observe, 1, |batch| {
        batch.iter().map(|c| cost(&c.values)).collect()
    })
}

/// As [`run`], with all candidates that the search has to propose at a time evaluated side by side on rayon's threads.
///
/// The result doesn't depend on the number of threads and is [`run`]'s, except that a whole batch is evaluated where
/// `run` would have met the target, its end of time or an interruption in the middle of it.
///
/// # Errors
/// A budget of zero; no candidate with a finite cost.
pub fn run_parallel<A: Answer + Send>(
    search: &mut (impl Optimiser<A> + ?Sized),
    cost: impl Fn(&[f64]) -> A + Sync,
    limits: Limits,
    observe: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
) -> Result<Report, RunError> {
    drive(search, limits, observe, usize::MAX, |batch| {
        batch.par_iter().map(|c| cost(&c.values)).collect()
    })
}

/// Counts of a run.
struct Run {
    began: Instant,
    evaluations: u64,
    failed: u64,
    last_cost: f64,
    history: Vec<f64>,
}

fn drive<A: Answer>(
    search: &mut (impl Optimiser<A> + ?Sized),
    limits: Limits,
    observe: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
    at_a_time: usize,
    mut evaluate: impl FnMut(&[Candidate]) -> Vec<A>,
) -> Result<Report, RunError> {
    if limits.evaluations == 0 {
        return Err(RunError::ZeroBudget);
    }
    let mut run = Run {
        began: Instant::now(),
        evaluations: 0,
        failed: 0,
        last_cost: f64::NAN,
        history: Vec::new(),
    };
    search.renew();
    let stop = loop {
        let left = limits.evaluations - run.evaluations;
        let most = usize::try_from(left).unwrap_or(usize::MAX).min(at_a_time);
        let batch: Vec<Candidate> = std::iter::from_fn(|| search.ask()).take(most).collect();
        if batch.is_empty() {
            break search.ending();
        }
        let answers = evaluate(&batch);
        let mut broken = None;
        for (candidate, answer) in batch.iter().zip(answers) {
            broken = broken.or(run.take(search, candidate, answer, limits, observe)?);
        }
        if broken.is_some() {
            break broken;
        }
    };
    let best = search.best().cloned().ok_or(RunError::NothingToAsk)?;
    if best.cost >= FAILED_COST {
        return Err(run.all_failed());
    }
    Ok(Report {
        best,
        evaluations: run.evaluations,
        failed: run.failed,
        elapsed: run.began.elapsed(),
        // A search that awaits nothing, proposes nothing and has not ended is stuck.
        stop: stop.unwrap_or(StopReason::Stalled { iterations: 0 }),
        history: run.history,
    })
}

impl Run {
    /// Tells one answer; whether the run is over.
    fn take<A: Answer>(
        &mut self,
        search: &mut (impl Optimiser<A> + ?Sized),
        candidate: &Candidate,
        answer: A,
        limits: Limits,
        observe: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
    ) -> Result<Option<StopReason>, RunError> {
        self.evaluations += 1;
        self.last_cost = answer.cost();
        let usable = answer.is_usable(search.variables().len());
        self.failed += u64::from(!usable);
        let answer = if usable {
            answer
        } else {
            A::failed(search.variables().len())
        };
        search.tell(candidate, answer)?;
        let Some(best) = search.best() else {
            return Ok(None);
        };
        self.history.push(best.cost);
        if best.cost >= FAILED_COST && self.failed >= limits.failures {
            return Err(self.all_failed());
        }
        let elapsed = self.began.elapsed();
        let progress = Progress {
            evaluations: self.evaluations,
            failed: self.failed,
            best,
            elapsed,
        };
        let interrupted = observe(&progress).is_break();
        Ok(if limits.target.is_some_and(|target| best.cost <= target) {
            Some(StopReason::Target { cost: best.cost })
        } else if interrupted {
            Some(StopReason::Interrupted)
        } else if let Some(ending) = search.ending() {
            Some(ending)
        } else if self.evaluations >= limits.evaluations {
            Some(StopReason::Budget {
                evaluations: self.evaluations,
            })
        } else {
            limits
                .time
                .filter(|time| elapsed >= *time)
                .map(|_| StopReason::Time { elapsed })
        })
    }

    fn all_failed(&self) -> RunError {
        RunError::AllFailed {
            evaluations: self.evaluations,
            last_cost: self.last_cost,
        }
    }
}
