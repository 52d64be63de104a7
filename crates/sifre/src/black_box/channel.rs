//! Channels: what a recorded number is.

use serde::{Deserialize, Serialize};

/// What part a recorded number plays for its agent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Role {
    /// Part of its state.
    State,
    /// What drives it: commands, wind.
    Input,
    /// What follows from state and inputs.
    Output,
    /// What it is asked to do.
    Reference,
}

/// The frame whose axes a component is along.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Frame {
    /// W: north-east-down.
    World,
    /// B: forward-right-down.
    Body,
    /// E: the platform of an energy transmission system.
    Platform,
    /// C: the camera.
    Camera,
    /// Not a component of a vector.
    Scalar,
}

/// One recorded number: its name, unit, frame and role.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Channel {
    /// Name, as in `position.x`; in a recording with the agent's name before it, `alpha.position.x`.
    pub name: String,
    /// What part it plays.
    pub role: Role,
    /// SI unit, as in `m/s`; `1` for a pure number.
    pub unit: String,
    /// The frame of a component.
    pub frame: Frame,
}

impl Channel {
    /// A channel.
    pub fn new(name: impl Into<String>, role: Role, unit: impl Into<String>, frame: Frame) -> Self {
        Self {
            name: name.into(),
            role,
            unit: unit.into(),
            frame,
        }
    }

    /// A channel for each component of a vector: `name.x` and so on, for these endings.
    pub fn group<const N: usize>(
        name: &str,
        endings: [&str; N],
        role: Role,
        unit: &str,
        frame: Frame,
    ) -> [Self; N] {
        endings.map(|ending| Self::new(format!("{name}.{ending}"), role, unit, frame))
    }

    /// The channel with its agent's name before its own.
    pub(crate) fn of(mut self, agent: &str) -> Self {
        self.name = format!("{agent}.{}", self.name);
        self
    }
}
