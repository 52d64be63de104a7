//! When and why a run ends, and who watches it.

use crate::agent::{AgentId, Invalid, Published};
use crate::black_box::BlackBoxError;
use crate::clock::seconds;
use crate::event::Event;
use crate::names::Names;
use std::fmt;
use std::ops::ControlFlow;

/// Whom a stop condition is on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Who {
    /// Every agent.
    Anyone,
    /// The agent of this name.
    Agent(String),
}

/// All that is published at an instant, as a stop condition sees it.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a> {
    /// The instant, ns.
    pub time_ns: u64,
    pub(super) names: &'a Names,
    pub(super) published: &'a [Published],
}

impl Scene<'_> {
    /// The instant, s.
    pub fn time_s(&self) -> f64 {
        seconds(self.time_ns)
    }

    /// What an agent has published last; asked at every instant, cheaper than by name.
    pub fn published(&self, agent: AgentId) -> &Published {
        &self.published[agent.0]
    }

    /// What the agent of this name has published last.
    pub fn of(&self, name: &str) -> Option<&Published> {
        Some(&self.published[self.names.find(name)?])
    }
}

/// A question about a [`Scene`].
pub type Test = Box<dyn Fn(&Scene<'_>) -> bool + Send>;

/// Ends a run besides its end time. Asked at every instant of an agent. (That an agent's state is not finite any more,
/// or not one that its model is valid for, always ends a run.)
pub enum StopCondition {
    /// An agent's height `−z` is less than this, m.
    Below {
        /// Whose.
        who: Who,
        /// Height above the world's origin, m.
        height_m: f64,
    },
    /// Whatever you like.
    When {
        /// What it means, for the report.
        name: String,
        /// Whether it is so.
        test: Test,
    },
}

impl StopCondition {
    /// Anyone below ground: `z > 0`.
    pub const fn below_ground() -> Self {
        Self::Below {
            who: Who::Anyone,
            height_m: 0.0,
        }
    }

    /// Whatever you like, with a name for the report.
    pub fn when(name: impl Into<String>, test: impl Fn(&Scene<'_>) -> bool + Send + 'static) -> Self {
        Self::When {
            name: name.into(),
            test: Box::new(test),
        }
    }
}

/// A condition, and the agent that it names.
#[derive(Debug)]
pub(super) struct Watched {
    pub(super) condition: StopCondition,
    pub(super) of: Option<AgentId>,
}

impl Watched {
    /// Why to stop now, if it is to be.
    pub(super) fn met(&self, scene: &Scene<'_>) -> Option<RunStatus> {
        match &self.condition {
            StopCondition::Below { height_m, .. } => {
                let below = |published: &Published| -published.position.z < *height_m;
                let (agent, published) = match self.of {
                    Some(id) => (&scene.names[id.0], scene.published(id)),
                    // The lowest, so that the order of agents doesn't matter.
                    None => (scene.names.iter().zip(scene.published))
                        .filter(|(_, published)| below(published))
                        .max_by(|(a, p), (b, q)| {
                            p.position.z.total_cmp(&q.position.z).then_with(|| b.cmp(a))
                        })?,
                };
                below(published).then(|| RunStatus::Below {
                    agent: agent.clone(),
                    height_m: -published.position.z,
                })
            }
            StopCondition::When { name, test } => {
                test(scene).then(|| RunStatus::Condition { name: name.clone() })
            }
        }
    }
}

impl fmt::Debug for StopCondition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Below { who, height_m } => write!(f, "Below({who:?}, {height_m} m)"),
            Self::When { name, .. } => write!(f, "When({name})"),
        }
    }
}

/// The last valid state that an agent published.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LastSeen {
    /// When, s.
    pub time_s: f64,
    /// What.
    pub published: Published,
}

impl fmt::Display for LastSeen {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Published {
            position, velocity, ..
        } = &self.published;
        let ([x, y, z], [u, v, w]): ([f64; 3], [f64; 3]) = ((*position).into(), (*velocity).into());
        write!(
            f,
            "at [{x:.3}, {y:.3}, {z:.3}] m with [{u:.3}, {v:.3}, {w:.3}] m/s"
        )
    }
}

