//! Dynamic resolution: a quadrotor that flies at a fine level near another agent and at a coarse one far from it.
//!
//! ```text
//! d ≤ d_fine      fine
//! d ≥ d_coarse    coarse
//! in between      as it was (hysteresis); at the start fine
//! ```
//!
//! with the distance d between what both have published. Every change is a lift or a restriction of the state and an event.

use super::LevelChoice;
use serde::{Deserialize, Serialize};

/// Which level where.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LevelRule {
    /// Name of the agent whose distance counts.
    pub near: String,
    /// The level near it.
    pub fine: LevelChoice,
    /// The level far from it.
    pub coarse: LevelChoice,
    /// Fine from this distance down, m.
    pub fine_within_m: f64,
    /// Coarse from this distance up, m; above the other.
    pub coarse_beyond_m: f64,
}

/// Which of a rule's levels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// Near.
    Fine,
    /// Far.
    Coarse,
}

/// Distances that make no rule.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "a level rule needs 0 < fine_within_m < coarse_beyond_m (the gap keeps the level from flickering), got {fine_within_m} m and {coarse_beyond_m} m"
)]
pub struct RuleError {
    /// Fine from this distance down, m.
    pub fine_within_m: f64,
    /// Coarse from this distance up, m.
    pub coarse_beyond_m: f64,
}

impl LevelRule {
    pub(super) fn check(&self) -> Result<(), RuleError> {
        let Self {
            fine_within_m,
            coarse_beyond_m,
            ..
        } = *self;
        if fine_within_m > 0.0 && coarse_beyond_m > fine_within_m && coarse_beyond_m.is_finite() {
            Ok(())
        } else {
            Err(RuleError {
                fine_within_m,
                coarse_beyond_m,
            })
        }
    }

    /// The side at a distance, m, after having been on another.
    pub(super) fn side(&self, distance_m: f64, before: Option<Side>) -> Side {
        if distance_m <= self.fine_within_m {
            Side::Fine
        } else if distance_m >= self.coarse_beyond_m {
            Side::Coarse
        } else {
            before.unwrap_or(Side::Fine)
        }
    }
}

impl Side {
    /// Its place among the rule's models.
    pub(super) fn place(self) -> usize {
        match self {
            Self::Fine => 0,
            Self::Coarse => 1,
        }
    }

    /// The side at a place.
    pub(super) fn at(place: usize) -> Self {
        match place {
            0 => Self::Fine,
            _ => Self::Coarse,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quad_dynamics::Level;

    fn rule() -> LevelRule {
        LevelRule {
            near: "station".into(),
            fine: Level::HIGHEST.into(),
            coarse: Level::Two.into(),
            fine_within_m: 2.0,
            coarse_beyond_m: 3.0,
        }
    }

    #[test]
    fn exact_hysteresis() {
        let (fine, coarse) = (Some(Side::Fine), Some(Side::Coarse));
        for (distance, before, expected) in [
            (1.0, coarse, Side::Fine),
            (2.0, coarse, Side::Fine),
            (2.5, coarse, Side::Coarse),
            (2.5, fine, Side::Fine),
            (2.5, None, Side::Fine),
            (3.0, fine, Side::Coarse),
        ] {
            assert_eq!(rule().side(distance, before), expected, "{distance}");
        }
    }

    #[test]
    fn exact_wrong_distances_are_errors() {
        for (fine_within_m, coarse_beyond_m) in [
            (3.0, 2.0),
            (2.0, 2.0),
            (-1.0, 2.0),
            (1.0, f64::NAN),
            (f64::NAN, 1.0),
        ] {
            let rule = LevelRule {
                fine_within_m,
                coarse_beyond_m,
                ..rule()
            };
            assert!(rule.check().is_err(), "{fine_within_m} {coarse_beyond_m}");
        }
        assert!(rule().check().is_ok());
    }
}
