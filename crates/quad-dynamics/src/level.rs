//! The table of levels: one row each, which everybody asks who must know what a level is.
//!
//! A row says what its model can't know by itself: number, own phenomena, and the structure that enters with it. All else (what
//! phenomena a level can have, how many states, their natural sizes, the fastest pole, whether there is a battery) is asked of the
//! row's model. A new level is a row here and a model, most often a new rotor in a [`crate::Quadrotor`].
//!
//! Source: thesis chapters 5.1.4 and 5.3.

use crate::{
    Capabilities, Feature, InFlight, Level1, Phenomenon, PhenomenonSet, Prerequisite, Quadrotor,
    QuadrotorModel, StateOf,
};
use quad_math::{Flat, Real};
use quad_rotor::{Battery, ConstantVoltage, FirstOrderRotor, IdealRotor, LinearRotor, NonLinearRotor};
use serde::{Deserialize, Serialize};
use std::fmt;

/// Level 2: non-linear rigid body, ideal rotors.
pub type Level2<R> = Quadrotor<R, IdealRotor<R>, ConstantVoltage<R>>;
/// Level 3: non-linear rigid body, first-order rotors.
pub type Level3<R> = Quadrotor<R, FirstOrderRotor<R>, ConstantVoltage<R>>;
/// Level 4: non-linear rigid body, identified linear rotors.
pub type Level4<R> = Quadrotor<R, LinearRotor<R>, ConstantVoltage<R>>;
/// Level 5: non-linear rigid body, identified non-linear rotors on a battery.
pub type Level5<R> = Quadrotor<R, NonLinearRotor<R>, Battery<R>>;

/// A model that is a level of the family.
pub trait LevelModel<R: Real>: QuadrotorModel<R> + Clone + fmt::Debug + Send + Sync + 'static {
    /// The level.
    const LEVEL: Level;

    /// The quadrotor as one whose level is known at run time only.
    fn any(quadrotor: InFlight<R, Self>) -> AnyQuadrotor<R>;
}

/// What to do with the model of a level that is known at run time only: a closure that is generic in a type.
pub trait WithLevel<R: Real> {
    /// What comes of it.
    type Out;

    /// Does it.
    fn with<M: LevelModel<R>>(self) -> Self::Out;
}

/// What to do with a quadrotor whose level is known at run time only: a closure that is generic in a type.
pub trait WithQuadrotor<R: Real> {
    /// What comes of it.
    type Out;

    /// Does it.
    fn with<M: LevelModel<R>>(self, quadrotor: &mut InFlight<R, M>) -> Self::Out;
}

