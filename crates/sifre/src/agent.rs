//! What an agent is: something with a pose that is stepped, sees others, and records itself.
//!
//! An agent with step h lives at the instants `k h`. At each it
//!
//! 1. publishes where it is ([`Agent::published`]),
//! 2. decides what to do until its next instant ([`Agent::decide`]), seeing what everybody has published,
//! 3. moves there ([`Agent::advance`]).
//!
//! Between its instants others see what it published last (zero-order hold): an agent with a slower step
//! is seen late by up to one of its steps, an error of first order in that step. Nobody ever sees a state that
//! another agent reached in the same instant's moves, so the order in which agents are moved, and the thread
//! that moves them, can't matter.

use crate::clock::{StepSize, seconds};
use crate::event::AgentEvent;
use crate::names::Names;
use crate::speed::Hook;
use crate::{BindError, Channel, UnknownAgent};
use nalgebra::Vector3;
use quad_kinematics::{Body, Rotation, World};
use std::any::Any;
use std::fmt::Debug;

/// The farthest that anything may be placed from the origin, m: beyond the Moon, and near enough for the square of any distance to be a number.
pub const FARTHEST_M: f64 = 1e9;

/// Speed of sound at 15 °C, m/s, which no quadrotor reaches: drag and rotors are those of air that is not compressed.
pub const SPEED_OF_SOUND_M_S: f64 = 340.0;

/// How far a saved attitude may be from a rotation: some thousand roundings of single precision, for files of other programs.
pub(crate) const ATTITUDE_ERROR: f64 = 1e-4;

/// What others may see of an agent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Published {
    /// Position in W, m.
    pub position: Vector3<f64>,
    /// Velocity in W, m/s.
    pub velocity: Vector3<f64>,
    /// Attitude `R_WB`.
    pub rotation: Rotation<f64, Body, World>,
    /// Angular velocity ω with components along B, rad/s.
    pub body_rates: Vector3<f64>,
}

impl Published {
    /// How many numbers it has.
    pub(crate) const LEN: usize = 18;

    /// At rest at a position in W, m, with this attitude.
    pub fn at_rest(position: Vector3<f64>, rotation: Rotation<f64, Body, World>) -> Self {
        Self {
            position,
            velocity: Vector3::zeros(),
            rotation,
            body_rates: Vector3::zeros(),
        }
    }

    /// Whether all its numbers are finite.
    pub fn is_finite(&self) -> bool {
        // A sum is finite if all its terms are: one question instead of eighteen. (Sums of finite numbers overflow
        // near 1e308 only, where nothing is well either.)
        let vectors = self.position.sum() + self.velocity.sum() + self.body_rates.sum();
        (vectors + self.rotation.matrix.sum()).is_finite()
    }

    /// Whether it is a flight within the validity of the quadrotors' models.
    #[inline(always)]
    pub(crate) fn check_flight(&self) -> Result<(), Invalid> {
        if !self.is_finite() {
            return Err(Invalid::NotFinite);
        }
        if self.velocity.norm_squared() > SPEED_OF_SOUND_M_S * SPEED_OF_SOUND_M_S {
            let speed_m_s = self.velocity.norm();
            return Err(Invalid::TooFast { speed_m_s });
        }
        Ok(())
    }

    /// Its numbers: position, velocity, matrix column by column, rates.
    pub(crate) fn to_array(self) -> [f64; Self::LEN] {
        let mut all = [0.0; Self::LEN];
        all[..3].copy_from_slice(self.position.as_slice());
        all[3..6].copy_from_slice(self.velocity.as_slice());
        all[6..15].copy_from_slice(self.rotation.matrix.as_slice());
        all[15..].copy_from_slice(self.body_rates.as_slice());
        all
    }

    /// Whether it can have been published: finite numbers, and columns of the attitude that are orthogonal unit vectors.
    pub(crate) fn check(&self) -> Result<(), MemoryError> {
        MemoryError::check_numbers("what others see", &self.to_array())?;
        let matrix = self.rotation.matrix;
        let length = (matrix.tr_mul(&matrix) - nalgebra::Matrix3::identity()).norm();
        match length < ATTITUDE_ERROR {
            true => Ok(()),
            false => Err(MemoryError::Number {
                what: "the attitude that others see",
                value: matrix.norm(),
            }),
        }
    }

    /// The reverse of [`Self::to_array`].
    pub(crate) fn from_array(all: &[f64; Self::LEN]) -> Self {
        Self {
            position: Vector3::from_column_slice(&all[..3]),
            velocity: Vector3::from_column_slice(&all[3..6]),
            rotation: Rotation::from_matrix(nalgebra::Matrix3::from_column_slice(&all[6..15])),
            body_rates: Vector3::from_column_slice(&all[15..]),
        }
    }
}

