//! A scenario that runs, and how it ends.

use crate::assemble::{AgentInfo, Built, Goal};
use crate::cost::Judged;
use crate::error::ScenarioError;
use crate::file::{BoxLimits, OutputFile, StopFile};
use sifre::{
    AgentEvent, AgentId, Engine, Event, Execution, Member, Observer, Progress, Published, RunReport,
    RunStatus, Scene, SimulationError, SimulationSnapshot, StepSize, StopCondition, Who, steps,
};
use std::fmt;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Speed below which a quadrotor that has arrived counts as at rest, m/s.
const AT_REST_M_S: f64 = 0.05;

/// Agents from which on they are moved on all cores: with fewer, handing them over costs more than it saves.
const MANY: usize = 256;

/// Name of the one condition that is no failure.
const ARRIVED: &str = "all quadrotors have arrived";

/// The simulation of a scenario.
#[derive(Debug)]
pub struct Run {
    /// The simulation; attach black boxes of your own before it is flown.
    pub simulation: Engine,
    /// What there is to know about its agents.
    pub agents: Vec<AgentInfo>,
    /// How long it lasts, s.
    pub duration_s: f64,
    /// What is to be recorded.
    pub output: OutputFile,
    /// What may surprise.
    pub notes: Vec<String>,
    pub(crate) judged: Vec<Judged>,
    lost: Arc<AtomicBool>,
}

/// How a run ended, in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// At its end time, or when all had arrived.
    Done,
    /// Early: an agent diverged, or met the ground or another condition.
    Early,
    /// The observer asked for it.
    Interrupted,
    /// A recording failed.
    RecordingFailed,
}

/// How a run ended.
#[derive(Debug)]
pub struct Ending {
    /// In one word.
    pub end: End,
    /// In full.
    pub report: RunReport,
}

impl fmt::Display for Ending {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} at {} s", self.report.status, self.report.time_s)
    }
}

impl Built {
    /// Puts the agents into a simulation, with the scenario's stop conditions.
    ///
    /// # Errors
    /// No agents; two of one name; one that looks at itself or at one that isn't there.
    pub fn start(self) -> Result<Run, ScenarioError> {
        self.start_as(|members| Ok(Engine::new(members)?))
    }

    /// The same, resumed from a saved run of these agents ([`Engine::save`]): bit for bit as if it had never been
    /// interrupted, if the scenario is the same.
    ///
    /// # Errors
    /// As [`Self::start`]; a snapshot of other agents, kinds or steps.
    pub fn resume(self, from: &SimulationSnapshot) -> Result<Run, ScenarioError> {
        self.start_as(|members| Ok(Engine::resume(members, from)?))
    }

    fn start_as(
        self,
        simulation: impl FnOnce(Vec<Member>) -> Result<Engine, ScenarioError>,
    ) -> Result<Run, ScenarioError> {
        let quadrotors = self.agents.iter().filter(|agent| agent.is_quadrotor());
        let quadrotors: Vec<String> = quadrotors.map(|agent| agent.name.clone()).collect();
        let lost = Arc::new(AtomicBool::new(false));
        let mut simulation = simulation(self.members)?;
        for condition in conditions(&self.stop, &quadrotors, &self.goals, &lost, &simulation) {
            simulation.stop_when(condition)?;
        }
        Ok(Run {
            simulation,
            agents: self.agents,
            duration_s: self.duration_s,
            output: self.output,
            notes: self.notes,
            judged: self.judged,
            lost,
        })
    }
}

impl Run {
    /// Time between two rows that metrics are taken from: that of the recording, but no more than the usual 20 ms, so that a coarse
    /// recording does not make them coarse.
    #[must_use]
    pub fn metrics_step(&self) -> StepSize {
        self.output.step_s.min(steps::BLACK_BOX.step)
    }