/// Makes everything that lists the levels, so that none can be forgotten. The leading `$` is passed in for the macro inside.
macro_rules! levels {
    ($d:tt $(
        $(#[$doc:meta])*
        $level:ident = $number:literal {
            model: $model:ident,
            phenomena: [$($phenomenon:ident),*],
            structure: [$($feature:ident),*],
        }
    )+) => {
        /// A level of resolution of the family. In files: its number, from 1.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
        #[serde(try_from = "u8", into = "u8")]
        #[repr(u8)]
        pub enum Level {
            $($(#[$doc])* $level = $number,)+
        }

        impl Level {
            /// All levels, lowest first.
            pub const ALL: [Self; [$($number),+].len()] = [$(Self::$level),+];

            /// The phenomena that belong to the level, unless a user switches others on or off.
            pub fn phenomena(self) -> PhenomenonSet {
                let own: &[Phenomenon] = match self {
                    $(Self::$level => &[$(Phenomenon::$phenomenon),*],)+
                };
                own.iter().copied().collect()
            }

            /// The structure that enters with the level; levels above have it too.
            pub const fn structure(self) -> &'static [Feature] {
                match self {
                    $(Self::$level => &[$(Feature::$feature),*],)+
                }
            }

            /// What the level's model brings along.
            pub const fn capabilities(self) -> Capabilities {
                match self {
                    $(Self::$level => <$model<f64> as QuadrotorModel<f64>>::CAPABILITIES,)+
                }
            }

            /// How many numbers the level's state has.
            pub const fn states(self) -> usize {
                match self {
                    $(Self::$level => <StateOf<f64, $model<f64>> as Flat<f64>>::LEN,)+
                }
            }

            /// Does something with the level's model.
            pub fn visit<R: Real, V: WithLevel<R>>(self, visitor: V) -> V::Out {
                match self {
                    $(Self::$level => visitor.with::<$model<R>>(),)+
                }
            }
        }

        /// A flying quadrotor of any level: model and state in one value, so that they can't be mismatched.
        #[derive(Clone, Debug)]
        pub enum AnyQuadrotor<R: Real> {
            $($(#[$doc])* $level(InFlight<R, $model<R>>),)+
        }

        $(impl<R: Real> LevelModel<R> for $model<R> {
            const LEVEL: Level = Level::$level;

            fn any(quadrotor: InFlight<R, Self>) -> AnyQuadrotor<R> {
                AnyQuadrotor::$level(quadrotor)
            }
        })+

        /// The same expression for whichever level is inside.
        macro_rules! each_level {
            ($d quadrotor:expr, $d inner:ident => $d body:expr) => {
                match $d quadrotor {
                    $($crate::AnyQuadrotor::$level($d inner) => $d body,)+
                }
            };
        }
    };
}

levels! { $
    /// Linear: the rigid body linearised about hover at the present heading, ideal rotors.
    One = 1 {
        model: Level1,
        phenomena: [],
        structure: [],
    }
    /// Non-linear rigid body, ideal rotors.
    Two = 2 {
        model: Level2,
        phenomena: [],
        structure: [NonLinearRigidBody],
    }
    /// As 2 with first-order rotors.
    Three = 3 {
        model: Level3,
        phenomena: [],
        structure: [RotorLag],
    }
    /// As 2 with identified linear rotors, drag and gyroscopic torque.
    Four = 4 {
        model: Level4,
        phenomena: [Drag, GyroscopicTorque],
        structure: [IdentifiedRotorDynamics],
    }
    /// As 4 with identified non-linear rotors, limits and battery voltage.
    Five = 5 {
        model: Level5,
        phenomena: [Drag, GyroscopicTorque, InputLimits, VoltageSag],
        structure: [NonLinearRotor, VoltageDependence],
    }
}

// Levels are counted from 1 without a gap.
const _: () = {
    let mut i = 0;
    while i < Level::ALL.len() {
        assert!(Level::ALL[i].number() as usize == i + 1);
        i += 1;
    }
};

impl Level {
    /// The lowest level.
    pub const LOWEST: Self = Self::ALL[0];

    /// The highest level: the reference that the others are compared with.
    pub const HIGHEST: Self = Self::ALL[Self::ALL.len() - 1];

    /// The number, from 1.
    pub const fn number(self) -> u8 {
        self as u8
    }

    /// The next level above.
    pub fn above(self) -> Option<Self> {
        Self::try_from(self.number() + 1).ok()
    }

    /// The next level below.
    pub fn below(self) -> Option<Self> {
        Self::try_from(self.number() - 1).ok()
    }
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "level {}", self.number())
    }
}

/// A number that is no level.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown level {number}; the family has {}", named(&Level::ALL))]
pub struct NoSuchLevel {
    /// The number.
    pub number: u8,
}

impl TryFrom<u8> for Level {
    type Error = NoSuchLevel;

    fn try_from(number: u8) -> Result<Self, NoSuchLevel> {
        Self::ALL
            .into_iter()
            .find(|l| l.number() == number)
            .ok_or(NoSuchLevel { number })
    }
}

impl From<Level> for u8 {
    fn from(level: Level) -> Self {
        level.number()
    }
}

/// Neighbouring levels in words: `level 3`, `levels 4 and 5`, `levels 2 to 5`.
fn named(levels: &[Level]) -> String {
    match levels {
        [] => "no level".to_owned(),
        [only] => only.to_string(),
        [first, second] => format!("levels {} and {}", first.number(), second.number()),
        [first, .., last] => format!("levels {} to {}", first.number(), last.number()),
    }
}

/// With the levels that meet it.
impl fmt::Display for Prerequisite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let met_by: Vec<_> = Level::ALL
            .into_iter()
            .filter(|level| self.is_met(level.capabilities(), &PhenomenonSet::none()))
            .collect();
        let levels = named(&met_by);
        match self {
            Self::None | Self::AirRelativeDrag => f.write_str(self.phrase()),
            Self::AerodynamicRotorTorque => {
                let highest_met = met_by.last();
                let others: Vec<_> = Level::ALL
                    .into_iter()
                    .filter(|level| Some(level) > highest_met)
                    .collect();
                write!(
                    f,
                    "{} ({levels}; the identified torque of {} contains the spin-up)",
                    self.phrase(),
                    named(&others)
                )
            }
            _ => write!(f, "{} ({levels})", self.phrase()),
        }
    }
}
