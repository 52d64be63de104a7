//! The step sizes of the agents in the energy transmission simulations: table G.4.
//!
//! The thesis' values are not available; these are the project's, each with its reason. Experiments print them, with what
//! halving them changes, and scenarios start from them.

use crate::clock::StepSize;

/// A step size and why it is that long.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DeclaredStep {
    /// What has it: an agent's kind, or the black box.
    pub of: &'static str,
    /// The step.
    pub step: StepSize,
    /// Why, in a phrase.
    pub reason: &'static str,
}

/// Quadrotors at every level.
pub const QUADROTOR: DeclaredStep = DeclaredStep {
    of: "quadrotor",
    step: StepSize::MILLISECOND,
    reason: "commands are held over a step: a seventh of the time constant of c3's fastest pole, 146 rad/s",
};

/// Energy transmission systems.
pub const ETS: DeclaredStep = DeclaredStep {
    of: "ets",
    step: StepSize::MILLISECOND.times(2),
    reason: "a twenty-fifth of the gimbal's lag of 50 ms; frames, 33 ms apart, come late by less than this",
};

/// Fixed and scripted targets.
pub const TARGET: DeclaredStep = DeclaredStep {
    of: "target",
    step: StepSize::MILLISECOND,
    reason: "exact at any step; who looks at it sees it late by less than this",
};

/// Black boxes.
pub const BLACK_BOX: DeclaredStep = DeclaredStep {
    of: "black box",
    step: StepSize::MILLISECOND.times(20),
    reason: "fifty rows a second draw every motion of the vehicle",
};

/// All of them.
pub const ALL: [DeclaredStep; 4] = [QUADROTOR, ETS, TARGET, BLACK_BOX];