    /// Runs to the scenario's end, or to whatever ends it before.
    pub(crate) fn run(&mut self, observer: &mut (dyn Observer + Send)) -> Result<Ending, SimulationError> {
        let mut watch = Watch {
            inner: observer,
            lost: &self.lost,
        };
        let (simulation, end_s) = (&mut self.simulation, self.duration_s);
        let report = if simulation.names().len() < MANY {
            simulation.run(end_s, &mut watch)?
        } else {
            simulation.execute(Execution::Parallel);
            rayon::scope(|_| simulation.run(end_s, &mut watch))?
        };
        let end = match &report.status {
            RunStatus::Completed => End::Done,
            RunStatus::Condition { name } if name == ARRIVED => End::Done,
            RunStatus::Condition { .. }
            | RunStatus::Below { .. }
            | RunStatus::Diverged { .. }
            | RunStatus::EstimatorFailed { .. } => End::Early,
            RunStatus::Interrupted => End::Interrupted,
            RunStatus::RecordingFailed { .. } => End::RecordingFailed,
        };
        Ok(Ending { end, report })
    }
}

/// Passes everything on, and raises a flag where a station loses its target.
struct Watch<'a> {
    inner: &'a mut (dyn Observer + Send),
    lost: &'a AtomicBool,
}

impl Observer for Watch<'_> {
    fn progress(&mut self, progress: &Progress) -> ControlFlow<()> {
        self.inner.progress(progress)
    }

    fn event(&mut self, event: &Event) {
        if event.what == AgentEvent::TargetLost {
            self.lost.store(true, Ordering::Relaxed);
        }
        self.inner.event(event);
    }
}

/// The conditions that a scenario asks for.
fn conditions(
    stop: &StopFile,
    quadrotors: &[String],
    goals: &[Goal],
    lost: &Arc<AtomicBool>,
    simulation: &Engine,
) -> Vec<StopCondition> {
    let mut all = Vec::new();
    // Looked up once: conditions are asked at every instant.
    let named = |name: &String| simulation.find(name);
    if stop.ground {
        all.extend(quadrotors.iter().map(|name| StopCondition::Below {
            who: Who::Agent(name.clone()),
            height_m: stop.ground_height_m,
        }));
    }
    if stop.lost_target {
        let lost = Arc::clone(lost);
        let is_lost = move |_: &Scene<'_>| lost.load(Ordering::Relaxed);
        all.push(StopCondition::when("a station has lost its target", is_lost));
    }
    // A circle or a follower never arrives.
    if let Some(within_m) = stop.arrived_within_m
        && goals.len() == quadrotors.len()
        && !goals.is_empty()
    {
        let goals: Vec<(AgentId, Goal)> = goals
            .iter()
            .filter_map(|g| Some((named(&g.agent)?, g.clone())))
            .collect();
        let arrived = move |scene: &Scene<'_>| {
            goals
                .iter()
                .all(|(id, goal)| goal.is_reached(scene, *id, within_m))
        };
        all.push(StopCondition::when(ARRIVED, arrived));
    }
    if let Some(limits) = stop.outside {
        let ids: Vec<AgentId> = quadrotors.iter().filter_map(named).collect();
        let out = move |scene: &Scene<'_>| ids.iter().any(|id| limits.is_left(scene.published(*id)));
        all.push(StopCondition::when("a quadrotor has left its box", out));
    }
    all
}

impl Goal {
    fn is_reached(&self, scene: &Scene<'_>, id: AgentId, within_m: f64) -> bool {
        let published = scene.published(id);
        scene.time_s() >= self.from_s
            && (published.position - self.position).norm() <= within_m
            && published.velocity.norm() <= AT_REST_M_S
    }
}

impl BoxLimits {
    fn is_left(&self, published: &Published) -> bool {
        let inside = |i: usize| (self.from_m[i]..=self.to_m[i]).contains(&published.position[i]);
        !(0..3).all(inside)
    }
}

impl AgentInfo {
    /// Whether it is a quadrotor.
    #[must_use]
    pub fn is_quadrotor(&self) -> bool {
        matches!(self.kind, crate::AgentKind::Quadrotor { .. })
    }
}