/// An agent of a simulation, as others refer to it. Got from a [`Directory`], or of an [`Engine`](crate::Engine), by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct AgentId(pub(crate) usize);

/// All agents of a simulation by name, as one of them looks others up when the simulation is put together.
#[derive(Clone, Copy, Debug)]
pub struct Directory<'a> {
    /// The step of the agent that asks.
    pub step: StepSize,
    pub(crate) asking: &'a str,
    pub(crate) names: &'a Names,
}

impl Directory<'_> {
    /// The agent of this name.
    ///
    /// # Errors
    /// If there is none, or the agent that asks is meant itself: nobody tracks or follows itself.
    pub fn find(&self, wanted: &str) -> Result<AgentId, UnknownAgent> {
        let place = self.names.find(wanted);
        place
            .filter(|&i| self.names[i] != self.asking)
            .map(AgentId)
            .ok_or_else(|| UnknownAgent {
                agent: self.asking.to_owned(),
                wanted: wanted.to_owned(),
                known: self.names.iter().filter(|n| *n != self.asking).cloned().collect(),
            })
    }
}

/// An instant of one agent, and what everybody has published up to it.
#[derive(Clone, Copy, Debug)]
pub struct Moment<'a> {
    /// The instant t, s.
    pub time_s: f64,
    /// The same, ns: exact.
    pub time_ns: u64,
    /// The agent's step, from this instant to its next.
    pub step: StepSize,
    /// The same, h, s.
    pub step_s: f64,
    /// The agent whose instant it is.
    pub me: AgentId,
    pub(crate) scene: &'a [Published],
}

impl Moment<'_> {
    /// The agent's next instant, s.
    #[inline]
    pub fn next_s(&self) -> f64 {
        seconds(self.time_ns + self.step.ns())
    }

    /// What an agent published last, at this instant or before.
    #[inline]
    pub fn published(&self, agent: AgentId) -> &Published {
        &self.scene[agent.0]
    }

    /// What the agent itself published at this instant.
    #[inline]
    pub fn own(&self) -> &Published {
        &self.scene[self.me.0]
    }
}

/// Why an agent's state is rejected.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Invalid {
    /// A number of its state is NaN or infinite.
    #[error("its state became NaN or infinite")]
    NotFinite,
    /// It is faster than its model is valid.
    #[error("its model is valid up to the speed of sound, {SPEED_OF_SOUND_M_S} m/s, got {speed_m_s:.4e} m/s")]
    TooFast {
        /// Its speed, m/s.
        speed_m_s: f64,
    },
}