/// How a run ended. Whatever it was, all that was computed and recorded is kept.
#[derive(Debug)]
pub enum RunStatus {
    /// At its end time.
    Completed,
    /// An agent is below the height of a stop condition.
    Below {
        /// The agent.
        agent: String,
        /// Its height, m.
        height_m: f64,
    },
    /// A condition of the user's is met.
    Condition {
        /// Its name.
        name: String,
    },
    /// An agent's state is not finite any more, or has left the validity of its model.
    Diverged {
        /// The agent; the first by name if there are several.
        agent: String,
        /// What is wrong with its state.
        why: Invalid,
        /// What probably made it so, in words.
        likely_cause: Option<String>,
        /// The last state that was valid; `None` if there was none from the start.
        last: Option<Box<LastSeen>>,
    },
    /// The filter of an agent's estimator refused to continue; it keeps its last good belief.
    EstimatorFailed {
        /// The agent; the first by name if there are several.
        agent: String,
        /// Why, in words.
        reason: String,
    },
    /// The observer asked for it.
    Interrupted,
    /// A black box failed; the simulation itself is sound and can continue without it.
    RecordingFailed {
        /// Why.
        source: BlackBoxError,
    },
}

impl RunStatus {
    /// Whether the run reached its end time.
    pub const fn is_completed(&self) -> bool {
        matches!(self, Self::Completed)
    }
}

impl fmt::Display for RunStatus {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Completed => write!(f, "completed"),
            Self::Below { agent, height_m } => write!(f, "\"{agent}\" is at a height of {height_m} m"),
            Self::Condition { name } => write!(f, "{name}"),
            Self::Diverged {
                agent,
                why,
                likely_cause,
                last,
            } => {
                match last {
                    Some(last) => write!(f, "\"{agent}\" diverged after {} s, {last}: {why}", last.time_s),
                    None => write!(f, "\"{agent}\" can't begin: {why}"),
                }?;
                match likely_cause {
                    Some(cause) => write!(f, "; likely cause: {cause}"),
                    None => Ok(()),
                }
            }
            Self::EstimatorFailed { agent, reason } => {
                write!(f, "the estimator of \"{agent}\" failed: {reason}")
            }
            Self::Interrupted => write!(f, "interrupted"),
            Self::RecordingFailed { source } => write!(f, "{source}"),
        }
    }
}

/// What a run did.
#[derive(Debug)]
pub struct RunReport {
    /// How it ended.
    pub status: RunStatus,
    /// When it ended, s.
    pub time_s: f64,
    /// Steps of agents that it took.
    pub agent_steps: u64,
}

/// How far a run is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// The present, s.
    pub time_s: f64,
    /// The end asked for, s.
    pub end_s: f64,
    /// Steps of agents taken in this run.
    pub agent_steps: u64,
}

/// Watches a run and may end it. `()` watches nothing; a closure that takes a [`Progress`] will do.
pub trait Observer {
    /// Called every [`PROGRESS_EVERY`] instants; [`ControlFlow::Break`] ends the run (after Ctrl-C, say), with all that
    /// was computed kept and the simulation ready to continue.
    fn progress(&mut self, _progress: &Progress) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    /// Called for each event when it happens.
    fn event(&mut self, _event: &Event) {}
}

/// Instants from one report of progress to the next.
pub const PROGRESS_EVERY: u64 = 64;

impl Observer for () {}

impl<F: FnMut(&Progress) -> ControlFlow<()>> Observer for F {
    fn progress(&mut self, progress: &Progress) -> ControlFlow<()> {
        self(progress)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::agent::Member;
    use crate::names::tests::LOOKUPS;
    use crate::{Engine, Path, StepSize, Target};
    use nalgebra::Vector3;

    /// A look-up per condition where it is set, and none at any instant, however many agents there are.
    #[test]
    fn exact_nobody_is_looked_up_by_name_while_a_simulation_runs() {
        const AGENTS: usize = 100;
        let name = |k: usize| format!("target-{k}");
        let at = Path::Fixed {
            position: Vector3::new(0.0, 0.0, -1.0),
            yaw: 0.0,
        };
        let member = |k| Member::new(Target::new(name(k), at.clone()), StepSize::MILLISECOND);
        let mut simulation = Engine::new((0..AGENTS).map(member).collect()).unwrap();
        LOOKUPS.set(0);
        for k in 0..AGENTS {
            let condition = StopCondition::Below {
                who: Who::Agent(name(k)),
                height_m: 0.5,
            };
            simulation.stop_when(condition).unwrap();
        }
        assert_eq!(LOOKUPS.get(), AGENTS);
        let end = simulation.run(0.02, &mut ()).unwrap();
        assert!(end.status.is_completed());
        assert_eq!(LOOKUPS.get(), AGENTS);
    }
}
