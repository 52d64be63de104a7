//! What the agents of a recording look like.

use ets::Station;
use quad_dynamics::Level;

/// Arm of the quadrotor that is drawn where nothing else is said, m: the Qball-X4's (Quanser, *Qball-X4 User Manual*).
pub const NOMINAL_ARM_M: f64 = 0.2;

/// Colours of the levels, lowest first: those of Okabe and Ito that the figures use, safe for colour-blind readers.
pub const LEVEL_COLOURS: [&str; Level::ALL.len()] = {
    const PALETTE: [&str; 6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];
    let mut colours = [""; Level::ALL.len()];
    let mut i = 0;
    while i < colours.len() {
        colours[i] = PALETTE[i % PALETTE.len()];
        i += 1;
    }
    colours
};

/// What is to be seen: a title and the agents.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Title of the page.
    pub title: String,
    /// The agents.
    pub agents: Vec<SceneAgent>,
}

/// One agent: the name before its channels, and its looks.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneAgent {
    /// Name, as in the recording's channels `name.position.x`.
    pub name: String,
    /// What it looks like.
    pub kind: Kind,
}

/// What an agent looks like.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// A quadrotor with four rotors on crossed arms, in the colour of its recorded level.
    Quadrotor {
        /// From the centre of mass to a rotor's axis, m.
        arm_m: f64,
    },
    /// A ground station with gimbal, camera and beam.
    Ets {
        /// Name of the agent that it tracks: who carries its receiver.
        tracks: String,
        /// Its parameters: where it stands, lens, beam, receiver, limits.
        station: Box<Station>,
    },
    /// A point.
    Target,
}

impl Kind {
    /// The kind in words.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Quadrotor { .. } => "quadrotor",
            Self::Ets { .. } => "ground station",
            Self::Target => "target",
        }
    }
}

impl Scene {
    /// A scene without agents.
    pub fn new(title: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            agents: Vec::new(),
        }
    }

    /// Adds an agent.
    #[must_use]
    pub fn with(mut self, name: impl Into<String>, kind: Kind) -> Self {
        self.agents.push(SceneAgent {
            name: name.into(),
            kind,
        });
        self
    }

    /// Adds a quadrotor with arms of this length, m.
    #[must_use]
    pub fn quadrotor(self, name: impl Into<String>, arm_m: f64) -> Self {
        self.with(name, Kind::Quadrotor { arm_m })
    }

    /// Adds a ground station that tracks this agent.
    #[must_use]
    pub fn ets(self, name: impl Into<String>, tracks: impl Into<String>, station: &Station) -> Self {
        self.with(
            name,
            Kind::Ets {
                tracks: tracks.into(),
                station: Box::new(station.clone()),
            },
        )
    }

    /// Adds a target.
    #[must_use]
    pub fn target(self, name: impl Into<String>) -> Self {
        self.with(name, Kind::Target)
    }
}
