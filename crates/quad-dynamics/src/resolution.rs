//! Resolution, reported and not asserted: what a model of the family contains.
//!
//! 'Higher than' is the inclusion of what models contain, which is a partial order: with drag switched on
//! at level 2 and off at level 3, neither is higher. Source: thesis chapter 5.1.4 (the notion); the measure
//! by inclusion is this project's choice.

use crate::{Level, Phenomenon, PhenomenonSet};
use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::fmt;

/// Something that a model contains.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Feature {
    /// The rigid body's coupling and large angles.
    NonLinearRigidBody,
    /// Thrust that follows its command with a lag.
    RotorLag,
    /// Identified transfer functions of thrust and torque.
    IdentifiedRotorDynamics,
    /// Thrust and torque that are not linear in the command.
    NonLinearRotor,
    /// Thrust and torque that depend on the battery voltage.
    VoltageDependence,
    /// A part that switches on and off.
    Phenomenon(Phenomenon),
}

impl fmt::Display for Feature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NonLinearRigidBody => "non-linear rigid body",
            Self::RotorLag => "rotor lag",
            Self::IdentifiedRotorDynamics => "identified rotor dynamics",
            Self::NonLinearRotor => "non-linear rotor",
            Self::VoltageDependence => "voltage dependence",
            Self::Phenomenon(phenomenon) => return phenomenon.fmt(f),
        })
    }
}

/// What a model of the family is like.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Resolution {
    /// Its level.
    pub level: Level,
    /// How many numbers its state has.
    pub states: usize,
    /// How many inputs it has.
    pub inputs: usize,
    /// What it contains.
    pub features: BTreeSet<Feature>,
}

impl Resolution {
    /// The resolution of a level with these phenomena switched on.
    pub fn of(level: Level, phenomena: &PhenomenonSet) -> Self {
        let structure = structure_up_to(level);
        let parts = phenomena.0.iter().map(|p| Feature::Phenomenon(*p));
        Self {
            level,
            states: level.states(),
            inputs: 4,
            features: structure.chain(parts).collect(),
        }
    }

    /// Whether the model is linear (at a fixed heading).
    pub fn is_linear(&self) -> bool {
        self.features.is_empty()
    }

    /// Whether the rotors are identified from measurements rather than given by gains.
    pub fn is_empirical(&self) -> bool {
        self.features.contains(&Feature::IdentifiedRotorDynamics)
    }

    /// The highest level all of whose structure is among these features.
    pub fn highest_level_within(features: &BTreeSet<Feature>) -> Level {
        let complete = |level: &Level| structure_up_to(*level).all(|feature| features.contains(&feature));
        Level::ALL.into_iter().rfind(complete).unwrap_or(Level::LOWEST)
    }

    /// What this model has and the other lacks.
    pub fn beyond(&self, other: &Self) -> Vec<Feature> {
        self.features.difference(&other.features).copied().collect()
    }
}

/// The structure of a level: what enters with it and with those below.
fn structure_up_to(level: Level) -> impl Iterator<Item = Feature> {
    let levels = Level::ALL.into_iter().filter(move |other| *other <= level);
    levels.flat_map(|level| level.structure().iter().copied())
}

/// By inclusion of features: `None` where each has something that the other lacks.
impl PartialOrd for Resolution {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        match (
            self.features.is_subset(&other.features),
            other.features.is_subset(&self.features),
        ) {
            (true, true) if self == other => Some(Ordering::Equal),
            (true, false) => Some(Ordering::Less),
            (false, true) => Some(Ordering::Greater),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thesis_levels_rise_in_resolution() {
        let all = Level::ALL.map(|level| Resolution::of(level, &level.phenomena()));
        assert!(all.windows(2).all(|pair| pair[0] < pair[1]));
        // Quaternions take one number more than angles; 12 + rotor states in the source.
        assert_eq!(all.each_ref().map(|r| r.states), [12, 13, 17, 29, 30]);
        assert!(all[0].is_linear() && !all[1].is_linear());
        assert!(all[3].is_empirical() && !all[2].is_empirical());
    }

    #[test]
    fn exact_order_is_partial() {
        let with_drag = Resolution::of(Level::Two, &PhenomenonSet::none().with(Phenomenon::Drag));
        let without = Resolution::of(Level::Three, &PhenomenonSet::none());
        assert_eq!(with_drag.partial_cmp(&without), None);
        assert_eq!(
            with_drag.beyond(&without),
            [Feature::Phenomenon(Phenomenon::Drag)]
        );
    }
}
