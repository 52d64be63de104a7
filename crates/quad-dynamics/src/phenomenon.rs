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
    /// Thrust that grows near the ground ([`crate::GroundEffect`]).
    GroundEffect,
    /// Arms that block the slipstream and are dragged down by it ([`crate::Blockage`]).
    Blockage,
    /// Random gusts about the mean wind ([`crate::Dryden`]) and how they turn ([`crate::DrydenRotation`]).
    Turbulence,
    /// Mean wind that grows with height ([`crate::Shear`]).
    WindShear,
    /// Random forces and moments that nothing else explains ([`crate::ProcessNoise`]).
    ProcessNoise,
}

impl Phenomenon {
    /// All of them, in the order of the declaration.
    pub const ALL: [Self; 10] = [
        Self::Drag,
        Self::GyroscopicTorque,
        Self::SpinUpReaction,
        Self::InputLimits,
        Self::VoltageSag,
        Self::GroundEffect,
        Self::Blockage,
        Self::Turbulence,
        Self::WindShear,
        Self::ProcessNoise,
    ];

    /// What it adds to a model's resolution, in a phrase.
    pub const fn contribution(self) -> &'static str {
        match self {
            Self::Drag => "force against the air-relative velocity, damping of the body rates",
            Self::GyroscopicTorque => "coupling of roll and pitch by the rotors' angular momentum",
            Self::SpinUpReaction => "yaw torque of accelerating rotors",
            Self::InputLimits => "saturation of the commands",
            Self::VoltageSag => "thrust that falls with load and charge; one state, the charge drawn",
            Self::GroundEffect => "thrust that depends on each rotor's height above the ground",
            Self::Blockage => "thrust lost to the arms in the slipstream, by induced velocity and climb",
            Self::Turbulence => {
                "random gusts that push and turn; eight states of the shaping filters, outside the model"
            }
            Self::WindShear => "mean wind that depends on height",
            Self::ProcessNoise => "random acceleration and angular acceleration, white",
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
            Self::GroundEffect => Prerequisite::NonLinearRigidBody,
            Self::Blockage => Prerequisite::InducedVelocity,
            Self::Turbulence | Self::WindShear => Prerequisite::AirRelativeDrag,
            Self::ProcessNoise => Prerequisite::None,
        }
    }

    /// Where the equation comes from.
    pub const fn source(self) -> &'static str {
        match self {
            Self::Drag | Self::GyroscopicTorque | Self::SpinUpReaction => "thesis 3.4",
            Self::InputLimits => "thesis 3.6",
            Self::VoltageSag => "Tremblay and Dessaint (2009)",
            Self::GroundEffect => "Cheeseman and Bennett (1955)",
            Self::Blockage => "Leishman (2006), Hoerner (1965)",
            Self::Turbulence | Self::WindShear => "MIL-F-8785C (1980)",
            Self::ProcessNoise => "Gelb (1974)",
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
            Self::GroundEffect => "ground-effect",
            Self::Blockage => "blockage",
            Self::Turbulence => "turbulence",
            Self::WindShear => "wind-shear",
            Self::ProcessNoise => "process-noise",
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
    /// A non-linear rigid body.
    NonLinearRigidBody,
    /// A non-linear rigid body, and rotor speeds: a propeller law, or speed states.
    RotorSpeed,
    /// Rotors with dynamics whose torque is aerodynamic only; an identified reaction torque
    /// contains the spin-up already.
    AerodynamicRotorTorque,
    /// Rotors whose thrust depends on the battery voltage.
    VoltageDependentRotor,
    /// A non-linear rigid body, and propellers whose thrust and disc give an induced velocity.
    InducedVelocity,
    /// The phenomenon [`Phenomenon::Drag`], through which a model feels the air move.
    AirRelativeDrag,
}

/// What a model brings along that a phenomenon may need.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Capabilities {
    /// Whether its rigid body is non-linear; its state then begins with a [`crate::RigidBodyState`].
    pub non_linear_rigid_body: bool,
    /// Whether its rotors' spin-up is not part of their torque already.
    pub separate_spin_up: bool,
    /// Whether its rotors feel the battery voltage.
    pub feels_voltage: bool,
    /// Whether it has a battery, which remembers the charge drawn.
    pub has_battery: bool,
}

impl Prerequisite {
    /// Whether a model that brings this along, with these phenomena switched on, has what it takes.
    pub fn is_met(self, model: Capabilities, phenomena: &PhenomenonSet) -> bool {
        match self {
            Self::None => true,
            Self::NonLinearRigidBody | Self::RotorSpeed | Self::InducedVelocity => {
                model.non_linear_rigid_body
            }
            Self::AerodynamicRotorTorque => model.separate_spin_up,
            Self::VoltageDependentRotor => model.feels_voltage,
            Self::AirRelativeDrag => phenomena.contains(Phenomenon::Drag),
        }
    }

    /// What it asks for, in a phrase; shown with the levels that have it.
    pub(crate) const fn phrase(self) -> &'static str {
        match self {
            Self::None => "nothing",
            Self::NonLinearRigidBody => "a non-linear rigid body",
            Self::RotorSpeed => "rotor speeds on a non-linear rigid body",
            Self::AerodynamicRotorTorque => "rotor dynamics with aerodynamic torque only",
            Self::VoltageDependentRotor => "rotors that depend on the battery voltage",
            Self::InducedVelocity => "the propellers' induced velocity on a non-linear rigid body",
            Self::AirRelativeDrag => "the phenomenon drag, through which the air is felt",
        }
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

    /// The first phenomenon of the set that needs what this model, with this set, doesn't have.
    pub fn first_unmet(&self, model: Capabilities) -> Option<Phenomenon> {
        let is_met = |p: &Phenomenon| p.prerequisite().is_met(model, self);
        self.0.iter().copied().find(|p| !is_met(p))
    }

    /// What is left of the set at a model: without what needs what the model doesn't have.
    #[must_use]
    pub fn admitted_by(&self, model: Capabilities) -> Self {
        let mut left = self.clone();
        while let Some(unmet) = left.first_unmet(model) {
            left.0.remove(&unmet);
        }
        left
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
