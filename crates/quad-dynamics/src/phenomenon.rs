//! The parts of a model that switch on and off, and the sets of them that order models by resolution.

use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::fmt;

/// A part of a model that can be switched on and off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Phenomenon {
    /// Quadratic drag against the air and damping of the body rates.
    Drag,
    /// Gyroscopic torque of the spinning rotors.
    GyroscopicTorque,
    /// Reaction of the airframe to the rotors' spin acceleration.
    SpinUpReaction,
    /// Limits on the magnitude of the PWM commands.
    InputLimits,
    /// Battery voltage that falls with load and charge.
    VoltageSag,
}

impl Phenomenon {
    /// All of them, in the order of the declaration.
    pub const ALL: [Self; 5] = [
        Self::Drag,
        Self::GyroscopicTorque,
        Self::SpinUpReaction,
        Self::InputLimits,
        Self::VoltageSag,
    ];

    /// What it adds to a model's resolution, in a phrase.
    pub const fn contribution(self) -> &'static str {
        match self {
            Self::Drag => "force against the air-relative velocity, damping of the body rates",
            Self::GyroscopicTorque => "coupling of roll and pitch by the rotors' angular momentum",
            Self::SpinUpReaction => "yaw torque of accelerating rotors",
            Self::InputLimits => "saturation of the commands",
            Self::VoltageSag => "thrust that falls with load and charge; one state, the charge drawn",
        }
    }

    /// What a model must have before it can have this.
    pub const fn prerequisite(self) -> Prerequisite {
        match self {
            Self::Drag => Prerequisite::NonLinearRigidBody,
            Self::GyroscopicTorque => Prerequisite::RotorSpeed,
            Self::SpinUpReaction => Prerequisite::AerodynamicRotorTorque,
            Self::InputLimits => Prerequisite::None,
            Self::VoltageSag => Prerequisite::VoltageDependentRotor,
        }
    }

    /// The name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Drag => "drag",
            Self::GyroscopicTorque => "gyroscopic-torque",
            Self::SpinUpReaction => "spin-up-reaction",
            Self::InputLimits => "input-limits",
            Self::VoltageSag => "voltage-sag",
        }
    }
}

impl fmt::Display for Phenomenon {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// What a phenomenon needs of the model that is to have it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Prerequisite {
    /// Nothing.
    None,
    /// A non-linear rigid body (levels 2 and up).
    NonLinearRigidBody,
    /// A non-linear rigid body, and rotor speeds: a propeller law, or speed states.
    RotorSpeed,
    /// Rotors with dynamics whose torque is aerodynamic only (level 3); an identified reaction torque
    /// contains the spin-up already.
    AerodynamicRotorTorque,
    /// Rotors whose thrust depends on the battery voltage (level 5).
    VoltageDependentRotor,
}

impl fmt::Display for Prerequisite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::None => "nothing",
            Self::NonLinearRigidBody => "a non-linear rigid body (levels 2 to 5)",
            Self::RotorSpeed => "rotor speeds on a non-linear rigid body (levels 2 to 5)",
            Self::AerodynamicRotorTorque => {
                "rotor dynamics with aerodynamic torque only (level 3; the identified torque of levels 4 and 5 \
                 contains the spin-up)"
            }
            Self::VoltageDependentRotor => "rotors that depend on the battery voltage (level 5)",
        })
    }
}

/// A set of phenomena; sets are ordered by inclusion, which is a partial order.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct PhenomenonSet(pub BTreeSet<Phenomenon>);

impl PhenomenonSet {
    /// Nothing switched on.
    pub fn none() -> Self {
        Self::default()
    }

    /// Whether the phenomenon is in the set.
    pub fn contains(&self, phenomenon: Phenomenon) -> bool {
        self.0.contains(&phenomenon)
    }

    /// This set with the phenomenon.
    #[must_use]
    pub fn with(mut self, phenomenon: Phenomenon) -> Self {
        self.0.insert(phenomenon);
        self
    }

    /// This set without the phenomenon.
    #[must_use]
    pub fn without(mut self, phenomenon: Phenomenon) -> Self {
        self.0.remove(&phenomenon);
        self
    }

    /// Whether every phenomenon of this set is in the other.
    pub fn is_subset(&self, other: &Self) -> bool {
        self.0.is_subset(&other.0)
    }
}

impl FromIterator<Phenomenon> for PhenomenonSet {
    fn from_iter<I: IntoIterator<Item = Phenomenon>>(phenomena: I) -> Self {
        Self(phenomena.into_iter().collect())
    }
}

impl fmt::Display for PhenomenonSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<&str> = self.0.iter().map(|p| p.name()).collect();
        f.write_str(&names.join(", "))
    }
}