/// Why an agent can't take up what was saved of it.
#[derive(Debug, thiserror::Error)]
pub enum MemoryError {
    /// It is not what this kind of agent saves.
    #[error("not a saved state of this kind of agent: {0}")]
    Format(#[from] serde_json::Error),
    /// Another number of numbers than the agent has.
    #[error(
        "{what} needs {expected} numbers, the saved state has {found}: was it saved with another model or controller?"
    )]
    Length {
        /// What the numbers are.
        what: &'static str,
        /// How many there should be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A number that no run can produce.
    #[error("{what} has {value:?}, which no run can produce")]
    Number {
        /// What the numbers are.
        what: &'static str,
        /// The number.
        value: f64,
    },
    /// Four numbers that are not an attitude.
    #[error("the quaternion of its attitude must have length 1, got a quaternion of length {length}")]
    Attitude {
        /// The length.
        length: f64,
    },
    /// A flight that its model is not valid for.
    #[error(transparent)]
    Invalid(#[from] Invalid),
    /// A place in a list that the agent does not have.
    #[error("it uses entry {entry} of its levels, but the script has {count} entries")]
    Entry {
        /// The place, from 0.
        entry: usize,
        /// How many there are.
        count: usize,
    },
    /// Instants of an estimator that are no successive steps.
    #[error("its estimator's instants must be {step_ns} ns apart, got {time_ns} ns after {before_ns} ns")]
    Instants {
        /// An instant, ns.
        time_ns: u64,
        /// The one before, ns.
        before_ns: u64,
        /// The step, ns.
        step_ns: u64,
    },
    /// It asks for a model that can't be built.
    #[error(transparent)]
    Build(#[from] quad_dynamics::BuildError),
    /// Only one of what was saved and of what is here has an estimator.
    #[error(
        "either the saved state or the agent has an estimator, but not both: assemble the same agent as before"
    )]
    OneHasAnEstimator,
    /// Its estimator can't take up what it remembered.
    #[error("its estimator: {0}")]
    Estimator(#[from] quad_estimation::EstimationError),
    /// Its controller can't fly that model.
    #[error(transparent)]
    Controller(#[from] quad_ndi::ControllerError),
}

impl MemoryError {
    /// Checks that all numbers are finite, and of a size that a run leads to: below [`FARTHEST_M`], in whatever unit.
    ///
    /// # Errors
    /// [`MemoryError::Number`].
    pub fn check_numbers(what: &'static str, numbers: &[f64]) -> Result<(), Self> {
        match numbers.iter().find(|x| x.is_nan() || x.abs() > FARTHEST_M) {
            Some(&value) => Err(Self::Number { what, value }),
            None => Ok(()),
        }
    }

    /// Checks that there are as many numbers as there should be of what they are.
    ///
    /// # Errors
    /// [`MemoryError::Length`].
    pub fn check_length(what: &'static str, expected: usize, found: usize) -> Result<(), Self> {
        if expected == found {
            Ok(())
        } else {
            Err(Self::Length {
                what,
                expected,
                found,
            })
        }
    }
}

/// Something with a pose that is stepped, sees the other agents, and records itself.
///
/// [`Agent::decide`] and [`Agent::advance`] must depend on the agent, its past and the [`Moment`] alone (no clock,
/// no generator that isn't saved), and must not allocate (a quadrotor's
/// [`Estimation`](crate::quadrotor::Estimation) does): then order, threads, saving and resuming can't
/// change a result.
pub trait Agent: Any + Debug + Send {
    /// Its name, unique in a simulation.
    fn name(&self) -> &str;

    /// The kind of agent, as in `quadrotor`; snapshots carry it.
    fn kind(&self) -> &'static str;

    /// Looks up the agents that it will look at, and gets ready for its step.
    ///
    /// # Errors
    /// A name that nobody has; a step that it can't have.
    fn bind(&mut self, _directory: &Directory<'_>) -> Result<(), BindError> {
        Ok(())
    }

    /// Where it is, at its latest instant.
    fn published(&self) -> Published;

    /// Publishes where it is, unless a number isn't finite: what was published before then remains. Provided here so that
    /// it is compiled together with [`Agent::published`]: numbers are checked and stored while they are at hand.
    #[doc(hidden)]
    fn publish(&self, to: &mut Published, _: Hook) -> Result<(), Invalid> {
        let published = self.published();
        if !published.is_finite() {
            return Err(Invalid::NotFinite);
        }
        *to = published;
        Ok(())
    }

    /// What probably made it diverge with this step, if that follows from its settings.
    fn likely_cause(&self, _step: StepSize) -> Option<String> {
        None
    }

    /// Decides on its inputs from this instant to its next; tells if something worth noting happened.
    fn decide(&mut self, now: &Moment<'_>) -> Option<AgentEvent>;

    /// Moves from this instant to its next with the inputs decided on.
    fn advance(&mut self, now: &Moment<'_>);

    /// Decides and moves in one go, where nobody looks in between: bit for bit the two one after the other.
    #[doc(hidden)]
    fn decide_and_advance(&mut self, now: &Moment<'_>, _: Hook) -> Option<AgentEvent> {
        let event = self.decide(now);
        self.advance(now);
        event
    }

    /// What it records: states, inputs, outputs, references. The same throughout the run.
    fn channels(&self) -> Vec<Channel>;

    /// Writes one number per channel: the state at its latest instant, and what was decided there.
    fn record(&self, row: &mut [f64]);

    /// Everything it needs to resume later as if nothing had happened.
    ///
    /// # Errors
    /// If the state can't be written as JSON.
    fn save(&self) -> Result<serde_json::Value, serde_json::Error>;

    /// Takes up what was saved of an agent built in the same way.
    ///
    /// # Errors
    /// If it was saved from an agent of another kind or built in another way; the agent is then unchanged.
    fn restore(&mut self, memory: &serde_json::Value) -> Result<(), MemoryError>;
}

/// An agent and its step, as a simulation takes it.
#[derive(Debug)]
pub struct Member {
    /// The agent.
    pub agent: Box<dyn Agent>,
    /// The time between its instants.
    pub step: StepSize,
}

impl Member {
    /// An agent that lives at the whole multiples of this step.
    pub fn new(agent: impl Agent, step: StepSize) -> Self {
        Self {
            agent: Box::new(agent),
            step,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn prop_published_survives_an_array(values in prop::array::uniform18(-1e3..1e3_f64)) {
            let published = Published::from_array(&values);
            prop_assert_eq!(published.to_array(), values);
            prop_assert!(published.is_finite());
        }

        #[test]
        fn prop_one_bad_number_is_seen(place in 0..18_usize, bad in prop::sample::select(vec![f64::NAN, f64::INFINITY])) {
            let mut values = [1.0; 18];
            values[place] = bad;
            prop_assert!(!Published::from_array(&values).is_finite());
        }
    }
}
