//! Numbers that sum up a flight, for questions about it: the flight's metrics, step metrics, and the cost Φ of each station.
//!
//! Beside [`MetricsBox`]'s there are, by name:
//!
//! | metric | what |
//! | --- | --- |
//! | `<quadrotor>.<axis>.settling_time_s` | time from the last jump of the set point until it stays within 2 % |
//! | `<quadrotor>.<axis>.overshoot` | largest excursion beyond it, as a fraction of the step |
//! | `<quadrotor>.<axis>.steady_state_error_m` | set point minus mean of the last 5 % of the response |
//! | `<station>.phi` | cost of the power transmission, limits and weights the scenario's or the defaults |
//!
//! Step metrics are there where an axis is asked to move, once or for the last time, to a place and stay.

use crate::exit::Failure;
use crate::interrupt;
use quad_ndi::metrics::StepMetrics;
use scenario::{AgentKind, Built, End, Files, Metric, MetricsBox, Scenario};
use sifre::black_box::MemoryBox;
use sifre::{Recording, StepSize};
use std::time::Instant;
use wpt_optim::{CostBox, Pair, Penalties, Span, Weights};

/// A flight in numbers.
#[derive(Clone, Debug)]
pub(crate) struct Measured {
    /// How it ended.
    pub(crate) end: End,
    /// How it ended, in words.
    pub(crate) status: String,
    /// All that was measured.
    pub(crate) metrics: Vec<Metric>,
}

impl Measured {
    /// A metric by its name, or by its name without its agent's where only one agent has it. Of a flight that ended early it is
    /// no number.
    pub(crate) fn value(&self, name: &str) -> Result<f64, Failure> {
        let exact = |m: &&Metric| m.name == name;
        let short = |m: &&Metric| m.name.split_once('.').is_some_and(|(_, what)| what == name);
        let mut found: Vec<&Metric> = self.metrics.iter().filter(exact).collect();
        if found.is_empty() {
            found = self.metrics.iter().filter(short).collect();
        }
        match found[..] {
            [metric] if self.end == End::Done => Ok(metric.value),
            [_] => Ok(f64::NAN),
            // What is measured of a step may be lacking where the flight ended before it.
            [] if self.end != End::Done => Ok(f64::NAN),
            [] => Err(Failure::Usage(format!(
                "--metric {name}: there is no such number of this flight; there are {}",
                names(self.metrics.iter())
            ))),
            _ => Err(Failure::Usage(format!(
                "--metric {name}: which of {}?",
                names(found.into_iter())
            ))),
        }
    }
}

fn names<'a>(metrics: impl Iterator<Item = &'a Metric>) -> String {
    metrics.map(|m| m.name.as_str()).collect::<Vec<_>>().join(", ")
}

/// Flies a scenario and measures it.
pub(crate) fn fly(scenario: &Scenario, files: &dyn Files) -> Result<Measured, Failure> {
    let built = scenario.build(files)?;
    let costs = cost_boxes(scenario, &built)?;
    let mut flight = built.fly()?;
    let step = flight.metrics_step();
    let sums = flight.simulation.attach(step, MetricsBox::default())?;
    let rows = flight.simulation.attach(step, MemoryBox::default())?;
    let mut phis = Vec::new();
    for (name, step, cost) in costs {
        phis.push((name, flight.simulation.attach(step, cost)?));
    }
    let ending = flight.run(&mut interrupt::watch())?;
    let sums = flight.simulation.detach::<MetricsBox>(sums).and_then(Result::ok);
    let mut metrics = sums.map_or_else(Vec::new, |m| m.metrics());
    let rows = flight.simulation.detach::<MemoryBox>(rows).and_then(Result::ok);
    let recording = rows.unwrap_or_default().recording;
    for quadrotor in &scenario.quadrotor {
        metrics.extend(step_metrics(&quadrotor.name, &recording));
    }
    for (name, id) in phis {
        let cost = flight.simulation.detach::<CostBox>(id).and_then(Result::ok);
        let span = |cost: &CostBox| match ending.end {
            End::Done if !cost.has_failed() => Span::Recorded,
            _ => Span::Planned(scenario.duration_s),
        };
        metrics.extend(cost.map(|cost| Metric {
            name: format!("{name}.phi"),
            value: cost.outcome(span(&cost)).cost,
        }));
    }
    Ok(Measured {
        end: ending.end,
        status: format!("{} at {} s", ending.report.status, ending.report.time_s),
        metrics,
    })
}

/// Seconds of computing per simulated second; nothing if it was interrupted.
pub(crate) fn price(scenario: &Scenario, files: &dyn Files) -> Result<Option<f64>, Failure> {
    let mut flight = scenario.build(files)?.fly()?;
    let begin = Instant::now();
    let ending = flight.run(&mut interrupt::watch())?;
    let wall_s = begin.elapsed().as_secs_f64();
    let flown_s = ending.report.time_s;
    let price = if flown_s > 0.0 { wall_s / flown_s } else { wall_s };
    Ok((ending.end != End::Interrupted).then_some(price))
}

/// A cost for each station that tracks a quadrotor, with the station's name and step.
fn cost_boxes(scenario: &Scenario, built: &Built) -> Result<Vec<(String, StepSize, CostBox)>, Failure> {
    let mut all = Vec::new();
    for file in &scenario.ets {
        let agent = |name: &str| built.agents.iter().find(|agent| agent.name == name);
        let of = (
            agent(&file.name).map(|a| &a.kind),
            agent(&file.tracks).map(|a| &a.kind),
        );
        let (Some(AgentKind::Ets { station, .. }), Some(AgentKind::Quadrotor { vehicle, .. })) = of else {
            continue;
        };
        let pair = Pair {
            quadrotor: file.tracks.clone(),
            station: file.name.clone(),
        };
        let (weights, penalties) = (Weights::default(), Penalties::default());
        let cost = CostBox::new(pair, station, vehicle, &weights, &penalties)
            .map_err(|error| Failure::Usage(format!("ets \"{}\": {error}", file.name)))?;
        all.push((file.name.clone(), file.step_s, cost));
    }
    Ok(all)
}

/// The step metrics of a quadrotor's axes.
fn step_metrics(quadrotor: &str, recording: &Recording) -> Vec<Metric> {
    let times: Vec<f64> = recording.times_s().collect();
    let mut all = Vec::new();
    for axis in ["x", "y", "z"] {
        let column = |what: &str| -> Vec<f64> {
            recording
                .column(&format!("{quadrotor}.{what}.{axis}"))
                .map_or_else(Vec::new, Iterator::collect)
        };
        let (response, asked) = (column("position"), column("reference.position"));
        let Some(&target) = asked.last() else {
            continue;
        };
        // A reference that moves on to the end is no step.
        let from = asked.iter().rposition(|r| *r != target).map_or(0, |k| k + 1);
        let points: Vec<(f64, f64)> = times.iter().copied().zip(response).skip(from).collect();
        let jumped = from == 0 || (asked[from] - asked[from - 1]).abs() >= LEAST_STEP_M;
        let moved = points
            .first()
            .is_some_and(|p| (target - p.1).abs() >= LEAST_STEP_M);
        if points.len() < LEAST_POINTS || !jumped || !moved {
            continue;
        }
        let Some(found) = StepMetrics::of(&points, target) else {
            continue;
        };
        let mut push = |what: &str, value: f64| {
            all.push(Metric {
                name: format!("{quadrotor}.{axis}.{what}"),
                value,
            });
        };
        push("settling_time_s", found.settling_time_s.unwrap_or(f64::NAN));
        push("overshoot", found.overshoot);
        push("steady_state_error_m", found.steady_state_error);
    }
    all
}

/// Least distance that counts as a step, m.
const LEAST_STEP_M: f64 = 1e-3;

/// Least rows of a response: the last 5 % of fewer are none.
const LEAST_POINTS: usize = 20;
